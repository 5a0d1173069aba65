# SPDX-License-Identifier: MIT
# The program as built has what Debian hardens its packages with.
set -eu
. tests/checks/common.sh

readelf -lWd "$PROGRAM" >"$WORK/layout"
readelf -hW "$PROGRAM" >"$WORK/header"
nm -D --undefined-only "$PROGRAM" >"$WORK/needed"

grep -q 'Type: *DYN' "$WORK/header" || fail "has a fixed address"
grep -q 'GNU_RELRO' "$WORK/layout" || fail "no read-only relocations"
grep -q 'BIND_NOW' "$WORK/layout" || fail "binds functions late, so that their table stays writable"
grep -q 'GNU_STACK.* RW ' "$WORK/layout" || fail "has an executable stack"
grep -q ' RWE ' "$WORK/layout" && fail "has memory that is writable and executable"
grep -q '__stack_chk_fail' "$WORK/needed" || fail "no guards of the stack"
grep -q '__[a-z]*_chk' "$WORK/needed" || fail "sizes are not checked (-D_FORTIFY_SOURCE)"
if [ "$(uname -m)" = x86_64 ]; then
    objdump -d --disassemble=main "$PROGRAM" | grep -q endbr64 || fail "no -fcf-protection"
fi

# The library for Windows must not need any of it, because C libraries there lack it. Only the commands are made.
cmake -S "$SOURCE" -B "$WORK/windows" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_SYSTEM_NAME=Windows \
    -DCMAKE_SYSTEM_PROCESSOR=x86_64 -DCMAKE_TRY_COMPILE_TARGET_TYPE=STATIC_LIBRARY -DLAMPION_PROGRAM=OFF -DLAMPION_TESTS=OFF >"$WORK/log"
grep -q 'src/light/light\.c' "$WORK/windows/compile_commands.json" || fail "no commands for Windows"
! grep -qE 'FORTIFY_SOURCE=|stack-protector-strong|cf-protection' "$WORK/windows/compile_commands.json" ||
    fail "the library for Windows is hardened by what its C library lacks"
