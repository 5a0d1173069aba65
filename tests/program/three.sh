# SPDX-License-Identifier: MIT
# The three.js example in a headless browser against `lampion render` of the scene that it exports:
# sphere lights alone, with three's own lights, and its LightProbe. It needs npm, node and Chromium, and the
# package that package-lock.json names, from npm's registry or its cache.
set -eu
. tests/checks/common.sh
export ASAN_OPTIONS=detect_leaks=0 # GL drivers leak at exit
sed -n '/^```js$/,/^```$/{/^```/d;p}' docs/three.md | sed '/^const lampion = await/,$d' >"$WORK/page.js"
sed 1d examples/three/lampion.js | cmp -s - "$WORK/page.js" || fail "docs/three.md does not show examples/three/lampion.js"
skip() {
    echo "skipped: $*"
    exit 0
}
for tool in node npm chromium; do
    command -v $tool >/dev/null || skip "$tool is not installed"
done

page=$WORK/page
mkdir "$page"
tar -C examples/three --exclude node_modules -cf - . | tar -C "$page" -xf -
cd "$page"
export XDG_CACHE_HOME="$WORK/cache"
npm ci --ignore-scripts --no-audit --no-fund --fetch-retries 0 --fetch-timeout 60000 >"$WORK/log" 2>&1 || {
    ! grep -Eq 'EINTEGRITY|EUSAGE|EJSONPARSE' "$WORK/log" || fail "$(cat "$WORK/log")"
    skip "npm cannot reach its registry"
}
mkdir -p shaders
cp "$SOURCE/shaders/lampion/ggx.glsl" "$SOURCE/shaders/lampion/lampion.glsl" shaders/
"$BUILD/tests/program/ggx_texels" >shaders/ggx.f32
LAMPION=$PROGRAM node probe.js 0 0.6 0

# draw NAME QUERY OPTION…: writes NAME.exr by the page, and truth.exr of the same scene by lampion render.
draw() {
    name=$1
    node "$SOURCE/tests/program/three.mjs" . "export&$2" chromium >"$WORK/log" 2>&1 || fail "$name: $(cat "$WORK/log")"
    shift 2
    mv three.exr "$name.exr"
    "$PROGRAM" render scene.gltf --lights lights.json --hide-lights --environment none --no-shadows --size 320x200 "$@" -o truth.exr
}
within() {
    "$PROGRAM" compare "$1.exr" truth.exr --fail-above relmse="$2" >"$WORK/log" 2>&1
}

draw alone alone --bands 16
within alone 2e-5 || fail "30 lights: $(cat "$WORK/log")"
draw beside "" --bands 16 --keep-lights
within beside 0.01 || fail "beside three's own lights: $(cat "$WORK/log")"
! within alone 0.01 || fail "lights that are missing go unseen"
draw probe probe --bands 3 --window none --material matte=lambert:1,1,1
within probe 1e-4 || fail "a probe: $(cat "$WORK/log")"
