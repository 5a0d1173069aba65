# SPDX-License-Identifier: MIT
# lampion reference and lampion compare: what they write, print and refuse.
set -eu
. tests/checks/common.sh

# refuses STATUS TEXT COMMAND…: the command must end with STATUS, print TEXT, and leave no image behind.
refuses() {
    expected=$1 text=$2
    shift 2
    status=0
    "$PROGRAM" "$@" >"$WORK/out" 2>"$WORK/err" || status=$?
    [ $status = "$expected" ] || fail "$*: status $status, not $expected"
    grep -q -- "$text" "$WORK/err" || fail "$*: $(cat "$WORK/err")"
    [ "$(grep -c . "$WORK/err")" -le 2 ] || fail "$*: more than a line"
    [ ! -e "$WORK/none.png" ] || fail "$*: left an image"
}

# E = pi L sin²a cos(theta) of a sphere of radius 1/2 at distance 2, half reflected by a white floor.
radiance=$("$PROGRAM" reference --point 0,0,0 --light 0,2,0,0.5,8,16,32)
[ "$radiance" = "0.5 1 2" ] || fail "one point: $radiance"
small="--size 48x32 --random-lights 3 --spp 8"
"$PROGRAM" reference builtin:balls $small --threads 1 -o "$WORK/one.exr"
"$PROGRAM" reference builtin:balls $small --threads 2 -o "$WORK/two.exr"
cmp "$WORK/one.exr" "$WORK/two.exr" || fail "the number of threads changes the image"
"$PROGRAM" reference builtin:balls $small --noise-seed 2 -o "$WORK/other.exr"
"$PROGRAM" reference builtin:balls $small -o "$WORK/one.png"
"$PROGRAM" reference builtin:balls $small --ev 1 -o "$WORK/brighter.png"
grep -q stderr.R "$WORK/one.exr" || fail "no standard error in the image"

"$PROGRAM" compare "$WORK/one.exr" "$WORK/two.exr" --fail-above max=0 --fail-above ssim=1 \
    >"$WORK/out" || fail "equal images are not equal"
"$PROGRAM" compare "$WORK/one.exr" "$WORK/other.exr" --json --heatmap "$WORK/heat.png" \
    --fail-above rmse=1000 | grep -q '"bad_values": 0' || fail "no JSON"
# the width and the height of a .png, after its signature and the head of its first chunk: 48x32 and the scale below
[ "$(od -An -tx1 -j16 -N8 "$WORK/heat.png" | tr -d ' \n')" = 000000300000003c ] || fail "no heat map with its scale"
# A .png is filtered over the pixel, a .exr only on request.
"$PROGRAM" reference builtin:balls $small --samples 1 -o "$WORK/center.png"
! cmp -s "$WORK/one.png" "$WORK/center.png" || fail "a .png is not filtered"
"$PROGRAM" reference builtin:balls $small --samples 8 -o "$WORK/filtered.exr"
! cmp -s "$WORK/one.exr" "$WORK/filtered.exr" || fail "--samples changes nothing"
"$PROGRAM" reference builtin:balls $small --samples 1 -o "$WORK/filtered.exr"
cmp -s "$WORK/one.exr" "$WORK/filtered.exr" || fail "a .exr is filtered"
refuses 2 'without --bands, --error and --samples' reference builtin:balls --shard 1/2 --samples 8 -o "$WORK/part.exr"

# One lamp's edge must not leave the rest of the map black.
"$PROGRAM" compare "$WORK/one.exr" "$WORK/other.exr" --heatmap "$WORK/heat.png" >"$WORK/out"
grep -q '^heatmap black is 0, white [0-9.e-]*, which 99 % of the pixels do not exceed$' "$WORK/out" ||
    fail "the heat map does not say what is white: $(cat "$WORK/out")"
awk '$1 == "max" { most = $2 } $1 == "heatmap" { exit !($6 + 0 < most) }' "$WORK/out" || fail "the largest difference is white"
"$PROGRAM" compare "$WORK/one.exr" "$WORK/other.exr" --heatmap "$WORK/heat.png" --heatmap-percentile 100 |
    awk '$1 == "max" { most = $2 } $1 == "heatmap" { exit !($6 + 0 == most) }' || fail "the percentile 100 is not the largest"
"$PROGRAM" compare "$WORK/one.png" "$WORK/brighter.png" | grep -q display || fail "PNG is not display"

# A camera beyond 1e17 is refused in a scene as on the command line: the ray tracer would abort.
cat >"$WORK/far.gltf" <<'GLTF'
{ "asset": { "version": "2.0" }, "scenes": [ { "nodes": [ 0, 1 ] } ],
  "nodes": [ { "mesh": 0 }, { "translation": [ 0, 1e30, 0 ], "camera": 0 } ],
  "meshes": [ { "primitives": [ { "attributes": { "POSITION": 0 } } ] } ],
  "cameras": [ { "type": "perspective", "perspective": { "yfov": 0.6, "znear": 0.1 } } ],
  "accessors": [ { "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3" } ],
  "bufferViews": [ { "buffer": 0, "byteLength": 36 } ],
  "buffers": [ { "byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA" } ] }
GLTF
for command in reference render; do
    refuses 1 'has a camera beyond 1e17' $command "$WORK/far.gltf" --size 8x8 -o "$WORK/none.png"
    refuses 2 'eye: 1e30,0,0 is out of range' $command builtin:ball --eye 1e30,0,0 --size 8x8 -o "$WORK/none.png"
done
refuses 1 'rmse is .*, limit 0' compare "$WORK/one.exr" "$WORK/other.exr" --fail-above rmse=0
refuses 1 'ssim is .*, limit 1' compare "$WORK/one.png" "$WORK/brighter.png" --fail-above ssim=1
# A black image has no peak to compare by.
echo '{ "lights": [ { "position": [0, 9, 0], "radius": 1, "radiance": [0, 0, 0] } ] }' >"$WORK/off.json"
"$PROGRAM" reference builtin:balls --size 48x32 --environment none --lights "$WORK/off.json" --spp 1 -o "$WORK/black.exr"
refuses 1 'ssim is 0, limit' compare "$WORK/one.exr" "$WORK/black.exr" --fail-above ssim=0.5
"$PROGRAM" compare "$WORK/one.exr" "$WORK/black.exr" --json | grep -q '"psnr": "-infinite"' || fail "psnr of a black reference"
refuses 2 'METRIC' compare "$WORK/one.exr" "$WORK/two.exr" --fail-above beauty=1
refuses 2 'not a number' compare "$WORK/one.exr" "$WORK/two.exr" --fail-above rmse=nan
refuses 2 'did you mean rmse' compare "$WORK/one.exr" "$WORK/two.exr" --fail-above rsme=1
refuses 2 'two of a kind' compare "$WORK/one.exr" "$WORK/one.png"
refuses 2 'two images' compare "$WORK/one.exr"
refuses 2 'heat.txt' compare "$WORK/one.exr" "$WORK/two.exr" --heatmap "$WORK/heat.txt"
mkfifo "$WORK/fifo.exr"
refuses 1 'no.* regular file' compare "$WORK/one.exr" "$WORK/fifo.exr"
refuses 1 'absent.exr' compare "$WORK/one.exr" "$WORK/absent.exr"
"$PROGRAM" reference builtin:balls --size 20x20 --spp 1 -o "$WORK/small.exr"
refuses 1 'different sizes: 48x32 and 20x20' compare "$WORK/one.exr" "$WORK/small.exr"
refuses 2 'one scene' reference -o "$WORK/none.png"
refuses 2 '-o FILE' reference builtin:balls
refuses 1 'absent.gltf' reference "$WORK/absent.gltf" -o "$WORK/none.png"
refuses 1 'none.jpg' reference builtin:balls -o "$WORK/none.jpg"
refuses 2 'no scene' reference builtin:balls --point 0,0,0
refuses 1 'X,Y,Z,RADIUS,R,G,B' reference --point 0,0,0 --light 1,2,3
refuses 1 'radius is not above 0' reference --point 0,0,0 --light 1,2,3,-1,1,1,1
refuses 1 'X,Y,Z,RADIUS,R,G,B' reference --point 0,0,0 --light 0x1,2,3,1,1,1,1
refuses 1 'X,Y,Z,RADIUS,R,G,B' reference --point 0,0,0 --light 1,2,3,1,1,1,1,
refuses 2 'not a number' compare "$WORK/one.exr" "$WORK/two.exr" --fail-above rmse=0x1
