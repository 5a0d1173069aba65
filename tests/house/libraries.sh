# SPDX-License-Identifier: MIT
# The library alone, static and shared, for the tests that look at it from outside.
set -eu
. tests/house/common.sh

configure "$WORK/static" -DCMAKE_INSTALL_LIBDIR=lib
configure "$WORK/shared" -DCMAKE_INSTALL_LIBDIR=lib -DBUILD_SHARED_LIBS=ON
