# SPDX-License-Identifier: MIT
# Light that bounces: what is kept in the cache gives the bytes of what is computed, whatever stands there.
set -eu
. tests/checks/common.sh
export XDG_CACHE_HOME="$WORK/cache"

# draw NAME [OPTION…]: renders the ball in bounced light.
draw() {
    name=$1
    shift
    "$PROGRAM" render builtin:ball --device cpu --size 48x27 --bounces 2 --bands 4 -o "$WORK/$name.exr" "$@" >"$WORK/$name.log" 2>&1 ||
        fail "$name: $(cat "$WORK/$name.log")"
}

draw first
kept=$(find "$WORK/cache" -name '*.bounces')
[ "$(echo "$kept" | wc -w)" = 1 ] || fail "not one entry in the cache: $kept"
before=$(stat -c %i "$kept")
draw second
[ "$(stat -c %i "$kept")" = "$before" ] || fail "the rays are cast again"
cmp "$WORK/first.exr" "$WORK/second.exr"

# other lights have the same rays
draw lights --random-lights 3
[ "$(find "$WORK/cache" -name '*.bounces' | wc -l)" = 1 ] || fail "lights have rays of their own"

# an entry that is damaged, cut off, or another one's
printf 'xxxx' | dd of="$kept" bs=1 seek=1000 conv=notrunc 2>/dev/null
draw damaged
cmp "$WORK/first.exr" "$WORK/damaged.exr"
head -c 1000 "$kept" >"$WORK/part"
cp "$WORK/part" "$kept"
draw short
cmp "$WORK/first.exr" "$WORK/short.exr"

# no surface: nothing to cast, and nothing kept that could be read
printf 'v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n' >"$WORK/line.obj"
"$PROGRAM" render "$WORK/line.obj" --device cpu --size 8x8 --bounces 2 -o "$WORK/line.png" >"$WORK/log" 2>&1 || [ $? = 1 ] ||
    fail "a scene without surfaces ends in $(cat "$WORK/log")"

for wrong in -1 1001 x; do
    status=0
    "$PROGRAM" render builtin:ball --bounces $wrong -o "$WORK/x.png" 2>"$WORK/err" || status=$?
    [ $status = 2 ] && grep -q -- --bounces "$WORK/err" || fail "--bounces $wrong: status $status, $(cat "$WORK/err")"
done
