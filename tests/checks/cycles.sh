# SPDX-License-Identifier: MIT
# No two files need each other, directly or in a ring: neither by what they include nor by what they call.
# A header and the source of its name are one file. A table may name functions that call back to those who
# read it: what counts is code that calls, not data that names.
set -eu
. tests/checks/common.sh

# includes ROOT: prints a line "FILE FILE" for each include between files of src/, include/, app/ and shaders/.
includes() (
    cd "$1"
    find src include app shaders -name '*.[ch]' ! -path '*/generate/*' | xargs awk '
        { file = FILENAME; sub(/\.[ch]$/, "", file); there[file] }
        /^ *# *include *[<"]/ {
            split($0, part, /[<">]/)
            sub(/\.[ch]$/, "", part[2])
            sub(/^lampion\//, "include/lampion/", part[2])
            if (part[2] != file)
                edges[file " " part[2]]
        }
        END { for (edge in edges) { split(edge, ends, " "); if (ends[2] in there) print edge } }'
)

# calls BUILD ROOT: prints a line "FILE FILE" for each object whose code uses another. Only relocations of code count;
# an object whose source is gone is left from an earlier build. Other tests build the library for other machines below
# BUILD.
calls() (
    cd "$2"
    find src app -name '*.c' | sed 's,$,.o,' >"$WORK/sources"
    cd "$1"
    find . -name '*.c.o' | grep -E '^\./(CMakeFiles/)?[^/]*\.dir/src/|^\./app/' | grep -v /generate/ >"$WORK/objects"
    xargs nm -A <"$WORK/objects" | awk 'NF == 3 && $2 ~ /[TDBRC]/ { sub(/:[0-9a-f]*$/, "", $1); print $3, "is", $1 }' >"$WORK/names"
    xargs readelf -rW <"$WORK/objects" | awk '
        /^File: / { file = $2 }
        /^Relocation section/ { code = /\.rela?\.text/ }
        code && $1 ~ /^[0-9a-f]+$/ { print $5, "taken", file }' >>"$WORK/names"
    sed 's, \./app/.*\.dir/, app/,; s, \./.*\.dir/, ,' "$WORK/names" | sort -u | awk '
        NR == FNR { there[$1]; next }
        !($3 in there) { next }
        { sub(/\.c\.o$/, "", $3) }
        $1 != name { name = $1; home = "" }
        $2 == "is" { home = $3 }
        $2 == "taken" && home && home != $3 { print $3, home }' "$WORK/sources" - | sort -u
)

# between FOLDER EDGES…: prints the edges of all files given whose ends are both in FOLDER.
between() {
    folder=$1
    shift
    awk -v folder="$folder/" 'index($1, folder) == 1 && index($2, folder) == 1' "$@" | sort -u
}

# rings EDGES: prints the first ring of files, or nothing.
rings() {
    tsort "$1" 2>&1 >/dev/null | sed -n 's/^tsort: //p' | grep -v 'contains a loop' || true
}

includes . >"$WORK/includes"
calls "$BUILD" . >"$WORK/calls"
# In the library includes and calls together go one way, too: types lie below the parts that need them, and what joins
# the parts lies above.
between src "$WORK/includes" "$WORK/calls" >"$WORK/library"
for edges in "$WORK/includes" "$WORK/calls" "$WORK/library"; do
    [ "$(wc -l <"$edges")" -gt 300 ] || fail "$edges: too few to be all"
    found=$(rings "$edges")
    [ -z "$found" ] || fail "$(basename "$edges"): in a ring:" $found
done

# A planted ring must be found.
mkdir -p "$WORK/src/a"
echo '#include "src/a/y.h"' >"$WORK/src/a/x.h"
echo '#include "src/a/z.h"' >"$WORK/src/a/y.c"
echo '#include "src/a/x.h"' >"$WORK/src/a/z.h"
: >"$WORK/src/a/y.h"
mkdir -p "$WORK/include" "$WORK/app" "$WORK/shaders"
includes "$WORK" >"$WORK/planted"
[ -n "$(rings "$WORK/planted")" ] || fail "a ring of includes goes unseen"
mkdir -p "$WORK/planted.build/planted.dir/src/a"
for pair in x:y y:x; do
    echo "void ${pair#*:}(void); void ${pair%:*}(void); void ${pair%:*}(void) { ${pair#*:}(); ${pair#*:}(); }" |
        cc -c -x c -o "$WORK/planted.build/planted.dir/src/a/${pair%:*}.c.o" -
done
touch "$WORK/src/a/x.c"
calls "$WORK/planted.build" "$WORK" >"$WORK/planted"
[ -n "$(rings "$WORK/planted")" ] || fail "a ring of calls goes unseen"
