# SPDX-License-Identifier: MIT
# What is written by hand stays small enough to be read at once: 450 lines a file, 60 a function, 1700 words a page.
set -eu
. tests/checks/common.sh

file_lines=450
function_lines=60
page_words=1700
generated='src/base/tables.c src/brdf/sgd_table.c src/lobe/ggx_table.c app/scoreboard/cosines_table.c'

# long_files FILE…
long_files() {
    wc -l "$@" | awk -v most=$file_lines '$2 != "total" && $1 > most { print $2 ": " $1 " lines" }'
}

# long_functions FILE…: of C or GLSL as clang-format lays it out: a function ends with the first brace in the
# first column after a line that closes its parameters and opens a brace there or on lines that go on from it.
long_functions() {
    awk -v most=$function_lines '
        FNR == 1 { head = body = 0 }
        !body && /^[A-Za-z_]/ { head = FNR }
        !body && head && /;$/ { head = 0 }
        !body && head && /\) \{$/ { body = head }
        /^}/ {
            if (body && FNR - body + 1 > most)
                print FILENAME ":" body ": a function of " FNR - body + 1 " lines"
            head = body = 0
        }' "$@"
}

# long_pages FILE…: notes alone may be longer.
long_pages() {
    wc -w "$@" | awk -v most=$page_words '$2 != "total" && $1 > most { print $2 ": " $1 " words" }'
}

by_hand=$(git ls-files '*.c' '*.h' '*.sh' '*.awk' '*.cmake' '*CMakeLists.txt' 'shaders/*' dev .ci/run |
    grep -vxF "$(echo $generated | tr ' ' '\n')")
found=$(long_files $by_hand; long_functions $(printf '%s\n' $by_hand | grep -E '\.[ch]$|^shaders/')
    long_pages $(git ls-files 'docs/*.md' | grep -v notes))
[ -z "$found" ] || fail "$found"

# and one would be seen
{
    printf 'static int planted(int a,\n                   int b) {\n'
    yes '    a += b;' | head -n 57
    printf '    return a;\n}\n'
} >"$WORK/planted.c"
[ -n "$(long_functions "$WORK/planted.c")" ] || fail "a function of 61 lines goes unseen"
sed -i 3d "$WORK/planted.c"
[ -z "$(long_functions "$WORK/planted.c")" ] || fail "a function of 60 lines is refused"
yes '/* line */' | head -n 451 >"$WORK/planted.c"
[ -n "$(long_files "$WORK/planted.c")" ] || fail "a file of 451 lines goes unseen"
yes word | head -n 1701 >"$WORK/planted.md"
[ -n "$(long_pages "$WORK/planted.md")" ] || fail "a page of 1701 words goes unseen"
