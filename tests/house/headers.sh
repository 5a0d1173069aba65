# SPDX-License-Identifier: MIT
# Each public header stands alone, as C11 and as C++17, under both compilers, and bears inclusion twice.
set -eu
. tests/house/common.sh

compile() {
    for header in include/lampion/*.h; do
        name=${header#include/}
        printf '#include <%s>\n#include <%s>\n' "$name" "$name" |
            "$@" -Iinclude -Wall -Wextra -Wpedantic -Werror -fsyntax-only - ||
            fail "$header does not stand alone: $*"
    done
}

for compiler in gcc clang; do
    compile "$compiler" -std=c11 -xc
done
for compiler in g++ clang++; do
    compile "$compiler" -std=c++17 -xc++
done
if echo '#include <lampion/nothing.h>' | gcc -Iinclude -fsyntax-only -xc - 2>/dev/null; then
    fail "a header that is not there was found"
fi
