# SPDX-License-Identifier: MIT
# lampion view while tables are made: it goes on drawing as before and takes input, then shows what was asked for.
set -eu
. tests/checks/common.sh
. tests/program/window.sh
tries=900
export ASAN_OPTIONS=detect_leaks=0 LAMPION_GL_DEBUG=fatal XDG_CACHE_HOME="$WORK/cache" XDG_STATE_HOME="$WORK/state"
mkdir -p "$XDG_CACHE_HOME" "$XDG_STATE_HOME"
if [ -z "${LAMPION_VIEW_DISPLAY:-}" ]; then
    export LAMPION_VIEW_DISPLAY=1
    exec xvfb-run -a -s "-screen 0 640x480x24" sh tests/program/view_baking.sh
fi

cd "$WORK"
# is NAME TEXT: tests a value of the state.
is() { grep -q "\"$1\":[[:space:]]*$2" state.json 2>/dev/null; }
eye() { sed -n '/"eye"/,/\]/p' state.json | tr -d ' \n'; }
moved() { [ "$(eye)" != "$before" ]; }
# Stops the process that makes tables as soon as it runs: until then the viewer waits for it, for ever if it were stopped.
stop_baking() {
    for _ in $(seq 3000); do
        read -r child _ </proc/$viewer/task/$viewer/children || true # which ends in no newline
        if [ -n "$child" ] && grep -qs bake "/proc/$child/cmdline" && kill -STOP "$child" 2>/dev/null; then return 0; fi
        sleep 0.01
    done
    fail "no process makes tables: $(cat state.json)"
}

"$PROGRAM" view builtin:ball --material test_material=sgd:red-fabric --bands 10 --method coefficients --size 160x120 --samples 1 \
    --state state.json 2>view.err &
viewer=$!
trap 'kill $viewer 2>/dev/null || true' EXIT
until_true "opening" is method '"coefficients"'
until_true "opening" is height 120
before=$(eye)
xdotool mousemove 20 20 key m
stop_baking
xdotool mousemove 40 60 mousedown 1 mousemove 60 70 mousemove 90 80 mouseup 1
until_true "orbiting meanwhile" moved
is method '"preintegrated"' && fail "shown before it was made"
is method '"coefficients"' || fail "drawn otherwise than before: $(cat state.json)"
kill -CONT "$child"
until_true "the table that was made" is method '"preintegrated"'
[ -n "$(find cache -name '*.lmps')" ] || fail "the table is not in the cache"

# If that process is killed, the viewer makes the tables itself.
xdotool key Up
stop_baking
kill -KILL "$child"
until_true "the table of the viewer" is bands 11

# Leaving the viewer ends the tables being made.
xdotool key Up
stop_baking
xdotool key ctrl+q
status=0
wait $viewer || status=$?
[ $status = 0 ] || fail "quitting: status $status: $(cat view.err)"
! kill -0 "$child" 2>/dev/null || fail "the process goes on"

# Tables that the GPU cannot hold are made by no process: one that was made would be in the cache.
made() { find cache -name '*.lmpt' | sort; }
too_large() { grep -q '"message":.*the tables of the materials are too large' state.json; }
rm state.json
"$PROGRAM" view builtin:ball --material test_material=ggx:1x0.9 --bands 9 --method coefficients --size 160x120 --samples 1 \
    --state state.json 2>view.err &
viewer=$!
until_true "opening by an anisotropic material" is bands 9
before=$(made)
[ -n "$before" ] || fail "no table is in the cache"
xdotool mousemove 20 20 key Page_Up
until_true "the refusal of 19 bands" too_large
is bands 9 || fail "19 bands are not taken back: $(cat state.json)"
[ "$(made)" = "$before" ] || fail "tables are made that no image can show"
xdotool key ctrl+q
wait $viewer || fail "quitting: status $?: $(cat view.err)"
