# SPDX-License-Identifier: MIT
# lampion view while the CPU draws an image that takes long: it answers, ends what no longer is to be shown, and shows
# what a screenshot repeats. One thread draws, so that the image takes long on any machine.
set -eu
. tests/checks/common.sh
. tests/program/window.sh
tries=600
export ASAN_OPTIONS=detect_leaks=0 LAMPION_GL_DEBUG=fatal XDG_CACHE_HOME="$WORK/cache" OMP_NUM_THREADS=1
mkdir -p "$XDG_CACHE_HOME"
if [ -z "${LAMPION_VIEW_DISPLAY:-}" ]; then
    export LAMPION_VIEW_DISPLAY=1
    exec xvfb-run -a -s "-screen 0 640x480x24" sh tests/program/view_busy.sh
fi

cd "$WORK"
value() { sed -n "s/^[[:space:]]*\"$1\":[[:space:]]*\(.*[^,]\),\{0,1\}$/\1/p" state.json 2>/dev/null | head -n 1; }
is() { [ "$(value "$1")" = "$2" ]; }
eye() { sed -n '/"eye"/,/\]/p' state.json | tr -d ' \n'; }
moved() { [ "$(eye)" != "$before" ]; }
# The state tells of work only while it is going on.
in_work() { [ "$(value percent)" -gt 0 ] 2>/dev/null; }
refining() { in_work && [ "$(value sample)" -gt 0 ]; }
cancelled() { [ "$(value cancelled)" -gt "$1" ]; }
# quit: ends the viewer, whatever it does.
quit() {
    xdotool key ctrl+q
    status=0
    wait $viewer || status=$?
    [ $status = 0 ] || fail "quitting: status $status: $(cat view.err)"
}
# open LIGHTS: opens a scene with so many.
open() {
    rm -f state.json
    "$PROGRAM" view builtin:atrium --random-lights "$1" --bands 10 --no-shadows --size 480x360 --samples 3 --state state.json \
        2>view.err &
    viewer=$!
    trap 'kill $viewer 2>/dev/null || true' EXIT
}

# The first image would take minutes: the help comes and goes before it, a second one is not awaited, and the viewer ends.
open 20000
until_true "an image in work" in_work
xdotool mousemove 200 200 key F1
until_true "the help meanwhile" is help true
xdotool key F1
until_true "no help meanwhile" is help false
is drawn_width 0 || fail "the image was not slow"
quit

# A finer image gives way to the camera's motion, and is drawn when that ends.
open 6000
until_true "a finer image in work" refining
xdotool mousemove 200 200
before=$(eye)
count=$(value cancelled)
xdotool keydown w sleep 0.5 keyup w
until_true "the camera" moved
until_true "an end of the finer image" cancelled "$count"

# Escape and the action end it as well, until something changes.
for key in Escape ctrl+b; do
    until_true "a finer image in work, again" refining
    xdotool key $key
    until_true "the cancellation by $key" is message '"Cancelled: a change draws the image again"'
    sleep 0.5
    in_work && fail "it is drawn in spite of $key"
    [ "$(value sample)" -lt 2 ] || fail "$key came too late"
    xdotool key period
done

# At rest the image is that of lampion render.
until_true "all samples" is sample 2
xdotool key p
until_true "a screenshot" test -s lampion-0001.png
"$PROGRAM" render --from lampion-0001.png -o again.png
cmp lampion-0001.png again.png || fail "the image is another one than without a window"
quit

# While the first scene is read, here by a child that is stopped, there is a window already, in which that is cancelled.
awk 'BEGIN { for (i = 0; i < 90000; i++) print "v", i % 300, i % 7, int(i / 300)
             for (i = 1; i < 89700; i++) print "f", i, i + 1, i + 300 }' >large.obj
rm -f state.json
"$PROGRAM" view large.obj --state state.json 2>view.err &
viewer=$!
child=
for _ in $(seq 1000); do
    child=$(cat /proc/$viewer/task/*/children 2>/dev/null) || true
    [ -z "$child" ] || break
    sleep 0.01
done
kill -STOP $child || fail "no child reads the scene"
has_window() { xdotool search --name 'large.obj - Lampion' >window.id 2>/dev/null; }
until_true "a window before the scene" has_window
[ ! -e state.json ] || fail "the scene was not slow"
xdotool windowfocus "$(head -n 1 window.id)" 2>/dev/null || true
xdotool key Escape
status=0
wait $viewer || status=$?
[ $status = 0 ] || fail "cancelling the first scene: status $status: $(cat view.err)"
[ ! -s view.err ] || fail "cancelling the first scene says: $(cat view.err)"
