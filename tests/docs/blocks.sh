# SPDX-License-Identifier: MIT
# blocks.sh NAME: runs every block of code of the document NAME.md, in a folder of its own, block after
# block:
#   sh    by sh -eu, with the program and an installed library at hand
#   c     compiled without a warning; run if it has a main
#   glsl  a fragment shader, compiled beside the installed lampion.glsl
#   hlsl  a pixel shader, and metal, compiled beside the installed variants (as tests/gpu/variants.sh does)
#   json  a lights file, which the program reads
#   python run by a Python that has NumPy and cffi, on the package that checks.libraries has installed
# The HTML comment on the line before a block may say
#   <!-- not run: REASON -->   the block is left out; the reason is printed
#   <!-- file: NAME -->        the block is this file of the folder (c, glsl: and is compiled too)
#   <!-- prints -->            a text block: what the block before it printed, to the letter
# Images are small here, samples and frames few, and materials truncated to few bands and views: the last value of
# an option counts, and the program's stand-in below adds its own; of the materials of `brdf bands`
# it keeps the first. Nothing else is changed.
set -eu
. tests/checks/common.sh
document=docs/$1.md
[ -f "$document" ] || document=$1.md
! grep -q '^```python' "$document" || . tests/python/package.sh

cmake --install "$BUILD" --prefix "$WORK/prefix" >"$WORK/log" 2>&1 || fail "$(cat "$WORK/log")"
mkdir "$WORK/bin"
cat >"$WORK/bin/lampion" <<SCRIPT
#!/bin/sh
case \$1:" \$* " in
*' --help '*) ;;
reference:*' --point '*) ;;
*' --from '*) ;;
view:*' --script '*) exec xvfb-run -a "$PROGRAM" "\$@" --samples 1 --fps 8 ;;
view:*) set -- "\$@" --size 160x90 --samples 1 ;;
render:*' --material '*) set -- "\$@" --size 96x54 --samples 1 --bands 4 ;;
render:*) set -- "\$@" --size 96x54 --samples 1 --repeat 1 ;;
reference:*) set -- "\$@" --size 96x54 --spp 4 ;;
basis:*) set -- "\$@" --size 320x200 ;;
brdf:*' bake '*) set -- "\$@" --views 8 --azimuths 8 ;;
brdf:*' brdf bands '*) set -- brdf bands "\$3" ;;
brdf:*' plot '*) set -- "\$@" --size 300x200 --bands 4 ;;
esac
case \$1 in view) exec xvfb-run -a "$PROGRAM" "\$@" --script "$WORK/look" ;; esac
exec "$PROGRAM" "\$@"
SCRIPT
printf '%s\n' "0.1 key F12" "0.2 key Ctrl+Q" >"$WORK/look" # a screenshot, and away
chmod +x "$WORK/bin/lampion"
export PATH="$WORK/bin:$PATH" XDG_CACHE_HOME="$WORK/cache" HOME="$WORK"
export PKG_CONFIG_PATH="$(dirname "$(find "$WORK/prefix" -name lampion.pc)")"
export SLURM_ARRAY_TASK_ID=3 SLURM_ARRAY_TASK_COUNT=8 # as in an array job
unset DISPLAY WAYLAND_DISPLAY

# le32 NUMBER: four bytes, the least first.
le32() {
    printf "$(printf '\\%03o\\%03o\\%03o\\000' $(($1 % 256)) $(($1 / 256 % 256)) $(($1 / 65536)))"
}

# glb TEXT FILE: a scene of JSON and one buffer of base64 as one binary file.
glb() {
    sed 's/, "uri": "[^"]*"//' "$1" >"$WORK/json"
    sed -n 's/.*;base64,\([^"]*\)".*/\1/p' "$1" | base64 -d >"$WORK/buffer"
    json=$(wc -c <"$WORK/json") buffer=$(wc -c <"$WORK/buffer")
    padding=$(((4 - json % 4) % 4))
    {
        printf glTF && le32 2 && le32 $((28 + json + padding + buffer))
        le32 $((json + padding)) && printf JSON && cat "$WORK/json" && printf '%*s' $padding ''
        le32 "$buffer" && printf 'BIN\000' && cat "$WORK/buffer"
    } >"$2"
}

compile_c() {
    if grep -q 'int main' "$1"; then
        cc -std=c11 -O1 -Wall -Wextra -Werror "$1" $(pkg-config --cflags --libs lampion) -lm -o ./"${1%.c}"
        ./"${1%.c}"
    else
        cc -std=c11 -Wall -Wextra -Werror -c "$1" $(pkg-config --cflags lampion) -o "${1%.c}.o"
    fi
}

compile_glsl() {
    stage=$(echo "${1%.glsl}" | sed -n 's/.*\.\(vert\|frag\|comp\)$/\1/p')
    glslangValidator -G -o compiled.spv -S "${stage:-frag}" "-I$WORK/prefix/share/lampion/shaders" "$1"
}

compile_hlsl() {
    glslangValidator -D -V -e main -S frag -o compiled.spv "-I$WORK/prefix/share/lampion/shaders" "$1"
}

compile_metal() {
    clang++ -std=c++14 -Wall -Werror -Wno-unknown-attributes -Dfragment= -include "$SOURCE/tests/gpu/variants/metal.h" \
        "-I$WORK/prefix/share/lampion/shaders" -x c++ -fsyntax-only "$1"
}

read_json() {
    case $1 in *.json) ;; *) return ;; esac
    if grep -q '"lights"' "$1"; then
        lampion render builtin:ball --lights "$1" -o read_json.png
    fi
}

# The package's own program, because the stand-in would add its options after the scene.
run_python() {
    LAMPION_PROGRAM=$PROGRAM PYTHONDONTWRITEBYTECODE=1 "$python" -W error "$1"
}

# run_block LANGUAGE FILE, in the document's folder; standard output to ../printed.
run_block() {
    case $1 in
    sh) timeout 120 sh -eu "$2" ;;
    c) compile_c "$2" ;;
    glsl | vert | frag | comp) compile_glsl "$2" ;;
    hlsl | metal) "compile_$1" "$2" ;;
    python) run_python "$2" ;;
    json) read_json "$2" ;;
    esac </dev/null >../printed 2>../complaints
}

folder=$WORK/blocks
mkdir -p "$folder" "$WORK/here"
awk -v folder="$folder" -f tests/docs/blocks.awk "$document" >"$WORK/list"
ln -s "$BUILD/.." "$WORK/here/build"
own_scene "$WORK/here/scene.gltf"
glb "$WORK/here/scene.gltf" "$WORK/here/scene.glb"
run=0 omitted=0
while read -r number line language annotation; do
    case $annotation in
    'not run: '?*)
        echo "$document:$line: $annotation"
        omitted=$((omitted + 1))
        continue
        ;;
    'file: '*) name=${annotation#file: } ;;
    prints)
        cmp -s "$folder/$number" "$WORK/printed" ||
            fail "$document:$line: not what is printed (< here, > printed):" \
                "$(diff "$folder/$number" "$WORK/printed")"
        continue
        ;;
    *) name=block-$line.$language ;;
    esac
    cp "$folder/$number" "$WORK/here/$name"
    began=$(date +%s)
    (cd "$WORK/here" && run_block "$language" "$name") ||
        fail "$document:$line: status $?: $(cat "$WORK/printed" "$WORK/complaints")"
    took=$(($(date +%s) - began))
    [ $took -lt 5 ] || echo "$document:$line: took $took s"
    run=$((run + 1))
done <"$WORK/list"
echo "$run blocks run, $omitted left out"
[ $((run + omitted)) -gt 0 ] || ! grep -q '^```' "$document" || fail "no block was run"
