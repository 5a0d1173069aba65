# SPDX-License-Identifier: MIT
# A small model on wide ground: a plate 2 cm above it casts the same shadow whether the ground ends after 2 m or after
# 5 km, the camera beside it sees it whole, and ground alone, at any angle, hides nothing from itself.
set -eu
. tests/checks/common.sh
export ASAN_OPTIONS=detect_leaks=0
cd "$WORK"

printf 'newmtl wall\nKd 0.8 0.8 0.8\n' >wall.mtl
echo '{ "lights": [ { "position": [ 0.3, 0.5, 0.1 ], "radius": 0.05, "radiance": 50 },
                    { "position": [ -0.2, 0.3, -0.3 ], "radius": 0.02, "radiance": 150 } ] }' >lights.json
camera="--lights lights.json --hide-lights --eye 0,0.4,0.6 --target 0,0,0 --size 96x64 --environment none"

# ground HALF: a square of ground.
ground() {
    printf '%s\n' 'mtllib wall.mtl' 'usemtl wall' "v -$1 0 $1" "v $1 0 $1" "v $1 0 -$1" "v -$1 0 -$1" 'f 1 2 3 4'
}
plate() {
    for y in 0.02 0.04; do printf "v %s $y %s\n" -0.1 0.1 0.1 0.1 0.1 -0.1 -0.1 -0.1; done
    printf 'f %s\n' '5 8 7 6' '9 10 11 12' '5 6 10 9' '6 7 11 10' '7 8 12 11' '8 5 9 12'
}
for half in 2 5000; do { ground $half; plate; } >$half.obj; done

# same BOUND A B: two images differ by at most so much, relatively.
same() {
    "$PROGRAM" compare $2.exr $3.exr --fail-above relmse=$1 >compared || fail "$what: $2 and $3 differ: $(cat compared)"
}

for what in 'render --samples 1 --device cpu' 'render --samples 1' 'reference --spp 16'; do
    for half in 2 5000; do "$PROGRAM" $what $half.obj $camera -o $half.exr; done
    same 0.002 5000 2
    "$PROGRAM" $what 2.obj $camera --no-shadows -o open.exr
    ! "$PROGRAM" compare 2.exr open.exr --fail-above relmse=0.005 >compared || fail "$what: no shadow to lose: $(cat compared)"
    for turn in 1,0 0.92,0.39 0.6,0.8; do
        awk -v turn=$turn 'BEGIN { split(turn, t, ","); print "mtllib wall.mtl\nusemtl wall"
            for (k = 0; k < 4; k++) { x = (k == 1 || k == 2 ? 4700 : -5200); z = k < 2 ? 5100 : -4600
                printf "v %.9g %.9g %.9g\n", t[1] * x, t[2] * x, z }
            print "f 1 2 3\nf 1 3 4" }' >tilted.obj
        for shadows in shadows no-shadows; do "$PROGRAM" $what tilted.obj $camera --$shadows -o $shadows.exr; done
        same 1e-5 shadows no-shadows
    done
done
