# SPDX-License-Identifier: MIT
# The step of materials of lampion paper: five, each within 20 bands and past them; what the page says of the paper's
# words follows from its rows.
set -eu
. tests/checks/common.sh
unset LAMPION_DATA

"$PROGRAM" paper -o "$WORK/materials" --step materials >/dev/null || fail "the step of materials fails"
! grep -q 'class="failed"' "$WORK/materials/index.html" || fail "the step of materials failed"
# verdict HOLDS TEXT: checks the verdict of the claim.
judged() {
    told="not on stand-ins"
    [ "$1" = 0 ] || told=holds
    grep -q "^\"\?$2.*,$told," "$WORK/materials/verdict.csv" ||
        fail "not \"$told\": $(cat "$WORK/materials/verdict.csv" "$WORK/materials/figure6.csv")"
}
set -- $(awk -F, '/^[a-e],/ {
        rows[$1 " " $4]++
        all[$1, $4] = $5
        steep[$1, $4] = $6
        if ($4 == "noise alone") noisy += !($5 < 0.005)
    }
    END {
        few = many = 1
        for (i = 1; i <= 5; i++) {
            m = substr("abcde", i, 1)
            for (k = split("10 20 100", bands, " "); k; k--) missing += rows[m " " bands[k]] != (i > 3 || k < 3)
            if (i <= 3) few = few && steep[m, 10] - steep[m, "noise alone"] <= 0.02
            if (i > 3) many = many && all[m, 100] - all[m, "noise alone"] > 0.02
        }
        print few, many, missing, noisy + 0
    }' "$WORK/materials/figure6.csv")
[ "$3" = 0 ] || fail "materials without a row of 10, 20 or 100 bands: $(cat "$WORK/materials/figure6.csv")"
[ "$4" = 0 ] || fail "the truths are too noisy to judge by: $(cat "$WORK/materials/figure6.csv")"
judged "$1" '10 bands are enough for materials (a) to (c) up to 70°'
judged "$2" 'materials (d) and (e) need more than a hundred bands'
grep -q 'more than about 70° from the' "$WORK/materials/index.html" || fail "the page hides the angles that the paper leaves out"
