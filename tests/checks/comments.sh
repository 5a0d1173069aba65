# SPDX-License-Identifier: MIT
# Public headers are contracts: 40 to 55 of 100 lines that are not blank are comment. A line counts
# as comment where one stands before any code.
set -eu
. tests/checks/common.sh

# percent FILE: prints the percentage of comment among its lines that are not blank.
percent() {
    awk '
        /^[ \t]*$/ { next }
        { lines++ }
        inside || /^[ \t]*\/\*/ { comments++ }
        {
            rest = $0
            while (at = index(rest, inside ? "*/" : "/*")) {
                rest = substr(rest, at + 2)
                inside = !inside
            }
        }
        END { printf "%d\n", 100 * comments / lines + 0.5 }' "$1"
}

for header in include/lampion/*.h; do
    portion=$(percent "$header")
    [ "$portion" -ge 40 ] && [ "$portion" -le 55 ] ||
        fail "$header: $portion % of its lines are comment, not 40 to 55"
done

printf '/* one\n * two */\n\nint a; /* three */\nint b;\n' >"$WORK/half.h"
[ "$(percent "$WORK/half.h")" = 50 ] || fail "two lines of four are not 50 %"
