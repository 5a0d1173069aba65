# SPDX-License-Identifier: MIT
# The site builds without a warning, needs no network, and has no dead link, anchor or image.
set -eu
. tests/checks/common.sh

# On Debian older pandoc releases cannot read by Lua; the packages of ./dev bring one that can.
command -v pandoc >/dev/null || {
    echo "skipped: pandoc is not installed"
    exit 0
}
site=$WORK/site
sh docs/site/build.sh "$site" >"$WORK/log" 2>&1 || fail "$(cat "$WORK/log")"

find "$site" -name '*.html' >"$WORK/pages"
for document in README.md CONTRIBUTING.md CHANGELOG.md $(ls docs/*.md include/lampion/*.h); do
    name=${document%.md}
    case $document in README.md) name=index ;; esac
    [ -f "$site/$name.html" ] || fail "$document has no page"
done

# everything a page can be asked for: itself, and its anchors
while read -r page; do
    name=${page#"$site"/}
    echo "$name"
    grep -o ' id="[^"]*"' "$page" | sed "s,^ id=\"\(.*\)\"\$,$name#\1,"
done <"$WORK/pages" | sort >"$WORK/targets"
twice=$(uniq -d <"$WORK/targets")
[ -z "$twice" ] || fail "anchors that exist twice:" $twice

# dead PAGE: its links that lead nowhere.
dead() {
    folder=$(dirname "${1#"$site"/}")
    grep -o ' \(href\|src\)="[^"]*"' "$1" | sed 's/^ [a-z]*="\(.*\)"$/\1/' | sort -u |
        while read -r link; do
            case $link in
            http://* | https://*) continue ;;
            '#'*) target=${1#"$site"/}$link ;;
            *) target=$(cd "$site" && realpath -m --relative-to . "$folder/${link%%#*}") ;;
            esac
            case $link in
            '#'*) ;;
            *'#'*) target=$target#${link#*#} ;;
            esac
            case $target in
            *'#'* | *.html) grep -qxF -e "$target" "$WORK/targets" ;;
            *) [ -f "$site/$target" ] ;;
            esac || echo "${1#"$site"/}: $link"
        done
}

while read -r page; do
    dead "$page"
    grep -H -o '<\(link\|img\|script\|iframe\)[^>]*="\(https\?:\)\?//[^>]*' "$page" || true
done <"$WORK/pages" >"$WORK/dead"
[ ! -s "$WORK/dead" ] || fail "dead links, or things of the network: $(cat "$WORK/dead")"

# what the search finds is there, and is found
sed -n 's/^\["\([^"]*\)","\([^"]*\)",.*/\1#\2/p; ' "$site/docs/site/sections.js" | sed 's/#$//' >"$WORK/found"
[ "$(wc -l <"$WORK/found")" -gt 200 ] || fail "the search knows only $(wc -l <"$WORK/found") sections"
grep -vxF -f "$WORK/targets" "$WORK/found" && fail "the search leads nowhere"
if command -v node >/dev/null; then
    cat >"$WORK/search.mjs" <<SEARCH
await import('$site/docs/site/sections.js');
await import('$site/docs/site/search.js');
for (const words of ['undo lights', 'LMP_SH_ROTATE', 'a(b', 'zebra crossing'])
    console.log(findSections(sections, words)[0]?.[0] ?? 'nothing');
SEARCH
    node "$WORK/search.mjs" >"$WORK/log" 2>&1 || fail "$(cat "$WORK/log")"
    printf 'docs/viewer.html\ninclude/lampion/sh.h.html\nnothing\nnothing\n' | diff - "$WORK/log" || fail "the search finds something else"
fi

for image in docs/images/*; do
    grep -qF "images/$(basename "$image")" README.md docs/*.md || fail "no document shows $image"
done

# and a dead link would be seen
printf '<a href="nowhere.html">x</a>\n<a href="index.html#nowhere">x</a>\n' >"$site/planted.html"
[ "$(dead "$site/planted.html" | wc -l)" = 2 ] || fail "a dead link goes unseen"

# the names of files end no sentence of what a header begins with
for opening in 'preintegrated: (docs/preintegration.md derives it).' 'lampion: each header with all that it builds on:'; do
    tr '\n' ' ' <"$site/include/lampion/${opening%%:*}.h.html" | grep -qF "${opening#*: }</p>" || fail "${opening%%:*}.h begins otherwise"
done

# a function without a comment is no page
sed 's,^/\* The version.*,,' include/lampion/base.h >"$WORK/bare.h"
if ROOT= API_SOURCES="$WORK/bare.h" pandoc -f docs/site/header.lua "$WORK/bare.h" >/dev/null 2>"$WORK/log"; then
    fail "a function without a comment goes unseen"
fi
grep -q 'without a comment: LMP_API uint32_t lmp_version' "$WORK/log" || fail "$(cat "$WORK/log")"
