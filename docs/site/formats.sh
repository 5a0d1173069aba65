#!/bin/sh
# SPDX-License-Identifier: MIT
# formats.sh FILE: the manual page lampion-formats(5), of the documents on files, by pandoc.
set -eu
cd "$(dirname "$0")/../.."
version=$(sed -n 's/^#define LMP_VERSION_[A-Z]* //p' include/lampion/base.h | paste -sd .)
{
    printf -- '---\ntitle: LAMPION-FORMATS\nsection: 5\nheader: Lampion\nfooter: lampion %s\n---\n\n' "$version"
    echo "# Name"
    echo
    echo "lampion-formats - lights files, tables and caches that lampion reads and writes"
    echo
    # links lead to pages that are not here
    { cat docs/lights.md docs/formats.md && sed -n '/^## Scripts/,/^## Without/p' docs/viewer.md | sed '$d'; } | sed 's/!\[[^]]*\]([^)]*)//g; s/\[\([^]]*\)\](\([^)]*\))/\1/g'
} | pandoc --fail-if-warnings -s -f gfm+tex_math_dollars+yaml_metadata_block -t man -o "$1"
