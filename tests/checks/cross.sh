# SPDX-License-Identifier: MIT
# The library for another CPU, built by a cross compiler and run by an emulator: the kernels have the bits and
# checksums of every instruction set, and single calls those of this machine.
set -eu
. tests/checks/common.sh
cpu=$1
for tool in $cpu-linux-gnu-gcc qemu-$cpu; do
    command -v $tool >/dev/null || { echo "skipped: $tool is not installed"; exit 0; }
done

# gcc for s390x says of loops of one turn that it unrolls none
warnings_fail=$([ $cpu = s390x ] && echo OFF || echo ON)
built=$WORK/built
cmake -S "$SOURCE" -B "$built" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_SYSTEM_NAME=Linux \
    -DCMAKE_SYSTEM_PROCESSOR=$cpu -DCMAKE_C_COMPILER=$cpu-linux-gnu-gcc \
    -DLAMPION_PROGRAM=OFF \
    -DLAMPION_TESTS=OFF -DLAMPION_WERROR=$warnings_fail >"$WORK/log"
cmake --build "$built" >"$WORK/log" || { cat "$WORK/log"; exit 1; }
if [ $cpu = aarch64 ]; then
    nm "$built/liblampion.a" 2>/dev/null | grep -q ' [DR] lmp_kernels_vector$' ||
        fail "the library for AArch64 has no kernels of vectors"
fi

"${CC:-cc}" -std=c11 -O2 -Iinclude tests/cross/single.c "$BUILD/liblampion.a" -lm -o "$WORK/here"
$cpu-linux-gnu-gcc -std=c11 -O2 -static -Iinclude tests/cross/single.c "$built/liblampion.a" -lm -o "$WORK/there"
"$WORK/here" >"$WORK/here.txt"
qemu-$cpu "$WORK/there" >"$WORK/there.txt"
different=$(diff "$WORK/here.txt" "$WORK/there.txt" | sed -n 's/^< \([a-z_]*\) .*/\1/p' | sort -u)
[ -z "$different" ] || fail "other bits than this machine's:" $different

# the checksums take minutes; for s390x, whose kernels are those of any CPU without vectors, batches are enough
[ $cpu = aarch64 ] && names='kernels batch' || names=batch
for name in $names; do
    $cpu-linux-gnu-gcc -std=c11 -O2 -ffp-contract=off -fexcess-precision=fast -static -Itests/cross -Iinclude -I. \
        tests/kernels/$name.c tests/oracle/*.c "$built/liblampion.a" -lm -o "$WORK/$name"
    qemu-$cpu "$WORK/$name"
done
