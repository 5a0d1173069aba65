# SPDX-License-Identifier: MIT
# lampion basis: the figure has its colors where they belong, at any size, or no file at all.
set -eu
. tests/checks/common.sh

"$PROGRAM" basis --bands 2 --size 360x220 -o "$WORK/basis.png" >"$WORK/out" 2>&1 ||
    fail "$(cat "$WORK/out")"
[ ! -s "$WORK/out" ] || fail "talks in a pipe: $(cat "$WORK/out")"
[ "$(head -c 8 "$WORK/basis.png" | od -An -tx1)" = " 89 50 4e 47 0d 0a 1a 0a" ] || fail "not a PNG"
"$PROGRAM" basis --bands 12 --size 480x260 -o "$WORK/basis.exr" || fail "12 bands"
[ -s "$WORK/basis.exr" ] || fail "no EXR"

# refuse STATUS ARGUMENT…: the command must print one line, and write nothing.
refuse() {
    expected=$1
    shift
    status=0
    line=$("$PROGRAM" basis "$@" 2>&1) || status=$?
    [ $status = "$expected" ] || fail "basis $*: status $status: $line"
    [ "$(printf '%s\n' "$line" | wc -l)" = 1 ] || fail "basis $*: $line"
}
mkdir "$WORK/empty"
refuse 2
refuse 2 --bands 13 -o "$WORK/empty/a.png"
refuse 1 -o "$WORK/empty/a.jpg"
refuse 1 -o "$WORK/nowhere/a.png"
refuse 1 --bands 12 --size 64x64 -o "$WORK/empty/a.png"
[ -z "$(ls -A "$WORK/empty")" ] || fail "left behind:" "$(ls -A "$WORK/empty")"
