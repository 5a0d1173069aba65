# SPDX-License-Identifier: MIT
# lampion paper: quick steps succeed, a step that fails is told in the page and stops nothing.
set -eu
. tests/checks/common.sh
unset LAMPION_DATA

"$PROGRAM" paper -o "$WORK/page" --quick --step operations --step cap --step table --step preintegrated --step gradients --step fields --step shadows >"$WORK/out" ||
    fail "the quick steps fail"
[ "$(cat "$WORK/out")" = "$WORK/page/index.html" ] || fail "the page's name is not printed"
grep -q '</html>' "$WORK/page/index.html" || fail "the page is truncated"
! grep -q 'class="failed"' "$WORK/page/index.html" || fail "a step failed"
for form in 3,3,5 6,13,19; do
    grep -q "^closed forms (Sloan 2008),$form,0," "$WORK/page/operations.csv" ||
        fail "the closed forms' operations are not the paper's $form"
done
[ "$(grep -o '<h2>[^<]*' "$WORK/page/index.html" | head -1)" = "<h2>Verdict" ] || fail "the page does not begin with the verdict"
verdict() {
    grep -q "^$1.*,$2," "$WORK/page/verdict.csv" || fail "not \"$2\": $(grep "^$1" "$WORK/page/verdict.csv")"
}
verdict "beyond three bands the recurrence takes fewer operations.*,22 against 32" holds
verdict "up to three bands the closed forms are as efficient.*,8 against 7" "does not hold"
verdict "the projection is robust to lights far away" "not as printed in single precision"
! grep -q 'measured materials' "$WORK/page/verdict.csv" || fail "a claim of a step that did not run"
grep -q '^"library: fused with Eq. 13, by differences",3,' "$WORK/page/operations.csv" ||
    fail "a comma in a label is not the label's"
grep -q 'the recurrence takes fewer operations from 3 bands on, 7 against 8' "$WORK/page/index.html" ||
    fail "the page hides what contradicts the paper"
# What the table step says of the paper's statements must follow from the figures beside it, whatever they are.
set -- $(sed -n 's/^the zonal coefficients cost little.*[,"]\([0-9]*\) of \([0-9]*\) ns a light, 10 bands",\([a-z]*\).*/\1 \2 \3/p' \
    "$WORK/page/verdict.csv")
[ $# = 3 ] || fail "nothing is said of what Y_lm costs beside Z_l: $(cat "$WORK/page/verdict.csv")"
[ $((2 * $1)) -ge $(($2 - 1)) ] || [ $3 = holds ] || fail "$1 of $2 ns, and Y_lm does not dominate?"
[ $((2 * $1)) -le $(($2 + 1)) ] || [ $3 = does ] || fail "$1 of $2 ns, and Y_lm dominates?"
said="Y<sub>lm</sub> does not dominate here"
[ $3 = does ] || said="Y<sub>lm</sub> dominates, as the paper says"
grep -qF "$said" "$WORK/page/index.html" || fail "the page does not say: $said"
set -- $(sed -n 's/.*half a millisecond a frame,"\([0-9]*\) ns a light, \([0-9]*\) by a table of 1024, of \([0-9]*\) for all",\([a-z]*\).*/\1 \2 \3 \4/p' \
    "$WORK/page/verdict.csv")
[ $# = 4 ] || fail "nothing is said of what a table saves: $(cat "$WORK/page/verdict.csv")"
saved=$((10 * ($1 - $2)))
[ $saved -ge $(($3 - 11)) ] || [ $4 = holds ] || fail "a table saves $1 - $2 of $3 ns, and that is much?"
[ $saved -le $(($3 + 11)) ] || [ $4 = not ] || fail "a table saves $1 - $2 of $3 ns, and that is little?"
awk -F, '!/^form|^"?largest/ { if ($(NF - 1) + 0 > $NF + 0) exit 1 }' "$WORK/page/tabulated.csv" ||
    fail "a part of the angles has a larger error than all of them"
awk -F, '/none/ { none = $(NF - 1) } $3 == 2 { if (!($(NF - 1) * 10 <= none)) exit 1; found++ } END { exit found != 2 }' \
    "$WORK/page/shadows.csv" || fail "shadows bring images no nearer to the truth"
for file in figure4.svg accuracy.csv tabulated.csv preintegrated.csv preintegrated-memory.svg gradients.svg fields-cost.csv fields.svg shadows.csv shadows-figure5-2.exr.png; do
    [ -s "$WORK/page/$file" ] || fail "$file is missing"
    grep -q "$file" "$WORK/page/index.html" || fail "$file is not on the page"
done

# Half the step gives a quarter of the error of derivatives, and half that of constants.
awk -F, '$1 == "as they are" { constant[++n] = $3 } $1 == "with derivatives" { x[++m] = $2; linear[m] = $3 }
    END { exit !(n == m && m > 9 && linear[1] < constant[1] / 50 && constant[4] / constant[1] < 1.01 * x[4] / x[1] &&
        linear[4] / linear[1] > 0.98 * (x[4] / x[1]) ^ 2) }' "$WORK/page/gradients.csv" ||
    fail "derivatives gain nothing: $(cat "$WORK/page/gradients.csv")"
awk -F, '!/^lights/ && !($5 + 0 > 0 && $5 + 0 < 5 && $6 + 0 < $5 + 0) { exit 1 }' "$WORK/page/fields-cost.csv" ||
    fail "a field is far from the sum: $(cat "$WORK/page/fields-cost.csv")"

mkdir -p "$WORK/broken/data/sponza"
echo nonsense >"$WORK/broken/data/sponza/sponza.gltf"
status=0
"$PROGRAM" paper -o "$WORK/failed" --step sponza --step operations --data "$WORK/broken" >"$WORK/out" 2>"$WORK/err" || status=$?
[ $status = 1 ] || fail "a failed step ends with status $status"
grep -q 'class="failed"' "$WORK/failed/index.html" || fail "the page hides the failure"
grep -q 'closed forms' "$WORK/failed/index.html" || fail "the failure stopped the other step"

status=0
"$PROGRAM" paper -o "$WORK/none" --step operations --data "$WORK/nowhere" 2>"$WORK/err" || status=$?
[ $status = 1 ] && grep -qxF "lampion: $WORK/nowhere: is no folder: No such file or directory" "$WORK/err" ||
    fail "a folder that is not there: status $status, $(cat "$WORK/err")"

status=0
"$PROGRAM" paper -o "$WORK/none" --step beauty 2>"$WORK/err" || status=$?
[ $status = 2 ] && grep -q beauty "$WORK/err" || fail "an unknown step is accepted"
