# SPDX-License-Identifier: MIT
# Static and shared library from one compilation, in build/package as ./dev package makes them, and
# installed in usr without the program, for the tests that look at them from outside.
set -eu
. tests/checks/common.sh

export SOURCE_DATE_EPOCH=0
{
    cmake --preset package && cmake --build --preset package --target lampion lampion_other lampion_hlsl lampion_metal &&
        for component in library development; do
            cmake --install build/package --prefix "$WORK/usr" --component $component || exit 1
        done
} >"$WORK/log" 2>&1 || fail "$(tail -n 40 "$WORK/log")"
