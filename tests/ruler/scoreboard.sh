# SPDX-License-Identifier: MIT
# lampion scoreboard: its tables agree with each other, its images appear, and wrong names are refused.
set -eu
. tests/checks/common.sh

"$PROGRAM" scoreboard --material lambert --material metal --formula point --formula cosines --plot "$WORK/plot.svg" \
    --plates "$WORK/plates.png" >"$WORK/text"
grep -A 4 '^lambert, [0-9]* rows' "$WORK/text" | grep -q '^  point  *0.222 ' || fail "$(cat "$WORK/text")"
! grep -q '^phong\|^dielectric\|gaussian' "$WORK/text" || fail "more than was asked for: $(cat "$WORK/text")"
[ "$(grep -c '<circle' "$WORK/plot.svg")" = 2 ] || fail "the plot has other points"
[ "$(head -c 4 "$WORK/plates.png" | tail -c 3)" = PNG ] || fail "plates are no PNG"

"$PROGRAM" scoreboard --formula cosines --format csv >"$WORK/all.csv"
# The rows of all cells of a material must be those of the material.
awk -F, 'NR == 1 { exit ($0 != "formula,material,roughness,half_angle,view_angle,rows,rms,balanced,median,max,worst,energy,ns") }
    ' "$WORK/all.csv" || fail "the header is another"
awk -F, 'NR > 1 && $5 == "all" { whole[$2] = $6; next } NR > 1 { sum[$2] += $6 }
    END { for (m in whole) if (sum[m] != whole[m]) { print m, sum[m], whole[m]; bad = 1 } exit bad }' "$WORK/all.csv" ||
    fail "cells are missing"
"$PROGRAM" scoreboard --formula cosines --format json >"$WORK/all.json"
[ "$(grep -c '"formula"' "$WORK/all.json")" = $(($(wc -l <"$WORK/all.csv") - 1)) ] || fail "JSON has other records"
python=$(python_with json)
[ -z "$python" ] || "$python" -c 'import json, sys; json.load(open(sys.argv[1]))' "$WORK/all.json"

# refuse TEXT OPTION…: the command must fail with one line that contains TEXT.
refuse() {
    text=$1
    shift
    status=0
    line=$("$PROGRAM" scoreboard "$@" 2>&1 >/dev/null) || status=$?
    [ $status = 1 ] || fail "$*: status $status"
    case $line in *"$text"*) ;; *) fail "$*: $line" ;; esac
}
refuse 'did you mean cosines?' --formula cosine
refuse 'did you mean lambert?' --material lambertt
refuse 'published: its table is read from a file: --cosines FILE' --formula published
echo 'var g_ltc_1 = [1, 0, 0, 1];' >"$WORK/ltc.js"
refuse "$WORK/ltc.js: is no table of linearly transformed cosines" --cosines "$WORK/ltc.js"
refuse "$WORK/nowhere/plot.svg" --formula point --plot "$WORK/nowhere/plot.svg"
refuse "$WORK/plates.txt" --formula point --plates "$WORK/plates.txt"
