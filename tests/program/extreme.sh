# SPDX-License-Identifier: MIT
# Inputs at the ends of their ranges: no image that is written holds a NaN or an infinity, and lights that
# could make one are refused in a line, by whatever reader they come; a glTF file is drawn without them.
set -eu
. tests/checks/common.sh

# finite NAME ARGUMENT…: the image that these arguments render must have only finite values. One comparison reads two.
image= before=
finite() {
    name=$1
    shift
    image=$([ "$image" = odd ] && echo even || echo odd)
    "$PROGRAM" "$@" --size 20x12 -o "$WORK/$image.exr" >"$WORK/out" 2>"$WORK/err" ||
        fail "$name: $* is refused: $(cat "$WORK/err")"
    [ $image = odd ] || compare_both "$before or $name: $*"
    before="$name: $*"
}

compare_both() {
    "$PROGRAM" compare "$WORK/odd.exr" "$WORK/$image.exr" >"$WORK/out" 2>&1 || fail "$1: $(tail -n 1 "$WORK/out")"
}

# overflows: the image just written must have had values beyond float32 before it was written.
overflows() {
    grep -q 'beyond what float32 holds' "$WORK/err"
}

# refused NAME ARGUMENT…: the command must print one line that states the limit, with status 1, and write no image.
refused() {
    name=$1
    shift
    rm -f "$WORK/none.exr"
    status=0
    "$PROGRAM" "$@" --size 8x8 -o "$WORK/none.exr" >"$WORK/out" 2>"$WORK/err" || status=$?
    [ $status = 1 ] || fail "$name: $*: status $status"
    [ "$(grep -c '^lampion: .*not finite.* above 1e19' "$WORK/err")" = 1 ] || fail "$name: $*: $(cat "$WORK/err")"
    [ ! -e "$WORK/none.exr" ] || fail "$name: an image was written"
}


# kinds COLOR: prints a light of each kind, by name.
kinds() {
    cat <<END
point {"kind":"point","position":[0,2,2],"intensity":$1}
spot {"kind":"spot","position":[0,3,0],"direction":[0,-1,0],"outer":0.5,"intensity":$1}
sphere {"position":[0,2,2],"radius":0.2,"radiance":$1}
inside {"position":[0,1,0],"radius":9,"radiance":$1}
least {"position":[0.3,2,2],"radius":1e-12,"radiance":$1}
largest {"position":[0,1e17,0],"radius":1e17,"radiance":$1}
directional {"kind":"directional","direction":[0,1,0],"irradiance":$1}
cap {"kind":"cap","direction":[0,1,0],"angle":0.3,"radiance":$1}
sun {"kind":"cap","direction":[0,1,0],"angle":1e-9,"radiance":$1}
sky {"kind":"hemisphere","direction":[0,1,0],"radiance":$1,"ground":$1}
END
}

# --- lights at the limit, and beyond it -------------------------------------------------------------

kinds 1e19 >"$WORK/kinds"
{ printf '{"lights":['; cut -d' ' -f2 "$WORK/kinds" | paste -sd,; printf ']}'; } >"$WORK/all.json"
while read -r kind light; do
    printf '{"lights":[%s]}' "$light" >"$WORK/light.json"
    for method in zonal coefficients preintegrated; do
        finite "$kind" render builtin:ball --lights "$WORK/light.json" --method $method --device cpu
        ! overflows || fail "$kind: $method overflows: $(cat "$WORK/err")"
    done
    finite "$kind" reference builtin:ball --lights "$WORK/light.json" --spp 1
    ! overflows || fail "$kind: the reference overflows"
done <"$WORK/kinds"
for method in zonal coefficients preintegrated field; do
    for device in cpu gpu; do
        finite all render builtin:ball --lights "$WORK/all.json" --method $method --device $device --shadows
        ! overflows || fail "$method on $device overflows: $(cat "$WORK/err")"
    done
done
for color in 1.1e19 3e38; do
    kinds $color | while read -r kind light; do
        printf '{"lights":[%s]}' "$light" >"$WORK/light.json"
        refused "$kind" render builtin:ball --lights "$WORK/light.json"
    done
done

# --- a scene's own: punctual lights, glowing meshes with and without a map -------------------------

# scene MATERIAL LIGHT: writes a glTF triangle of a material under a light.
scene() {
    cat >"$WORK/scene.gltf" <<END
{ "asset": { "version": "2.0" }, "scenes": [ { "nodes": [ 0, 1 ] } ],
  "extensionsUsed": [ "KHR_lights_punctual", "KHR_materials_emissive_strength" ],
  "extensions": { "KHR_lights_punctual": { "lights": [ { $2 } ] } },
  "nodes": [ { "mesh": 0 }, { "translation": [ 0.2, 0.2, 1 ], "extensions": { "KHR_lights_punctual": { "light": 0 } } } ],
  "meshes": [ { "primitives": [ { "attributes": { "POSITION": 0, "TEXCOORD_0": 1 }, "material": 0 } ] } ],
  "materials": [ { $1 } ], "textures": [ { "source": 0 } ],
  "images": [ { "uri": "data:image/png;base64,$pixel" } ],
  "accessors": [ { "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [ 0, 0, 0 ], "max": [ 1, 1, 0 ] },
                 { "bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2" } ],
  "bufferViews": [ { "buffer": 0, "byteLength": 36 }, { "buffer": 0, "byteLength": 24 } ],
  "buffers": [ { "byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA" } ] }
END
}
# one white pixel
pixel=iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR42mP4//8/AAX+Av4zEpUUAAAAAElFTkSuQmCC
strength() { printf '"emissiveFactor":[1,1,1]%s,"extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":%s}}' "$2" "$1"; }
map=',"emissiveTexture":{"index":0}'
for type in point directional spot; do
    scene '"name":"plain"' "\"type\":\"$type\",\"spot\":{},\"intensity\":1e19"
    finite $type render "$WORK/scene.gltf" --device cpu
    ! overflows || fail "$type of a scene overflows"
    for intensity in 1e20 3e38; do
        scene '"name":"plain"' "\"type\":\"$type\",\"spot\":{},\"intensity\":$intensity"
        finite $type render "$WORK/scene.gltf" --device cpu
        grep -q 'left out: impossible value (1 light)' "$WORK/err" || fail "$type of $intensity: $(cat "$WORK/err")"
    done
done
for texture in '' "$map"; do
    scene "$(strength 1e19 "$texture")" '"type":"point"'
    finite glow render "$WORK/scene.gltf" --device cpu
    ! overflows || fail "a glowing mesh overflows"
    for intensity in 1e20 3e38 1e300; do
        scene "$(strength $intensity "$texture")" '"type":"point"'
        refused glow render "$WORK/scene.gltf"
    done
done

# --- surroundings, options and screenshots -----------------------------------------------------------

# surroundings EXPONENT: a .hdr of 8 x 4 pixels of 2^EXPONENT, about
surroundings() {
    printf '#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 8\n' >"$WORK/sky.hdr"
    for i in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24 25 26 27 28 29 30 31 32; do
        printf "\\200\\200\\200\\$(printf %o $(($1 + 129)))"
    done >>"$WORK/sky.hdr"
}
surroundings 62
finite sky render builtin:balls --environment "$WORK/sky.hdr" --device cpu
! overflows || fail "the surroundings overflow"
surroundings 110
refused sky render builtin:balls --environment "$WORK/sky.hdr"
surroundings 55
refused sky render builtin:balls --environment "$WORK/sky.hdr" --environment-strength 1e6
scene '"name":"plain"' '"type":"point","intensity":1e18'
refused --point-radius render "$WORK/scene.gltf" --point-radius 1e-3
refused --light reference --point 0,0,0 --normal 0,1,0 --view 0,1,0 --light 0,1,0,0.5,1e20,1,1
compare_both "$before" # the last one, if it has no other
