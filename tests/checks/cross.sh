# SPDX-License-Identifier: MIT
# The library for another platform, built by a cross compiler and run by an emulator, or by this machine: single calls have
# this machine's bits, the kernels those and the checksums of every instruction set, and the library's tests pass, where
# the platform is one that this machine runs itself.
set -eu
. tests/checks/common.sh
platform=$1

# how it is compiled and run, and what an emulator is given of tests/kernels: the checksums take minutes, which the soak
# has, and where the kernels are those of any CPU without vectors, batches are enough; and whether this machine runs the
# unit tests there
processor=$platform system=Linux suffix= flags= options=-DLAMPION_WERROR=ON run= units= kernels=batch
case $platform in
aarch64) compiler=aarch64-linux-gnu-gcc run=qemu-aarch64 kernels="${LAMPION_SOAK:+kernels }batch" ;;
s390x) # gcc for s390x says of loops of one turn that it unrolls none
    compiler=s390x-linux-gnu-gcc run=qemu-s390x options=-DLAMPION_WERROR=OFF ;;
i686) # SSE2's float and double are those of other platforms, the x87's are not
    compiler=i686-linux-gnu-gcc flags='-msse2 -mfpmath=sse' units=yes ;;
musl) compiler=musl-gcc processor=x86_64 options="$options -DLAMPION_SIMD=OFF" units=yes ;;
windows) # isnan of its headers converts doubles to float
    compiler=x86_64-w64-mingw32-gcc processor=x86_64 system=Windows suffix=.exe run=wine units=yes
    options='-DLAMPION_WERROR=OFF -DLAMPION_SIMD=OFF -DLAMPION_BOTH=ON'
    export WINEPREFIX="$WORK/wine" WINEDEBUG=-all DISPLAY= ;;
esac
# Unrolled code takes the compiler minutes; the soak has AArch64's. Of its rolled loops, which run at least once, gcc
# warns that what they set may not be set.
level=-O3
if [ -z "${LAMPION_SOAK:-}" ]; then
    unset LAMPION_LONG # the full size of these tests has been tried by this machine's own programs
    level=-O2 options="$options -DLAMPION_UNROLL=OFF"
    [ $platform != aarch64 ] || options="$options -DLAMPION_WERROR=OFF"
fi
for tool in $compiler $run; do
    command -v $tool >/dev/null || { echo "skipped: $tool is not installed"; exit 0; }
done

# One server for all of the programs: one that stops while the next program starts would fail it.
if [ $platform = windows ]; then
    mkdir -p "$WINEPREFIX"
    wineserver -p
    trap 'wineserver -k' EXIT
fi

built=$WORK/built
cmake -S "$SOURCE" -B "$built" -G Ninja -DCMAKE_BUILD_TYPE=Release "-DCMAKE_C_FLAGS_RELEASE=$level -DNDEBUG" -DCMAKE_SYSTEM_NAME=$system \
    -DCMAKE_SYSTEM_PROCESSOR=$processor -DCMAKE_C_COMPILER=$compiler "-DCMAKE_C_FLAGS=$flags" \
    -DLAMPION_PROGRAM=OFF -DLAMPION_TESTS=OFF $options >"$WORK/log"
cmake --build "$built" >"$WORK/log" || { cat "$WORK/log"; exit 1; }
if [ $platform = aarch64 ]; then
    nm "$built/liblampion.a" 2>/dev/null | grep -q ' [DR] lmpi_kernels_vector$' ||
        fail "the library for AArch64 has no kernels of vectors"
fi

compile_c="$compiler -std=c11 -O2 $flags -D_GNU_SOURCE -ffp-contract=off -fexcess-precision=fast -static -Itests/cross -Iinclude -I."

# compile OUTPUT SOURCE…: compiles for the platform.
compile() {
    output=$1
    shift
    $compile_c "$@" "$built/liblampion.a" -lm -o "$output$suffix"
}

# A kernel may be told to run no programs of 32 bits.
if [ $platform = i686 ]; then
    compile "$WORK/trial" examples/first_light.c
    if ! "$WORK/trial" >"$WORK/log" 2>&1; then
        command -v qemu-i386 >"$WORK/log" || { echo "skipped: this machine runs no 32-bit programs, and qemu-i386 is not installed"; exit 0; }
        run=qemu-i386
        unset LAMPION_LONG # at a twentieth of the speed
    fi
fi

"${CC:-cc}" -std=c11 -O2 -Iinclude tests/cross/single.c "$BUILD/liblampion.a" -lm -o "$WORK/here"
compile "$WORK/there" tests/cross/single.c
"$WORK/here" >"$WORK/here.txt"
$run "$WORK/there$suffix" | tr -d '\r' >"$WORK/there.txt"
different=$(diff "$WORK/here.txt" "$WORK/there.txt" | sed -n 's/^< \([a-z_]*\) .*/\1/p' | sort -u)
[ -z "$different" ] || fail "other bits than this machine's:" $different

for name in $kernels; do
    compile "$WORK/$name" tests/kernels/$name.c tests/oracle/*.c
    $run "$WORK/$name$suffix"
done

# A DLL exports the public functions alone, and serves a program of its headers.
if [ $platform = windows ]; then
    dll=$(echo "$built"/*lampion*.dll)
    x86_64-w64-mingw32-objdump -p "$dll" | sed -n '/Ordinal\/Name Pointer/,/^$/s/.*\] *\([a-z]\)/\1/p' | awk '{ print $NF }' | sort >"$WORK/exported"
    declarations include/lampion/*.h | cut -d '|' -f 2 | sort >"$WORK/declared"
    diff "$WORK/declared" "$WORK/exported" >"$WORK/log" || fail "the DLL exports otherwise than the headers declare: $(cat "$WORK/log")"
    $compiler -std=c11 -DLMP_DLL -Iinclude examples/first_light.c "$built"/*.dll.a -o "$built/first_light.exe"
    (cd "$built" && $run first_light.exe) | grep -q '^point 0 reflects 0\.2' || fail "a program does not run by the DLL"
fi

[ -n "$units" ] || exit 0
oracle=
for source in tests/oracle/*.c; do
    object=$WORK/$(basename $source .c).o
    $compile_c -c $source -o "$object"
    oracle="$oracle $object"
done
# These tests take seconds and use nothing of the system; most of the others are heavy sums in double precision.
xargs -P "$(nproc)" -I NAME sh -c "$compile_c tests/unit/NAME.c $oracle $built/liblampion.a -lm -o $WORK/unit_NAME$suffix &&
    $run $WORK/unit_NAME$suffix && echo passed: NAME || { echo failed: NAME; exit 1; }" >"$WORK/log" 2>&1 <<UNITS || fail "$(cat "$WORK/log")"
base
coat
environment
field_bytes
half
host
image
light
light_n
lobe
probe
product
rotation
sh
shade
shade_n
sphere
transfer
window
UNITS
echo "$(grep -c '^passed: ' "$WORK/log") unit tests passed"
