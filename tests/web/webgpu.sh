# SPDX-License-Identifier: MIT
# The page of docs/webgpu.md draws what the library computes, in Chromium without a GPU.
set -eu
. tests/checks/common.sh
for tool in node chromium; do
    command -v "$tool" >/dev/null || {
        echo "skipped: $tool is not installed (packages nodejs, chromium)"
        exit 0
    }
done
code_blocks docs/webgpu.md html >"$WORK/page.html"
"$BUILD/tests/web/test_web_sphere" >"$WORK/wanted"
exec node tests/web/webgpu.mjs page.html "$BUILD/variants/wgsl/lampion.js" "$WORK/wanted" "$WORK"
