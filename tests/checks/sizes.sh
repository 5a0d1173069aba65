# SPDX-License-Identifier: MIT
# Advice on lengths: up to 600 lines a file and 100 a function, what is written by hand reads well. What is longer is
# named as a warning, and fails unless tests/checks/sizes.txt says why it is. A page of docs has at most 1700 words.
set -eu
. tests/checks/common.sh

file_lines=600
function_lines=100
page_words=1700

# long_files FILE…: prints FILE and its lines, if it is long.
long_files() {
    wc -l "$@" | awk -v most=$file_lines '$2 != "total" && $1 > most { print $2, $1, "lines" }'
}

# long_functions FILE…: FILE:FUNCTION and its lines, of C or GLSL as clang-format lays it out: a function ends with the first
# brace in the first column after a line that closes its parameters and opens a brace there or on lines that go on from it.
long_functions() {
    awk -v most=$function_lines '
        FNR == 1 { head = body = 0 }
        !body && /^[A-Za-z_]/ { head = FNR; name = match($0, /[A-Za-z_0-9]+\(/) ? substr($0, RSTART, RLENGTH - 1) : "?" }
        !body && head && /;$/ { head = 0 }
        !body && head && /\) \{$/ { body = head }
        /^}/ {
            if (body && FNR - body + 1 > most) print FILENAME ":" name, FNR - body + 1, "lines"
            head = body = 0
        }' "$@"
}

# long_pages FILE…: prints pages that are too long; only notes may be longer.
long_pages() {
    wc -w "$@" | awk -v most=$page_words '$2 != "total" && $1 > most { print $2 ": " $1 " words" }'
}

# listed FILE: prints what it permits, one per line; a reason follows each.
listed() {
    sed 's/ *#.*//; /^$/d' "$1"
}

# judge LONG LIST: warns of what is long, or listed without being so; fails for what is long and not listed.
judge() {
    listed "$2" | awk '
        FILENAME == "-" { listed[$1] = 1; next }
        $1 in listed { print "warning: " $0; delete listed[$1]; next }
        { print "not in tests/checks/sizes.txt: " $0; bad = 1 }
        END {
            for (name in listed) print "warning: " name " is listed, and no longer long"
            exit bad
        }' - "$1"
}

by_hand=$(git ls-files '*.c' '*.cpp' '*.h' '*.sh' '*.awk' '*.py' '*.cmake' '*CMakeLists.txt' 'shaders/*/*' dev .ci/run)
{
    long_files $by_hand
    long_functions $(printf '%s\n' $by_hand | grep -E '\.([ch]|cpp)$|^shaders/')
} >"$WORK/long"
judge "$WORK/long" tests/checks/sizes.txt || fail "split it, or say in tests/checks/sizes.txt why not"
pages=$(long_pages $(git ls-files 'docs/*.md' | grep -v notes))
[ -z "$pages" ] || fail "$pages"

# What is too long must be found.
{
    printf 'static int planted(int a,\n                   int b) {\n'
    yes '    a += b;' | head -n 97
    printf '    return a;\n}\n'
} >"$WORK/planted.c"
[ "$(long_functions "$WORK/planted.c")" = "$WORK/planted.c:planted 101 lines" ] || fail "a function of 101 lines goes unseen"
sed -i 3d "$WORK/planted.c"
[ -z "$(long_functions "$WORK/planted.c")" ] || fail "a function of 100 lines is long"
yes '/* line */' | head -n 601 >"$WORK/planted.c"
[ "$(long_files "$WORK/planted.c")" = "$WORK/planted.c 601 lines" ] || fail "a file of 601 lines goes unseen"
long_files "$WORK/planted.c" >"$WORK/planted.long"
! judge "$WORK/planted.long" /dev/null >/dev/null || fail "what is long and not listed passes"
echo "$WORK/planted.c # because" >"$WORK/planted.list"
judge "$WORK/planted.long" "$WORK/planted.list" >/dev/null || fail "what is listed fails"
yes word | head -n 1701 >"$WORK/planted.md"
[ -n "$(long_pages "$WORK/planted.md")" ] || fail "a page of 1701 words goes unseen"
