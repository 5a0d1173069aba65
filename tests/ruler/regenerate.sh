# SPDX-License-Identifier: MIT
# Rows of ruler/ruler.csv and ruler/bands.csv, drawn at random, are computed again: configurations are
# the same text, and the old enclosure and the new one overlap. SEED repeats a draw.
set -eu
. tests/checks/common.sh

if ! printf '#include <acb.h>\nint main(void) { return 0; }\n' >"$WORK/arb.c" ||
    ! ${CC:-cc} "$WORK/arb.c" -lflint-arb -lflint -o "$WORK/arb" 2>/dev/null; then
    echo "skipped: Arb is not installed (libflint-arb-dev, libflint-dev)"
    exit 0
fi
${CC:-cc} -std=c11 -O2 -I. ruler/*.c -lflint-arb -lflint -lm -o "$WORK/lampion_ruler"

seed=${SEED:-$(date +%s)}
count=24
[ "${LAMPION_LONG:-0}" != 1 ] || count=200
echo "SEED=$seed"
ids=$(awk -F, -v seed="$seed" -v count=$count '
    NR > 1 { id[NR - 1] = $1 }
    END { srand(seed); for (k = 0; k < count; k++) print id[1 + int(rand() * (NR - 1))] }' ruler/ruler.csv)

# overlap OLD NEW VALUES: the columns before the last VALUES + 1 are the same, and of each value the
# difference is at most both radii and what printing rounds.
overlap() {
    awk -F, -v values="$3" '
        { text = $1; for (k = 2; k < NF - values; k++) text = text "," $k }
        NR == FNR { old[text] = $0; next }
        FNR == 1 { next }
        !(text in old) { print "changed: " $0; bad = 1; next }
        { split(old[text], was, ",")
          for (k = NF - values; k < NF; k++) {
              size = $k < 0 ? -$k : $k; off = $k - was[k]
              if (!((off < 0 ? -off : off) <= $NF + was[NF] + 4e-16 * size)) {
                  print "was " old[text] "\nis  " $0; bad = 1 } } }
        END { exit bad }' "$1" "$2"
}

"$WORK/lampion_ruler" $ids >"$WORK/rows.csv" 2>"$WORK/effort"
overlap ruler/ruler.csv "$WORK/rows.csv" 1 || fail "the table is not what its generator writes"
"$WORK/lampion_ruler" --bands $ids >"$WORK/bands.csv" 2>>"$WORK/effort"
overlap ruler/bands.csv "$WORK/bands.csv" 10 || fail "the truncated values are not what their generator writes"

# and a wrong one would be seen
sed '2s/,[0-9.e-]*,\([^,]*\)$/,123,\1/' "$WORK/rows.csv" >"$WORK/wrong.csv"
! overlap ruler/ruler.csv "$WORK/wrong.csv" 1 >/dev/null || fail "a wrong value goes unseen"

