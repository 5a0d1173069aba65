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

# What is changed, and the tests that should notice.
subjects() {
    grep "^$folder" <<'END'
app/trace/texture.c reference.texture
app/reference/lobe.c reference.texture reference.estimate
app/compare/ssim.c reference.compare
app/gpu/renderer.c gpu.draw
src/brdf/table.c unit.brdf_table unit.brdf_table_bytes
src/brdf/rgl_read.c unit.brdf_rgl unit.brdf_rgl_refusals
END
}

mkdir -p "$tree"
git ls-files -z | tar -c --null -T - | tar -x -C "$tree"
{
    # one instruction set: it compiles in a third of the time, and gives the same bits
    cmake -G Ninja -S "$tree" -B "$build" -DCMAKE_BUILD_TYPE=Release -DLAMPION_SIMD=OFF
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
