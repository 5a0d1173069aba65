# SPDX-License-Identifier: MIT
# The CPU draws where no OpenGL can be loaded: with every method, shadows, layers, what blends and an
# environment.
set -eu
. tests/checks/common.sh

# Files of these names are not libraries: opening them as such fails.
mkdir "$WORK/refused"
for library in libEGL.so.1 libGL.so.1 libOpenGL.so.0 libGLX.so.0 libgbm.so.1; do
    echo "not a library" >"$WORK/refused/$library"
done
export LD_LIBRARY_PATH="$WORK/refused"
unset DISPLAY WAYLAND_DISPLAY || true

"$PROGRAM" doctor >"$WORK/doctor" 2>&1 || fail "doctor fails without OpenGL: $(cat "$WORK/doctor")"
grep -q '^OpenGL.*none.*the CPU draws' "$WORK/doctor" || fail "doctor does not miss OpenGL: $(cat "$WORK/doctor")"
if "$PROGRAM" render builtin:ball --size 8x8 --device gpu -o "$WORK/gpu.png" 2>"$WORK/log"; then
    fail "the GPU's device drew without OpenGL"
fi

# A square with a coat and a sheen stands before one that blends, under a sky.
cat >"$WORK/layers.gltf" <<'JSON'
{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],
"extensionsUsed":["KHR_materials_clearcoat","KHR_materials_sheen"],
"nodes":[{"mesh":0},{"mesh":1,"translation":[0.3,0.3,0.4]}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]},
{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":1}]}],
"materials":[{"doubleSided":true,"extensions":{"KHR_materials_clearcoat":{"clearcoatFactor":1},
"KHR_materials_sheen":{"sheenColorFactor":[0.5,0.2,0.2],"sheenRoughnessFactor":0.5}}},
{"doubleSided":true,"alphaMode":"BLEND","pbrMetallicRoughness":{"baseColorFactor":[0.1,0.8,0.2,0.5]}}],
"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[-1,-1,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":12}],
"buffers":[{"byteLength":60,"uri":"data:application/octet-stream;base64,AACAvwAAgL8AAAAAAACAPwAAgL8AAAAAAACAPwAAgD8AAAAAAACAvwAAgD8AAAAAAAABAAIAAAACAAMA"}]}
JSON
for method in zonal coefficients preintegrated field; do
    "$PROGRAM" render builtin:atrium --size 96x54 --bands 5 --device cpu --method $method --shadows \
        --samples 2 -o "$WORK/atrium-$method.png"
    "$PROGRAM" render "$WORK/layers.gltf" --size 48x48 --bands 5 --device cpu --method $method \
        --environment studio --samples 4 -o "$WORK/layers-$method.exr"
done
for method in coefficients preintegrated field; do
    "$PROGRAM" compare "$WORK/atrium-zonal.png" "$WORK/atrium-$method.png" --fail-above rmse=0.02 >/dev/null ||
        fail "$method draws another image"
done
# Without --device, where no GPU is found, nothing else is needed.
"$PROGRAM" render builtin:ball --size 8x8 -o "$WORK/auto.png"
LD_DEBUG=files "$PROGRAM" render builtin:ball --size 8x8 --device cpu -o "$WORK/quiet.png" 2>"$WORK/loaded"
if grep -Eq 'file=lib(EGL|GL|OpenGL|GLX|gallium)[^ ]*.so' "$WORK/loaded"; then
    fail "the CPU's device asks for OpenGL"
fi
