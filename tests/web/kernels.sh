# SPDX-License-Identifier: MIT
# The kernels in WebAssembly, with its vectors and without: the bits and checksums of every other instruction set.
set -eu
. tests/checks/common.sh
for tool in emcc node; do
    command -v $tool >/dev/null || { echo "skipped: $tool is not installed (packages emscripten, nodejs)"; exit 0; }
done
. web/emscripten.sh

[ -f "$BUILD/web/build.ninja" ] || cmake --preset web -B "$BUILD/web" >"$WORK/log"
cmake --build "$BUILD/web" --target lampion >"$WORK/log" || fail "$(cat "$WORK/log")"
for name in kernels batch; do
    emcc -std=c11 -O2 -ffp-contract=off -Itests/cross -Iinclude -I. tests/kernels/$name.c tests/oracle/*.c \
        "$BUILD/web/liblampion.a" -sALLOW_MEMORY_GROWTH -sTOTAL_STACK=1MB -sSINGLE_FILE -o "$WORK/$name.js"
    node "$WORK/$name.js" >"$WORK/log" 2>&1 || fail "$name: $(tail -c 2000 "$WORK/log")"
done

# Another bit must be found.
sed 's/0x092618f8u/0x092618f9u/' tests/kernels/golden.h >"$WORK/golden.h"
! cmp -s "$WORK/golden.h" tests/kernels/golden.h || fail "the checksum to break is not there"
mkdir -p "$WORK/tests/kernels"
cp "$WORK/golden.h" "$WORK/tests/kernels/golden.h"
emcc -std=c11 -O2 -ffp-contract=off -I"$WORK" -Itests/cross -Iinclude -I. tests/kernels/kernels.c tests/oracle/*.c \
    "$BUILD/web/liblampion.a" -sALLOW_MEMORY_GROWTH -sTOTAL_STACK=1MB -sSINGLE_FILE -o "$WORK/broken.js"
! node "$WORK/broken.js" >"$WORK/log" 2>&1 || fail "a wrong checksum goes unseen"
