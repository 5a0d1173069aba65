#!/bin/sh
# SPDX-License-Identifier: MIT
# pictures.sh PROGRAM [DOCUMENT…]: runs the commands of the documents (or of these) whose pictures lie in docs/images, as they
# stand, and puts the pictures there. docs/gallery.md shows most.
set -eu
cd "$(dirname "$0")/../.."
program=$(realpath "$1")
shift
[ $# -gt 0 ] || set -- getting-started method cookbook gallery
root=$PWD
mkdir -p out/pictures
PATH=$(dirname "$program"):$PATH
export PATH
cd out/pictures
for document in "$@"; do
    mkdir -p blocks
    awk -v folder=blocks -f "$root/tests/docs/blocks.awk" "$root/docs/$document.md" >list
    while read -r number line language annotation; do
        case $language:$annotation in
        json:'file: '*) cp "blocks/$number" "${annotation#file: }" ;;
        sh:*)
            # only what makes a picture that a document shows
            for picture in $(grep -o '[a-z0-9$%-]*\.\(png\|svg\)' "blocks/$number" | sed 's/\$n/[0-9]*/; s/%02d/[0-9]*/'); do
                if ls "$root"/docs/images/$picture >/dev/null 2>&1; then
                    sh -eu "blocks/$number" </dev/null
                    break
                fi
            done
            ;;
        esac
    done <list
done
for picture in "$root"/docs/images/*; do
    [ -f "$(basename "$picture")" ] || {
        echo "pictures: no command makes $picture" >&2
        exit 1
    }
    cp "$(basename "$picture")" "$picture"
done
