# SPDX-License-Identifier: MIT
# The ground truth beside a renderer that others made: Blender's Cycles agrees with `lampion reference`, of the same
# triangles under the same lights, within the noise of both: direct light of spheres, of areas and of a mesh that glows,
# and light that bounces in a closed room. White metal is seen straight down, for there the separable masking of Cycles 3
# and the correlated one of glTF are the same.
set -eu
. tests/checks/common.sh
command -v blender >/dev/null || { echo "skipped: blender is not installed (package blender)"; exit 0; }
seeds=16
script=$PWD/tests/reference/cycles.py
cd "$WORK"

cat >spheres.json <<'END'
{ "lights": [ { "position": [ -1.5, 0.5, 1.2 ], "radius": 0.6, "radiance": [ 9, 5, 2 ] },
              { "position": [ 1.2, -0.8, 1.8 ], "radius": 0.5, "radiance": [ 2, 8, 9 ] },
              { "position": [ 4.4, 1.5, 0.1 ], "radius": 0.8, "radiance": [ 6, 6, 9 ] } ] }
END
cat >rectangle.json <<'END'
{ "lights": [ { "kind": "rectangle", "position": [ 0.3, -0.2, 1.1 ], "half_width": [ 0.9, 0, 0.4 ],
                "half_height": [ 0, -0.5, 0 ], "radiance": [ 9, 7, 4 ] } ] }
END
cat >disk.json <<'END'
{ "lights": [ { "kind": "disk", "position": [ -0.8, 0.4, 0.9 ], "direction": [ 1, -0.3, -1 ], "radius": 0.6,
                "radiance": [ 3, 6, 9 ] } ] }
END
echo '{ "lights": [] }' >none.json
cat >lamp.json <<'END'
{ "lights": [ { "position": [ 0.6, 0.3, 0.5 ], "radius": 0.25, "radiance": [ 40, 36, 30 ] } ] }
END
cat >panel.json <<'END'
{ "lights": [ { "kind": "rectangle", "position": [ -0.4, 0.2, 1.15 ], "half_width": [ 0.6, 0, 0 ],
                "half_height": [ 0, -0.4, 0 ], "radiance": [ 20, 20, 20 ] } ] }
END

# plate NAME ROUGHNESS: writes a plate of white metal.
plate() {
    printf 'newmtl white\nKd 1 1 1\nPm 1\nPr %s\n' "$2" >"$1.mtl"
    printf '%s\n' "mtllib $1.mtl" 'usemtl white' 'v -4 -3 0' 'v 4 -3 0' 'v 4 3 0' 'v -4 3 0' 'vn 0 0 1' \
        'f 1//1 2//1 3//1 4//1' >"$1.obj"
}

# box NAME LOW HIGH: adds a box, given its opposite corners, that is seen from outside.
box() {
    first=$(grep -c '^v ' "$1.obj" || true) normal=$(grep -c '^vn ' "$1.obj" || true)
    echo "$2 $3 $first $normal" | awk '{
        for (k = 0; k < 8; k++) print "v", (k % 2 ? $4 : $1), (int(k / 2) % 2 ? $5 : $2), (k > 3 ? $6 : $3)
        split("0 0 -1:0 0 1:0 -1 0:0 1 0:-1 0 0:1 0 0", normals, ":")
        split("1 3 4 2:5 6 8 7:1 2 6 5:3 7 8 4:1 5 7 3:2 4 8 6", faces, ":")
        for (f = 1; f <= 6; f++) print "vn", normals[f]
        for (f = 1; f <= 6; f++) {
            split(faces[f], corner, " ")
            line = "f"
            for (k = 1; k <= 4; k++) line = line " " $7 + corner[k] "//" $8 + f
            print line
        } }' >>"$1.obj"
}

# room NAME: a closed room of white walls, a red and a green one, with a white box in it.
room() {
    printf 'newmtl white\nKd 1 1 1\nnewmtl red\nKd 1 0 0\nnewmtl green\nKd 0 1 0\n' >"$1.mtl"
    printf '%s\n' "mtllib $1.mtl" 'v -2 -1.5 -1.2' 'v 2 -1.5 -1.2' 'v -2 1.5 -1.2' 'v 2 1.5 -1.2' 'v -2 -1.5 1.2' \
        'v 2 -1.5 1.2' 'v -2 1.5 1.2' 'v 2 1.5 1.2' 'vn 0 0 1' 'vn 0 0 -1' 'vn 0 1 0' 'vn 0 -1 0' 'vn 1 0 0' 'vn -1 0 0' \
        'usemtl red' 'f 1//5 3//5 7//5 5//5' 'usemtl green' 'f 2//6 6//6 8//6 4//6' 'usemtl white' \
        'f 1//1 2//1 4//1 3//1' 'f 5//2 7//2 8//2 6//2' 'f 1//3 5//3 6//3 2//3' 'f 3//4 4//4 8//4 7//4' >"$1.obj"
    box "$1" '-0.9 -0.3 -1.2' '-0.2 0.5 -0.4'
}

set --
plate lambert 1
set -- "$@" lambert white=lambert:0.8 orthographic:4 spheres 0
for roughness in 0.2 0.4 0.6 0.9; do
    plate "ggx-$roughness" $roughness
    set -- "$@" "ggx-$roughness" "white=ggx:$roughness" orthographic:4 spheres 0
done
plate shadow 1
box shadow '-0.5 -0.4 0.3' '0.5 0.4 0.8'
set -- "$@" shadow white=lambert:0.8 perspective:0.3,-1.8,2.2 spheres 0
for area in rectangle disk; do
    plate $area 1
    plate $area-ggx 0.4
    set -- "$@" $area white=lambert:0.8 orthographic:4 $area 0 $area-ggx white=ggx:0.4 orthographic:4 $area 0
done
plate glow 1
printf 'newmtl bulb\nKd 0 0 0\nKe 8 6 3\n' >>glow.mtl
echo 'usemtl bulb' >>glow.obj
box glow '2.8 -0.4 0.3' '3.4 0.5 1.1'
set -- "$@" glow white=lambert:0.8+bulb=glow:8,6,3 orthographic:4 none 0
for light in lamp panel; do
    room $light
    set -- "$@" $light white=lambert:0.8+red=lambert:0.8,0.1,0.1+green=lambert:0.2,0.7,0.2 perspective:1.7,-1.3,0.2 $light 4
done
blender --background --factory-startup --python-exit-code 1 --python "$script" -- "$WORK" "$seeds" "$@" >blender.log 2>&1 ||
    fail "$(tail -n 5 blender.log)"

bad=
while [ $# -gt 0 ]; do
    name=$1 camera="--eye 0,0,9 --orthographic ${3#*:}"
    materials=$(echo "$2" | tr + '\n' | sed -n '/=lambert:/s/^/--material /p')
    lights="--lights $4.json --hide-lights"
    [ "$4" != none ] || lights=
    case $3 in perspective:*) camera="--eye ${3#*:} --fov 45" ;; esac
    "$PROGRAM" reference "$name.obj" $lights --environment none --shadows --size 48x36 \
        --spp 1024 --target 0,0,0 --bounces "$5" $materials $camera -o "$name.exr"
    printf '%s: ' "$name"
    "$BUILD/tests/reference/judge_seeds" "$name.exr" "$name"-[0-9]*.exr || bad="$bad $name"
    shift 5
done
[ -z "$bad" ] || fail "Cycles shows something else:$bad"

# A difference must be found.
! "$BUILD/tests/reference/judge_seeds" ggx-0.6.exr ggx-0.4-[0-9]*.exr >/dev/null || fail "another roughness goes unseen"
! "$BUILD/tests/reference/judge_seeds" rectangle.exr disk-[0-9]*.exr >/dev/null || fail "another light goes unseen"
