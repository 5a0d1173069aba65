# SPDX-License-Identifier: MIT
# Memory that runs out: for every command, a request of the program's own for memory is refused once. It
# ends well and prints what it always prints, or fails with one line; it neither crashes nor leaves a part
# of a file. The first request of every call in the code is refused once, and some spread over each run: 3, 64 with
# LAMPION_LONG=1, every one with LAMPION_SOAK=1.
set -eu
. tests/checks/common.sh

if nm -D "$PROGRAM" | grep -q '__[at]san_init'; then
    echo "skipped: sanitizers have an allocator of their own"
    exit 0
fi
scarce=$BUILD/tests/program/libscarce.so
export XDG_CACHE_HOME="$WORK/cache" LC_ALL=C
cd "$WORK"
own_scene scene.gltf
printf 'light_x,light_y,light_z,radius,recv_x,recv_y,recv_z\n0,3,0,1,0,0,0\n1,3,0,1,0,0,0\n' >lights.csv

most=3
[ -z "${LAMPION_LONG:-}" ] || most=64
[ -z "${LAMPION_SOAK:-}" ] || most=1000000

# What follows runs after every refusal, so it starts no programs where the shell knows as much.
exists() { [ -e "$1" ]; }
says_one_line() {
    { IFS= read -r line && ! read -r more; } <err || return 1
    case $line in 'lampion: '*) ;; *) return 1 ;; esac
}

# run REFUSED COMMAND…: into out, err and image.*; REFUSED is the number of a request, or at:CALL.
run() {
    refused=$1
    shift
    rm -rf image.* cache
    status=0
    LD_PRELOAD=$scarce LAMPION_REFUSE=${refused%%at:*} LAMPION_REFUSE_AT=${refused#*at:} "$PROGRAM" "$@" >out 2>err </dev/null || status=$?
}

# Prints what a run printed, without times, and the image or table that it wrote, if any.
printed() {
    sed 's/[0-9.e+-]*[0-9]//g' out | cksum
}

written() {
    cat image.* 2>/dev/null | cksum
}

# sweep COMMAND…: refuses the calls that no sweep before has refused.
: >calls
sweep() {
    rm -f requests
    LAMPION_REQUESTS=$PWD/requests run 0 "$@"
    [ "$status" = 0 ] || fail "$*: $(cat err)"
    text=$(printed) file=$(written) requests=$(head -n 1 requests) refusals=0
    step=$((requests / most + 1))
    calls=$(tail -n +2 requests | sort | comm -23 - calls)
    for call in $calls; do echo "$call"; done | sort -m - calls -o calls
    tried=0
    for k in $(seq 1 $step "$requests") $(for call in $calls; do echo "at:$call"; done); do
        tried=$((tried + 1))
        run "$k" "$@"
        case $status in
        0) [ "$(printed) $(written)" = "$text $file" ] || fail "$*: refusal $k of $requests: a wrong result, and no error" ;;
        1)
            refusals=$((refusals + 1))
            says_one_line || fail "$*: refusal $k of $requests: said $(cat err)"
            ! exists image.* || [ "$(written)" = "$file" ] || fail "$*: refusal $k of $requests: a part of a file"
            ;;
        *) fail "$*: refusal $k of $requests: status $status: $(cat err)" ;;
        esac
        ! exists .lampion-* && ! exists */.lampion-* && ! exists */*/.lampion-* || fail "$*: refusal $k of $requests: left a temporary"
    done
    echo "$*: $requests requests, $refusals of those refused were errors"
    echo "tried: $tried requests for memory that were refused"
}

# Triangles that cannot be sorted for rays must be reported in one line, with a way out.
for k in 1 2 5 20; do
    rm -f image.png
    status=0
    LD_PRELOAD=$scarce LAMPION_REFUSE_TO=libembree LAMPION_REFUSE=$k "$PROGRAM" render builtin:ball --size 16x16 \
        --bands 3 --device cpu --shadows -o image.png 2>err || status=$?
    [ "$status" = 1 ] && [ "$(wc -l <err)" = 1 ] && grep -q 'builtin:ball: out of memory' err ||
        fail "refusal $k to the ray tracer: status $status: $(cat err)"
    status=0
    LD_PRELOAD=$scarce LAMPION_REFUSE_TO=libembree LAMPION_REFUSE=$k "$PROGRAM" render builtin:ball --size 16x16 \
        --bands 3 --device gpu --shadows -o image.png 2>err || status=$?
    [ "$status" = 1 ] && [ "$(wc -l <err)" = 1 ] && grep -q 'out of memory for shadows (--no-shadows ' err ||
        fail "refusal $k to the ray tracer of shadows: status $status: $(cat err)"
    [ ! -e image.png ] || fail "refusal $k to the ray tracer: an image"
done

# Without memory jansson would read another text, so all its requests must go through the program, which ends the parse.
for command in "info --json scene.gltf" "render scene.gltf --size 8x8 --bands 2 --stats --repeat 1 -o image.png"; do
    LD_PRELOAD=$scarce LAMPION_REFUSE_TO=libjansson LAMPION_REQUESTS=$PWD/requests "$PROGRAM" $command >out 2>err ||
        fail "$command: $(cat err)"
    [ "$(head -n 1 requests)" = 0 ] || fail "$command: jansson has memory of its own: $(head -n 1 requests) requests"
done

sweep info scene.gltf
sweep info --json scene.gltf
sweep info --json builtin:balls
sweep basis --bands 2 --size 64x64 -o image.png
sweep basis --bands 2 --size 64x64 -o image.exr
sweep brdf bake ggx:0.5 --bands 3 --views 8 -o image.lmpt
sweep project --light 0,3,0 --radius 0.5 --bands 4
sweep project --batch lights.csv --bands 3
sweep field scene.gltf --random-lights 2 --grid 2x2x3 --preset unity --shadows -o image.json
sweep field scene.gltf --random-lights 2 --grid 2x2x3 -o image.lmpf
sweep reference scene.gltf --eye 0,2,2 --target 0,0,0 --random-lights 2 --size 16x16 --spp 1 --threads 1 -o image.exr
sweep render scene.gltf --eye 0,2,2 --target 0,0,0 --random-lights 2 --size 16x16 --bands 3 --stats --repeat 1 -o image.png
sweep render scene.gltf --eye 0,2,2 --target 0,0,0 --random-lights 2 --size 16x16 --bands 3 --shadows -o image.png
