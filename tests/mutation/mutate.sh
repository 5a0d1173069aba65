# SPDX-License-Identifier: MIT
# sh tests/mutation/mutate.sh [COUNT [FOLDER]]: whether the tests notice COUNT small changes (by default 40) of those
# that mutants.awk makes of the files below, or of those in FOLDER alone. Which are drawn depends on their text, so
# that a draw stays nearly the same while the sources grow. Works on a copy of the tree in build/mutation; prints the
# survivors, as FILE:LINE:COLUMN: THE CHANGED LINE, and the score. Survivors are tried once more by programs with
# sanitizers, which see reads and writes past an end. Many change nothing that could be seen: those that leave the
# compiled tests as they were are counted apart, as the same, and those of equivalent.txt (file, changed line and why
# nothing differs, between tabs) as equivalent. build/mutation/results has what is judged so far: a stopped run goes on
# from there, and what is taken out of it is judged again.
set -eu
cd "$(dirname "$0")/../.."
count=${1:-40} folder=${2:-}
work=$PWD/build/mutation
tree=$work/tree results=$work/results log=$work/log

# What is changed, and the tests that should notice, the quickest first; the first row that names a file counts.
# Tables that programs wrote stay as they are: a test of their own compares them with what their generator writes.
subjects() {
    while read -r pattern tests; do
        for file in $pattern; do
            [ -f "$file" ] || { echo "mutate: there is no $pattern" >&2; continue; }
            case $file in
            *_table.c | src/base/tables.c) ;;
            "$folder"*) echo "$file $tests" ;;
            esac
        done
    done <<'END' | awk '!seen[$1]++'
src/base/*.c unit.base unit.host unit.sh
src/sh/double.c unit.double
src/sh/euler.c unit.rotation unit.assertions
src/sh/half.c unit.half unit.assertions
src/sh/image.c unit.image unit.assertions
src/sh/product.c unit.product unit.assertions
src/sh/project.c unit.project unit.assertions
src/sh/quadrature.c unit.project unit.assertions
src/sh/rotation.c unit.rotation unit.assertions
src/sh/window.c unit.window unit.assertions
src/sh/*.c unit.sh unit.assertions
src/sphere/double.c unit.double
src/sphere/*.c unit.sphere unit.edges unit.assertions
src/light/flat.c unit.area_shade unit.assertions
src/light/gradient.c unit.light_gradient unit.assertions
src/light/loop_gradient.c unit.light_gradient unit.assertions
src/light/light_n.c unit.light_n unit.light unit.assertions
src/light/*.c unit.light unit.area unit.light_gradient unit.sphere unit.edges unit.assertions
src/lobe/*.c unit.lobe unit.ggx_lobes unit.assertions
src/probe/irradiance.c unit.irradiance unit.probe unit.probe_engines unit.assertions
src/probe/*.c unit.probe unit.probe_engines unit.peers unit.peers_engines unit.assertions
src/shade/area.c unit.area_shade unit.assertions
src/shade/*.c unit.shade unit.shade_n unit.coat unit.sheen unit.environment unit.assertions
src/field/*.c unit.field_bytes unit.field unit.field_changes unit.field_shade unit.assertions
src/preintegrated/brdf*.c unit.preintegrated_brdf unit.preintegrated_brdf_bytes unit.assertions
src/preintegrated/*.c unit.preintegrated_lobe unit.assertions
src/brdf/rgl*.c unit.brdf_rgl unit.brdf_rgl_written unit.brdf_rgl_refusals unit.read_back unit.assertions
src/brdf/sheen.c unit.brdf_sheen unit.assertions
src/brdf/*.c unit.brdf_table_bytes unit.brdf unit.brdf_table unit.brdf_files unit.assertions
src/transfer/*.c unit.transfer unit.transfer_refused unit.transfer_room unit.assertions
src/kernels/*.h kernels.kernels kernels.batch
app/scene/trace/blend.c program.blend
app/scene/trace/trace.c program.trace reference.estimator reference.render reference.texture
app/scene/texture_at.c reference.texture reference.estimate
app/scene/trace/*.c program.trace program.instances reference.texture reference.estimate
app/truth/reference_part.c reference.part
app/truth/reference_sheen.c reference.sheen
app/truth/reference_ggx.c reference.ggx reference.layers
app/truth/reference_*.c reference.estimator reference.texture reference.kinds reference.environment reference.ggx reference.estimate reference.render
app/image/compare.c reference.compare
app/image/flip.c reference.compare
app/image/ssim.c reference.compare
app/render/shadow/around.c program.around gpu.shadow
app/render/shadow/batch.c program.shadow_batch gpu.shadow
app/render/shadow/transfer*.c reference.bounced
app/render/shadow/*.c program.shadow gpu.shadow gpu.shadow_filter
app/render/shade*.c gpu.table gpu.field gpu.shade gpu.draw
app/render/gl/table.c gpu.table gpu.draw
app/render/gl/environment.c gpu.devices
app/render/gl/zonal.c gpu.devices
app/render/gl/screen.c gpu.screen
app/render/gl/*.c gpu.table gpu.edges gpu.draw gpu.plate gpu.shadow gpu.shade gpu.devices
shaders/program/table.glsl gpu.table
shaders/program/environment.glsl gpu.devices gpu.table
shaders/program/field.glsl gpu.field
shaders/*/*.glsl gpu.glsl gpu.table gpu.draw gpu.plate gpu.shade gpu.devices
shaders/program/*.comp gpu.draw gpu.shade
shaders/program/compose.frag gpu.screen
shaders/program/screen.vert gpu.screen gpu.draw
shaders/program/*.frag gpu.draw gpu.plate reference.layers
shaders/program/*.vert gpu.draw gpu.plate
END
}

# Only what differs is copied: an old time on a file that was put back would leave its mutant's object in the build.
git ls-files | while read -r file; do
    cmp -s "$file" "$tree/$file" && continue
    mkdir -p "$tree/$(dirname "$file")"
    cp -P "$file" "$tree/$file"
done
touch "$results"
target() { echo "test_$1" | tr . _; }
# make BUILD TEST…: builds their programs.
make() {
    build=$1
    shift
    timeout 600 cmake --build "$build" --target $(for test; do target "$test"; done) >"$log" 2>&1
}

# prepare BUILD SANITIZERS TEST…: records each test's program without a change, that it passes, and how long it may run.
prepare() {
    build=$1 sanitizers=$2
    shift 2
    # One instruction set compiles in a third of the time and gives the same bits; assertions stay in.
    cmake -G Ninja -S "$tree" -B "$build" -DCMAKE_BUILD_TYPE=Release -DCMAKE_C_FLAGS_RELEASE=-O2 -DLAMPION_SIMD=OFF \
        -DLAMPION_SANITIZE="$sanitizers" >"$log" 2>&1 || { tail -n 20 "$log"; exit 1; }
    timeout 3600 cmake --build "$build" --target $(for test; do target "$test"; done) >"$log" 2>&1 ||
        { tail -n 20 "$log"; exit 1; }
    : >"$build.programs"
    for test; do
        began=$(date +%s)
        ctest --test-dir "$build" -R "^$test(\.[a-z.]*)?\$" >"$log" 2>&1 || { tail -n 20 "$log"; exit 1; }
        program=$(find "$build/tests" -name "$(target "$test")" -type f)
        echo "$test $program $(cksum <"$program" | tr ' ' _) $((20 + 5 * ($(date +%s) - began)))" >>"$build.programs"
    done
}

# result_of BUILD TEST…: judges the change in place. A program that is the same as before has nothing to notice.
result_of() {
    build=$1 result=same
    shift
    for test; do
        make "$build" "$test" || { echo invalid; return; }
        read -r name program sum limit <<END
$(grep "^$test " "$build.programs")
END
        [ "$(cksum <"$program" | tr ' ' _)" != "$sum" ] || continue
        result=survived
        ctest --test-dir "$build" -R "^$name(\.[a-z.]*)?\$" --timeout "$limit" >"$log" 2>&1 || { echo "killed by $name"; return; }
    done
    echo "$result"
}

tab=$(printf '\t')
# judge BUILD: judges each mutant of the input, and adds it to the results.
judge() {
    while IFS=$tab read -r file line column length text tests; do
        awk -v line="$line" -v column="$column" -v length_="$length" -v text="$text" '
            NR == line { $0 = substr($0, 1, column - 1) text substr($0, column + length_) } { print }' \
            "$file" >"$tree/$file"
        changed=$(sed -n "${line}s/^ *//p" "$tree/$file")
        if grep -qF "$file$tab$changed$tab" tests/mutation/equivalent.txt; then
            result=equivalent
        else
            result=$(result_of "$1" $tests </dev/null)
        fi
        printf '%s: %s\n' "$result" "$file:$line:$column: $changed"
        cp "$file" "$tree/$file"
    done
}

# with RESULT: prints the drawn mutants whose results begin so; without RESULT those that have none yet.
with() {
    awk -F '\t' -v wanted="$1" '
        FILENAME == ARGV[1] { at = index($0, ": "); split(substr($0, at + 2), place, ": "); result[place[1]] = substr($0, 1, at - 1); next }
        { place[1] = $1 ":" $2 ":" $3 }
        wanted == "" ? !(place[1] in result) : index(result[place[1]], wanted) == 1' "$results" "$work/drawn"
}

subjects | while read -r file tests; do
    awk -f tests/mutation/mutants.awk "$file" | awk -v file="$file" -v tests="$tests" -f tests/mutation/draw.awk - "$file"
done >"$work/all"
sort -n "$work/all" | head -n "$count" | cut -f2- | LC_ALL=C sort >"$work/drawn"

with '' >"$work/left"
prepare "$work/build" '' $(cut -f6 "$work/left" | tr ' ' '\n' | sort -u)
judge "$work/build" <"$work/left" >>"$results"
with survived >"$work/left"
if [ -s "$work/left" ]; then
    export ASAN_OPTIONS=detect_leaks=0 # drivers leak
    prepare "$work/sanitized" address,undefined $(cut -f6 "$work/left" | tr ' ' '\n' | sort -u)
    judge "$work/sanitized" <"$work/left" | sed 's/^same: /survived: /; s/^killed by /&sanitized /' >"$results.sanitized"
    grep -v '^survived' "$results" >"$results.new" || true
    cat "$results.sanitized" >>"$results.new"
    mv "$results.new" "$results"
fi

grep '^survived' "$results" || true
for result in killed survived equivalent same invalid; do
    printf '%s %s  ' "$(with $result | wc -l)" $result
done
echo "of $count drawn from $(wc -l <"$work/all")"
