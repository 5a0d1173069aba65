# SPDX-License-Identifier: MIT
# Little input asks for little: what a small file or a short name makes the program do is bounded, is refused by
# its size before it is read, or says how long it takes and can be stopped.
set -eu
. tests/checks/common.sh
export XDG_CACHE_HOME="$WORK/cache"
python=$(python_with zlib)
[ -n "$python" ] || { echo "skipped: python3 is not installed"; exit 0; }

# png WIDTH HEIGHT FILE: writes a black image of 8 bits, deflated as well as possible.
png() {
    "$python" - "$@" <<'PY'
import struct, sys, zlib
width, height = int(sys.argv[1]), int(sys.argv[2])
def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
rows = zlib.compressobj(9)
data = rows.compress(bytes((3 * width + 1) * height)) + rows.flush()
with open(sys.argv[3], "wb") as file:
    file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
               chunk(b"IDAT", data) + chunk(b"IEND", b""))
PY
}

# within KILOBYTES COMMAND…: in so much memory; its output in $WORK/out, its errors in $WORK/err. A thread that asks the C
# library for memory while another one does may get 64 MiB of addresses for itself: one run of 25 had too few then.
within() {
    room=$1
    shift
    (ulimit -v "$room" && MALLOC_ARENA_MAX=1 exec "$@") >"$WORK/out" 2>"$WORK/err"
}

# Sanitizers take all addresses there are.
sanitized=no
grep -q 'LAMPION_SANITIZE:STRING=..*' "$BUILD/CMakeCache.txt" && sanitized=yes

# The least memory that the program takes, for an image of one pixel, is found by bisection.
png 1 1 "$WORK/one.png"
"$PROGRAM" compare "$WORK/one.png" "$WORK/one.png" >/dev/null || fail "an image of one pixel is not compared"
if [ $sanitized = no ]; then
    low=1024 least=4194304
    while [ $((least - low)) -gt 4096 ]; do
        middle=$(((low + least) / 2))
        if within $middle "$PROGRAM" compare "$WORK/one.png" "$WORK/one.png"; then least=$middle; else low=$middle; fi
    done
    # 1024² pixels take 80 bytes each, as the help says, and not twice as much.
    "$PROGRAM" compare --help | tr -s ' \n' ' ' | grep -q 'take 80 bytes per pixel' || fail "the help does not say what a pixel takes"
    png 1024 1024 "$WORK/many.png"
    within $((least + 80 * 1024 + 8192)) "$PROGRAM" compare "$WORK/many.png" "$WORK/many.png" ||
        fail "more than 80 bytes a pixel: $(cat "$WORK/err")"
    # 8192² pixels in some kilobytes are refused by their number, before anything is made for them.
    png 8192 8192 "$WORK/bomb.png"
    for pair in "bomb one" "one bomb"; do
        if within $((least + 8192)) "$PROGRAM" compare "$WORK/${pair% *}.png" "$WORK/${pair#* }.png"; then
            fail "8192 x 8192 pixels are compared"
        fi
        [ "$(cat "$WORK/err")" = "lampion: $WORK/bomb.png: an image of 8192 x 8192 is too large (33554432 pixels; see --max-pixels)" ] ||
            fail "8192 x 8192 pixels: $(cat "$WORK/err")"
    done
fi

# --max-pixels is exactly the number of pixels that are allowed.
png 30 20 "$WORK/some.png"
"$PROGRAM" compare "$WORK/some.png" "$WORK/some.png" --max-pixels 600 >/dev/null || fail "600 of 600 pixels are refused"
! "$PROGRAM" compare "$WORK/some.png" "$WORK/some.png" --max-pixels 599 2>"$WORK/err" || fail "600 pixels pass for 599"
grep -qF '(599 pixels; see --max-pixels)' "$WORK/err" || fail "600 of 599 pixels: $(cat "$WORK/err")"

# Tables that no buffer of the GPU holds are refused before they are made, which takes minutes: a table that was made
# would be in the cache.
if "$PROGRAM" render builtin:ball --device gpu --method coefficients --bands 20 --material test_material=ggx:0.5x0.4 \
    --size 16x16 -o "$WORK/none.png" 2>"$WORK/err"; then
    fail "20 bands of an anisotropic material fit the GPU"
fi
too_large='the tables of the materials are too large (fewer --bands)'
grep -qF "$too_large" "$WORK/err" || fail "the tables: $(cat "$WORK/err")"
if "$PROGRAM" bench gpu --scene builtin:ball --device gpu --method coefficients --bands 20 --size 16x16 --lights 1 \
    --material test_material=ggx:0.5x0.4 >/dev/null 2>"$WORK/err"; then
    fail "20 bands of an anisotropic material are timed on the GPU"
fi
grep -qF "$too_large" "$WORK/err" || fail "the tables of bench: $(cat "$WORK/err")"
[ -z "$(find "$WORK/cache" -name '*.lmpt')" ] || fail "a table was made before it was refused"

# A step that takes minutes reports its progress and the time left on a terminal, by any number of threads; when it is
# stopped, it leaves no partial result.
command -v script >/dev/null || exit 0
for pass in bake info; do
    set -- "$PROGRAM" brdf $pass ggx:0.001x0.002
    if [ $pass = info ]; then
        export OMP_NUM_THREADS=1
    else
        set -- "$@" -o "$WORK/mirror.lmpt"
    fi
    rm -f "$WORK/bar" "$WORK/status"
    mkfifo "$WORK/bar"
    # The pipe ends the wait, so no time is asserted. A line is read when it is written, not with the next 4096 bytes.
    TERM=xterm script -qfec "echo \$\$ >'$WORK/pid'; exec $*" "$WORK/log" </dev/null >"$WORK/bar" 2>&1 &
    shell=$!
    stdbuf -o0 tr '\r' '\n' <"$WORK/bar" | while IFS= read -r line; do
        case $line in *%*left*)
            printf '%s\n' "$line" >"$WORK/line"
            kill -TERM "$(cat "$WORK/pid")" 2>/dev/null || true # again at each line, until there are no more
            ;;
        esac
    done
    wait $shell || true
    grep -qE '\[ *=* *\] +[0-9]+%, [0-9]+:[0-9]+ left' "$WORK/line" || fail "$pass tells no progress"
    ! kill -0 "$(cat "$WORK/pid")" 2>/dev/null || fail "$pass goes on after it was stopped"
    [ ! -e "$WORK/mirror.lmpt" ] || fail "$pass left a part of its table"
    [ -z "$(find "$WORK/cache" -name '*.lmpt' 2>/dev/null)" ] || fail "$pass left an entry of what it did not finish"
done
