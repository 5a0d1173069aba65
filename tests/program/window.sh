# SPDX-License-Identifier: MIT
# What the tests of the viewer by real input share: the programs that make it, and waiting for its state.

for tool in xvfb-run xdotool; do
    command -v $tool >/dev/null || {
        echo "skipped: $tool is not installed (packages xvfb, xauth, xdotool)"
        exit 0
    }
done

# until_true WHAT COMMAND…: waits for the command to succeed, for $tries tenths of a second at most.
until_true() {
    what=$1
    shift
    for _ in $(seq "$tries"); do
        if "$@"; then return 0; fi
        kill -0 $viewer 2>/dev/null || fail "$what: the viewer has ended: $(cat view.err)"
        sleep 0.1
    done
    fail "$what: the state is $(cat state.json)"
}
