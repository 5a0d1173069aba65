# SPDX-License-Identifier: MIT
# lampion ruler: what it prints reads back, and bad columns are refused by the name of their row.
set -eu
. tests/checks/common.sh

"$PROGRAM" ruler --truth >"$WORK/all.csv"
head -n 1 "$WORK/all.csv" | grep -qx 'id,light,size,.*,exponent,value,radius' || fail "the header is another"
cut -d, -f1 ruler/ruler.csv >"$WORK/ids"
cut -d, -f1 "$WORK/all.csv" | cmp - "$WORK/ids" || fail "rows are missing"
"$PROGRAM" ruler >"$WORK/plain.csv"
cut -d, -f1-10 "$WORK/all.csv" | cmp - "$WORK/plain.csv" || fail "--truth changes other columns"
"$PROGRAM" ruler --material lambert --light sphere >"$WORK/some.csv"
! tail -n +2 "$WORK/some.csv" | grep -v '^[0-9]*,sphere,.*,lambert,' || fail "other rows were printed"
"$PROGRAM" ruler --format json --truth >"$WORK/all.json"
[ "$(grep -c '"value": [0-9]' "$WORK/all.json")" = $(($(wc -l <"$WORK/all.csv") - 1)) ] || fail "JSON has other rows"
python=$(python_with json)
[ -z "$python" ] || "$python" -c 'import json, sys; json.load(open(sys.argv[1]))' "$WORK/all.json"

# A column may have either form, any order, and either end of line.
cut -d, -f1-11 "$WORK/all.csv" >"$WORK/whole.csv"
cut -d, -f1,11 "$WORK/all.csv" >"$WORK/mine.csv"
{ head -n 1 "$WORK/mine.csv"; tail -n +2 "$WORK/mine.csv" | sort -r; } | sed 's/$/\r/' >"$WORK/sorted.csv"
cut -d, -f1,11,12 "$WORK/all.csv" >"$WORK/bounded.csv"
for form in all whole mine bounded sorted; do
    "$PROGRAM" ruler --check "$WORK/$form.csv" >"$WORK/out" || fail "$form: $(cat "$WORK/out")"
    grep -q '^verdict: within the limits (rms 0 ' "$WORK/out" || fail "$form: $(tail -n 1 "$WORK/out")"
done
grep -q '^worst rows' "$WORK/out" && fail "rows without an error are the worst"
sed '/^700,/s/,.*/,1000/' "$WORK/mine.csv" >"$WORK/one.csv"
status=0
"$PROGRAM" ruler --check "$WORK/one.csv" >"$WORK/out" || status=$?
[ $status = 1 ] || fail "one wrong row: status $status"
grep -A 1 '^worst rows' "$WORK/out" | grep -q '^  700,' || fail "the worst row is not named: $(cat "$WORK/out")"
"$PROGRAM" ruler --check "$WORK/one.csv" --rms 1e20 --max 1e20 >/dev/null || fail "the limits do not count"
grep '^id\|,lambert,' "$WORK/whole.csv" | "$PROGRAM" ruler --check - --material lambert >/dev/null ||
    fail "a column of one material is refused"

# refuse TEXT SED-SCRIPT: the column changed by the script must be refused with a line that contains TEXT.
refuse() {
    sed "$2" "$WORK/mine.csv" >"$WORK/bad.csv"
    status=0
    line=$("$PROGRAM" ruler --check "$WORK/bad.csv" 2>&1) || status=$?
    [ $status = 1 ] || fail "$2: status $status"
    [ "$(printf '%s\n' "$line" | wc -l)" = 1 ] || fail "$2: $line"
    case $line in "lampion: $WORK/bad.csv: "*"$1"*) ;; *) fail "$2: $line" ;; esac
}
refuse 'row 17 is missing (1 of ' '/^17,/d'
refuse 'line 19: row 17 is repeated (first on line 18)' '/^17,/p'
refuse 'row 99999 is not one of the ' '$s/^[0-9]*/99999/'
refuse 'row 17.5 is not one of the ' 's/^17,/17.5,/'
refuse 'line 18: row 17: "nan" is not a finite number' 's/^17,.*/17,nan/'
refuse 'line 18: row 17: "inf" is not a finite number' 's/^17,.*/17,inf/'
refuse 'line 18: row 17: "" is not a finite number' 's/^17,.*/17,/'
refuse 'line 18: row 17 is not "17,VALUE"' 's/^17,.*/17,1,2/'
refuse 'line 18: row 17 is not "17,VALUE"' 's/^17,.*/17/'
refuse 'line 18: id: "x" is not a number' 's/^17,/x,/'
refuse 'line 19: id: "" is not a number' '18G'
mv "$WORK/mine.csv" "$WORK/plain.csv" && mv "$WORK/bounded.csv" "$WORK/mine.csv"
refuse 'line 18: row 17 is not "17,VALUE,RADIUS"' 's/^17,.*/17,1/'
refuse 'line 18: row 17 is not "17,VALUE,RADIUS"' 's/^17,.*/17,1,2,3/'
refuse 'line 18: row 17: the radius "" is not a number from 0 on' 's/^17,.*/17,1,/'
refuse 'line 18: row 17: the radius "-1" is not a number from 0 on' 's/^17,.*/17,1,-1/'
refuse 'line 18: row 17: "" is not a finite number' 's/^17,.*/17,,1/'
refuse 'the first line must be "id,value"' '1s/radius/error/'
mv "$WORK/plain.csv" "$WORK/mine.csv"
refuse 'the first line must be "id,value"' '1d'
refuse 'is empty' d
sed '/^17,/s/lambert/metal/' "$WORK/whole.csv" >"$WORK/bad.csv"
! "$PROGRAM" ruler --check "$WORK/bad.csv" 2>"$WORK/out" || fail "another configuration is taken"
grep -q 'line 18: row 17 is not "17,' "$WORK/out" || fail "$(cat "$WORK/out")"
! "$PROGRAM" ruler --check "$WORK/nothing.csv" 2>/dev/null || fail "a file that is not there is read"
! "$PROGRAM" ruler --material gold 2>"$WORK/out" || fail "an unknown material is taken"
grep -q 'gold' "$WORK/out" || fail "$(cat "$WORK/out")"
