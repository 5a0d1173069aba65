# SPDX-License-Identifier: MIT
# The browser demo in headless Chromium (page.mjs), and its size.
set -eu
. tests/checks/common.sh
for tool in emcc esbuild node chromium; do
    command -v $tool >/dev/null || { echo "skipped: $tool is not installed (packages emscripten, esbuild, nodejs, chromium)"; exit 0; }
done
sh web/build.sh "$BUILD/web" "$WORK/demo" >"$WORK/log" 2>&1 || fail "$(tail -n 30 "$WORK/log")"
size=$(cat "$WORK"/demo/* | wc -c)
[ "$size" -lt 5000000 ] || fail "the page has $size bytes"
! grep -Eo '(src|href)="(https?:)?//[^"]*' "$WORK/demo/index.html" || fail "the page loads from elsewhere"
# what the linker does not find becomes a call that fails: only those for files and a clock may
node -e 'const module = new WebAssembly.Module(require("fs").readFileSync(process.argv[1]));
    console.log(WebAssembly.Module.imports(module).map(({ name }) => name).join("\n"))' "$BUILD/web/web/demo.wasm" |
    grep -Ev '^(emscripten_|environ_|fd_|__syscall_|clock_|proc_)' >"$WORK/missing" && fail "the module lacks $(cat "$WORK/missing")"
node tests/web/page.mjs "$WORK/demo" "$PROGRAM" "$WORK"
