# SPDX-License-Identifier: MIT
# ./dev keeps its build folders to itself: one that somebody configured without tests or program by hand is
# reconfigured, and said to be; one of its own is left alone. Presets for people have other folders. Its tests end with
# what failed.
set -eu
. tests/checks/common.sh

mkdir -p "$WORK/bin" "$WORK/tree/build/release"
cp dev "$WORK/tree"
cat >"$WORK/bin/cmake" <<'CMAKE'
#!/bin/sh
echo "$*" >>"$LOG"
CMAKE
printf '#!/bin/sh\nprintf installed\n' >"$WORK/bin/dpkg-query"
chmod +x "$WORK/bin/cmake" "$WORK/bin/dpkg-query"
export LOG="$WORK/log"

# built TESTS PROGRAM: prints what ./dev build asks of cmake after release was configured so.
built() {
    : >"$LOG"
    : >"$WORK/tree/build/release/build.ninja"
    printf 'LAMPION_TESTS:BOOL=%s\nLAMPION_PROGRAM:BOOL=%s\n' "$1" "$2" >"$WORK/tree/build/release/CMakeCache.txt"
    PATH="$WORK/bin:$PATH" "$WORK/tree/dev" build >"$WORK/out" 2>"$WORK/err" || fail "./dev build: $(cat "$WORK/err")"
}
build='--build --preset release --target lampion_program'
built ON ON
[ "$(cat "$LOG")" = "$build" ] && [ ! -s "$WORK/err" ] || fail "its own folder is reconfigured: $(cat "$LOG" "$WORK/err")"
for wrong in 'OFF ON' 'ON OFF'; do
    built $wrong
    [ "$(cat "$LOG")" = "--fresh --preset release
$build" ] || fail "a folder of $wrong is taken as it is: $(cat "$LOG")"
    grep -q 'reconfiguring it' "$WORK/err" || fail "nothing is said of it: $(cat "$WORK/err")"
done
! grep -h 'cmake --preset' README.md docs/*.md | grep -vE 'preset (library|install|web)\b' ||
    fail "a document sends its readers into a folder of ./dev"

# What failed is told again at the end, with the last of what it printed.
cat >"$WORK/bin/ctest" <<'CTEST'
#!/bin/sh
cat <<'LOG'
 1/3 Test  #1: unit.one .........   Passed    0.04 sec
 2/3 Test  #2: unit.two .........***Failed    0.05 sec
of the second
      Start  4: unit.four
 3/3 Test  #3: unit.three .......***Timeout   9.00 sec
33% tests passed, 2 tests failed out of 3
LOG
exit 8
CTEST
printf '#!/bin/sh\n' >"$WORK/bin/clang-format"
chmod +x "$WORK/bin/ctest" "$WORK/bin/clang-format"
! (cd "$WORK/tree" && git init -q && PATH="$WORK/bin:$PATH" ./dev test --quick) >"$WORK/out" 2>"$WORK/err" ||
    fail "./dev test succeeds where tests failed"
[ "$(tail -n 4 "$WORK/out")" = "failed: unit.two
    of the second
failed: unit.three
3 passed, 2 failed" ] || fail "./dev test does not end with what failed: $(cat "$WORK/out" "$WORK/err")"
