#!/bin/sh
# SPDX-License-Identifier: MIT
# wheel.sh PREFIX FOLDER: makes a wheel of the Python package and the shared library that are installed in PREFIX, and
# puts it into FOLDER. It needs no network; PYTHON names the Python that has setuptools and wheel.
set -eu
prefix=$1 folder=$2 python=${PYTHON:-python3}
stage=$(mktemp -d)
trap 'rm -rf "$stage"' EXIT

cp -r "$prefix/lib/python3/dist-packages/lampion" "$stage"
cp "$(find "$prefix" -name 'liblampion.so.*.*' ! -name 'liblampion.so.*.*.*')" "$stage/lampion" # which follows the link
cp "$(dirname "$0")/setup.py" "$stage"
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)
cd "$stage"
"$python" setup.py --quiet bdist_wheel --dist-dir "$folder"
