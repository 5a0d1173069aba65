# SPDX-License-Identifier: MIT
# What lies before the near plane of a file's camera, or past its far plane, is not seen: on both
# devices and in the ground truth.
set -eu
. tests/checks/common.sh
export ASAN_OPTIONS=detect_leaks=0 # GL drivers leak at exit

# scene NODES CAMERA: writes glowing squares of three colors and the camera, 5 before the middle one.
scene() {
    cat <<JSON
{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[$1,3]}],
"nodes":[{"mesh":0,"translation":[0.5,0,3]},{"mesh":1},{"mesh":2,"translation":[-1,0,-3],"scale":[3,3,1]},
{"camera":0,"translation":[0,0,5]}],
"cameras":[$2],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]},
{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":1}]},
{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":2}]}],
"materials":[{"emissiveFactor":[1,0,0]},{"emissiveFactor":[0,1,0]},{"emissiveFactor":[0,0,1]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[-1,-1,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":12}],
"buffers":[{"byteLength":60,"uri":"data:application/octet-stream;base64,AACAvwAAgL8AAAAAAACAPwAAgL8AAAAAAACAPwAAgD8AAAAAAACAvwAAgD8AAAAAAAABAAIAAAACAAMA"}]}
JSON
}

# draw NAME: draws the scene by every device, without its light, which is the squares.
draw() {
    for device in cpu gpu; do
        "$PROGRAM" render "$WORK/$1.gltf" --size 48x32 --bands 3 --environment none --lights "$WORK/none.json" \
            --device $device -o "$WORK/$1-$device.exr"
    done
    "$PROGRAM" reference "$WORK/$1.gltf" --size 48x32 --spp 1 --environment none --lights "$WORK/none.json" \
        -o "$WORK/$1-reference.exr"
}

echo '{ "lights": [] }' >"$WORK/none.json"
for kind in perspective orthographic; do
    case $kind in
    perspective) shape='"yfov":0.9,"aspectRatio":1.5' ;;
    orthographic) shape='"xmag":3,"ymag":2' ;;
    esac
    scene 1 "{\"type\":\"$kind\",\"$kind\":{$shape,\"znear\":0.01,\"zfar\":100}}" >"$WORK/alone.gltf"
    scene 0,1,2 "{\"type\":\"$kind\",\"$kind\":{$shape,\"znear\":3,\"zfar\":6}}" >"$WORK/clipped.gltf"
    scene 0,1,2 "{\"type\":\"$kind\",\"$kind\":{$shape,\"znear\":0.01,\"zfar\":100}}" >"$WORK/whole.gltf"
    for name in alone clipped whole; do
        draw $name
    done
    for device in cpu gpu reference; do
        "$PROGRAM" compare "$WORK/alone-$device.exr" "$WORK/clipped-$device.exr" --fail-above rmse=1e-5 >/dev/null ||
            fail "$kind, $device: the planes do not clip"
        if "$PROGRAM" compare "$WORK/alone-$device.exr" "$WORK/whole-$device.exr" --fail-above rmse=1e-2 >/dev/null; then
            fail "$kind, $device: planes far away clip"
        fi
    done
done
