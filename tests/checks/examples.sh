# SPDX-License-Identifier: MIT
# The examples, built as installed and run: each prints what stands in examples/NAME.txt, and the
# window draws its lanterns. rotate_splats and read_probes need a file: tests/program/splats.c and volume.c run them.
set -eu
. tests/checks/common.sh

usr=$WORK/../libraries/usr
examples=$usr/share/doc/lampion/examples
export PKG_CONFIG_PATH="$(dirname "$(find "$usr" -name lampion.pc)")"
cmake -G Ninja -S "$examples" -B "$WORK/build" -DCMAKE_PREFIX_PATH="$usr" \
    -DCMAKE_C_FLAGS='-Wall -Wextra -Wpedantic -Wconversion -Werror' >"$WORK/log" 2>&1 || fail "$(cat "$WORK/log")"
cmake --build "$WORK/build" >"$WORK/log" 2>&1 || fail "$(cat "$WORK/log")"

cd "$WORK"
for source in "$examples"/*.c; do
    name=$(basename "$source" .c)
    case $name in lanterns | read_probes | rotate_splats) continue ;; esac
    "build/$name" | sed 's/ *$//' >"$name.txt" || fail "$name fails"
    diff "$examples/$name.txt" "$name.txt" || fail "$name prints something else"
done

if [ ! -x build/lanterns ] || ! command -v xvfb-run >/dev/null; then
    echo "skipped: the window needs libglfw3-dev, libepoxy-dev, xvfb and xauth"
    exit 0
fi
glsl=$(pkg-config --variable=glsl lampion)
for frames in 1 20; do
    xvfb-run -a build/lanterns "$glsl/lampion.glsl" "$examples/lanterns.frag" $frames $frames.ppm >log 2>&1 ||
        fail "lanterns: $(cat log)"
done
! cmp -s 1.ppm 20.ppm || fail "the lanterns stand still"
# The sky must be black, the floor lit and warm, and the lanterns bright.
[ "$(head -n 1 20.ppm)" = "P6 960 540 255" ] || fail "size: $(head -n 1 20.ppm)"
tail -c $((3 * 960 * 540)) 20.ppm | od -An -v -tu1 -w2880 | awk '
    NR <= 100 { for (i = 1; i <= NF; i++) sky += $i }
    NR > 440 { for (i = 1; i <= NF; i += 3) { red += $i; blue += $(i + 2); pixels++ } }
    { for (i = 1; i <= NF; i += 3) bright += $i > 230 }
    END { print sky, red / pixels, blue / pixels, bright
        exit !(sky == 0 && red / pixels > 60 && red > blue && bright > 1000 && bright < 20000) }' >log ||
    fail "the image is not as it should be: $(cat log)"
if xvfb-run -a build/lanterns "$glsl/lampion.glsl" "$examples/CMakeLists.txt" 1 none.ppm >log 2>&1; then
    fail "a broken shader is not refused"
fi
[ ! -e none.ppm ] || fail "a broken shader leaves an image"
