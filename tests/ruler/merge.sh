# SPDX-License-Identifier: MIT
# Parts of a reference are joined to the image of one run, and parts of others are refused.
set -eu
. tests/checks/common.sh

cd "$WORK"
set -- builtin:balls --size 32x20 --spp 10 --shadows
"$PROGRAM" reference "$@" -o whole.exr
for part in 1 2 3; do
    "$PROGRAM" reference "$@" --shard $part/3 --output "$part.exr" --threads $part
done
"$PROGRAM" merge 2.exr 1.exr 3.exr -o all.exr
"$PROGRAM" compare all.exr whole.exr --fail-above rmse=1e-6 >/dev/null || fail "the parts are not the whole"
! "$PROGRAM" compare 1.exr whole.exr --fail-above rmse=1e-4 >/dev/null || fail "a part is the whole already"

# refuse TEXT COMMAND…: the command must fail with one line that contains TEXT.
refuse() {
    text=$1
    shift
    status=0
    line=$("$PROGRAM" "$@" 2>&1) || status=$?
    [ $status != 0 ] || fail "$*: is taken"
    case $line in *"$text"*) ;; *) fail "$*: $line" ;; esac
}
"$PROGRAM" reference "$@" --shard 2/3 --noise-seed 2 -o seed.exr
"$PROGRAM" reference "$@" --shard 2/4 -oquarter.exr
"$PROGRAM" reference builtin:atrium --size 32x20 --spp 10 --shadows --shard 2/3 -o scene.exr
refuse 'seed.exr: is of another scene or other settings than 1.exr' merge 1.exr seed.exr -o bad.exr
refuse 'quarter.exr: is of another scene' merge 1.exr quarter.exr -o bad.exr
refuse 'scene.exr: is of another scene' merge 1.exr scene.exr -o bad.exr
refuse 'part 2 of 3 is missing (--partial joins the others)' merge 3.exr 1.exr -o bad.exr
refuse '1.exr: is part 1 of 3, as 1.exr is' merge 1.exr 1.exr -o bad.exr
refuse 'whole.exr: has no layer "run"' merge whole.exr -o bad.exr
refuse 'expected the parts' merge -o bad.exr
refuse 'is not a .exr file' merge 1.exr -o bad.png
# The words are the same, but name another file.
"$PROGRAM" brdf bake lambert:0.2 --bands 4 --views 4 -o paint.lmpt
"$PROGRAM" reference "$@" --material 'plastic 1.00=paint.lmpt' --shard 1/2 -o paint1.exr
"$PROGRAM" brdf bake lambert:0.9 --bands 4 --views 4 -o paint.lmpt
"$PROGRAM" reference "$@" --material 'plastic 1.00=paint.lmpt' --shard 2/2 -o paint2.exr
refuse "paint2.exr: is of another scene or other settings" merge paint1.exr paint2.exr -o bad.exr
refuse 'has no sample' reference "$@" --shard 11/11 -o bad.exr
refuse '--shard writes .exr' reference "$@" --shard 1/2 -o bad.png
refuse '--shard writes .exr' reference "$@" --shard 1/2 --bands 5 -o bad.exr

# Two parts of three are an image of fewer samples, noisier than the whole.
"$PROGRAM" merge --partial 3.exr 1.exr -o two.exr
"$PROGRAM" compare two.exr whole.exr --fail-above relmse=0.1 >/dev/null || fail "two parts are another image"
! "$PROGRAM" compare two.exr whole.exr --fail-above rmse=1e-4 >/dev/null || fail "two parts are the whole"
[ ! -e bad.exr ] || fail "something was written"
