# SPDX-License-Identifier: MIT
# The library's binary interface against that of the last release, tests/checks/abi/VERSION.abi. What has changed so that
# callers notice must be what tests/checks/abi/changed.txt lists, a line each ("changed lmp_light", "removed lmp_sh_dot"),
# and the changelog, or a page that its first entry links to, must name each. New functions are free.
# A release puts the dump of this test's folder, now.abi, in the place of the old one, and empties the list.
set -eu
. tests/checks/common.sh
command -v abidiff >/dev/null || { echo "skipped: abigail-tools is not installed"; exit 0; }

lists=tests/checks/abi
baseline=$(echo $lists/*.abi)

# dump SOURCE FILE: writes the interface of the library in SOURCE. Headers of src/ may have the names of public ones,
# and abidw recognizes private types only by the name of their header: in the debug information the public ones begin
# with "public-". Nothing in the dump depends on the machine's folders.
dump() {
    rm -rf "$WORK/built" "$WORK/headers"
    mkdir "$WORK/headers"
    for header in "$1"/include/lampion/*.h; do
        cp "$header" "$WORK/headers/public-$(basename "$header")"
    done
    { cmake -S "$1" -B "$WORK/built" -G Ninja -DCMAKE_BUILD_TYPE=Debug -DCMAKE_C_COMPILER_LAUNCHER= \
        "-DCMAKE_C_FLAGS_DEBUG=-O0 -g -ffile-prefix-map=$1/include/lampion/=lampion/public-" \
        -DBUILD_SHARED_LIBS=ON -DLAMPION_SIMD=OFF -DLAMPION_PROGRAM=OFF -DLAMPION_TESTS=OFF &&
        cmake --build "$WORK/built" --target lampion; } >"$WORK/log" 2>&1 || fail "$(tail -n 40 "$WORK/log")"
    abidw --no-corpus-path --no-comp-dir-path --no-show-locs --type-id-style hash --exported-interfaces-only \
        --headers-dir "$WORK/headers" --drop-private-types "$WORK/built/liblampion.so" |
        sed "s, path='[^']*/src/, path='src/,; s, filepath='[^']*/, filepath=',g" >"$2"
    [ "$(grep -c '<function-decl name=.lmp_' "$2")" -gt 100 ] || fail "the dump of the interface lacks functions"
}

# changes BEFORE AFTER: prints what a caller notices, as lines of the list.
changes() {
    abidiff --leaf-changes-only --impacted-interfaces "$1" "$2" >"$WORK/report" || [ $(($? & 3)) = 0 ] ||
        fail "abidiff: $(cat "$WORK/report")"
    sed -n "s/^ *\[D\] '[^']*[ *]\(lmp_[a-z0-9_]*\)(.*/removed \1/p
        s/^ *\[C\] '[^']*[ *]\(lmp_[a-z0-9_]*\)(.*/changed \1/p
        s/^'[a-z]* \(lmp_[a-z0-9_]*\).* changed:\$/changed \1/p" "$WORK/report" | LC_ALL=C sort -u
}

dump "$SOURCE" "$WORK/now.abi"
changes "$baseline" "$WORK/now.abi" >"$WORK/changed"
grep -v '^#' $lists/changed.txt | LC_ALL=C sort -u >"$WORK/permitted"
diff "$WORK/permitted" "$WORK/changed" >"$WORK/log" ||
    fail "the interface of $(basename "$baseline" .abi) has changed otherwise than $lists/changed.txt says (<):" "$(cat "$WORK/log")"
pages="CHANGELOG.md $(awk '/^## / { entries++ } entries == 1' CHANGELOG.md | grep -o '(docs/[^)#]*' | tr -d '(' | sort -u)"
while read -r how name; do
    cat $pages | grep -qw "$name" || fail "$name is $how, and neither the changelog nor a page that it links to tells its callers"
done <"$WORK/changed"

# Changes of an enumeration, and a function that is gone, must be found.
sed "s/<enumerator name='LMP_WINDOW_NONE' value='0'/<enumerator name='LMP_WINDOW_NONE' value='7'/
    /<elf-symbol name='lmp_light_range'/d; /<function-decl name='lmp_light_range'/,/<\/function-decl>/d" \
    "$WORK/now.abi" >"$WORK/planted.abi"
[ "$(changes "$WORK/now.abi" "$WORK/planted.abi")" = 'changed lmp_window
removed lmp_light_range' ] || fail "a changed enumeration or a removed function goes unseen"
