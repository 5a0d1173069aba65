# SPDX-License-Identifier: MIT
# One word for a thing: what stands on the left is called what stands on the right, in identifiers, options,
# help, comments and documents. Only words that mean nothing else here.
set -eu
. tests/house/common.sh

words() {
    cat <<'END'
pictures?=image
matt=matte, diffuse
graphics cards?=GPU
ladders?=stages
contestants?=benchmark case
made anew=reproduced, drawn again
one_minus=one_minus_cos
lmp_(brdf|material)_response=lmp_preintegrated_brdf
colours?=color
centres?=center
greys?=gray
lmp_parse_error \*?fault=error
[a-z_]+_fault=error, what is wrong
sound=valid
rungs?=stage
[a-z_]*share_of[a-z_]*=fraction, weight
[a-z_]*_turn(ed|s)?=rotate
(view|add|read|describe)_looks?=view_shading
[a-z_]*gather(ed|s|ing)?[a-z_]*=accumulated, response
shade_aims?=light direction
shade-(response|measured)=shade-preintegrated, shade-brdf
gpu_set_responses=gpu_set_preintegrated_brdfs
END
}

# found FOLDER: the lines under it with a word that is not ours.
found() {
    words | while IFS== read -r word instead; do
        grep -rnIiwE --exclude-dir=images --exclude=words.sh -e "$word" $1 | sed "s|\$|  <- $instead|" || true
    done
}

old=$(found "app src include shaders tests fuzz examples cmake docs dev README.md CONTRIBUTING.md CHANGELOG.md CMakeLists.txt")
[ -z "$old" ] || fail "$old"

# and one would be seen
printf 'int one_minus = 0; /* of the picture */\n' >"$WORK/planted.c"
[ "$(found "$WORK/planted.c" | wc -l)" = 2 ] || fail "an old word goes unseen"
