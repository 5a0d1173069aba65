# SPDX-License-Identifier: MIT
# lampion brdf: values through every format, tables, images, and what it refuses.
set -eu
. tests/checks/common.sh
export XDG_CACHE_HOME="$WORK/cache"

# A material and its files must give the same values.
cat >"$WORK/pairs" <<'END'
wi_x,wi_y,wi_z,wo_x,wo_y,wo_z
0,0,1,0,0.6,0.8
0.6,0,0.8,-0.6,0,0.8
0.48,0.64,0.6,-0.6,0,0.8
END
"$PROGRAM" brdf eval lambert:0.5,0.25,1 <"$WORK/pairs" >"$WORK/lambert"
printf 'r,g,b\n' >"$WORK/expected"
for i in 1 2 3; do printf '0.159154937,0.0795774683,0.318309873\n'; done >>"$WORK/expected"
diff "$WORK/expected" "$WORK/lambert" || fail "values of a Lambert material"
tail -n +2 "$WORK/pairs" | "$PROGRAM" brdf eval lambert:0.5,0.25,1 | diff "$WORK/expected" - ||
    fail "the header line is not optional"
"$PROGRAM" brdf convert lambert:0.5,0.25,1 -o "$WORK/l.binary"
[ "$(wc -c <"$WORK/l.binary")" -eq 34992012 ] || fail "size of a MERL file"
"$PROGRAM" brdf eval "$WORK/l.binary" <"$WORK/pairs" | diff "$WORK/expected" - ||
    fail "values through a MERL file"

# glTF's factors are a GGX: a dielectric under its layer, or a metal.
"$PROGRAM" brdf eval ggx:0.25:0.04:0.4,0.2,0.1 <"$WORK/pairs" >"$WORK/expected"
"$PROGRAM" brdf eval gltf:0.4,0.2,0.1:0.5:0 <"$WORK/pairs" | diff "$WORK/expected" - || fail "values of a glTF dielectric"
"$PROGRAM" brdf eval ggx:0.25:0.4,0.2,0.1 <"$WORK/pairs" >"$WORK/expected"
"$PROGRAM" brdf eval gltf:0.4,0.2,0.1:0.5:1 <"$WORK/pairs" | diff "$WORK/expected" - || fail "values of a glTF metal"

# Tables must be the same from the cache, and hold what was asked for.
"$PROGRAM" brdf bake phong:20 -o "$WORK/a.lmpt" --bands 6 --views 8
"$PROGRAM" brdf bake phong:20 -o "$WORK/b.lmpt" --bands 6 --views 8
cmp "$WORK/a.lmpt" "$WORK/b.lmpt" || fail "a table from the cache differs"
"$PROGRAM" brdf info "$WORK/a.lmpt" | grep -q '^bands      6$' || fail "info of a table"
"$PROGRAM" brdf info ggx:0.5x0.2 --views 4 --azimuths 4 | grep -q 'anisotropic' || fail "info"
"$PROGRAM" brdf plot ggx:0.5 -o "$WORK/plot.png" --bands 8 --size 200x200
[ -s "$WORK/plot.png" ] || fail "no plot"
[ "$("$PROGRAM" brdf list | wc -l)" -eq 100 ] || fail "not 100 SGD materials"

# Refusals print one line that names the file, exit with 1 (usage 2), and leave no output behind.
refuse() {
    status=$1 text=$2
    shift 2
    code=0
    "$PROGRAM" brdf "$@" >"$WORK/out" 2>"$WORK/err" </dev/null || code=$?
    [ $code -eq $status ] || fail "brdf $*: exit $code"
    grep -q -e "$text" "$WORK/err" || fail "brdf $*: $(cat "$WORK/err")"
    [ $status -eq 2 ] || [ "$(wc -l <"$WORK/err")" -eq 1 ] || fail "brdf $*: more than one line"
}
refuse 1 'sgd:gold-metallic-paint?' info sgd:gold-metalic-paint
refuse 1 'ggx:ALPHA' info ggx:rough
refuse 1 'ALPHA is 7, out of range (0.001 to 1)' info ggx:7
refuse 1 'ALPHA is 3, out of range (0.001 to 1)' info ggx:0.2x3
refuse 1 'F0 is 1.5, out of range (0 to 1)' info ggx:0.2:1,1.5,1
refuse 1 'gltf:COLOR' info gltf:0.5:0.5
refuse 1 'METALLIC is 2, out of range (0 to 1)' info gltf:0.5:0.5:2
refuse 1 'COLOR is 3, out of range (0 to 1)' info gltf:3:0.5:1
refuse 1 'sheen:ROUGHNESS' info sheen:soft
refuse 1 'ROUGHNESS is 0, out of range (0.07 to 1)' info sheen:0
refuse 1 'EXPONENT is -1, out of range (0 to 1e+06)' info phong:-1
refuse 1 'nickel: does not exist (is it sgd:nickel?)' info nickel
refuse 1 'missing.binary' info "$WORK/missing.binary"
head -c 1000 "$WORK/l.binary" >"$WORK/short.binary"
refuse 1 'short.binary: MERL dimensions 90 x 90 x 180 need 34992012 bytes, the file has 1000' \
    info "$WORK/short.binary"
printf 'tensor_file\000\001\000\003\000\000\000' >"$WORK/short.bsdf"
refuse 1 'the directory ends' info "$WORK/short.bsdf"
{ head -c 100 "$WORK/a.lmpt"; printf 'XXXX'; tail -c +105 "$WORK/a.lmpt"; } >"$WORK/damaged.lmpt"
refuse 1 'checksum' info "$WORK/damaged.lmpt"
refuse 1 'table' eval "$WORK/a.lmpt"
for action in info eval bands list; do
    refuse 2 "$action prints and writes no file: it has no -o" $action lambert:1 -o "$WORK/none.csv"
done
refuse 1 'name it .binary or .bsdf' convert lambert:1 -o "$WORK/x.txt"
refuse 1 'x.png: bake writes a table (name it .lmpt)' bake missing.binary -o "$WORK/x.png"
refuse 1 'x.lmpt: plot writes an image (name it .png)' plot missing.binary -o "$WORK/x.lmpt"
[ ! -e "$WORK/x.txt" ] || fail "an output was left behind"
refuse 2 '-o FILE is needed' plot lambert:1
refuse 2 'needs one MATERIAL' info
refuse 2 'bands needs a MATERIAL' bands
refuse 2 'list takes no MATERIAL' list x
refuse 2 'is not one of info.*did you mean bake' bkae lambert:1
refuse 2 'is not one of info' paint lambert:1
