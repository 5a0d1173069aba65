# SPDX-License-Identifier: MIT
# Static and shared library from one compilation, in build/package as ./dev package makes them, and
# installed in usr, for the tests that look at them from outside.
set -eu
. tests/house/common.sh

export SOURCE_DATE_EPOCH=0
{ cmake --preset package && cmake --build --preset package && cmake --install build/package --prefix "$WORK/usr"; } \
    >"$WORK/log" 2>&1 || fail "$(tail -n 40 "$WORK/log")"
