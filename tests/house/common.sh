# SPDX-License-Identifier: MIT
# What the scripts of this folder share.

fail() {
    printf '%s\n' "$*" >&2
    exit 1
}

# what is compiled here goes through what the tests' own build goes through, such as ccache
CMAKE_C_COMPILER_LAUNCHER=$(sed -n 's/^CMAKE_C_COMPILER_LAUNCHER:[A-Z]*=//p' "$BUILD/CMakeCache.txt")
export CMAKE_C_COMPILER_LAUNCHER

# configure FOLDER ARGUMENT…: a build of the library alone, quietly.
configure() {
    folder=$1
    shift
    cmake -G Ninja -S "$SOURCE" -B "$folder" -DCMAKE_BUILD_TYPE=Release -DLAMPION_PROGRAM=OFF \
        -DLAMPION_TESTS=OFF "$@" >"$folder.log" 2>&1 || fail "$(cat "$folder.log")"
    cmake --build "$folder" >"$folder.log" 2>&1 || fail "$(cat "$folder.log")"
}

# code_blocks FILE LANGUAGE: the lines of its ```LANGUAGE blocks.
code_blocks() {
    awk -v fence='```'"$2" '$0 == fence { inside = 1; next } /^```/ { inside = 0 } inside' "$1"
}
