# SPDX-License-Identifier: MIT
# lampion project against the reference vectors, one form of output against the other, and what it
# refuses.
set -eu
. tests/checks/common.sh

header=light_x,light_y,light_z,radius,recv_x,recv_y,recv_z
vectors=ruler/vectors/sphere.csv
cut -d, -f1-7 "$vectors" | "$PROGRAM" project --batch - --bands 10 >"$WORK/rows"
# bound: 2e-5 of the largest coefficient of the row.
cut -d, -f1-107 "$vectors" | paste -d, - "$WORK/rows" | awk -F, '
    NR == 1 { next }
    {
        largest = 0; error = 0
        for (i = 8; i <= 107; i++) {
            size = $i < 0 ? -$i : $i
            difference = $i - $(i + 100); if (difference < 0) difference = -difference
            if (size > largest) largest = size
            if (!(difference <= error)) error = difference
        }
        if (NF != 207 || !(error <= 2e-5 * largest)) { print "row " NR ": " error " of " largest; bad = 1 }
    }
    END { exit bad || NR < 2 }' >"$WORK/log" || fail "$(cat "$WORK/log")"

# One light is given in three ways, and as a row of a table.
set -- --light 1,2.5,-3 --radius 0.75 --point 0.25,0,1 --bands 4 --radiance 2.5
printf '%s\r\n1,2.5,-3,0.75,0.25,0,1\r\n\r\n' $header |
    "$PROGRAM" project --batch - --bands 4 --radiance 2.5 >"$WORK/table"
"$PROGRAM" project "$@" --format csv | cmp - "$WORK/table" || fail "csv is not the table's row"
"$PROGRAM" project "$@" | awk 'NR > 1 { row = row sep $3; sep = "," } END { print row }' >"$WORK/text"
tail -n 1 "$WORK/table" | cmp - "$WORK/text" || fail "text is not the table's row"
"$PROGRAM" project "$@" --format json | sed 's/.*"coefficients":\[\(.*\)\]}/\1/' |
    cmp - "$WORK/text" || fail "json is not the table's row"
[ "$(head -n 1 "$WORK/table")" = "$(seq -s, -f 'c_%g' 0 15)" ] || fail "the header of the table"

# The visibility of a light is a half, none, and all, which is the same as without the column.
printf '%s,visibility\n1,2.5,-3,0.75,0.25,0,1,0.5\n1,2.5,-3,0.75,0.25,0,1,0\n1,2.5,-3,0.75,0.25,0,1,1\n' $header |
    "$PROGRAM" project --batch - --bands 4 --radiance 5 >"$WORK/visible"
sed -n 2p "$WORK/visible" | cmp - "$WORK/text" || fail "half of twice the light"
[ "$(sed -n 3p "$WORK/visible" | tr -d ,0-)" = "" ] || fail "none of the light"
"$PROGRAM" project "$@" --radiance 5 --format csv | tail -n 1 >"$WORK/all"
tail -n 1 "$WORK/visible" | cmp - "$WORK/all" || fail "all of the light"

# Every instruction set must print the same.
for mask in 1 2 4 8; do
    "$PROGRAM" project "$@" --format csv --cpu-mask $mask | cmp - "$WORK/table" || fail "mask $mask"
done
for mask in 0 16 avx2; do
    if "$PROGRAM" project "$@" --cpu-mask $mask >"$WORK/out" 2>&1; then fail "mask $mask"; fi
done

# A table of many blocks must be complete and in order.
awk -v header=$header 'BEGIN { print header; for (i = 1; i <= 20000; i++) print i % 7 ",0,3," i / 20000 ",0,0,0" }' \
    </dev/null >"$WORK/many"
"$PROGRAM" project --batch "$WORK/many" --bands 1 >"$WORK/many-rows"
[ "$(wc -l <"$WORK/many-rows")" = 20001 ] || fail "rows are missing"
printf '%s\n' "$header" "$(tail -n 1 "$WORK/many")" | "$PROGRAM" project --batch - --bands 1 |
    tail -n 1 >"$WORK/last"
tail -n 1 "$WORK/many-rows" | cmp - "$WORK/last" || fail "rows are out of order"

# The farthest lights allowed must still have coefficients.
printf '%s\n1e17,1e17,1e17,1e17,-1e17,-1e17,-1e17\n' $header | "$PROGRAM" project --batch - --bands 2 >"$WORK/far"
grep -Eq 'nan|inf' "$WORK/far" && fail "the farthest light: $(tail -n 1 "$WORK/far")"

# refuse STATUS MESSAGE ARGUMENT…: the command must print MESSAGE in one line, and no coefficient on a usage error.
refuse() {
    expected=$1 message=$2
    shift 2
    status=0
    line=$("$PROGRAM" project "$@" 2>&1 >"$WORK/out" </dev/null) || status=$?
    [ "$status $line" = "$expected $message" ] || fail "project $*: $status $line"
}
see="; see lampion project --help"
refuse 2 "lampion project: needs --light X,Y,Z and --radius R, or --batch FILE$see"
refuse 2 "lampion project: --radius: -1 is out of range (0 to 1e+17)$see" --radius -1
refuse 2 "lampion project: --batch prints csv only$see" --batch x --format json
refuse 2 "lampion project: --batch takes lights and points from its table alone$see" --batch x --point 0,0,0
refuse 2 "lampion project: \"x\" is not an option$see" x
refuse 1 "lampion: standard input: is empty (its first line must be $header[,visibility])" --batch -
refuse 1 "lampion: $WORK/nothing: No such file or directory" --batch "$WORK/nothing"
printf '%s\n1,2,3,-0.5,0,0,0\n' $header >"$WORK/negative"
refuse 1 "lampion: $WORK/negative: line 2: radius: -0.5 is negative" --batch "$WORK/negative"
printf '%s\n1,2,3,1,0,0,0\n0,2e17,0,1,0,0,0\n' $header >"$WORK/far"
refuse 1 "lampion: $WORK/far: line 3: light_y: 2e+17 is out of range (up to 1e+17)" --batch "$WORK/far"
# Blanks around numbers and names do not count.
printf '%s\n1,2,3,.5,0,0,0\n' $header | "$PROGRAM" project --batch - --bands 2 >"$WORK/tight"
printf '%s\n1, 2, 3, .5, 0, 0, 0\n' "$(echo $header | sed 's/,/, /g')" | "$PROGRAM" project --batch - --bands 2 >"$WORK/blanks"
cmp "$WORK/tight" "$WORK/blanks" || fail "blanks after commas change a row"
printf '%s\n1,2,3,1,0,0,0\n1,2,3,1,0,0,0,9\n' $header >"$WORK/wide"
refuse 1 "lampion: $WORK/wide: line 3: has 8 columns, not 7" --batch "$WORK/wide"
printf '%s,visibility\n1,2,3,1,0,0,0,1.5\n' $header >"$WORK/visibility"
refuse 1 "lampion: $WORK/visibility: line 2: visibility: 1.5 is out of range (0 to 1)" --batch "$WORK/visibility"
printf '%s,c_0\n1,2,3,1,0,0,0,9\n' $header >"$WORK/header"
refuse 1 "lampion: $WORK/header: line 1: the header must be $header[,visibility]" --batch "$WORK/header"
