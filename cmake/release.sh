#!/bin/sh
# SPDX-License-Identifier: MIT
# release.sh: makes a release in out/release-VERSION/: the packages and the source archive by ./dev package, the wheel, the
# npm package, the shaders, the site, the notes, and a checksum of each file. The commit must be ready: nothing uncommitted, and the headers' version at the top of
# CHANGELOG.md, with its date.
set -eu
cd "$(dirname "$0")/.."

fail() {
    echo "dev: no release: $1" >&2
    exit 1
}

# heading: prints the version and the date of the changelog's first entry, "0.1.0 (2026-11-27)".
heading() {
    sed -n 's/^## //p' CHANGELOG.md | head -n 1
}

# notes: prints the text of the changelog's first entry. Links into the tree, which may span lines, become their text, because notes are read
# elsewhere.
notes() {
    printf '# Lampion %s\n' "$(heading)"
    awk '/^## / { entries++; next } entries == 1' CHANGELOG.md | sed -z 's/\[\([^]]*\)\]([^)]*\.md[^)]*)/\1/g'
}

git rev-parse -q --verify HEAD >/dev/null 2>&1 || fail "this is not a clone of the repository"
changed=$(git status --porcelain)
[ -z "$changed" ] || fail "there are changes that are not committed:
$changed"
version=$(sed -n 's/^#define LMP_VERSION_[A-Z]* //p' include/lampion/base.h | paste -sd .)
[ "$(heading | cut -d ' ' -f 1)" = "$version" ] ||
    fail "CHANGELOG.md begins with $(heading), include/lampion/base.h says $version"
heading | grep -qE '^[0-9.]+ \([0-9]{4}-[0-9]{2}-[0-9]{2}\)$' || fail "CHANGELOG.md gives no date for $version: $(heading)"

folder=out/release-$version
rm -rf "$folder"
./dev package "$folder" >/dev/null
./dev npm "$folder" >/dev/null
stage=$(mktemp -d)
trap 'rm -rf "$stage"' EXIT
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
export SOURCE_DATE_EPOCH
for component in library development python; do
    cmake --install build/package --prefix "$stage/usr" --component $component >/dev/null
done
PYTHON=/usr/bin/python3 sh python/wheel.sh "$stage/usr" "$folder" >/dev/null
# The shaders in every language, for engines without a package manager.
mkdir "$stage/lampion-shaders-$version"
cp -r "$stage/usr/share/lampion/shaders/." examples/engines LICENSE "$stage/lampion-shaders-$version"
archive() { # FILE FORMAT FOLDER, whose files get the commit's time
    (cd "$stage" && find "$3" -exec touch -d "@$SOURCE_DATE_EPOCH" {} + && find "$3" -type f | LC_ALL=C sort >"$stage/list" &&
        TZ=UTC cmake -E tar cf "$1" "--format=$2" --files-from="$stage/list")
}
archive "$PWD/$folder/lampion-shaders-$version.zip" zip "lampion-shaders-$version"
rm -rf build/site/docs build/site/index.html
./dev docs >/dev/null
cp -r build/site "$stage/lampion-site-$version"
rm -rf "$stage/lampion-site-$version/demo"
archive "$PWD/$folder/lampion-site-$version.zip" zip "lampion-site-$version"
notes >"$folder/release-notes.md"
(cd "$folder" && sha256sum -- * >../SHA256SUMS && mv ../SHA256SUMS .)
ls "$folder"/*
