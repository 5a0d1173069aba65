# SPDX-License-Identifier: MIT
# The camera and the exposure of a scene, as render and reference choose them.
set -eu
. tests/checks/common.sh
cd "$WORK"
small='--size 32x24 --samples 1 --bands 3'

cat >box.obj <<'END'
v -1 0 -1
v 1 0 -1
v 1 2 -1
v -1 2 -1
v -1 0 1
v 1 0 1
v 1 2 1
v -1 2 1
f 1 4 3 2
f 5 6 7 8
f 1 2 6 5
f 4 8 7 3
f 1 5 8 4
f 2 3 7 6
END
cat >lamps.json <<'END'
{ "lights": [ { "position": [-2, 2, 3], "radius": 0.4, "radiance": [900, 300, 50] },
              { "position": [2, 3, 2], "radius": 0.2, "radiance": [100, 300, 900] },
              { "position": [0, 1, 3], "radius": 0.3, "radiance": [10, 10, 10] } ] }
END

# The framing found is printed, and its alternative; not where one was chosen.
"$PROGRAM" render box.obj $small -o found.png 2>err
grep -q 'box.obj: no camera in it, seen from outside (--framing inside steps in)' err || fail "$(cat err)"
for from in outside inside; do
    "$PROGRAM" render box.obj $small --framing $from -o $from.png 2>err
    ! grep -q framing err || fail "--framing $from: $(cat err)"
    "$PROGRAM" reference box.obj --size 32x24 --spp 1 --framing $from -o reference-$from.png 2>err
    ! grep -q framing err || fail "reference --framing $from: $(cat err)"
done
cmp -s found.png outside.png || fail "the framing that was found is not --framing outside"
! cmp -s inside.png outside.png || fail "--framing inside changes nothing"
! cmp -s reference-inside.png reference-outside.png || fail "reference --framing inside changes nothing"
"$PROGRAM" render box.obj $small --eye 3,3,3 -o eye.png 2>err
! grep -q framing err || fail "--eye: $(cat err)"
status=0
"$PROGRAM" render builtin:balls $small --framing outside --camera 0 -o none.png 2>err || status=$?
[ $status = 1 ] && grep -q 'camera: --camera and --framing exclude each other' err || fail "$status: $(cat err)"
[ ! -e none.png ] || fail "an image beside an error"

# A file whose z is up is rotated and that printed, from the cache too; not where an axis was chosen.
printf 'solid s\nfacet normal 0 -1 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 0 3\nendloop\nendfacet\nendsolid s\n' >flag.stl
for time in 1 2; do
    "$PROGRAM" render flag.stl $small -o auto.png 2>err
    grep -q 'flag.stl: z is up in this kind of file, so it was rotated (--up y leaves it as it is)' err || fail "$(cat err)"
done
for up in y z; do
    "$PROGRAM" render flag.stl $small --up $up -o $up.png 2>err
    ! grep -q rotated err || fail "--up $up: $(cat err)"
done
cmp -s auto.png z.png && ! cmp -s auto.png y.png || fail "the axis that was found is not --up z"
"$PROGRAM" info --quiet flag.stl >info 2>err
[ ! -s err ] || fail "--quiet: $(cat err)"

# Exposure depends neither on shadows nor on lamps that are seen.
for options in '' --shadows --hide-lights '--shadows --hide-lights'; do
    "$PROGRAM" render box.obj $small --lights lamps.json --environment studio --stats --repeat 1 $options -o lit.png 2>err |
        grep -e '"exposure"' -e '"average_radiance"' >exposure
    [ "$(grep -c . exposure)" = 2 ] || fail "--stats $options: $(cat exposure)"
    [ -n "$options" ] || cp exposure first
    cmp -s exposure first || fail "$options: $(cat first exposure)"
done

# A light stands inside the box.
echo '{ "lights": [ { "position": [0, 1, 0], "radius": 0.1, "radiance": [10, 10, 10] } ] }' >inside.json
"$PROGRAM" render box.obj $small --lights inside.json -o lit.png 2>err
grep -q 'box.obj: light 0 is inside closed geometry: with shadows it lights nothing else' err || fail "$(cat err)"
"$PROGRAM" render box.obj $small --lights lamps.json -o lit.png 2>err
! grep -q 'closed geometry' err || fail "$(cat err)"
