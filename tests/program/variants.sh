# SPDX-License-Identifier: MIT
# --variant: every command that reads a scene shows the variant of its materials that is wanted.
set -eu
. tests/checks/common.sh
export XDG_CACHE_HOME="$WORK/cache"
cd "$WORK"
own_scene plain.gltf

# The scene has a second material, black and glowing with 1, and a variant that shows it.
mapping='"KHR_materials_variants": { "mappings": [ { "material": 0, "variants": [ 1 ] } ] }'
names='"KHR_materials_variants": { "variants": [ { "name": "day" }, { "name": "night" } ] }'
lamp='{ "name": "lamp", "emissiveFactor": [1, 1, 1], "pbrMetallicRoughness": { "baseColorFactor": [0, 0, 0, 1] } }'
sed -e "s/\"materials\": \\[/&$lamp,/" -e "s/\"material\": 0/\"material\": 1, \"extensions\": { $mapping }/" \
    -e "s/{ \"asset\"/{ \"extensions\": { $names }, \"asset\"/" plain.gltf >scene.gltf

"$PROGRAM" info scene.gltf | grep -qx 'variants   2: day, night' || fail "info does not list the variants"
"$PROGRAM" info --json scene.gltf | tr -d ' \n\t' | grep -qF '"variants":["day","night"]' || fail "nor as JSON"
! "$PROGRAM" info plain.gltf | grep -q variants || fail "info lists variants where there are none"

# At night each pixel of the triangle has a radiance of 1; by day, without a light, of 0.
view='--size 8x8 --eye 0,1,0 --target 0,0,0'
for variant in day night; do
    "$PROGRAM" render scene.gltf --variant $variant --hide-lights --environment none $view -o $variant.exr
    "$PROGRAM" reference scene.gltf --variant $variant --hide-lights --environment none $view --spp 4 -o r-$variant.exr
    "$PROGRAM" compare $variant.exr r-$variant.exr --fail-above max=1e-3 || fail "$variant: reference differs"
done
! "$PROGRAM" compare day.exr night.exr --fail-above max=0.9 || fail "the variant is not shown"
"$PROGRAM" field scene.gltf --variant night --grid 2x2x2 --bands 2 -o night.json
! "$PROGRAM" field scene.gltf --variant noon --grid 2x2x2 --bands 2 -o noon.json 2>noon.log || fail "field takes any variant"
grep -q night noon.log || fail "field does not say which variants there are: $(cat noon.log)"
"$PROGRAM" render scene.gltf --variant noon $view -o noon.png 2>errors && fail "an unknown variant is drawn"
[ "$(cat errors)" = 'lampion: scene.gltf: no such variant: "noon" is not one of day, night' ] || fail "$(cat errors)"
[ ! -e noon.png ] || fail "an image of an unknown variant is there"
