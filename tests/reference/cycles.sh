# SPDX-License-Identifier: MIT
# The ground truth beside a renderer that others made: Blender's Cycles agrees with `lampion reference`, of the same
# triangles under the same spheres of light, within the noise of both. White metal is seen straight down, for there the
# separable masking of Cycles 3 and the correlated one of glTF are the same.
set -eu
. tests/checks/common.sh
command -v blender >/dev/null || { echo "skipped: blender is not installed (package blender)"; exit 0; }
seeds=16
script=$PWD/tests/reference/cycles.py
cd "$WORK"

cat >lights.json <<'END'
{ "lights": [ { "position": [ -1.5, 0.5, 1.2 ], "radius": 0.6, "radiance": [ 9, 5, 2 ] },
              { "position": [ 1.2, -0.8, 1.8 ], "radius": 0.5, "radiance": [ 2, 8, 9 ] },
              { "position": [ 4.4, 1.5, 0.1 ], "radius": 0.8, "radiance": [ 6, 6, 9 ] } ] }
END

# plate NAME ROUGHNESS: writes a plate of white metal.
plate() {
    printf 'newmtl white\nKd 1 1 1\nPm 1\nPr %s\n' "$2" >"$1.mtl"
    printf '%s\n' "mtllib $1.mtl" 'usemtl white' 'v -4 -3 0' 'v 4 -3 0' 'v 4 3 0' 'v -4 3 0' 'vn 0 0 1' \
        'f 1//1 2//1 3//1 4//1' >"$1.obj"
}

# A box stands over the plate.
plate shadow 1
for z in 0.3 0.8; do printf "v %s $z\n" '-0.5 -0.4' '0.5 -0.4' '0.5 0.4' '-0.5 0.4'; done >>shadow.obj
printf '%s\n' 'vn 0 0 -1' 'vn 0 -1 0' 'vn 1 0 0' 'vn 0 1 0' 'vn -1 0 0' 'f 9//1 10//1 11//1 12//1' \
    'f 8//2 7//2 6//2 5//2' 'f 5//3 6//3 10//3 9//3' 'f 6//4 7//4 11//4 10//4' 'f 7//5 8//5 12//5 11//5' \
    'f 8//6 5//6 9//6 12//6' >>shadow.obj

set --
plate lambert 1
set -- "$@" lambert lambert:0.8 orthographic:4
for roughness in 0.2 0.4 0.6 0.9; do
    plate "ggx-$roughness" $roughness
    set -- "$@" "ggx-$roughness" "ggx:$roughness" orthographic:4
done
set -- "$@" shadow lambert:0.8 perspective:0.3,-1.8,2.2
blender --background --factory-startup --python-exit-code 1 --python "$script" -- "$WORK" "$seeds" "$@" >blender.log 2>&1 ||
    fail "$(tail -n 5 blender.log)"

bad=
while [ $# -gt 0 ]; do
    name=$1 material= camera="--eye 0,0,9 --orthographic ${3#*:}"
    case $2 in lambert:*) material="--material white=$2" ;; esac
    case $3 in perspective:*) camera="--eye ${3#*:} --fov 45" ;; esac
    "$PROGRAM" reference "$name.obj" --lights lights.json --hide-lights --shadows --size 48x36 --spp 1024 --target 0,0,0 \
        $material $camera -o "$name.exr"
    printf '%s: ' "$name"
    "$BUILD/tests/reference/judge_seeds" "$name.exr" "$name"-[0-9]*.exr || bad="$bad $name"
    shift 3
done
[ -z "$bad" ] || fail "Cycles shows something else:$bad"

# A difference must be found.
! "$BUILD/tests/reference/judge_seeds" ggx-0.6.exr ggx-0.4-[0-9]*.exr >/dev/null || fail "another roughness goes unseen"
