# SPDX-License-Identifier: MIT
# docs/build-systems.md: Meson with the library installed and in the source archive, where Debian's meson is installed; the
# recipe for Conan and the port for vcpkg on stand-ins for what these tools give them.
set -eu
. tests/checks/common.sh

quietly() {
    "$@" >"$WORK/log" 2>&1 || fail "$*: $(tail -n 40 "$WORK/log")"
}
git rev-parse HEAD >/dev/null 2>&1 || {
    echo "skipped: not a clone, from which the source archive is made"
    exit 0
}
version=$(sed -n 's/^#define LMP_VERSION_M[A-Z]* //p; s/^#define LMP_VERSION_PATCH //p' include/lampion/base.h | paste -sd .)
tree=$WORK/lampion-$version
mkdir "$tree"
git archive HEAD | tar -x -C "$tree"
grep -q "\"version\": \"$version\"" "$tree/packaging/vcpkg/lampion/vcpkg.json" || fail "vcpkg.json has another version than $version"
! grep -o 'lampion[-/][0-9][0-9.]*[0-9]' docs/build-systems.md | grep -v "lampion[-/]$version" || fail "docs/build-systems.md has another version than $version"

# runs PROGRAM: it must print what the program does that is linked with the library of checks.libraries.
gcc -std=c11 -I"$WORK/../libraries/usr/include" examples/first_light.c "$(find "$WORK/../libraries/usr" -name liblampion.a)" -lm -o "$WORK/first_light"
"$WORK/first_light" >"$WORK/expected"
runs() {
    "$1" >"$WORK/printed" || fail "$1 cannot run"
    cmp -s "$WORK/printed" "$WORK/expected" || fail "$1 prints something else"
}

if command -v meson >/dev/null; then
    { echo "project('consumer', 'c', default_options: ['c_std=c11', 'buildtype=release'])"
        code_blocks docs/build-systems.md meson; } >"$WORK/meson.build"
    for way in installed inside; do
        mkdir -p "$WORK/$way/subprojects"
        cp examples/first_light.c "$WORK/$way"
    done
    cp "$WORK/meson.build" "$WORK/installed"
    lib=$(dirname "$(find "$WORK/../libraries/usr" -name liblampion.a)")
    PKG_CONFIG_PATH=$lib/pkgconfig quietly meson setup "$WORK/installed/build" "$WORK/installed"
    quietly meson compile -C "$WORK/installed/build"
    LD_LIBRARY_PATH=$lib runs "$WORK/installed/build/first_light"
    # compiling every instruction set takes minutes: the kernels' own options are left to checks.install
    sed "s/'LAMPION_TESTS': false/&, 'LAMPION_SIMD': false, 'LAMPION_UNROLL': false/" "$WORK/meson.build" >"$WORK/inside/meson.build"
    cp -r "$tree" "$WORK/inside/subprojects/lampion"
    quietly env -u PKG_CONFIG_PATH meson setup "$WORK/inside/build" "$WORK/inside"
    quietly meson compile -C "$WORK/inside/build"
    runs "$WORK/inside/build/first_light"
else
    echo "skipped: meson is not installed"
fi

quietly cmake -DPORT="$tree/packaging/vcpkg/lampion/portfile.cmake" -DCURRENT_PACKAGES_DIR="$WORK/vcpkg/package" -DWORK="$WORK/vcpkg" \
    -P tests/checks/build_systems/vcpkg.cmake
[ ! -d "$WORK/vcpkg/package/share/doc" ] && [ ! -d "$WORK/vcpkg/package/bin" ] || fail "the port installs documents or programs"
quietly gcc -std=c11 -I"$WORK/vcpkg/package/include" examples/first_light.c "$WORK/vcpkg/package/lib/liblampion.a" -lm -o "$WORK/by_vcpkg"
runs "$WORK/by_vcpkg"

/usr/bin/python3 tests/checks/build_systems/conan_create.py "$tree/packaging/conan/conanfile.py" "$WORK/conan" >"$WORK/log" 2>&1 ||
    fail "conan: $(tail -n 20 "$WORK/log")"
[ "$(tail -n 1 "$WORK/log")" = "lampion/$version -llampion -lm" ] || fail "the recipe says $(tail -n 1 "$WORK/log")"
[ -f "$WORK/conan/package/licenses/LICENSE" ] && [ ! -d "$WORK/conan/package/lib/cmake" ] || fail "Conan's package lacks the license, or has files for CMake"
quietly gcc -std=c11 -I"$WORK/conan/package/include" examples/first_light.c "$WORK/conan/package/lib/liblampion.a" -lm -o "$WORK/by_conan"
runs "$WORK/by_conan"
