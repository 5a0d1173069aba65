# SPDX-License-Identifier: MIT
# One spelling, and one name for a thing in the code: what stands on the left is called what stands on the right. Prose may use
# any plain English.
set -eu
. tests/checks/common.sh

words() {
    cat <<'END'
matt=matte
colours?=color
centres?=center
greys?=gray
one_minus=one_minus_cos
lmp_parse_error \*?(fault|wrong)=error
[a-z_]+_fault=error
[a-z]+_gather(ed|s|ing)?[a-z_]*=accumulated, response
lmp_(brdf|material)_response=lmp_preintegrated_brdf
measured_materials_[a-z_]+=tabulated
[a-z_]*share_of[a-z_]*=fraction, weight
(int|size_t|float|double|char|lmp_vec3|vec[234]) \*?(const )?places?=position, index, offset
(find|chunk|lmp_ggx|surfaces?)_places?=position, index, offset
[a-z_]+_turn(ed|s)?=rotate
(int|void|float|double|lmp_quat) turn=rotate, rotation
shade_aims?=light direction
[a-z_]*tabulated_aim=orient
(view|add|read|describe)_looks?=view_shading
shade-(response|measured)=shade-preintegrated, shade-brdf
gpu_set_responses=gpu_set_preintegrated_brdfs
(lmpi_)?sights?(_[a-z]+)?=subtended, hit
(lmpi_shade_)?overs=layer_mask
(gpu|render|renderer|override|shade|draw)_([a-z]+_)*fibers(_[a-z]+)?=sheen
[a-z_]+_left_out(_[a-z]+)?=unsupported, skipped
[a-z_]*wishes=requests
(view|has|compositor)_drafts?(_[a-z]+)?=preview
settle_[a-z]+=choose, resolve, prepare
[a-z]+_reflectors?=material_constants
frame(\.|->)host=cpu_shader
END
}

# found FOLDER: prints the lines under it with such a name.
found() {
    words | while IFS== read -r word instead; do
        grep -rnIiwE --exclude-dir=images --exclude-dir=node_modules --exclude=words.sh -e "$word" $1 | sed "s|\$|  <- $instead|" || true
    done
}

old=$(found "app src include shaders tests fuzz examples python cmake docs dev README.md CONTRIBUTING.md CHANGELOG.md CMakeLists.txt")
[ -z "$old" ] || fail "$old"

# A planted name must be found.
printf 'int one_minus = 0; /* of the colour */\n' >"$WORK/planted.c"
[ "$(found "$WORK/planted.c" | wc -l)" = 2 ] || fail "an old name goes unseen"
