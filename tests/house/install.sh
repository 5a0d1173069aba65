# SPDX-License-Identifier: MIT
# Installs the library, static and shared, moves it elsewhere, and builds the README's program
# against it as users would: find_package, pkg-config, add_subdirectory.
set -eu
. tests/house/common.sh

code_blocks README.md c >"$WORK/first_light.c"
grep -q 'int main' "$WORK/first_light.c" || fail "README.md has no C program"
sed 1d examples/first_light.c | cmp - "$WORK/first_light.c" >/dev/null || # but for the licence
    fail "the program in README.md is not examples/first_light.c"

quietly() {
    "$@" >"$WORK/log" 2>&1 || fail "$*: $(cat "$WORK/log")"
}

mkdir "$WORK/package" "$WORK/inside"
cat >"$WORK/package/CMakeLists.txt" <<'CMAKE'
cmake_minimum_required(VERSION 3.25)
project(consumer LANGUAGES C)
find_package(lampion 0.1 REQUIRED)
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

consume() {
    kind=$1 prefix=$WORK/moved-$1
    export LD_LIBRARY_PATH="$prefix/lib"
    quietly cmake -G Ninja -S "$WORK/package" -B "$WORK/package/$kind" -DCMAKE_PREFIX_PATH="$prefix"
    quietly cmake --build "$WORK/package/$kind"
    "$WORK/package/$kind/first_light" >"$WORK/$kind-package.txt" || fail "find_package: cannot run"

    flags=$(PKG_CONFIG_PATH=$prefix/lib/pkgconfig pkg-config --cflags --libs lampion)
    quietly gcc -std=c11 -Wall -Wextra -Wpedantic -Werror "$WORK/first_light.c" $flags \
        -o "$WORK/$kind-pkg-config"
    "$WORK/$kind-pkg-config" >"$WORK/$kind-pkg-config.txt" || fail "pkg-config: cannot run"
    unset LD_LIBRARY_PATH
}

for kind in static shared; do
    quietly cmake --install "$WORK/../libraries/$kind" --prefix "$WORK/first-$kind"
    mv "$WORK/first-$kind" "$WORK/moved-$kind"
    consume "$kind"
done
quietly cmake -G Ninja -S "$WORK/inside" -B "$WORK/inside/build" -DCMAKE_BUILD_TYPE=Debug
quietly cmake --build "$WORK/inside/build"
"$WORK/inside/build/first_light" >"$WORK/inside.txt"

grep -Eq '[0-9]' "$WORK/inside.txt" || fail "the program in README.md prints nothing"
for output in "$WORK"/*-package.txt "$WORK"/*-pkg-config.txt; do
    cmp "$WORK/inside.txt" "$output" || fail "$output differs"
done
