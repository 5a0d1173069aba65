# SPDX-License-Identifier: MIT
# A hardened build by clang keeps the basis in registers: each value goes from the register that it was
# computed in to its plane, not first to the stack.
set -eu
. tests/checks/common.sh

case $(uname -m) in x86_64) ;; *) echo "skipped: the instructions of x86-64 are counted"; exit 0 ;; esac

command -v clang >/dev/null || { echo "skipped: clang is not installed"; exit 0; }
cmake -S "$SOURCE" -B "$WORK/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_C_COMPILER=clang \
    -DCMAKE_C_FLAGS='-O2 -D_FORTIFY_SOURCE=2' -DLAMPION_PROGRAM=OFF -DLAMPION_TESTS=OFF >"$WORK/log"
cat >"$WORK/six_bands.c" <<'C'
#define LMPI_LANES 8
#include "src/kernels/basis_tmpl.h"
void six_bands(const float *axes, float *planes);
void six_bands(const float *axes, float *planes) {
    const vf axis[3] = { vf_load(axes), vf_load(axes + 8), vf_load(axes + 16) };
    basis_straight(6, axis, NULL, planes, 64);
}
C
command=$(sed -n 's,^ *"command": "\(.* \)-o .*/avx2\.c\.o -c .*,\1,p' "$WORK/build/compile_commands.json" | sed 's,\\,,g')
[ -n "$command" ] || fail "no command compiles src/kernels/avx2.c"
sh -c "$command -w -S -o '$WORK/six_bands.s' '$WORK/six_bands.c'"

planes=36
stores=$(grep -c 'vmov[a-z]*[[:space:]]*%ymm[0-9]*, *[-0-9]*(%r' "$WORK/six_bands.s" || true)
[ "$stores" -ge $planes ] || fail "$stores stores of $planes planes: what is counted is not what clang writes"
spilled=$(grep -c 'vmov[a-z]*[[:space:]]*%ymm[0-9]*, *[-0-9]*(%r[sb]p)' "$WORK/six_bands.s" || true)
[ "$spilled" -lt $((planes / 4)) ] || fail "$spilled of $stores stores go to the stack"
