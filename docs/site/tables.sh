#!/bin/sh
# SPDX-License-Identifier: MIT
# tables.sh BUILD [PAGE…]: writes the measured tables of the documents (or of these) anew, by the commands below.
# tables.sh --check BUILD [PAGE…]: measures them and fails where a page says anything else; where LAMPION_LONG is not
# set, those alone that take a few seconds.
#
# The line before a table names it: <!-- table: PAGE.NAME -->. Numbers may differ by a unit of their last digit and
# 2 %, or by as much as the line says: <!-- table: PAGE.NAME within 30 % -->.
set -eu
check=no
[ "$1" != --check ] || { check=yes && shift; }
build=$(realpath "$1")
shift
cd "$(dirname "$0")/../.."
[ $# -gt 0 ] || set -- accuracy areas fields ggx layers preintegration-notes shadows transfer
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# test_prints TEST FILTER: what a test prints in its long form, of those of its cases that the filter matches.
test_prints() {
    log=$work/$(basename "$1").$(echo "$2" | tr -dc a-z)
    [ -f "$log" ] || LAMPION_LONG=1 LAMPION_TEST="$2" "$build/tests/$1" >"$log" 2>&1 || { cat "$log" >&2 && exit 1; }
    cat "$log"
}

# named TABLE: of what a test printed, the table after its name.
named() {
    awk -v name="table $1" '$0 == name { on = 1; next } /^seed/ { next } !/^\|/ { on = 0 } on'
}

# paper STEP: runs a step of `lampion paper`, into $work/paper.
paper() {
    [ -d "$work/$1" ] || "$build/lampion" paper -o "$work/$1" --step "$1" >/dev/null
}

# atrium NAME OPTION…: draws the atrium of the page on shadows as $work/NAME.exr, once.
atrium() {
    atrium_image=$work/$1.exr
    shift
    [ -f "$atrium_image" ] || "$build/lampion" render builtin:atrium --bands 8 -q "$@" -o "$atrium_image"
}

# atrium_error NAME TRUTH DIGITS: the relative error of one of these images.
atrium_error() {
    "$build/lampion" compare --json "$work/$1.exr" "$work/$2.exr" | sed 's/.*"relmse": //' | awk -v form="%.$3f" '{ printf form, $1 }'
}

# lobe_bounds: of the step's table, a line a bound with the numbers of 10, 20 and 100 bands.
lobe_bounds() {
    awk -F, '
        NR > 1 && !($2 in seen) { seen[$2]; bound[++bounds] = $2 }
        NR > 1 { cells[$2] = cells[$2] sprintf(" %.0f | %.2g | %.2g |", $3, $4, $5) }
        END {
            print "| bound asked for | 10 bands | | | 20 bands | | | 100 bands | | |"
            print "|---|---|---|---|---|---|---|---|---|---|"
            print "| | KB | max % | rms % | KB | max % | rms % | KB | max % | rms % |"
            for (i = 1; i <= bounds; i++)
                print "| " bound[i] " %" (bound[i] == 0.5 ? " (default)" : "") " |" cells[bound[i]]
        }'
}

# material_errors: errors of preintegrated BRDFs, by the same test.
material_errors() {
    LAMPION_LONG=1 LAMPION_TEST='ten_materials*' "$build/tests/unit/test_unit_preintegrated_brdf" >"$work/materials" 2>&1 ||
        { cat "$work/materials" >&2 && exit 1; }
    printf '| material, 10 bands | MB | max %% | rms %% |\n|---|---|---|---|\n'
    sed -n 's/^\([a-z-]*\), [0-9]* bands, .*: \([0-9.]*\) MB, .* max \([0-9.]*\) %, rms \([0-9.]*\) %$/\1 \2 \3 \4/p' "$work/materials" |
        awk '{ printf "| sgd:%s | %.1f | %.2f | %.3f |\n", $1, $2, $3, $4 }'
}

# shadow_rays: errors of frames of one sample by rays per pixel, unfiltered and filtered.
shadow_rays() {
    atrium truth --size 660x332 --samples 1 --shadow-rays 1024 --no-shadow-filter
    printf '| rays per pixel | unfiltered | filtered |\n|---|---|---|\n'
    for rays in 1 2 4 8 16; do
        atrium noisy-$rays --size 660x332 --samples 1 --shadow-rays $rays --no-shadow-filter
        atrium even-$rays --size 660x332 --samples 1 --shadow-rays $rays
        echo "| $rays | $(atrium_error noisy-$rays truth 3) | $(atrium_error even-$rays truth 3) |"
    done
}

# shadow_samples: errors of images of eight samples.
shadow_samples() {
    atrium truth-8 --size 495x249 --samples 8 --shadow-rays 128 --no-shadow-filter
    printf '| 495 x 249 | relative error |\n|---|---|\n'
    atrium default-8 --size 495x249 --samples 8
    atrium sparse-8 --size 495x249 --samples 8 --shadow-sparse
    echo "| default | $(atrium_error default-8 truth-8 4) |"
    echo "| \`--shadow-sparse\` | $(atrium_error sparse-8 truth-8 4) |"
}

# measure TABLE: prints it.
measure() {
    case $1 in
    accuracy.zonal)
        paper cap
        tr -d '"' <"$work/cap/accuracy.csv" | sed 's/printed, \([0-9]*,\)/\1/g; s/library, \([0-9]*,\)/\1/g; s/library, 128/128/; s/Sloan, 3 bands/Sloan, 3/
            s/Sloan, 6/6/; s/library, 3 bands/library, 3/; s/,\([^ ]\)/ | \1/g; s/.*/| & |/; 1p; 1s/[^|]*|/---|/2g; 1s/^|[^|]*/|---/'
        ;;
    accuracy.cost)
        paper cost
        awk -F, '
            $4 == "none" || $4 == "Hanning" { error[$1, $2, $3, $4] = $5; low[$1, $2, $3, $4] = $6; peak[$1, $2, $3, $4] = $7 }
            NR > 1 && !(($1, $2) in seen) { seen[$1, $2]; row[++rows] = $1 SUBSEP $2 }
            function pair(of, row, bands) { return " " of[row, bands, "none"] " / " of[row, bands, "Hanning"] " |" }
            END {
                print "| exponent | r/d | error, 5 bands | 10 bands | 20 bands | lowest value, 10 bands | peak, 10 bands |"
                print "|---|---|---|---|---|---|---|"
                for (i = 1; i <= rows; i++) {
                    split(row[i], key, SUBSEP)
                    print "| " key[1] " | " key[2] " |" pair(error, row[i], 5) pair(error, row[i], 10) \
                        pair(error, row[i], 20) pair(low, row[i], 10) pair(peak, row[i], 10)
                }
            }' "$work/cost/cost.csv"
        ;;
    accuracy.bands) test_prints unit/test_unit_accuracy 'errors_grow*' | named "$1" ;;
    accuracy.surface) test_prints unit/test_unit_accuracy 'the_last_digits*' | named "$1" ;;
    areas.bent) test_prints program/test_program_mesh_lights 'more_lights*' | named "$1" ;;
    areas.plates) test_prints unit/test_unit_area_plates 'plates_under*' | named "$1" ;;
    fields.error) test_prints unit/test_unit_field_error '*reach*' | named "$1" ;;
    preintegration-notes.lobes)
        paper preintegrated
        lobe_bounds <"$work/preintegrated/preintegrated.csv"
        ;;
    preintegration-notes.materials) material_errors ;;
    shadows.rays) shadow_rays ;;
    shadows.samples) shadow_samples ;;
    transfer.reading) test_prints unit/test_unit_transfer_room 'links_err*' | named "$1" ;;
    transfer.iterations) test_prints unit/test_unit_transfer_room 'iterations_add*' | named "$1" ;;
    layers.sheen) test_prints unit/test_unit_brdf_sheen 'bands_come*' | named "$1" ;;
    ggx.*) test_prints unit/test_unit_ggx_lobes "$(
        case $1 in
        ggx.caps) echo 'lobes_follow_ggx_around*' ;;
        ggx.plates) echo 'plates_look*' ;;
        ggx.energy) echo 'a_white_metal*' ;;
        ggx.grazing) echo 'plates_of_all*' ;;
        esac
    )" | named "$1" ;;
    *) echo "tables.sh: nothing measures $1" >&2 && return 1 ;;
    esac
}

# is_quick TABLE: takes no more than a few seconds.
is_quick() {
    case $1 in
    areas.bent | layers.sheen | ggx.energy | preintegration-notes.lobes | transfer.*) ;;
    *) return 1 ;;
    esac
}

# compare PERCENT SAID MEASURED: fails, with both lines, where they differ by more.
compare() {
    paste -d '\n' "$2" "$3" | awk -v percent="$1" '
        # the words of a line without its numbers, and these in number[of, 1 …]; a unit of their last digit in unit[…]
        function words(line, of,    text, count, token, digits) {
            text = ""
            count = 0
            while (match(line, /-?[0-9]+(\.[0-9]+)?(e[-+]?[0-9]+)?/)) {
                token = substr(line, RSTART, RLENGTH)
                text = text substr(line, 1, RSTART - 1) "#"
                line = substr(line, RSTART + RLENGTH)
                number[of, ++count] = token + 0
                digits = token
                sub(/e.*/, "", digits)
                if (!sub(/.*\./, "", digits))
                    digits = ""
                unit[of, count] = 10 ^ (-length(digits) + (match(token, /e/) ? substr(token, RSTART + 1) : 0))
            }
            numbers[of] = count
            gsub(/[ *]+/, " ", text)
            return text line
        }
        function size(x) { return x < 0 ? -x : x }
        NR % 2 { said = $0; next }
        {
            bad = words(said, 1) != words($0, 2)
            for (i = 1; i <= numbers[1] && !bad; i++) {
                most = size(number[1, i]) > size(number[2, i]) ? size(number[1, i]) : size(number[2, i])
                if (!(size(number[1, i] - number[2, i]) <= 1.001 * unit[1, i] + percent / 100 * most))
                    bad = 1
            }
            if (bad) {
                print "the page says " said
                print "measured      " $0
                wrong = 1
            }
        }
        END { exit wrong }'
}

# one TABLE PERCENT PAGE: measures it, and checks or replaces what the page has.
one() {
    [ $check = yes ] || echo "tables: measuring $1" >&2
    awk -v name="<!-- table: $1" 'index($0, name " ") == 1 { on = 1; next } on && !/^\|/ { exit } on' "$3" >"$work/said"
    measure "$1" >"$work/measured"
    [ -s "$work/measured" ] || { echo "tables.sh: $1 is empty" >&2 && return 1; }
    if [ $check = yes ]; then
        compare "$2" "$work/said" "$work/measured" || { echo "tables.sh: $1 of $3 is not what is measured" >&2 && return 1; }
    else
        awk -v name="<!-- table: $1" -v from="$work/measured" '
            on && /^\|/ { next }
            { on = 0; print }
            index($0, name " ") == 1 { on = 1; while ((getline line < from) > 0) print line }' "$3" >"$work/page"
        cat "$work/page" >"$3"
    fi
}

failed=0
for page in "$@"; do
    file=docs/$page.md
    sed -n 's/^<!-- table: \([a-z.-]*\) -->$/\1 2/p; s/^<!-- table: \([a-z.-]*\) within \([0-9]*\) % -->$/\1 \2/p' "$file" >"$work/tables"
    [ "$(grep -c '^<!-- table' "$file")" = "$(wc -l <"$work/tables")" ] && [ -s "$work/tables" ] ||
        { echo "tables.sh: $file has no tables, or lines that are not understood" >&2 && exit 1; }
    while read -r table percent; do
        if [ $check = yes ] && [ -z "${LAMPION_LONG:-}" ] && ! is_quick "$table"; then
            echo "$table: in the long form"
        elif one "$table" "$percent" "$file"; then
            echo "$table: ok"
        else
            failed=1
        fi
    done <"$work/tables"
done
exit $failed
