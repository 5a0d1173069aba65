# SPDX-License-Identifier: MIT
# The browser demo as $BUILD/web/page, which web.page opens: that it builds, its size, and that it lacks nothing.
set -eu
. tests/checks/common.sh
for tool in emcc esbuild node; do
    command -v $tool >/dev/null || { echo "skipped: $tool is not installed (packages emscripten, esbuild, nodejs)"; exit 0; }
done
page=$BUILD/web/page
rm -rf "$page"
sh web/build.sh "$BUILD/web" "$page" >"$WORK/log" 2>&1 || fail "$(tail -n 30 "$WORK/log")"
size=$(cat "$page"/* | wc -c)
[ "$size" -lt 2000000 ] || fail "the page has $size bytes"
! grep -Eo '(src|href)="(https?:)?//[^"]*' "$page/index.html" || fail "the page loads from elsewhere"
# what the linker does not find becomes a call that fails: only those for files and a clock may
! node -e 'const module = new WebAssembly.Module(require("fs").readFileSync(process.argv[1]));
    console.log(WebAssembly.Module.imports(module).map(({ name }) => name).join("\n"))' "$BUILD/web/web/demo.wasm" |
    grep -Ev '^(emscripten_|environ_|fd_|__syscall_|clock_|proc_)' >"$WORK/missing" || fail "the module lacks $(cat "$WORK/missing")"
