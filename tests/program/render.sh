# SPDX-License-Identifier: MIT
# lampion render as a user runs it: images, sequences, statistics, and what it refuses.
set -eu
. tests/checks/common.sh
export LAMPION_GL_DEBUG=fatal
# llvmpipe's LLVM leaks 112 bytes and is unloaded before the check, so no suppression can name it
export ASAN_OPTIONS=detect_leaks=0
small="--size 64x36 --bands 4"

# The same command must give the same bytes.
"$PROGRAM" render builtin:balls $small -o "$WORK/a.png"
"$PROGRAM" render builtin:balls $small -o "$WORK/b.png"
cmp "$WORK/a.png" "$WORK/b.png" || fail "two runs differ"
for method in zonal coefficients; do
    "$PROGRAM" render builtin:balls --size 16x9 --bands 128 --device cpu --method $method -o "$WORK/cpu-$method.exr"
done
# Methods differ by rounding, and by what 128 bands lack of the diffuse lobe, which zonal sums have exactly.
"$PROGRAM" compare "$WORK/cpu-zonal.exr" "$WORK/cpu-coefficients.exr" --fail-above rmse=5e-5 ||
    fail "the CPU's images differ by more than 128 bands do"

# Unlit materials take the colors of their vertices, on every device and in the reference.
cat >"$WORK/unlit.gltf" <<'END'
{"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0,"COLOR_0":1},"material":0}]}],"materials":[{"extensions":{"KHR_materials_unlit":{}}}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},{"bufferView":0,"byteOffset":36,"componentType":5126,"count":3,"type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":72}],"buffers":[{"byteLength":72,"uri":"data:application/octet-stream;base64,AABAwAAAQMAAAAAAAABAQAAAQMAAAAAAAAAAAAAAQEAAAAAAAACAP83MTD4AAAAAAACAP83MTD4AAAAAAACAP83MTD4AAAAA"}]}
END
front="--size 8x8 --eye 0,0,1 --target 0,0,0 --environment none"
for device in cpu gpu; do
    "$PROGRAM" render "$WORK/unlit.gltf" $front --device $device -o "$WORK/unlit-$device.exr"
done
"$PROGRAM" reference "$WORK/unlit.gltf" $front --spp 1 -o "$WORK/unlit.exr"
for device in cpu gpu; do
    "$PROGRAM" compare "$WORK/unlit-$device.exr" "$WORK/unlit.exr" --fail-above rmse=1e-3 ||
        fail "$device: an unlit surface has another color than its vertices"
done

# Sequences are numbered, move, and share one exposure.
"$PROGRAM" render builtin:balls $small --frames 2 --fps 1 -o "$WORK/f_%03d.png"
[ -f "$WORK/f_000.png" ] && [ -f "$WORK/f_001.png" ] || fail "frames are not numbered"
cmp -s "$WORK/f_000.png" "$WORK/f_001.png" && fail "lights do not move"
"$PROGRAM" render builtin:balls $small --frames 1 -o "$WORK/g.exr"
[ -f "$WORK/g_0000.exr" ] || fail "the number does not go before the extension"

# The union of shards, and of any ranges of frames, is the whole, byte for byte.
mkdir "$WORK/whole" "$WORK/parts" "$WORK/range"
"$PROGRAM" render builtin:balls $small --frames 5 -o "$WORK/whole/%04d.png"
for part in 1 2 3; do
    "$PROGRAM" render builtin:balls $small --frames 0-4 --shard $part/3 -o "$WORK/parts/%04d.png"
    ls "$WORK/parts" | wc -l
done >"$WORK/counts"
[ "$(echo $(cat "$WORK/counts"))" = "1 3 5" ] || fail "shards of" $(cat "$WORK/counts")
diff -r "$WORK/whole" "$WORK/parts" || fail "the union of the shards is not the whole"
"$PROGRAM" render builtin:balls $small --frames 3-4 -o "$WORK/range/%04d.png"
rm "$WORK"/whole/000[012].png
diff -r "$WORK/whole" "$WORK/range" || fail "a range differs from the whole"
"$PROGRAM" render builtin:balls $small --frames 1 --shard 1/2 -o "$WORK/empty_%d.png"
[ ! -e "$WORK/empty_0.png" ] || fail "an empty shard has a frame"

# --stats reports these values.
"$PROGRAM" render builtin:balls $small --stats --compare-methods --repeat 1 -o "$WORK/s.png" >"$WORK/stats"
for word in '"triangles"' '"zonal_speedup"' '"coefficients"' '"device"' '"shade"' '"total"'; do
    grep -q "$word" "$WORK/stats" || fail "--stats without $word"
done
grep -q '"samples": 1,' "$WORK/stats" || fail "--stats times more than one sample unasked"
"$PROGRAM" render builtin:balls --size 8x8 --samples 3 --stats --repeat 1 -o "$WORK/s.png" >"$WORK/stats"
grep -q '"samples": 3,' "$WORK/stats" || fail "--stats does not time the samples of --samples"

# Samples that repeat a pixel's first one count as often as they occur, also beside others of the pixel: where nothing
# is in the way of light, shadows, which add each sample, change nothing. The materials are hard to tell apart.
printf '\000\000\002\000\000\000\000\000\000\000\000\000\001\000\001\000\030\000\377\377\377' >"$WORK/white.tga"
printf 'newmtl a\nKd 0.5 0.5 0.5\nmap_Kd white.tga\nnewmtl b\nKd 0.55 0.55 0.55\nmap_Kd white.tga\n' >"$WORK/two.mtl"
printf 'mtllib two.mtl\nv -2 0 -2\nv 2 0 -2\nv 2 0 2.3\nv -2 0 2\nusemtl a\nf 1 4 3\nusemtl b\nf 1 3 2\n' >"$WORK/two.obj"
echo '{ "lights": [ { "position": [0, 3, 0], "radius": 0.1, "radiance": [100, 100, 100] } ] }' >"$WORK/above.json"
for shadows in shadows no-shadows; do
    "$PROGRAM" render "$WORK/two.obj" --lights "$WORK/above.json" --environment none --device cpu $small --samples 8 \
        --exposure 0.1 --eye 0,2,0.01 --target 0,0,0 --$shadows -o "$WORK/$shadows.exr"
done
"$PROGRAM" compare "$WORK/shadows.exr" "$WORK/no-shadows.exr" --fail-above rmse=1e-7 >/dev/null ||
    fail "samples that repeat the first one do not count"

# A field draws what sums do, and is described.
"$PROGRAM" render builtin:balls $small --method zonal --device cpu -o "$WORK/sums.exr"
"$PROGRAM" render builtin:balls $small --method field --device cpu --field-grid 12x9x12 --field-error 0.02 --stats --repeat 1 \
    -o "$WORK/field.exr" >"$WORK/stats"
for word in '"field"' '"nodes"' '"bytes"' '"update_milliseconds"' '"evaluate_milliseconds"' \
    '"resting_milliseconds"' '"estimated_milliseconds"'; do
    grep -q "$word" "$WORK/stats" || fail "--stats of a field without $word"
done
"$PROGRAM" compare "$WORK/field.exr" "$WORK/sums.exr" --fail-above rmse=1e-3 || fail "a field's image is another"
# Without --method the number of bands chooses the method, in view as in render.
for rule in "32 zonal" "33 preintegrated"; do
    "$PROGRAM" render builtin:ball --size 8x8 --bands "${rule% *}" --stats --repeat 1 -o "$WORK/rule.png" >"$WORK/rule"
    grep -q "\"method\":.*\"${rule#* }\"" "$WORK/rule" || fail "${rule% *} bands are not shaded by ${rule#* }"
done
# Where the CPU shades, the number of lights chooses, too.
for rule in "3 cpu zonal 480x270" "2000 cpu field 480x270" "2000 gpu zonal 64x36"; do
    set -- $rule
    "$PROGRAM" render builtin:balls --size "$4" --bands 3 --random-lights "$1" --device "$2" --samples 1 --stats \
        --repeat 1 -o "$WORK/rule.png" >"$WORK/rule"
    grep -q "\"method\":.*\"$3\"" "$WORK/rule" || fail "$1 lights are not shaded by $3 on the $2"
done
"$PROGRAM" render builtin:balls $small --method field --device gpu --field-grid 12x9x12 --field-error 0.02 \
    --stats --repeat 1 -o "$WORK/gpu.exr" >"$WORK/stats"
for word in '"field"' '"update_milliseconds"' '"resting_milliseconds"'; do
    grep -q "$word" "$WORK/stats" || fail "--stats of a field on the GPU without $word"
done
# Hardware moves corners to 1/256 of a pixel, which gives 3e-5 by every method.
bound=1e-4
if grep -q llvmpipe "$WORK/stats"; then bound=1e-5; fi
"$PROGRAM" compare "$WORK/gpu.exr" "$WORK/field.exr" --fail-above rmse=$bound || fail "a field on the GPU is another"

# Samples smooth edges: more distinct gray levels there mean other bytes.
"$PROGRAM" render builtin:balls $small --samples 4 -o "$WORK/smooth.png"
cmp -s "$WORK/smooth.png" "$WORK/a.png" && fail "--samples changes nothing"

# Parallel rays work; and a scene that is rotated with its camera and lights looks the same.
"$PROGRAM" render builtin:balls $small -o "$WORK/parting.exr"
"$PROGRAM" render builtin:balls $small --no-shadows --orthographic 3 -o "$WORK/parallel.exr"
"$PROGRAM" render builtin:balls $small --no-shadows --orthographic 3 --up z -o "$WORK/up.exr"
"$PROGRAM" compare "$WORK/up.exr" "$WORK/parallel.exr" --fail-above rmse=1e-4 || fail "--up z leaves something as it was"
cmp -s "$WORK/parallel.exr" "$WORK/parting.exr" && fail "--orthographic changes nothing"

# Options without effect are reported, and stop nothing.
noted() {
    text=$1
    shift
    "$PROGRAM" render builtin:ball $small -o "$WORK/noted.png" "$@" 2>"$WORK/err" || fail "render $*: $(cat "$WORK/err")"
    [ "$(cat "$WORK/err")" = "lampion: $text" ] || fail "render $*: $(cat "$WORK/err")"
}
noted '--seed: changes nothing without --random-lights' --seed 3
noted '--keep-lights: changes nothing without --lights or --random-lights' --keep-lights
echo '{ "lights": [] }' >"$WORK/none.json"
noted "$WORK/none.json: has no lights, so the scene is dark: add some to its \"lights\", such as \
{ \"position\": [0, 3, 0], \"radius\": 0.2, \"power\": 100 }, or leave --lights out" --lights "$WORK/none.json"

# The lights in what info --lights prints make a lights file, which gives the same image.
"$PROGRAM" info --lights builtin:balls >"$WORK/each" || fail "info --lights"
[ "$(wc -l <"$WORK/each")" = "$("$PROGRAM" info builtin:balls | awk '$1 == "lights" { print $2 + 0 }')" ] || fail "not a line per light"
{ echo '{ "lights": ['; sed '$!s/$/,/' "$WORK/each"; echo '] }'; } >"$WORK/each.json"
"$PROGRAM" render builtin:balls $small --lights "$WORK/each.json" -o "$WORK/each.exr"
cmp "$WORK/parting.exr" "$WORK/each.exr" || fail "info --lights gives other lights"

# Names of frames that FILE does not determine are printed; those that it does are not.
"$PROGRAM" render builtin:ball $small --frames 2-3 -o "$WORK/turn.exr" 2>"$WORK/err"
grep -qF "writing $WORK/turn_0002.exr … $WORK/turn_0003.exr (" "$WORK/err" || fail "names of frames: $(cat "$WORK/err")"
[ -s "$WORK/turn_0002.exr" ] && [ -s "$WORK/turn_0003.exr" ] || fail "the frames have other names"
"$PROGRAM" render builtin:ball $small --frames 1 -o "$WORK/turn_%d.exr" 2>"$WORK/err"
[ -s "$WORK/turn_0.exr" ] && [ ! -s "$WORK/err" ] || fail "names that are given are told: $(cat "$WORK/err")"

# A material without a name is written as two quotes.
own_scene "$WORK/plain.gltf"
sed -i 's/"name": "floor", //' "$WORK/plain.gltf"
"$PROGRAM" info "$WORK/plain.gltf" | grep -q '^materials  *[0-9]*: ""' || fail "a name that is empty goes unseen"
"$PROGRAM" render "$WORK/plain.gltf" $small --material floor=ggx:0.3 -o "$WORK/plain.png" 2>&1 | grep -q 'is not one of ""' ||
    fail "an empty name in a message goes unseen"

# Refusals have a status and one line, and write nothing.
refused() {
    status=$1
    shift
    got=0
    "$PROGRAM" render "$@" >"$WORK/out" 2>"$WORK/err" || got=$?
    [ $got -eq "$status" ] || fail "render $*: status $got, not $status"
    [ "$(wc -l <"$WORK/err")" -eq 1 ] || fail "render $*: not one line: $(cat "$WORK/err")"
    [ ! -e "$WORK/x.png" ] || fail "render $*: left an image"
}
refused 2
refused 2 builtin:ball
refused 2 builtin:ball -o "$WORK/x.gif"
refused 2 builtin:ball -o "$WORK/x.png" --size 0x10
refused 2 builtin:ball -o "$WORK/x.png" --size 16384x16384
refused 2 builtin:ball -o "$WORK/x.png" --bands 129
refused 2 builtin:ball -o "$WORK/x.png" --bands 21 --method coefficients --device gpu
refused 2 builtin:ball -o "$WORK/x.png" --eye nan,0,0
refused 2 builtin:ball -o "$WORK/x.png" --background 1,-1,0
refused 2 builtin:ball -o "$WORK/x.png" --shard 1/2
refused 2 builtin:ball -o "$WORK/x.png" --frames 0
refused 1 builtin:ball -o "$WORK/none/x.png"
refused 1 builtin:ball -o "$WORK/x.png" --gl-device 99
refused 1 builtin:ball -o "$WORK/x.png" --camera none
refused 1 builtin:ball -o "$WORK/x.png" --camera ''
refused 1 builtin:ball -o "$WORK/x.png" --camera ' 0'
refused 1 builtin:ball -o "$WORK/x.png" --camera -18446744073709551616
refused 1 '' -o "$WORK/x.png"
grep -q '^lampion: "": ' "$WORK/err" || fail "a name of nothing: $(cat "$WORK/err")"
mkfifo "$WORK/fifo.png"
refused 1 --from "$WORK/fifo.png" -o "$WORK/x.png"
refused 1 --from "$WORK" -o "$WORK/x.png"
refused 2 builtin:ball -o "$WORK/x.png" --help=x
refused 1 builtin:ball -o "$WORK/x.png" --eye 1,2,3 --target 1,2,3
refused 1 "$WORK/none.gltf" -o "$WORK/x.png"

# A file at its size limit is an error like any other.
(ulimit -f 1 && refused 1 builtin:ball --size 640x360 --bands 3 -o "$WORK/long.exr") || fail "a long file: $(cat "$WORK/err")"
[ -z "$(ls "$WORK" | grep long)" ] || fail "a part of a long file is left"

# Lights follow paths.
"$PROGRAM" render builtin:balls $small --frames 2 --fps 1 --animate bounce -o "$WORK/b_%d.png"
cmp -s "$WORK/b_1.png" "$WORK/f_001.png" && fail "--animate changes nothing"
refused 1 builtin:ball -o "$WORK/x.png" --frames 1 --animate scene
refused 1 builtin:ball -o "$WORK/x.png" --frames 1 --animate none.json
refused 2 builtin:ball -o "$WORK/x.png" --animate orbit

# rays [OPTION…]: prints how many rays the shadows take.
rays() {
    "$PROGRAM" render builtin:ball $small --device cpu --shadows --stats -o "$WORK/rays.exr" "$@" >"$WORK/rays" 2>&1 ||
        fail "shadows $*: $(cat "$WORK/rays")"
    sed -n 's/.*"rays":[^0-9]*\([0-9]*\).*/\1/p' "$WORK/rays"
}
all=$(rays)
twice=$(rays --shadow-rays 4) sparse=$(rays --shadow-sparse)
[ $((twice * 100)) -gt $((all * 195)) ] && [ $((twice * 100)) -lt $((all * 205)) ] ||
    fail "four rays a pixel are $twice, two $all"
[ "$sparse" -gt 0 ] && [ $((sparse * 9)) -lt $((all * 5)) ] || fail "--shadow-sparse sends $sparse of $all rays"

# Shadows are the default, except where only the studio lights a room; in the studio they fall on ground.
alike() {
    "$PROGRAM" render -q $small $2 -o "$WORK/one.png" && "$PROGRAM" render -q $small $3 -o "$WORK/two.png" || fail "render $2, $3"
    same=yes
    cmp -s "$WORK/one.png" "$WORK/two.png" || same=no
    [ "$1" = "$same" ] || fail "the same image by $2 and $3: $same"
}
printf 'v -1 0 0\nv 1 0 0\nv 0 0 1\nv 0 2 0\nf 1 2 3\nf 1 3 4\nf 3 2 4\nf 2 1 4\n' >"$WORK/spike.obj"
room="builtin:atrium --lights $WORK/none.json --environment studio"
alike yes builtin:balls "builtin:balls --shadows"
alike no builtin:balls "builtin:balls --no-shadows"
alike yes "$room" "$room --no-shadows"
alike no "$room" "$room --shadows"
alike yes "$WORK/spike.obj" "$WORK/spike.obj --ground on"
alike no "$WORK/spike.obj" "$WORK/spike.obj --ground off"

# Suns that are a file's only lights have a sky, by every reader; lights that the command line chooses have none.
cat >"$WORK/sun.gltf" <<'END'
{"asset":{"version":"2.0"},"extensionsUsed":["KHR_lights_punctual"],"extensions":{"KHR_lights_punctual":{"lights":[{"type":"directional","intensity":406}]}},"scenes":[{"nodes":[0,1]}],"nodes":[{"mesh":0},{"extensions":{"KHR_lights_punctual":{"light":0}}}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AABAwAAAQMAAAAAAAABAQAAAQMAAAAAAAAAAAAAAQEAAAAAA"}]}
END
alike yes "$WORK/sun.gltf" "$WORK/sun.gltf --environment studio --environment-strength 20"
alike no "$WORK/sun.gltf" "$WORK/sun.gltf --environment none"
"$PROGRAM" info --lights "$WORK/sun.gltf" | sed 's/^/{"lights":[/;s/$/]}/' >"$WORK/sun.json"
alike yes "$WORK/sun.gltf --lights $WORK/sun.json" "$WORK/sun.gltf --environment none"
"$PROGRAM" reference "$WORK/sun.gltf" --size 8x8 --spp 1 -o "$WORK/sky.exr" 2>"$WORK/err"
grep -q 'little but suns lights it' "$WORK/err" || fail "reference does not say that it adds a sky: $(cat "$WORK/err")"
alike yes "$WORK/spike.obj --no-shadows --ground on" "$WORK/spike.obj --no-shadows --ground off"
"$PROGRAM" render builtin:balls --size 64x36 --bands 20 -o "$WORK/shadows.exr"
"$PROGRAM" reference builtin:balls --size 64x36 --spp 64 -o "$WORK/truth.exr"
"$PROGRAM" compare "$WORK/shadows.exr" "$WORK/truth.exr" >"$WORK/with"
"$PROGRAM" render builtin:balls --size 64x36 --bands 20 --no-shadows -o "$WORK/bare.exr"
"$PROGRAM" compare "$WORK/bare.exr" "$WORK/truth.exr" >"$WORK/without"
with=$(awk '$1 == "rmse" { print $2 }' "$WORK/with") without=$(awk '$1 == "rmse" { print $2 }' "$WORK/without")
awk "BEGIN { exit !($with < 0.7 * $without) }" || fail "reference has no shadows by default: $with, $without without"
