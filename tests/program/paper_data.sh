# SPDX-License-Identifier: MIT
# lampion paper shows what a folder of data has, by names of files, and says what is the paper's, a fit or a stand-in.
set -eu
. tests/checks/common.sh
unset LAMPION_DATA

# A name is one word, whatever is in it, and the page quotes the command for a shell.
data="$WORK/it's a \\ folder --spp 1"
mkdir -p "$data/data/sponza" "$WORK/more"
own_scene "$data/data/sponza/sponza.gltf"
cat >"$data/data/sponza/sponza_lights.json" <<'END'
{ "lights": [ { "position": [-1, 1, 0], "radius": 0.3, "radiance": [9, 1, 1] },
              { "position": [1, 1, 0], "radius": 0.3, "radiance": [1, 1, 9] } ] }
END
LAMPION_DATA=$data "$PROGRAM" paper -o "$WORK/scene" --quick --step sponza >/dev/null || fail "a scene of the data fails"
! grep -q 'class="failed"' "$WORK/scene/index.html" || fail "a step failed"
grep -qF "it'\\''s a \\ folder --spp 1/data/sponza/sponza_lights.json' --no-shadows --size 660x332" "$WORK/scene/index.html" ||
    fail "the page tells no command"
for said in 'Sponza, 2 sphere lights, 8 bands, 660×332' "On the paper's own data: <b>Sponza</b>" 'Crytek Sponza ©'; do
    grep -qF "$said" "$WORK/scene/index.html" || fail "the page does not say: $said"
done
! grep -q 'stands in' "$WORK/scene/index.html" || fail "the page calls the scene a stand-in"
grep -q '^30 lights on 8 bands in real time,.* ms the frame.*at 660×332.*,"\?Sponza; ' "$WORK/scene/verdict.csv" ||
    fail "the verdict hides what was timed: $(cat "$WORK/scene/verdict.csv")"
for file in figure5-5.png figure5-8.png figure5-floor-8.png figure5-curtain-truth.png figure5-details.csv; do
    [ -s "$WORK/scene/$file" ] && grep -q "$file" "$WORK/scene/index.html" || fail "$file is missing"
done

# An option overrides the environment; without data there are stand-ins.
LAMPION_DATA=$data "$PROGRAM" paper -o "$WORK/stand_in" --quick --step sponza --data "$WORK/more" >/dev/null || fail "the stand-in fails"
for said in 'Here <code>builtin:atrium</code> stands in for it' 'On stand-ins, for want of data: <b>builtin:atrium</b>'; do
    grep -qF "$said" "$WORK/stand_in/index.html" || fail "the page does not say: $said"
done
# What the caption of figure 5 says of more bands must follow from the figures beside it.
set -- $(sed -n 's/^colors show more by 8 bands.*saturation \([0-9.]*\) and \([0-9.]*\), truth.*",\([a-z]*\).*/\1 \2 \3/p' "$WORK/stand_in/verdict.csv")
[ $# = 3 ] || fail "nothing is said of colors: $(cat "$WORK/stand_in/verdict.csv")"
[ "$(awk -v a="$1" -v b="$2" 'BEGIN { print (b >= a ? "holds" : "not") }')" = "$3" ] || fail "colors $1 and $2: $3"

# NAME_rgb.bsdf is a measurement, NAME.binary a fit, and of several folders the first that has one counts.
mkdir "$WORK/more/rgl_neural"
"$PROGRAM" brdf convert sgd:red-fabric -o "$WORK/more/rgl_neural/acrylic_felt_orange.binary"
"$PROGRAM" brdf convert sgd:white-paint -o "$WORK/paper_white_rgb.bsdf"
"$PROGRAM" paper -o "$WORK/materials" --quick --step materials --data "$WORK/more" --data "$WORK" >/dev/null ||
    fail "materials of the data fail"
for material in 'a,paper_white,paper_white (measured)' 'b,ilm_solo_millennium_falcon,silver-metallic-paint (stand-in)' \
    'c,acrylic_felt_orange,acrylic_felt_orange (fit)' 'e,cc_amber_citrine,specular-yellow-phenolic (stand-in)'; do
    grep -qF "$material,10," "$WORK/materials/figure6.csv" || fail "not $material: $(cat "$WORK/materials/figure6.csv")"
done
for said in '(c) acrylic_felt_orange (fit): ground truth' 'On fits, which are not the measurements: <b>acrylic_felt_orange (fit)</b>' \
    'A quick page leaves out 100 bands'; do
    grep -qF "$said" "$WORK/materials/index.html" || fail "the page does not say: $said"
done
grep -q '^10 bands are enough.*measurements, neural fits, stand-ins on builtin:ball' "$WORK/materials/verdict.csv" ||
    fail "the verdict hides what it rests on: $(cat "$WORK/materials/verdict.csv")"
! grep -q 'more than a hundred bands' "$WORK/materials/verdict.csv" || fail "a claim of bands that a quick page leaves out"
