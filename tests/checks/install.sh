# SPDX-License-Identifier: MIT
# Installs the library, static and shared, moves it elsewhere, and builds the README's program
# against it as users would: find_package, pkg-config, add_subdirectory.
set -eu
. tests/checks/common.sh

code_blocks README.md c >"$WORK/first_light.c"
grep -q 'int main' "$WORK/first_light.c" || fail "README.md has no C program"
sed 1d examples/first_light.c | cmp - "$WORK/first_light.c" >/dev/null || # but for the license
    fail "the program in README.md is not examples/first_light.c"

quietly() {
    "$@" >"$WORK/log" 2>&1 || fail "$*: $(cat "$WORK/log")"
}

mkdir "$WORK/package" "$WORK/inside"
version=$(sed -n 's/^#define LMP_VERSION_M[A-Z]* //p' include/lampion/base.h | paste -sd .)
cat >"$WORK/package/CMakeLists.txt" <<CMAKE
cmake_minimum_required(VERSION 3.25)
project(consumer LANGUAGES C)
find_package(lampion $version REQUIRED)
add_executable(first_light ../first_light.c)
target_link_libraries(first_light PRIVATE lampion::lampion)
CMAKE
cat >"$WORK/inside/CMakeLists.txt" <<CMAKE
cmake_minimum_required(VERSION 3.25)
project(consumer LANGUAGES C)
add_subdirectory($SOURCE lampion)
add_executable(first_light ../first_light.c)
target_link_libraries(first_light PRIVATE lampion::lampion)
CMAKE

# consume KIND: builds the program against that kind of library, by CMake and by pkg-config.
consume() {
    kind=$1 shared=ON static=
    [ "$kind" = shared ] || shared=OFF static=yes
    quietly cmake -G Ninja -S "$WORK/package" -B "$WORK/package/$kind" -DBUILD_SHARED_LIBS=$shared \
        -DCMAKE_PREFIX_PATH="$WORK/moved"
    quietly cmake --build "$WORK/package/$kind"
    "$WORK/package/$kind/first_light" >"$WORK/$kind-package.txt" || fail "find_package: cannot run"
    quietly gcc -std=c11 -Wall -Wextra -Wpedantic -Werror "$WORK/first_light.c" \
        ${static:+-static} $(pkg-config ${static:+--static} --cflags --libs lampion) -o "$WORK/$kind-pkg-config"
    "$WORK/$kind-pkg-config" >"$WORK/$kind-pkg-config.txt" || fail "pkg-config: cannot run"
    for program in "$WORK/package/$kind/first_light" "$WORK/$kind-pkg-config"; do
        linked=$(objdump -p "$program" | grep -c 'NEEDED *liblampion' || true)
        [ "$kind $linked" = "shared 1" ] || [ "$kind $linked" = "static 0" ] || fail "$program is not $kind"
    done
}

cp -r "$WORK/../libraries/usr" "$WORK/moved"
lib=$(dirname "$(find "$WORK/moved" -name liblampion.a)")
export PKG_CONFIG_PATH="$lib/pkgconfig" LD_LIBRARY_PATH="$lib"
consume shared
consume static
unset PKG_CONFIG_PATH LD_LIBRARY_PATH
# Within another project files are compiled by the same flags: of each folder one is, the others are those of $BUILD;
# compiling all is of the long form, as the library alone below, once with ccache.
inside() {
    quietly cmake -G Ninja -S "$WORK/inside" -B "$WORK/inside/build" -DCMAKE_BUILD_TYPE=Release "$@"
}
if [ -n "${LAMPION_LONG:-}" ]; then
    inside
else
    objects=$(library_objects)
    inside "-DLAMPION_OBJECTS=$objects"
    quietly ninja -C "$WORK/inside/build" $(ls src/[!k]*/*.c src/kernels/dispatch.c |
        awk -F/ '!seen[$2]++ { print "lampion/CMakeFiles/lampion_objects.dir/" $0 ".o" }')
fi
quietly cmake --build "$WORK/inside/build"
"$WORK/inside/build/first_light" >"$WORK/inside.txt"

# The library alone needs nothing of the program's.
quietly cmake --preset library -B "$WORK/alone/build" -DCMAKE_INSTALL_PREFIX="$WORK/alone/installed"
! grep -qiE 'embree|pkg_config|cmocka' "$WORK/alone/build/CMakeCache.txt" || fail "the library alone looks for the program's libraries"
[ -z "${LAMPION_LONG:-}" ] || {
    quietly cmake --build "$WORK/alone/build"
    quietly cmake --install "$WORK/alone/build"
    quietly env PKG_CONFIG_PATH="$(dirname "$(find "$WORK/alone/installed" -name lampion.pc)")" \
        sh -c 'cc "$1" $(pkg-config --cflags --libs lampion) -o "$2"' - "$WORK/first_light.c" "$WORK/alone/first_light"
    "$WORK/alone/first_light" | cmp "$WORK/inside.txt" - || fail "the library alone gives another color"
}

# README's three lines of FetchContent get this tree in place of what they would fetch, and a compiler that CMake takes
# for another processor's: the kernels must follow the compiler.
code_blocks README.md cmake >"$WORK/fetch.cmake"
[ "$(grep -c . "$WORK/fetch.cmake")" = 4 ] || fail "README.md has no three lines of FetchContent and the one that links"
mkdir "$WORK/fetched"
cat >"$WORK/fetched/CMakeLists.txt" <<CMAKE
cmake_minimum_required(VERSION 3.25)
project(consumer LANGUAGES C)
add_executable(my_program ../first_light.c)
$(cat "$WORK/fetch.cmake")
CMAKE
quietly cmake -G Ninja -S "$WORK/fetched" -B "$WORK/fetched/build" -DFETCHCONTENT_SOURCE_DIR_LAMPION="$SOURCE" \
    -DCMAKE_SYSTEM_NAME=Linux -DCMAKE_SYSTEM_PROCESSOR=none-such -DCMAKE_BUILD_TYPE=Debug
for define in LMPI_KERNELS_VECTOR $([ "$(uname -m)" != x86_64 ] || echo LMPI_KERNELS_X86); do
    grep -q "$define" "$WORK/fetched/build/build.ninja" || fail "without $define, by the name of a processor"
done
grep -q cmocka "$WORK/fetched/build/CMakeCache.txt" && fail "a library within a project looks for what tests need"

grep -Eq '[0-9]' "$WORK/inside.txt" || fail "the program in README.md prints nothing"
for output in "$WORK"/*-package.txt "$WORK"/*-pkg-config.txt; do
    cmp "$WORK/inside.txt" "$output" || fail "$output differs"
done
