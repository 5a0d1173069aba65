# SPDX-License-Identifier: MIT
# The site builds without a warning, needs no network, and has no dead link, anchor or image. docs.pages looks at it, too.
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

# Targets of links: a page, and its anchors.
while read -r page; do
    name=${page#"$site"/}
    echo "$name"
    grep -o ' id="[^"]*"' "$page" | sed "s,^ id=\"\(.*\)\"\$,$name#\1,"
done <"$WORK/pages" | sort >"$WORK/targets"
twice=$(uniq -d <"$WORK/targets")
[ -z "$twice" ] || fail "anchors that exist twice:" $twice

(cd "$site" && find . -type f | sed 's,^\./,,') >"$WORK/files"

# dead PAGE…: prints their links that lead nowhere; pages are named from the site's folder.
dead() {
    (cd "$site" && grep -H -o ' \(href\|src\)="[^"]*"' "$@") | sed 's/^\([^:]*\): [a-z]*="\(.*\)"$/\1 \2/' | sort -u |
        awk -v targets="$WORK/targets" -v files="$WORK/files" '
            # the folder of the page and the link, without . and ..
            function plain(path, part, n, i, kept, whole) {
                n = split(path, part, "/")
                for (i = 1; i <= n; i++)
                    if (part[i] == "..") kept -= kept > 0
                    else if (part[i] != "" && part[i] != ".") part[++kept] = part[i]
                for (i = 1; i <= kept; i++) whole = whole (i > 1 ? "/" : "") part[i]
                return whole
            }
            BEGIN {
                while ((getline line <targets) > 0) is_target[line]
                while ((getline line <files) > 0) is_file[line]
            }
            $2 ~ /^https?:\/\// { next }
            {
                link = substr($0, length($1) + 2)
                folder = $1
                sub(/[^\/]*$/, "", folder)
                at = index(link, "#")
                path = at ? substr(link, 1, at - 1) : link
                target = (at == 1 ? $1 : plain(folder path)) (at ? substr(link, at) : "")
                if (!(target ~ /#|\.html$/ ? target in is_target : target in is_file)) print $1 ": " link
            }'
}

{
    dead $(sed "s,^$site/,," "$WORK/pages")
    xargs -d '\n' grep -H -o '<\(link\|img\|script\|iframe\)[^>]*="\(https\?:\)\?//[^>]*' <"$WORK/pages" || true
} >"$WORK/dead"
[ ! -s "$WORK/dead" ] || fail "dead links, or things of the network: $(cat "$WORK/dead")"

# What the search finds exists, and is found.
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

# A dead link must be found.
printf '<a href="nowhere.html">x</a>\n<a href="index.html#nowhere">x</a>\n' >"$site/planted.html"
printf '<a href="index.html">x</a>\n<a href="docs/../docs/./viewer.html">x</a>\n<a href="docs/nowhere.png">x</a>\n' >>"$site/planted.html"
[ "$(dead planted.html | wc -l)" = 3 ] || fail "a dead link goes unseen"
rm "$site/planted.html"

# The dot in the name of a file does not end the first sentence of a header.
for opening in 'preintegrated: (docs/preintegration.md has the derivation).' 'lampion: each header includes those that it builds on:'; do
    tr '\n' ' ' <"$site/include/lampion/${opening%%:*}.h.html" | grep -qF "${opening#*: }</p>" || fail "${opening%%:*}.h begins otherwise"
done

# A function without a comment must fail.
sed 's,^/\* Returns the version.*,,' include/lampion/base.h >"$WORK/bare.h"
if ROOT= API_SOURCES="$WORK/bare.h" pandoc -f docs/site/header.lua "$WORK/bare.h" >/dev/null 2>"$WORK/log"; then
    fail "a function without a comment goes unseen"
fi
grep -q 'without a comment: LMP_API uint32_t lmp_version' "$WORK/log" || fail "$(cat "$WORK/log")"
