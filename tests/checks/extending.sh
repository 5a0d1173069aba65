# SPDX-License-Identifier: MIT
# docs/extending.md names files that exist, and values that those files have.
set -eu
. tests/checks/common.sh

# missing FILE: prints the paths between backquotes in FILE that do not exist. NAME, TOPIC and ROOM stand for the
# reader's own.
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

# has FILE WORD: fails unless FILE has the table or type that the document names.
has() {
    grep -qw "$2" "$1" || fail "$document: $1 has no $2"
}
has include/lampion/light.h lmp_light_kind
# Code that tells kinds of light apart by a switch must be named.
for file in $(git grep -l 'case LMP_LIGHT_' -- src app); do
    grep -q "$file" $document || fail "$document does not name $file, which has a case for kinds of light"
done
# Few files may know kinds of light at all: all others know the forms they are packed to.
kinds=$(sed -n '/^typedef enum lmp_light_kind/,/}/s/^ *\(LMP_LIGHT_[A-Z]*\).*/\1/p' include/lampion/light.h | paste -sd '|')
named() {
    git grep -lwE "$kinds" -- "$@"
}
files=$(named 'src/*.c' 'app/*.c' ':!app/scene/builtin') # built-in scenes have lights, and tell none apart
[ "$(echo "$files" | wc -l)" -le 9 ] || fail "more than 9 .c files name kinds of light:" $files
[ -n "$(named 'tests/oracle/kinds.h')" ] || fail "a name of a kind of light would go unseen"
has app/render/method.h method_kind
has app/render/method.c BANDS
has include/lampion/shade.h lmp_shade_method
has app/study/bench_kernels.c bench_kernels
has app/scene/material_file.c formats
has app/scene/material.c kinds
has src/kernels/kernels.h lmpi_kernels
has src/kernels/sh.h lmpi_sh_kernels
has app/image/tone.c image_tones

# These files have the trace of a section only because they use what it adds.
users='app/study/bench_inputs.c app/study/paper_frame.c app/study/paper_materials.c app/study/paper_materials_time.c app/study/paper_scenes.c app/truth/scoreboard_lampion.c
src/shade/layers.c shaders/lampion/coefficients.glsl shaders/lampion/area.glsl shaders/program/sheen.comp shaders/lampion/lampion.glsl shaders/program/paper.frag'

# unnamed FILE: prints, for each trace in FILE, the files of code that have it and that the section does not name; and
# traces that are in no file.
unnamed() {
    awk -F'`' '/^## / { heading = substr($0, 4) }
        /Trace: `/ { sub(/.*Trace: `/, "`"); print $2 "\t" heading }' "$1" |
        while IFS="$(printf '\t')" read -r trace heading; do
            section=$(awk -v heading="## $heading" '/^## / { inside = $0 == heading } inside' "$1")
            files=$(git grep -lwE "$trace" -- include src app shaders web fuzz cmake) || echo "$trace"
            for file in $files; do
                stem=$(basename "${file%.*}")
                name=${stem%_tmpl}
                case $trace in *"$name"*) own=${file%/*}/NAME${stem#"$name"}.${file##*.} ;; *) own=$file ;; esac
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
