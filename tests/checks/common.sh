# SPDX-License-Identifier: MIT
# Functions that the scripts of this folder share.

fail() {
    printf '%s\n' "$*" >&2
    exit 1
}

# Compiles here by the same launcher as the tests' own build, such as ccache.
CMAKE_C_COMPILER_LAUNCHER=$(sed -n 's/^CMAKE_C_COMPILER_LAUNCHER:[A-Z]*=//p' "$BUILD/CMakeCache.txt")
export CMAKE_C_COMPILER_LAUNCHER

# code_of HEADER…: prints their code on one line, without comments and directives.
code_of() {
    sed '/^ *#/d' "$@" | tr '\n' ' ' | tr -s ' ' | awk '{ gsub(/\/\*([^*]|\*+[^*\/])*\*+\//, ""); print }'
}

# declarations HEADER…: prints each exported function as a line: what it returns, its name, its arguments.
declarations() {
    code_of "$@" | tr ';' '\n' | sed -n 's/.*LMP_API \(.*[ *]\)\(lmp_[a-z0-9_]*\)(\(.*\))$/\1|\2|\3/p'
}

# code_blocks FILE LANGUAGE: prints the lines of its ```LANGUAGE blocks.
code_blocks() {
    awk -v fence='```'"$2" '$0 == fence { inside = 1; next } /^```/ { inside = 0 } inside' "$1"
}

# library_objects: prints those of $BUILD as a list of CMake's.
library_objects() {
    objects=$(ninja -C "$BUILD" -t inputs liblampion.a | sed -n "s,^\(CMakeFiles/lampion_objects[.]dir/.*[.]o\)\$,$BUILD/\1,p")
    [ "$(echo "$objects" | wc -l)" -gt 50 ] || fail "the objects of $BUILD:" $objects
    echo $objects | tr ' ' ';'
}

# python_with MODULE…: prints the first Python that has these modules; nothing if none has.
python_with() {
    modules=$(printf 'import %s\n' "$@")
    for python in /usr/bin/python3 "$(command -v python3 || true)"; do
        if "$python" -c "$modules" 2>/dev/null; then
            echo "$python"
            break
        fi
    done
}

# own_scene FILE: writes a scene that stands for the reader's own, a triangle of the material floor.
own_scene() {
    cat >"$1" <<'GLTF'
{ "asset": { "version": "2.0" }, "scene": 0, "scenes": [ { "nodes": [ 0 ] } ],
  "nodes": [ { "mesh": 0 } ], "meshes": [ { "primitives": [ { "attributes": { "POSITION": 0 }, "material": 0 } ] } ],
  "materials": [ { "name": "floor", "pbrMetallicRoughness": { "metallicFactor": 0, "roughnessFactor": 0.6 } } ],
  "accessors": [ { "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                   "min": [ -4, 0, -4 ], "max": [ 4, 0, 4 ] } ],
  "bufferViews": [ { "buffer": 0, "byteLength": 36 } ],
  "buffers": [ { "byteLength": 36, "uri": "data:application/octet-stream;base64,@POSITIONS@" } ] }
GLTF
    # (-4,0,4) (4,0,4) (0,0,-4)
    sed -i 's,@POSITIONS@,AACAwAAAAAAAAIBAAACAQAAAAAAAAIBAAAAAAAAAAAAAAIDA,' "$1"
}
