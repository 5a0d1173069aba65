# SPDX-License-Identifier: MIT
# The shaders in HLSL and Metal compute what the library does. HLSL is compiled by glslang and runs on the OpenGL
# device as SPIR-V; Metal is compiled by clang as C++14 with a stand-in for Metal's vectors and runs on the CPU.
set -eu
. tests/checks/common.sh
export ASAN_OPTIONS=detect_leaks=0 # GL drivers leak at exit
variants=$BUILD/variants sources=$SOURCE/tests/gpu/variants steps=$BUILD/tests/gpu/test_gpu_variants
sizes="-DLIGHTS=5 -DSURFACES=64 -DTEXELS=5152 -DAREAS=4"
"$steps" inputs "$WORK/inputs"

# hlsl OUT BANDS OPTION…: compiles the user's shader with so many bands
hlsl() {
    out=$1
    sed "s/^#define LMP_BANDS .*/#define LMP_BANDS $2/" "$sources/shade.hlsl" >"$WORK/shade.hlsl"
    shift 2
    # shellcheck disable=SC2086
    glslangValidator -D -e main -S comp -I"$variants/hlsl" $sizes "$@" "$WORK/shade.hlsl" -o "$WORK/$out" \
        >"$WORK/log" 2>&1 || fail "HLSL: $(cat "$WORK/log")"
}
if command -v glslangValidator >/dev/null; then
    hlsl shade.spv 6 -V
    "$steps" run "$WORK/shade.spv"
    hlsl whole.spv 6 -V -DWHOLE
    hlsl many.spv 9 -V -DWHOLE
    sed 's/lmp_make_surface(given/lmp_surface_of(given/' "$sources/shade.hlsl" >"$WORK/wrong.hlsl"
    # shellcheck disable=SC2086
    ! glslangValidator -D -V -e main -S comp -I"$variants/hlsl" $sizes "$WORK/wrong.hlsl" -o "$WORK/wrong.spv" \
        >"$WORK/log" 2>&1 || fail "what is no HLSL goes unseen"
else
    echo "skipped: glslangValidator is not installed (package glslang-tools)"
fi
if command -v clang++ >/dev/null; then
    # shellcheck disable=SC2086
    clang++ -std=c++14 -O1 -Wall -Wextra -Werror -Wno-unused-parameter $sizes -I"$variants/metal" -I"$sources" \
        "$sources/metal.cpp" -o "$WORK/metal" || fail "the Metal variants do not compile"
    "$WORK/metal" "$WORK/inputs" "$WORK/values"
    "$steps" check "$WORK/values"
else
    echo "skipped: clang++ is not installed (package clang)"
fi
