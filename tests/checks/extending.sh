# SPDX-License-Identifier: MIT
# docs/extending.md names files that exist, and values that those files have.
set -eu
. tests/checks/common.sh

# missing FILE: the paths between backquotes in FILE that are not there. NAME, TOPIC and ROOM stand for
# the reader's own.
missing() {
    grep -o '`[^` ]*/[^` ]*`' "$1" | tr -d '`' | grep -v 'NAME\|TOPIC\|ROOM' | sort -u | while read -r path; do
        [ -e "$path" ] || echo "$path"
    done
}

document=docs/extending.md
found=$(missing $document)
[ -z "$found" ] || fail "$document names what is not there: $found"
[ "$(wc -w <$document)" -le 1600 ] || fail "$document is longer than 1600 words"

sed 's,`src/sh/window.c`,`src/sh/gone.c`,' $document >"$WORK/changed.md"
[ "$(missing "$WORK/changed.md")" = src/sh/gone.c ] || fail "a file that is gone would go unseen"

# has FILE WORD: what the document calls a table or a type is there.
has() {
    grep -qw "$2" "$1" || fail "$document: $1 has no $2"
}
has include/lampion/light.h lmp_light_kind
# What tells kinds of light apart by a switch is named.
for file in $(git grep -l 'case LMP_LIGHT_' -- src app); do
    grep -q "$file" $document || fail "$document does not name $file, which has a case for kinds of light"
done
has app/method/method.h method_kind
has app/method/method.c BANDS
has include/lampion/shade.h lmp_shade_method
has app/bench/kernels.c bench_kernels
has app/material/file.c formats
has app/material/material.c kinds
has src/kernels/kernels.h lmp_kernels
has app/image/tone.c image_tones
