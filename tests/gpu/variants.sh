# SPDX-License-Identifier: MIT
# The shaders in HLSL and Metal compute what the library does. HLSL is compiled by glslang and runs on the OpenGL
# device as SPIR-V; Metal is compiled by clang as C++14 with a stand-in for Metal's vectors and runs on the CPU.
set -eu
. tests/checks/common.sh
export ASAN_OPTIONS=detect_leaks=0 # GL drivers leak at exit
variants=$BUILD/variants sources=$SOURCE/tests/gpu/variants steps=$BUILD/tests/gpu/test_gpu_variants
sizes="-DLIGHTS=5 -DSURFACES=64 -DTEXELS=5152"

# hlsl FILE OUT OPTION…: compiles a user's shader
hlsl() {
    file=$1 out=$2
    shift 2
    # shellcheck disable=SC2086
    glslangValidator -D -V -e main -S comp -I"$variants/hlsl" $sizes "$@" "$file" -o "$WORK/$out" >"$WORK/log" 2>&1
}
# compare LOBES BANDS WINDOW AREAS
compare() {
    kind=-DPHONG
    [ "$1" = phong ] || kind=-DGGX
    hlsl "$sources/shade.hlsl" shade.spv $kind "-DLMP_BANDS=$2" "-DLMP_WINDOW=$3" "-DAREAS=$4" \
        || fail "HLSL: $(cat "$WORK/log")"
    "$steps" run "$WORK/shade.spv" "$@"
}
if command -v glslangValidator >/dev/null; then
    compare phong 1 2 0
    compare ggx 6 1 0
    compare phong 3 0 4
    if [ "${LAMPION_LONG:-0}" = 1 ]; then
        for bands in 2 5 8 10 20; do
            for window in 0 1 2; do
                compare phong "$bands" "$window" 4
                [ "$bands" = 20 ] || compare ggx "$bands" "$window" 0
            done
        done
    fi
    # files for engines: Unity's, and Godot's, whose language is GLSL's in them
    engines="$sizes -DPROBE=$((2 * 5 + 3 * 64 + 5152 + 11 * 4)) -I$SOURCE/examples/engines -V -S comp"
    # shellcheck disable=SC2086
    glslangValidator -D -e main $engines "$SOURCE/tests/gpu/engines/unity.hlsl" -o "$WORK/unity.spv" >"$WORK/log" \
        || fail "Unity: $(cat "$WORK/log")"
    # shellcheck disable=SC2086
    glslangValidator $engines "$SOURCE/tests/gpu/engines/godot.comp" -o "$WORK/godot.spv" >"$WORK/log" \
        || fail "Godot: $(cat "$WORK/log")"
    "$steps" probes "$WORK/unity.spv"
    "$steps" probes "$WORK/godot.spv"
    sed 's/lmp_make_surface(given/lmp_surface_of(given/' "$sources/shade.hlsl" >"$WORK/wrong.hlsl"
    ! hlsl "$WORK/wrong.hlsl" wrong.spv -DLMP_BANDS=3 -DAREAS=0 || fail "what is no HLSL goes unseen"
else
    echo "skipped: glslangValidator is not installed (package glslang-tools)"
fi
if command -v clang++ >/dev/null; then
    # shellcheck disable=SC2086
    clang++ -std=c++14 -O1 -Wall -Wextra -Werror -Wno-unused-parameter $sizes -DAREAS=4 -I"$variants/metal" -I"$sources" \
        "$sources/metal.cpp" -o "$WORK/metal" || fail "the Metal variants do not compile"
    "$steps" inputs "$WORK" ggx 6 1 4
    "$WORK/metal" "$WORK" "$WORK/values"
    "$steps" check "$WORK/values" ggx 6 1 4
else
    echo "skipped: clang++ is not installed (package clang)"
fi
