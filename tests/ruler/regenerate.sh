# SPDX-License-Identifier: MIT
# Rows of ruler/ruler.csv, ruler/bands.csv and ruler/vectors/*.csv, drawn at random, are computed again: what
# was asked is the same text, and the old enclosure and the new one overlap. SEED repeats a draw.
set -eu
. tests/checks/common.sh

if ! printf '#include <acb.h>\nint main(void) { return 0; }\n' >"$WORK/arb.c" ||
    ! ${CC:-cc} "$WORK/arb.c" -lflint-arb -lflint -o "$WORK/arb" 2>/dev/null; then
    echo "skipped: Arb is not installed (libflint-arb-dev, libflint-dev)"
    exit 0
fi
${CC:-cc} -std=c11 -O2 -I. ruler/*.c -lflint-arb -lflint -lm -o "$WORK/lampion_ruler"
${CC:-cc} -std=c11 -O2 -I. ruler/vectors/*.c -lflint-arb -lflint -lm -o "$WORK/lampion_vectors"

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

# A wrong row must be found.
sed '2s/,[0-9.e-]*,\([^,]*\)$/,123,\1/' "$WORK/rows.csv" >"$WORK/wrong.csv"
! overlap ruler/ruler.csv "$WORK/wrong.csv" 1 >/dev/null || fail "a wrong value goes unseen"

# A hundredth of the vectors, by the number of columns that are asked for. A row of brdf_table takes seconds.
vectors='basis 3,basis_128 4,sphere 7,sphere_inside 7,sphere_gradient 7,sphere_128 8,zonal 1,rotation 68,rotation_128 8,product 72,product_12 288,lobe 2,brdf_table 2'
echo "$vectors" | tr , '\n' | while read -r name asked; do
    wc -l <"ruler/vectors/$name.csv" | awk -v seed="$seed$asked" -v name="$name" -v asked="$asked" -v all="${LAMPION_LONG:-0}" '
        { srand(seed); for (k = 1; k < $1; k++) if (rand() < (all == 1 ? 0.3 : 0.012)) print name, asked, k }'
done >"$WORK/drawn"
[ -s "$WORK/drawn" ] || echo "zonal 1 20" >"$WORK/drawn"
while read -r name asked row; do
    "$WORK/lampion_vectors" "$name" "$row" >"$WORK/vector.csv"
    { head -n 1 "ruler/vectors/$name.csv"; sed -n "$((row + 1))p" "ruler/vectors/$name.csv"; } >"$WORK/kept.csv"
    values=$(head -n 1 "$WORK/kept.csv" | awk -F, -v asked="$asked" '{ print NF - 1 - asked }')
    overlap "$WORK/kept.csv" "$WORK/vector.csv" "$values" || fail "$name.csv, row $row, is not what its generator writes"
done <"$WORK/drawn"
