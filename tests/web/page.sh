# SPDX-License-Identifier: MIT
# The browser demo, which web.demo has built, in headless Chromium (page.mjs).
set -eu
. tests/checks/common.sh
for tool in emcc esbuild node chromium; do
    command -v $tool >/dev/null || { echo "skipped: $tool is not installed (packages emscripten, esbuild, nodejs, chromium)"; exit 0; }
done
node tests/web/page.mjs "$BUILD/web/page" "$PROGRAM" "$WORK"
