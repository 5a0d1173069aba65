# SPDX-License-Identifier: MIT
# The shaders in WGSL compute what the library does: Chromium compiles and runs them without a GPU.
set -eu
for tool in node chromium; do
    command -v "$tool" >/dev/null || {
        echo "skipped: $tool is not installed (packages nodejs, chromium)"
        exit 0
    }
done
exec node tests/gpu/variants/wgsl.mjs "$BUILD/variants/wgsl/lampion.js" "$BUILD/tests/gpu/test_gpu_variants" "$WORK"
