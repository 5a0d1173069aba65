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
[ "$(wc -w <$document)" -le 1700 ] || fail "$document is longer than 1700 words"

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
# And few files know kinds of light at all: all others know the forms they are packed to.
named() {
    git grep -lwE 'LMP_LIGHT_(SPHERE|POINT|SPOT|DIRECTIONAL|CAP|HEMISPHERE)' -- "$@"
}
files=$(named 'src/*.c' 'app/*.c')
[ "$(echo "$files" | wc -l)" -le 8 ] || fail "more than 8 .c files name kinds of light:" $files
[ -n "$(named 'tests/oracle/kinds.h')" ] || fail "a name of a kind of light would go unseen"
kinds=$(sed -n '/^typedef enum lmp_light_kind/,/}/p' include/lampion/light.h | grep -c '^ *LMP_LIGHT_')
[ "$kinds" -eq 6 ] || fail "a kind of light is not looked for"
has app/method/method.h method_kind
has app/method/method.c BANDS
has include/lampion/shade.h lmp_shade_method
has app/bench/kernels.c bench_kernels
has app/material/file.c formats
has app/material/material.c kinds
has src/kernels/kernels.h lmp_kernels
has app/image/tone.c image_tones

# Files of code that have the trace of a section only because they use what it adds.
users='app/bench/inputs.c app/paper/frame.c app/paper/materials.c app/paper/materials_time.c app/paper/scenes.c app/scoreboard/lampion.c
src/shade/layers.c shaders/coefficients.glsl shaders/fibers.comp shaders/lampion.glsl shaders/paper.frag'

# unnamed FILE: for each trace in FILE, the files of code that have it, where the section does not
# name them; traces that are in no file.
unnamed() {
    awk -F'`' '/^## / { heading = substr($0, 4) }
        /Trace: `/ { sub(/.*Trace: `/, "`"); print $2 "\t" heading }' "$1" |
        while IFS="$(printf '\t')" read -r trace heading; do
            section=$(awk -v heading="## $heading" '/^## / { inside = $0 == heading } inside' "$1")
            files=$(git grep -lwE "$trace" -- include src app shaders web fuzz cmake) || echo "$trace"
            for file in $files; do
                stem=$(basename "${file%.*}")
                case $trace in *"$stem"*) own=${file%/*}/NAME.${file##*.} ;; *) own=$file ;; esac
                case " $(echo $users) " in *" $file "*) continue ;; esac
                case $section in
                *"\`$file\`"* | *"\`${file##*/}\`"* | *"\`$own\`"*) ;;
                *) echo "$heading: $file" ;;
                esac
            done
        done
}

found=$(unnamed $document)
[ -z "$found" ] || fail "$document does not name what its traces find:
$found"
sed 's,`src/sh/window.c`,`src/sh/gone.c`,' $document >"$WORK/changed.md"
[ "$(unnamed "$WORK/changed.md")" = 'A windowing filter: src/sh/window.c' ] || fail "an unnamed file would go unseen"
