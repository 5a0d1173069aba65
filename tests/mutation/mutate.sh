# SPDX-License-Identifier: MIT
# sh tests/mutation/mutate.sh [COUNT [FOLDER]]: whether the tests notice COUNT small changes (by default 40), drawn
# evenly from those that mutants.awk makes of the files below, or of those in FOLDER alone. Works on a copy of the
# tree in build/mutation; prints the survivors, as FILE:LINE: THE CHANGED LINE, and the score. Many survivors
# change nothing that could be seen.
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
src/probe/*.c unit.probe unit.peers unit.peers_engines unit.assertions
src/shade/*.c unit.shade unit.shade_n unit.coat unit.environment unit.assertions
src/field/*.c unit.field_bytes unit.field unit.field_changes unit.field_shade unit.assertions
src/preintegrated/brdf*.c unit.preintegrated_brdf unit.preintegrated_brdf_bytes unit.assertions
src/preintegrated/*.c unit.preintegrated_lobe unit.assertions
src/brdf/rgl*.c unit.brdf_rgl unit.brdf_rgl_refusals unit.read_back unit.assertions
src/brdf/*.c unit.brdf_table_bytes unit.brdf unit.brdf_table unit.brdf_files unit.assertions
src/kernels/*.h kernels.kernels kernels.batch
app/trace/*.c reference.texture reference.estimate
app/reference/*.c reference.texture reference.kinds reference.environment reference.ggx reference.estimate
app/compare/*.c reference.compare
app/shadow/*.c gpu.shadow gpu.shadow_filter
app/shade/*.c gpu.shade gpu.draw gpu.field
app/gpu/*.c gpu.draw gpu.shade gpu.plate
shaders/*.glsl gpu.glsl gpu.draw gpu.plate gpu.shade
shaders/*.comp gpu.draw gpu.shade
shaders/*.frag gpu.draw gpu.plate
shaders/*.vert gpu.draw
END
}

mkdir -p "$tree"
git ls-files -z | tar -c --null -T - | tar -x -C "$tree"
{
    # one instruction set: it compiles in a third of the time, and gives the same bits; assertions stay in
    cmake -G Ninja -S "$tree" -B "$build" -DCMAKE_BUILD_TYPE=Release -DCMAKE_C_FLAGS_RELEASE=-O2 -DLAMPION_SIMD=OFF
    cmake --build "$build" --target $(subjects | cut -d' ' -f2- | tr ' .' '\n_' | sort -u | sed 's/^/test_/')
} >"$build.log" 2>&1 || { tail -n 20 "$build.log"; exit 1; }

subjects | while read -r file tests; do
    awk -f tests/mutation/mutants.awk "$file" | sed "s|^|$file\t|; s|\$|\t$tests|"
done >"$build.all"
total=$(wc -l <"$build.all")
awk -v count="$count" -v total="$total" 'int(NR * count / total) > int((NR - 1) * count / total)' \
    "$build.all" >"$build.drawn"

# verdict FILE TESTS: of the change that is in place.
verdict() {
    timeout 300 cmake --build "$build" --target $(echo "$2" | tr '. ' '_\n' | sed 's/^/test_/') \
        >"$build.log" 2>&1 || { echo invalid; return; }
    for test in $2; do
        timeout 120 ctest --test-dir "$build" -R "^$test\$" --timeout 100 >"$build.log" 2>&1 || { echo killed; return; }
    done
    echo survived
}

tab=$(printf '\t')
while IFS=$tab read -r file line column length text tests; do
    awk -v line="$line" -v column="$column" -v length_="$length" -v text="$text" '
        NR == line { $0 = substr($0, 1, column - 1) text substr($0, column + length_) } { print }' \
        "$file" >"$tree/$file"
    result=$(verdict "$file" "$tests")
    echo "$result" >>"$build.results.new"
    [ "$result" != survived ] || echo "$file:$line: $(sed -n "${line}s/^ *//p" "$tree/$file")"
    cp "$file" "$tree/$file"
done <"$build.drawn"
mv "$build.results.new" "$build.results"
for result in killed survived invalid; do
    printf '%s %s  ' "$(grep -c $result "$build.results" || true)" $result
done
echo "of $count drawn from $total"
