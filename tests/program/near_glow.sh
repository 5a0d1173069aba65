# SPDX-License-Identifier: MIT
# What glows just before a surface of a large scene: its own triangles hide none of its light from the surfaces that they
# face, which start rays a little before themselves. A room's corner, of which every point sees the whole panel, is the
# same with shadows and without, by `render`, by `reference`, and by light that bounces.
set -eu
. tests/checks/common.sh
export ASAN_OPTIONS=detect_leaks=0 XDG_CACHE_HOME="$WORK/cache"
cd "$WORK"

printf 'newmtl wall\nKd 0.8 0.8 0.8\nnewmtl panel\nKd 0 0 0\nKe 9 7 4\n' >corner.mtl

# same SCALE COMMAND OPTION…: under a panel so many units above the floor, COMMAND shows with shadows what it does without,
# to within its noise.
same() {
    scale=$1 command=$2
    shift 2
    printf '%s\n' 'mtllib corner.mtl' 'v -200 0 200' 'v 200 0 200' 'v 200 0 -10' 'v -200 0 -10' 'v -200 200 -10' 'v 200 200 -10' \
        'vn 0 1 0' 'vn 0 0 1' 'vn 0 -1 0' 'usemtl wall' 'f 1//1 2//1 3//1 4//1' 'f 4//2 3//2 6//2 5//2' 'usemtl panel' >corner.obj
    echo "$scale" | awk '{ print "v", -$1, $1, -$1 / 2; print "v", $1, $1, -$1 / 2; print "v", $1, $1, $1 / 2; print "v", -$1, $1, $1 / 2
        print "f 7//3 8//3 9//3 10//3" }' >>corner.obj
    for shadows in shadows no-shadows; do
        "$PROGRAM" $command corner.obj --eye "0,$((2 * scale)),$((3 * scale))" --target 0,0,0 --size 64x48 --environment none \
            --material wall=lambert:0.8 "$@" --$shadows -o $shadows.exr
    done
    "$PROGRAM" compare shadows.exr no-shadows.exr --fail-above relmse=2e-3 >compared ||
        fail "$command $*: shadows where there are none: $(cat compared)"
}
same 1 reference --spp 256
same 1 render --samples 1
same 20 render --samples 1 --bounces 2 --device cpu
