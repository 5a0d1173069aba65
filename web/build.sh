#!/bin/sh
# SPDX-License-Identifier: MIT
# build.sh BUILD OUT: the browser demo as one folder of static files, by Emscripten in BUILD.
set -eu
cd "$(dirname "$0")/.."
build=$1 out=$2
. web/emscripten.sh
[ -f "$build/build.ninja" ] || cmake --preset web -B "$build"
cmake --build "$build" --target demo
mkdir -p "$out"
gzip -9nc "$build/web/demo.wasm" >"$build/web/demo.wasm.gz"
esbuild web/main.js --bundle --format=iife --target=es2021 --log-level=warning --minify --legal-comments=none \
    --loader:.glsl=text --loader:.frag=text --loader:.vert=text --loader:.h=text --loader:.gz=binary \
    "--alias:demo.wasm=$(realpath "$build")/web/demo.wasm.gz" \
    --outfile="$out/demo.js"
cp web/index.html web/demo.css "$out"
du -sb "$out" | awk '{ printf "%.1f MB\n", $1 / 1e6 }'
