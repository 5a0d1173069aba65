# SPDX-License-Identifier: MIT
# What the scripts of this folder share.

fail() {
    printf '%s\n' "$*" >&2
    exit 1
}

# what is compiled here goes through what the tests' own build goes through, such as ccache
CMAKE_C_COMPILER_LAUNCHER=$(sed -n 's/^CMAKE_C_COMPILER_LAUNCHER:[A-Z]*=//p' "$BUILD/CMakeCache.txt")
export CMAKE_C_COMPILER_LAUNCHER

# code_blocks FILE LANGUAGE: the lines of its ```LANGUAGE blocks.
code_blocks() {
    awk -v fence='```'"$2" '$0 == fence { inside = 1; next } /^```/ { inside = 0 } inside' "$1"
}

# own_scene FILE: a scene that stands for the reader's own, a triangle of the material floor.
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
