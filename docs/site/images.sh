#!/bin/sh
# SPDX-License-Identifier: MIT
# images.sh PROGRAM [DOCUMENT…]: runs the commands of the documents (or of these) whose images lie in docs/images, as they
# stand, and puts the images there. docs/gallery.md shows most.
set -eu
cd "$(dirname "$0")/../.."
program=$(realpath "$1")
shift
[ $# -gt 0 ] || set -- getting-started method cookbook cookbook-shell gallery shadows areas scoreboard
root=$PWD
mkdir -p out/images
PATH=$(dirname "$program"):$PATH
export PATH
cd out/images
count=0
for document in "$@"; do
    count=$((count + 1))
    echo "images: docs/$document.md, $count of $#" >&2
    mkdir -p blocks
    awk -v folder=blocks -f "$root/tests/docs/blocks.awk" "$root/docs/$document.md" >list
    while read -r number line language annotation; do
        case $language:$annotation in
        json:'file: '*) cp "blocks/$number" "${annotation#file: }" ;;
        sh:*)
            # only what makes an image that a document shows
            for image in $(grep -o '[a-z0-9$%-]*\.\(png\|svg\)' "blocks/$number" | sed 's/\$n/[0-9]*/; s/%02d/[0-9]*/'); do
                if ls "$root"/docs/images/$image >/dev/null 2>&1; then
                    sh -eu "blocks/$number" </dev/null
                    break
                fi
            done
            ;;
        esac
    done <list
done
for image in "$root"/docs/images/*; do
    [ -f "$(basename "$image")" ] || {
        echo "images: no command makes $image" >&2
        exit 1
    }
    cp "$(basename "$image")" "$image"
done
