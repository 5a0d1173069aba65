# SPDX-License-Identifier: MIT
# sh tests/mutation/mutate.sh [COUNT [FOLDER]]: whether the tests notice COUNT small changes (by default 40), drawn
# evenly from those that mutants.awk makes of the files below, or of those in FOLDER alone. Works on a copy of the
# tree in build/mutation; prints the survivors, as FILE:LINE:COLUMN: THE CHANGED LINE, and the score. Many survivors
# change nothing that could be seen: those that leave the compiled tests as they were are counted apart, as the same,
# and those of equivalent.txt (file, changed line and why nothing differs, between tabs) as equivalent.
# build/mutation/build.results has the verdicts so far, and a stopped run goes on from there.
set -eu
cd "$(dirname "$0")/../.."
count=${1:-40} folder=${2:-}
tree=$PWD/build/mutation/tree
build=$PWD/build/mutation/build

# What is changed, and the tests that should notice, the quickest first; the first row that names a file counts.
# Tables that programs wrote stay as they are: a test of their own compares them with what their generator writes.
subjects() {
    while read -r pattern tests; do
        for file in $pattern; do
            case $file in
            *_table.c | src/base/tables.c) ;;
            "$folder"*) echo "$file $tests" ;;
            esac
        done
    done <<'END' | awk '!seen[$1]++'
src/base/*.c unit.base unit.host unit.sh
src/sh/double.c unit.double
src/sh/image.c unit.image unit.assertions
src/sh/product.c unit.product unit.assertions
src/sh/project.c unit.project unit.assertions
src/sh/quadrature.c unit.project unit.assertions
src/sh/rotation.c unit.rotation unit.assertions
src/sh/window.c unit.window unit.assertions
src/sh/*.c unit.sh unit.assertions
src/light/double.c unit.double
src/light/*.c unit.light unit.sphere unit.edges unit.assertions
src/lobe/*.c unit.lobe unit.ggx_lobes unit.assertions
src/probe/*.c unit.probe unit.probe_engines unit.peers unit.peers_engines unit.assertions
src/shade/*.c unit.shade unit.shade_n unit.coat unit.fibers unit.environment unit.assertions
src/field/*.c unit.field_bytes unit.field unit.field_changes unit.field_shade unit.assertions
src/preintegrated/brdf*.c unit.preintegrated_brdf unit.preintegrated_brdf_bytes unit.assertions
src/preintegrated/*.c unit.preintegrated_lobe unit.assertions
src/brdf/rgl*.c unit.brdf_rgl unit.brdf_rgl_written unit.brdf_rgl_refusals unit.read_back unit.assertions
src/brdf/sheen.c unit.brdf_sheen unit.assertions
src/brdf/*.c unit.brdf_table_bytes unit.brdf unit.brdf_table unit.brdf_files unit.assertions
src/kernels/*.h kernels.kernels kernels.batch
app/trace/trace.c reference.estimator reference.render reference.texture
app/trace/*.c reference.texture reference.estimate
app/reference/sheen.c reference.sheen
app/reference/ggx.c reference.ggx reference.layers
app/reference/*.c reference.estimator reference.texture reference.kinds reference.environment reference.ggx reference.estimate reference.render
app/compare/*.c reference.compare
app/shadow/*.c program.shadow gpu.shadow gpu.shadow_filter
app/shade/*.c gpu.shade gpu.draw gpu.field
app/gpu/table.c gpu.table gpu.draw
app/gpu/environment.c gpu.devices
app/gpu/zonal.c gpu.devices
app/gpu/*.c gpu.draw gpu.plate gpu.shade gpu.devices
shaders/table.glsl gpu.table
shaders/environment.glsl gpu.devices gpu.table
shaders/*.glsl gpu.glsl gpu.draw gpu.plate gpu.shade gpu.devices
shaders/*.comp gpu.draw gpu.shade
shaders/*.frag gpu.draw gpu.plate reference.layers
shaders/*.vert gpu.draw gpu.plate
END
}

mkdir -p "$tree"
git ls-files -z | tar -c --null -T - | tar -x -C "$tree"
target() { echo "test_$1" | tr . _; }
# make TEST…: their programs.
make() {
    timeout 300 cmake --build "$build" --target $(for test; do target "$test"; done) >"$build.log" 2>&1
}
tests=$(subjects | cut -d' ' -f2- | tr ' ' '\n' | sort -u)
{
    # one instruction set: it compiles in a third of the time, and gives the same bits; assertions stay in
    cmake -G Ninja -S "$tree" -B "$build" -DCMAKE_BUILD_TYPE=Release -DCMAKE_C_FLAGS_RELEASE=-O2 -DLAMPION_SIMD=OFF
    cmake --build "$build" --target $(for test in $tests; do target "$test"; done)
} >"$build.log" 2>&1 || { tail -n 20 "$build.log"; exit 1; }

# What each test is without a change, and that it passes.
for test in $tests; do
    program=$(find "$build/tests" -name "$(target "$test")" -type f)
    echo "$test $program $(cksum <"$program")"
done >"$build.programs"
ctest --test-dir "$build" -R "^($(echo $tests | tr ' ' '|'))\$" >"$build.log" 2>&1 || { tail -n 20 "$build.log"; exit 1; }

subjects | while read -r file tests; do
    awk -f tests/mutation/mutants.awk "$file" | sed "s|^|$file\t|; s|\$|\t$tests|"
done >"$build.all"
total=$(wc -l <"$build.all")
awk -v count="$count" -v total="$total" 'int(NR * count / total) > int((NR - 1) * count / total)' \
    "$build.all" >"$build.drawn.new"
# A run that was stopped goes on where it was.
cmp -s "$build.drawn" "$build.drawn.new" || rm -f "$build.results"
mv "$build.drawn.new" "$build.drawn"
touch "$build.results"

# verdict TEST…: of the change that is in place. A program that is what it was before has nothing to notice.
verdict() {
    result=same
    for test; do
        make "$test" || { echo invalid; return; }
        read -r name program sum <<END
$(grep "^$test " "$build.programs")
END
        [ "$(cksum <"$program")" != "$sum" ] || continue
        result=survived
        ctest --test-dir "$build" -R "^$name\$" --timeout 60 >"$build.log" 2>&1 || { echo "killed by $name"; return; }
    done
    echo "$result"
}

tab=$(printf '\t')
tail -n +$(($(wc -l <"$build.results") + 1)) "$build.drawn" |
    while IFS=$tab read -r file line column length text tests; do
        awk -v line="$line" -v column="$column" -v length_="$length" -v text="$text" '
            NR == line { $0 = substr($0, 1, column - 1) text substr($0, column + length_) } { print }' \
            "$file" >"$tree/$file"
        changed=$(sed -n "${line}s/^ *//p" "$tree/$file") result=$(verdict $tests </dev/null)
        if [ "$result" = survived ] && grep -qF "$file$tab$changed$tab" tests/mutation/equivalent.txt; then
            result=equivalent
        fi
        printf '%s\n' "$result: $file:$line:$column: $changed" >>"$build.results"
        cp "$file" "$tree/$file"
    done
grep '^survived' "$build.results" || true
for result in killed survived equivalent same invalid; do
    printf '%s %s  ' "$(grep -c "^$result" "$build.results" || true)" $result
done
echo "of $count drawn from $total"
