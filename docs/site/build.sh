#!/bin/sh
# SPDX-License-Identifier: MIT
# build.sh FOLDER: the documents and the public headers as a site, by pandoc, without a network.
# Every file of the repository keeps its path; .md becomes .html, README.md index.html.
set -eu
cd "$(dirname "$0")/../.."
out=$1
home=README.md
guide="docs/getting-started.md docs/web.md docs/method.md docs/cookbook.md docs/cookbook-shell.md docs/gallery.md docs/viewer.md docs/aiming.md docs/troubleshooting.md docs/glossary.md"
use="docs/engine.md docs/probes.md docs/npm.md docs/webgpu.md docs/python.md docs/build-systems.md docs/scenes.md docs/lights.md docs/areas.md docs/materials.md docs/ggx.md docs/layers.md docs/shading.md docs/fields.md docs/transfer.md docs/shadows.md docs/preintegration.md docs/sequences.md docs/reference.md docs/ruler.md docs/scoreboard.md docs/paper.md docs/formats.md docs/formats-ruler.md docs/migrating.md docs/migrating-engines.md docs/security.md"
accuracy="docs/accuracy.md docs/benchmarks.md docs/performance-notes.md docs/preintegration-notes.md"
project="docs/design.md docs/extending.md docs/releasing.md docs/moving.md CONTRIBUTING.md CHANGELOG.md"
API_SOURCES="$(echo include/lampion/*.h) shaders/lampion/lampion.glsl shaders/lampion/coefficients.glsl shaders/lampion/area.glsl"
export API_SOURCES

version=$(sed -n 's/^#define LMP_VERSION_[A-Z]* //p' include/lampion/base.h | paste -sd .)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# page_of SOURCE: where it lies in the site.
page_of() {
    case $1 in
    README.md) echo index.html ;;
    *.md) echo "${1%.md}.html" ;;
    *) echo "$1.html" ;;
    esac
}

# title_of SOURCE
title_of() {
    case $1 in
    *.md) sed -n 's/^# //p' "$1" | head -n 1 ;;
    *) basename "$1" ;;
    esac
}

# section TITLE SOURCE…: a list of links in the navigation, with @ROOT@ before each.
section() {
    printf '<h2>%s</h2><ul>\n' "$1"
    shift
    for source in "$@"; do
        [ -f "$source" ] || continue
        listed="$listed $source "
        printf '<li><a href="@ROOT@%s">%s</a></li>\n' "$(page_of "$source")" "$(title_of "$source")"
    done
    printf '</ul>\n'
}

# make_navigation: a document that no list above names goes under "More".
make_navigation() {
    listed=
    section "Begin" $home $guide
    section "Use" $use
    section "API" docs/api.md $API_SOURCES
    section "Accuracy and performance" $accuracy
    section "Project" $project
    more=
    for source in docs/*.md; do
        case $listed in *" $source "*) ;; *) more="$more $source" ;; esac
    done
    [ -z "$more" ] || section "More" $more
}

# make_page SOURCE: with pandoc's warnings as errors.
make_page() {
    source=$1
    page=$(page_of "$source")
    ROOT=$(dirname "$page" | sed 's,[^/.][^/]*,..,g; s,^\.$,,; s,..*,&/,')
    PAGE=$page
    export ROOT PAGE
    mkdir -p "$out/$(dirname "$page")"
    sed "s,@ROOT@,$ROOT,g; s,<a href=\"$ROOT$page\",& aria-current=\"page\"," "$work/navigation" >"$work/here"
    case $source in
    *.md) from=gfm+tex_math_dollars+gfm_auto_identifiers ;;
    *) from=docs/site/header.lua ;;
    esac
    home_page=
    [ "$source" != $home ] || home_page="-V home"
    timeout 60 pandoc --fail-if-warnings -f "$from" -t html5 --mathml --toc --toc-depth 2 --wrap none \
        --template docs/site/page.html --lua-filter docs/site/page.lua $home_page \
        -V root="$ROOT" -V source="$source" -V version="$version" -V navigation="$(cat "$work/here")" \
        "$source" -o "$out/$page"
}

# copy_linked: what pages link to and is no page: images, sources, examples.
copy_linked() {
    (cd "$out" && find . -name '*.html' -exec grep -o '\(href\|src\)="[^"#]*' {} +) |
        sed -n 's,^\(.*/\)[^/:]*:[a-z]*="\([^:]*\)$,\1\2,p' | sort -u | xargs -d '\n' realpath -m --relative-to . |
        sort -u | while read -r file; do
        [ ! -f "$file" ] || [ -e "$out/$file" ] || {
            mkdir -p "$out/$(dirname "$file")"
            cp "$file" "$out/$file"
        }
    done
}

find "$out" -mindepth 1 -maxdepth 1 ! -name demo -exec rm -rf {} + 2>/dev/null || true # that is of ./dev web
mkdir -p "$out"
make_navigation >"$work/navigation"
export SEARCH_INDEX="$work/sections"
set -- $home $API_SOURCES CONTRIBUTING.md docs/*.md
number=0
for source in "$@"; do
    number=$((number + 1))
    [ ! -t 2 ] || printf '\r%d of %d pages' $number $# >&2
    make_page "$source"
done
[ ! -t 2 ] || printf '\r\033[K' >&2
unset SEARCH_INDEX # what changed is nothing to search in
make_page CHANGELOG.md
copy_linked
{ echo 'globalThis.sections = ['; cat "$work/sections"; echo '];'; } >"$out/docs/site/sections.js"
echo "$out/index.html"
