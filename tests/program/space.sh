# SPDX-License-Identifier: MIT
# An address space that is limited, from less than the program's libraries take to more than enough: each
# command does what it always does, or fails with one line; it does not crash, nor leave a part of a file.
# LAMPION_LONG=1 tries every 32 MiB.
set -eu
. tests/checks/common.sh

if nm -D "$PROGRAM" | grep -q '__[at]san_init'; then
    echo "skipped: sanitizers take terabytes of it"
    exit 0
fi
export XDG_CACHE_HOME="$WORK/cache" LC_ALL=C
cd "$WORK"
own_scene scene.gltf
sizes='64 160 320 448 4096'
[ -z "${LAMPION_LONG:-}" ] || sizes=$(seq 64 32 4096)

run() {
    rm -rf image.* cache
    status=0
    "$PROGRAM" "$@" >out 2>err </dev/null || status=$?
}

result() {
    { sed 's/[0-9.e+-]*[0-9]//g' out; cat image.* 2>/dev/null; } | cksum
}

# The dynamic loader, the threads' library and the drivers' parser of shaders end a program by themselves, each with a
# line of its own, and the drivers' C++ says what it threw before it ends.
says_why() {
    sed -i '/^terminate called after throwing/d; /^  what():  std::/d' err
    [ "$(grep -c . err)" = 1 ] && grep -q '^lampion: \|while loading shared libraries: \|^libgomp: \|^out of dynamic memory in yy_' err
}

# sweep COMMAND…: runs the command under every limit.
sweep() {
    run "$@"
    [ "$status" = 0 ] || fail "$*: $(cat err)"
    expected=$(result)
    for size in $sizes; do
        rm -rf image.* cache
        status=0
        (ulimit -c 0 && ulimit -v $((size * 1024)) && exec "$PROGRAM" "$@") >out 2>err </dev/null || status=$?
        if [ "$status" = 0 ]; then
            [ "$(result)" = "$expected" ] || fail "$*: $size MiB: a wrong result, and no error: $(cat err)"
        else
            [ "$status" = 1 ] || [ "$status" = 127 ] || grep -q '^out of dynamic memory in yy_' err ||
                fail "$*: $size MiB: status $status: $(cat err)"
            says_why || fail "$*: $size MiB: said $(cat err)"
            ! ls image.* >/dev/null 2>&1 || fail "$*: $size MiB: an image, and an error"
        fi
        [ "$(find . -name '.lampion-*' | wc -l)" = 0 ] || fail "$*: $size MiB: left a temporary"
    done
    echo "tried: $(echo $sizes | wc -w) limits of the address space"
}

sweep info scene.gltf
sweep project --light 0,3,0 --radius 0.5 --bands 8
sweep brdf bake ggx:0.5 --bands 3 --views 8 -o image.lmpt
sweep reference scene.gltf --eye 0,2,2 --target 0,0,0 --random-lights 2 --size 16x16 --spp 1 -o image.exr
sweep render scene.gltf --eye 0,2,2 --target 0,0,0 --random-lights 2 --size 16x16 --bands 3 -o image.png
