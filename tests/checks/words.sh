# SPDX-License-Identifier: MIT
# One word for a thing: what stands on the left is called what stands on the right, in identifiers, options,
# help, comments and documents. Only words that mean nothing else here, or what stands around those that do.
set -eu
. tests/checks/common.sh

words() {
    cat <<'END'
pictures?=image
matt=matte, diffuse
graphics cards?=GPU
processors=CPU, core
the processor=CPU, core
ladders?=stages
rungs?=stage
house=checks
contestants?=benchmark case
made anew=reproduced, drawn again
one_minus=one_minus_cos
colours?=color
centres?=center
greys?=gray
sound=valid
lmp_parse_error \*?(fault|wrong)=error
[a-z_]+_fault=error, what is wrong
answer(s|ed|ing)?=response, reply
[a-z_]*gather(ed|s|ing)?[a-z_]*=accumulated, response
heaps?=allocator
lmp_(brdf|material)_response=lmp_preintegrated_brdf
(measured|several|two|of) responses=preintegrated lobes, BRDFs
measured_materials_[a-z_]+=tabulated
(sharp|broad) lobes?=narrow, specular; wide, diffuse
cut(s|ting)? (lobes?|series|(the )?materials?)=truncate
(lobes?|series|materials?|exponent [0-9]+) cut (at|to)=truncated
[a-z_]*share_of[a-z_]*=fraction, weight
(float|double|an?|the|its|their|per|each) shares?=fraction, weight
(int|size_t|float|double|char|lmp_vec3|vec[234]) \*?(const )?places?=position, index, offset
(a|one|each|every|finite|their|odd) places? (that|of|at|in|along|after)=position, index, offset
(find|chunk|lmp_ggx|surfaces?)_places?=position, index, offset
(light|cap|alike|same) from all around=ambient, from every point
light all around=ambient
[a-z_]*_turn(ed|s)?=rotate
turned=rotated
(int|void|float|double|lmp_quat) turn=rotate, rotation
material slots?=material name
(axis|lobe|look|cap|goes|runs) round=around
numbered (images|frames)=image sequence
warp(s|ed)?=remap
shade_aims?=light direction
[a-z_]*tabulated_aim=orient
error by window=windowing filter
(view|add|read|describe)_looks?=view_shading
shade-(response|measured)=shade-preintegrated, shade-brdf
gpu_set_responses=gpu_set_preintegrated_brdfs
END
}

# found FOLDER: the lines under it with a word that is not ours.
found() {
    words | while IFS== read -r word instead; do
        grep -rnIiwE --exclude-dir=images --exclude-dir=node_modules --exclude=words.sh -e "$word" $1 | sed "s|\$|  <- $instead|" || true
    done
}

old=$(found "app src include shaders tests fuzz examples cmake docs dev README.md CONTRIBUTING.md CHANGELOG.md CMakeLists.txt")
[ -z "$old" ] || fail "$old"

# and one would be seen
printf 'int one_minus = 0; /* of the picture */\n' >"$WORK/planted.c"
[ "$(found "$WORK/planted.c" | wc -l)" = 2 ] || fail "an old word goes unseen"
