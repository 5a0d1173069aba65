# SPDX-License-Identifier: MIT
# ./dev release, in a clone: what it refuses, what it makes, and that it makes the same bytes again. The packages are
# those of the library, of the objects that $BUILD has; checks.package judges the whole ones.
set -eu
. tests/checks/common.sh

if ! command -v dpkg-shlibdeps >/dev/null || ! git rev-parse -q --verify HEAD >/dev/null 2>&1; then
    echo "skipped: not a clone on a Debian system with dpkg-dev"
    exit 0
fi
objects=$(ninja -C "$BUILD" -t inputs liblampion.a | sed -n "s,^\(CMakeFiles/lampion_objects[.]dir/.*[.]o\)\$,$BUILD/\1,p")
git clone -q "$SOURCE" "$WORK/clone"
cd "$WORK/clone"
git config user.name Lampion
git config user.email lampion@example.org
version=$(sed -n 's/^#define LMP_VERSION_[A-Z]* //p' include/lampion/base.h | paste -sd .)

# heading TEXT: makes a commit in which the changelog begins with TEXT.
heading() {
    awk -v text="$1" '/^## / && !done { $0 = "## " text; done = 1 } { print }' CHANGELOG.md >"$WORK/changelog"
    cp "$WORK/changelog" CHANGELOG.md
    git diff --quiet || git commit -qam "Begin with $1"
}

# refused WORDS: ./dev release must fail with WORDS and make nothing.
refused() {
    ! ./dev release >"$WORK/log" 2>&1 || fail "released in spite of: $1"
    grep -q "^dev: no release: .*$1" "$WORK/log" || fail "not '$1' but: $(cat "$WORK/log")"
    [ ! -e out ] || fail "refused, and out/ is there"
}

# What takes minutes is judged elsewhere: the npm package by web.npm, the site by docs.site.
cat >web/package/pack.sh <<'END'
mkdir -p "$2"
echo "stands for the npm package" >"$2/lampion-stand-in.tgz"
END
cat >docs/site/build.sh <<'END'
mkdir -p "$1/docs"
echo "stands for the site" >"$1/index.html"
END
git commit -qam "Stand in for the npm package and the site"

heading "$version (unreleased)"
refused "no date"
heading "9.9.9 (2030-01-02)"
refused "begins with 9.9.9"
heading "$version (2030-01-02)"
echo "a stray line" >>LICENSE
refused "not committed"
git checkout -q LICENSE
echo stray >stray.txt
refused "not committed"
rm stray.txt

# released: lists what ./dev release makes, without the slow parts of the build.
released() {
    ./dev release >"$WORK/log" 2>&1 || fail "$(tail -n 40 "$WORK/log")"
}
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct) cmake --preset package -DLAMPION_PROGRAM=OFF \
    "-DLAMPION_OBJECTS=$(echo $objects | tr ' ' ';')" >"$WORK/log" 2>&1 || fail "$(tail -n 40 "$WORK/log")"
released
folder=out/release-$version
for file in "liblampion${version%.*}_$version-1_"*.deb "liblampion-dev_$version-1_"*.deb "liblampion-doc_$version-1_all.deb" "python3-lampion_$version-1_all.deb" \
    "lampion-$version.tar.gz" "lampion-$version-py3-none-"*.whl lampion-stand-in.tgz "lampion-shaders-$version.zip" \
    "lampion-site-$version.zip" release-notes.md SHA256SUMS; do
    [ -s "$(echo $folder/$file)" ] || fail "no $file in $(ls $folder)"
done
[ "$(wc -l <$folder/SHA256SUMS)" = "$(($(ls $folder | wc -l) - 1))" ] || fail "not a checksum for each file"
(cd $folder && sha256sum --quiet -c SHA256SUMS) || fail "checksums that do not hold"
[ "$(head -n 1 $folder/release-notes.md)" = "# Lampion $version (2030-01-02)" ] || fail "the notes begin otherwise"
! grep -q '^## \|](docs' $folder/release-notes.md || fail "the notes hold more than one version, or links into the tree"
python3 -m zipfile -l "$folder/lampion-shaders-$version.zip" >"$WORK/shaders"
for file in lampion.glsl hlsl/lampion.hlsl metal/lampion.metal wgsl/lampion.js wgsl/ggx/lampion.wgsl engines/lampion_probe.cginc LICENSE; do
    grep -q "^lampion-shaders-$version/$file " "$WORK/shaders" || fail "the shaders' archive lacks $file"
done
[ -z "$(git status --porcelain)" ] || fail "the tree is no longer clean: $(git status --porcelain)"

cp -r $folder "$WORK/first"
touch LICENSE # times of files do not count
rm -rf build/package/_CPack_Packages
released
diff -r "$WORK/first" $folder || fail "a second release differs"
