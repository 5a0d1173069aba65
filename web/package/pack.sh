#!/bin/sh
# SPDX-License-Identifier: MIT
# pack.sh BUILD OUT: the npm package as OUT/lampion-VERSION.tgz, the same bytes from the same commit. Both WebAssembly
# modules are built in BUILD/simd and BUILD/scalar by Emscripten.
set -eu
cd "$(dirname "$0")/../.."
build=$(realpath -m "$1") out=$(realpath -m "$2")
. web/emscripten.sh
for kind in simd scalar; do
    [ -f "$build/$kind/build.ninja" ] || cmake --preset "web-$kind" -B "$build/$kind"
    cmake --build "$build/$kind" --target package lampion_wgsl
done
version=$(sed -n 's/^#define LMP_VERSION_[A-Z]* //p' include/lampion/base.h | paste -sd .)

folder=$build/package
rm -rf "$folder"
mkdir -p "$folder/shaders" "$out"
cp "$build/simd/web/package/lampion.wasm" "$build/scalar/web/package/lampion-scalar.wasm" \
    "$build/simd/web/package/api.js" "$build/simd/web/package/api.d.ts" "$folder"
cp web/package/*.js web/package/*.d.ts LICENSE "$folder" # and no .mjs, which builds
cp shaders/lampion/*.glsl "$folder/shaders"
cp "$build/simd/variants/wgsl/lampion.js" "$folder/wgsl.js"
# The page of the documents, without links to others and without notes for its test.
sed -E '/^<!-- .* -->$/d; s/\[([^]]*)\]\((\.\.\/|[a-z])[^)]*\)/\1/g' docs/npm.md >"$folder/README.md"
sed "s/\"0.0.0\"/\"$version\"/" web/package/package.json >"$folder/package.json"
# as_text FILE…: shaders as text, for bundlers and browsers alike.
as_text() {
    node --input-type=module - "$@" <<'END'
import { readFileSync } from 'node:fs';
import { basename } from 'node:path';
for (const file of process.argv.slice(2))
    console.log(`export const ${basename(file, '.glsl')} = ${JSON.stringify(readFileSync(file, 'utf8'))};`);
END
sed -n 's/^export const \([a-z_]*\) = .*/export const \1: string;/p' "$folder/shaders.js" >"$folder/shaders.d.ts"
}
as_text shaders/lampion/*.glsl >"$folder/shaders.js"
mkdir -p "$build/expanded"
for shader in lights volume; do
    emcc -E -P -x c -Ishaders/lampion "web/package/$shader.glsl" -o "$build/expanded/$shader.glsl"
done
as_text "$build/expanded"/*.glsl >"$folder/expanded.js"
time=${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct 2>/dev/null || date -r CHANGELOG.md +%s)}
chmod -R u=rwX,go=rX "$folder"
find "$folder" -type f -exec chmod a-x {} +
tar -C "$build" --sort=name --owner=0 --group=0 --numeric-owner --mtime="@$time" -cf - package | gzip -9n >"$out/lampion-$version.tgz"
echo "$out/lampion-$version.tgz"
