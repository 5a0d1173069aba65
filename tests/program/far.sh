# SPDX-License-Identifier: MIT
# A scene at (5e6, 100, -5e6) is what it is at 0: on both devices and in the ground truth, by the file's
# camera, by one that frames the scene and by one in coordinates of the world, with lights, paths and
# probes in such coordinates.
set -eu
. tests/checks/common.sh
export ASAN_OPTIONS=detect_leaks=0 # GL drivers leak at exit

# scene X Y Z CAMERAS: a floor, and over it two leaning squares that hang on another node; with a camera or none
scene() {
    cat <<JSON
{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1,4$4]}],"extensionsUsed":["KHR_lights_punctual"],
"extensions":{"KHR_lights_punctual":{"lights":[{"type":"point","intensity":60}]}},
"nodes":[{"mesh":0,"translation":[$1,$2,$3],"rotation":[-0.70710678,0,0,0.70710678],"scale":[3,3,3]},
{"translation":[$1,$2,$3],"rotation":[0,0.38268343,0,0.92387953],"children":[2,3]},
{"mesh":0,"translation":[0.1,1.3,-0.2],"rotation":[0.1,0.2,0.3,0.9273618],"scale":[0.7,0.9,1.1]},
{"mesh":0,"translation":[-0.8,0.6,0.9],"rotation":[0.3,-0.1,0.2,0.9273618],"scale":[0.6,0.4,0.5]},
{"translation":[$1,$(add "$2" 4),$(add "$3" 3)],"extensions":{"KHR_lights_punctual":{"light":0}}},
{"camera":0,"translation":[$(add "$1" 1.5),$(add "$2" 2.25),$(add "$3" 6.5)],"rotation":[-0.1,0.1,0.01,0.9898989]}],
"cameras":[{"type":"perspective","perspective":{"yfov":0.8,"znear":0.1}}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]}],
"materials":[{"doubleSided":true,"pbrMetallicRoughness":{"baseColorFactor":[0.8,0.6,0.4,1],"metallicFactor":0,"roughnessFactor":0.5}}],
"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[-1,-1,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":12}],
"buffers":[{"byteLength":60,"uri":"data:application/octet-stream;base64,AACAvwAAgL8AAAAAAACAPwAAgL8AAAAAAACAPwAAgD8AAAAAAACAvwAAgD8AAAAAAAABAAIAAAACAAMA"}]}
JSON
}

add() {
    awk -v a="$1" -v b="$2" 'BEGIN { printf "%.10g", a + b }'
}

# point PLACE X,Y,Z: prints that point of the scene near 0, or of the far one.
point() {
    if [ "$1" = near ]; then echo "$2"; else
        echo "$2" | awk -F, '{ printf "%.10g,%.10g,%.10g\n", $1 + 5e6, $2 + 100, $3 - 5e6 }'
    fi
}

scene 0 0 0 ,5 >"$WORK/near.gltf"
scene 5000000 100 -5000000 ,5 >"$WORK/far.gltf"
scene 0 0 0 '' >"$WORK/near-framed.gltf"
scene 5000000 100 -5000000 '' >"$WORK/far-framed.gltf"
for place in near far; do
    cat >"$WORK/$place.json" <<JSON
{"lights":[{"position":[$(point $place 1.25,3.5,2.75)],"radius":0.25,"power":400},
{"kind":"spot","position":[$(point $place -1,4,1)],"direction":[0.6,-0.8,0],"outer":0.6,"intensity":30}]}
JSON
    cat >"$WORK/$place-paths.json" <<JSON
{"paths":[{"light":0,"circle":{"center":[$(point $place 0,3,0)],"period":4}},
{"light":1,"keys":[[0,$(point $place -1,4,1)],[2,$(point $place 1,3,2)]]}]}
JSON
done

# same WHAT: the images near.exr and far.exr differ by less than a thousandth of what they show; WHAT says whose they are
same() {
    if "$PROGRAM" compare "$WORK/near.exr" "$WORK/dark.exr" --fail-above rmse=0.1 >/dev/null 2>&1; then
        fail "$1: nothing is seen"
    fi
    "$PROGRAM" compare "$WORK/far.exr" "$WORK/near.exr" --fail-above rmse=1e-4 >"$WORK/differ" ||
        fail "$1: $(cat "$WORK/differ")"
}

# draw WHAT SUFFIX COMMAND OPTION…: both scenes with that suffix by a command, in whose options @X,Y,Z is a point of
# the place and @NAME a file of it
draw() {
    what=$1
    suffix=$2
    command=$3
    shift 3
    for place in near far; do
        line=
        for word in "$@"; do
            case $word in
            @*,*) line="$line $(point $place "${word#@}")" ;;
            @*) line="$line $WORK/$place${word#@}" ;;
            *) line="$line $word" ;;
            esac
        done
        # shellcheck disable=SC2086 # words of this script
        "$PROGRAM" "$command" "$WORK/$place$suffix.gltf" $line --size 48x32 -o "$WORK/$place.exr"
    done
    same "$what"
}

echo '{"lights":[]}' >"$WORK/none.json"
"$PROGRAM" render "$WORK/near.gltf" --size 48x32 --device cpu --lights "$WORK/none.json" --environment none -o "$WORK/dark.exr"
for device in cpu gpu; do
    draw "$device" '' render --device $device --shadows
    draw "$device, framed" -framed render --device $device
    draw "$device, --eye" '' render --device $device --eye @2,3,5 --target @0,0.5,0 --lights @.json --shadows
done
draw reference '' reference --spp 4 --shadows
draw 'reference, framed' -framed reference --spp 4
draw 'reference, --eye' '' reference --spp 4 --eye @2,3,5 --target @0,0.5,0 --lights @.json
draw 'a field of lights' '' render --device cpu --method field --random-lights 20
draw 'orthographic' '' render --device cpu --eye @2,3,5 --target @0,0.5,0 --orthographic 5
draw 'z is up' '' render --device cpu --up z

# Lights move by paths in the world's coordinates.
for place in near far; do
    "$PROGRAM" render "$WORK/$place.gltf" --size 48x32 --device cpu --lights "$WORK/$place.json" \
        --animate "$WORK/$place-paths.json" --frames 3-3 --fps 2 -o "$WORK/$place-%d.exr"
    mv "$WORK/$place-3.exr" "$WORK/$place.exr"
done
same 'paths'

# Printed coordinates are the world's, and are the same to the bit when read back.
"$PROGRAM" info "$WORK/far.gltf" | grep -qx 'bounds     4999997 100 -5000003 … 5000003 [0-9.]* -4999997' ||
    fail "bounds: $("$PROGRAM" info "$WORK/far.gltf" | grep bounds)"
"$PROGRAM" info --json "$WORK/far.gltf" >"$WORK/info"
for line in '"position": \[5000000, 104, -4999997\]' '"eye": \[5000001.5, 102.25, -4999993.5\]' '"minimum": \[4999997, 100, -5000003\]'; do
    grep -q "$line" "$WORK/info" || fail "info --json has no $line: $(cat "$WORK/info")"
done
"$PROGRAM" info "$WORK/near.gltf" | grep -qx 'bounds     -3 [-0-9.e]* -3 … 3 [0-9.]* 3' || fail "bounds at 0: $("$PROGRAM" info "$WORK/near.gltf")"

# Probes have the same values, at positions that are moved, in the engine's axes and units.
for place in near far; do
    "$PROGRAM" field "$WORK/$place.gltf" --grid 3x2x3 --preset unreal --minimum "$(point $place -1,0,-1)" -o "$WORK/$place.csv"
done
head -2 "$WORK/far.csv" | tail -1 | grep -q '^499999900,-500000100,10000,' || fail "probes: $(head -2 "$WORK/far.csv")"
for place in near far; do
    cut -d, -f4- "$WORK/$place.csv" >"$WORK/$place.values"
done
cmp "$WORK/near.values" "$WORK/far.values" || fail "probes of the far scene have other values"
"$PROGRAM" field "$WORK/far.gltf" --grid 3x2x3 -o "$WORK/far.lmpf" 2>"$WORK/note"
grep -q 'is relative to 5000000,[0-9.]*,-5000000' "$WORK/note" || fail "a .lmpf does not say what it is relative to: $(cat "$WORK/note")"
