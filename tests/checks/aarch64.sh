# SPDX-License-Identifier: MIT
# The kernels of NEON, built by a cross compiler and run by an emulator of the CPU: the bits and
# checksums of every other instruction set.
set -eu
for tool in aarch64-linux-gnu-gcc qemu-aarch64; do
    command -v $tool >/dev/null || { echo "skipped: $tool is not installed"; exit 0; }
done

built=$WORK/built
cmake -S "$SOURCE" -B "$built" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_SYSTEM_NAME=Linux \
    -DCMAKE_SYSTEM_PROCESSOR=aarch64 -DCMAKE_C_COMPILER=aarch64-linux-gnu-gcc \
    -DLAMPION_PROGRAM=OFF -DLAMPION_TESTS=OFF -DLAMPION_WERROR=ON >"$WORK/log"
cmake --build "$built" >"$WORK/log" || { cat "$WORK/log"; exit 1; }
nm "$built/liblampion.a" 2>/dev/null | grep -q ' [DR] lmp_kernels_vector$' || {
    echo "the library for AArch64 has no kernels of vectors"
    exit 1
}

for name in kernels batch; do
    aarch64-linux-gnu-gcc -std=c11 -O2 -ffp-contract=off -static -Itests/cross -Iinclude -I. \
        tests/kernels/$name.c tests/oracle/*.c "$built/liblampion.a" -lm -o "$WORK/$name"
    qemu-aarch64 "$WORK/$name"
done
