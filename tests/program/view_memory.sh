# SPDX-License-Identifier: MIT
# A long session of the viewer: nothing is lost under the address sanitizer, memory is steady without.
set -eu
. tests/checks/common.sh
unset GLIBC_TUNABLES # memory is measured as a user has it
command -v xvfb-run >/dev/null || {
    echo "skipped: xvfb-run is not installed (packages xvfb, xauth)"
    exit 0
}
if [ -z "${LAMPION_VIEW_DISPLAY:-}" ]; then
    export LAMPION_VIEW_DISPLAY=1
    exec xvfb-run -a -s "-screen 0 640x480x24" sh tests/program/view_memory.sh
fi
sanitizer=$(ldd "$PROGRAM" | sed -n 's/.*libasan[^ ]* => \([^ ]*\).*/\1/p')
frames=${LAMPION_VIEW_FRAMES:-$([ -n "$sanitizer" ] && echo 1000 || echo 400)}
session="view builtin:balls --size 64x48 --samples 1 --animate orbit --frames $frames"

if [ -n "$sanitizer" ]; then
    # the driver would be unloaded before leaks are looked for: then its own have no name
    driver=$(find /usr/lib/*/dri -name swrast_dri.so | head -n 1)
    export ASAN_OPTIONS=detect_leaks=1 LSAN_OPTIONS="suppressions=$PWD/tests/program/leaks.txt"
    LD_PRELOAD="$sanitizer $driver" "$PROGRAM" $session 2>"$WORK/err" || fail "$(cat "$WORK/err")"
    exit 0
fi

# memory NUMBER: prints the viewer's kilobytes once it has shown that many frames.
memory() {
    while kill -0 $viewer 2>/dev/null; do
        shown=$(sed -n 's/.*"frame":[^0-9]*\([0-9]*\).*/\1/p' "$WORK/state" 2>/dev/null || true)
        if [ "${shown:-0}" -ge "$1" ]; then
            sed -n 's/^VmRSS:[^0-9]*\([0-9]*\).*/\1/p' /proc/$viewer/status
            return
        fi
        sleep 0.05
    done
}
"$PROGRAM" $session --state "$WORK/state" 2>"$WORK/err" &
viewer=$!
early=$(memory $((frames / 4)))
late=$(memory $((frames - frames / 10)))
wait $viewer || fail "the viewer ends in $?: $(cat "$WORK/err")"
echo "memory after a quarter of $frames frames: $early kB, at the end: $late kB"
[ -n "$early" ] && [ -n "$late" ] || fail "the frames went by unseen"
[ $((late - early)) -lt 4096 ] || fail "memory grows: $early kB, then $late kB"
