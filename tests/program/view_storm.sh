# SPDX-License-Identifier: MIT
# lampion view while its scene changes without rest: malformed, gone, a pipe, a folder, growing, good again, by four
# formats, LAMPION_STORM_SECONDS in all (24). It goes on all the while and shows the good scene in the end; the
# builds with sanitizers find what else goes wrong.
set -eu
. tests/checks/common.sh
. tests/program/window.sh
command -v python3 >/dev/null || { echo "skipped: python3 is not installed"; exit 0; }
tries=3000
ulimit -s 4096 # as in a container that grants less: the viewer's settings alone are 5 MB
export LAMPION_GL_DEBUG=fatal XDG_CACHE_HOME="$WORK/cache" XDG_STATE_HOME="$WORK/state"
export ASAN_OPTIONS=detect_leaks=0 TSAN_OPTIONS=ignore_noninstrumented_modules=1
mkdir -p "$XDG_CACHE_HOME" "$XDG_STATE_HOME"
if [ -z "${LAMPION_VIEW_DISPLAY:-}" ]; then
    export LAMPION_VIEW_DISPLAY=1
    exec xvfb-run -a -s "-screen 0 640x480x24" sh tests/program/view_storm.sh
fi
seconds=$((${LAMPION_STORM_SECONDS:-24} / 4))
seed=${LAMPION_STORM_SEED:-1}
source=$PWD
shown() { [ -s state.json ]; }
# In the end the scene is read again on request: nothing hangs and nothing is stuck.
read_again() {
    xdotool key F5
    sleep 0.3
    grep -q '"message":.*read again' state.json
}

for kind in gltf glb obj ply; do
    rm -rf "$WORK/$kind"
    mkdir -p "$WORK/$kind"
    cd "$WORK/$kind"
    python3 "$source/tests/program/view_storm.py" scene.$kind 0 "$seed" "$source/fuzz/corpus" >/dev/null
    "$PROGRAM" view scene.$kind --bands 4 --size 160x120 --samples 2 --state state.json 2>view.err &
    viewer=$!
    trap 'kill -KILL $viewer 2>/dev/null || true' EXIT
    until_true "opening scene.$kind" shown
    xdotool mousemove 80 60
    python3 "$source/tests/program/view_storm.py" scene.$kind "$seconds" "$seed" "$source/fuzz/corpus" ||
        fail "the storm of $kind ends in $?"
    kill -0 $viewer 2>/dev/null || fail "$kind, seed $seed: the viewer has ended: $(cat view.err)"
    until_true "the scene after the storm of $kind" read_again
    # repeated until it is taken: a key that comes while the window is replaced is lost with the old one
    for _ in $(seq "$tries"); do
        kill -0 $viewer 2>/dev/null || break
        xdotool key ctrl+q
        sleep 0.5
    done
    status=0
    wait $viewer || status=$?
    [ $status = 0 ] || fail "$kind, seed $seed: status $status: $(cat view.err)"
    ! grep -q 'Sanitizer\|runtime error' view.err || fail "$kind, seed $seed: $(cat view.err)"
    cd "$source"
done
