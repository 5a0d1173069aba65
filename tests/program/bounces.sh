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

# Replaced materials reflect in place of the scene's own: a room is the same, whatever color it had.
room() {
    printf 'newmtl wall\nKd %s %s %s\n' "$2" "$2" "$2" >"$WORK/$1.mtl"
    printf '%s\n' "mtllib $1.mtl" 'v -2 -1 -2' 'v 2 -1 -2' 'v -2 1 -2' 'v 2 1 -2' 'v -2 -1 2' 'v 2 -1 2' 'v -2 1 2' 'v 2 1 2' \
        'usemtl wall' 'f 1 2 4 3' 'f 5 7 8 6' 'f 1 5 6 2' 'f 3 4 8 7' 'f 1 3 7 5' 'f 2 6 8 4' >"$WORK/$1.obj"
    "$PROGRAM" render "$WORK/$1.obj" --device cpu --size 24x16 --bounces 4 --bands 4 --samples 1 --eye 1,0,1.5 --target -1,0,-1 \
        --lights "$WORK/lamp.json" --hide-lights --material wall=lambert:0.5 -o "$WORK/$1.exr" 2>"$WORK/$1.log" || fail "$(cat "$WORK/$1.log")"
}
echo '{ "lights": [ { "position": [ 0, 0.3, 0 ], "radius": 0.2, "radiance": 9 } ] }' >"$WORK/lamp.json"
room dark 0.1
room bright 0.9
cmp "$WORK/dark.exr" "$WORK/bright.exr" || fail "replaced walls reflect as their own material"
rm -f $(find "$WORK/cache" -name "*.bounces")
draw lights --random-lights 3
kept=$(find "$WORK/cache" -name '*.bounces')

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
