# SPDX-License-Identifier: MIT
# The mutants of a file, as mutants.awk prints them, and then the file: each mutant behind a number that its text
# makes, the file's name, and before the tests' names. Equal lines differ by how many came before.
BEGIN { FS = OFS = "\t" }
NR == FNR { mutants[$1] = mutants[$1] $0 "\n"; next }
FNR in mutants {
    line = $0
    sub(/^ +/, "", line)
    seen[line]++
    for (n = split(mutants[FNR], list, "\n") - 1; n; n--) {
        split(list[n], field, "\t")
        text = file " " seen[line] " " substr($0, 1, field[2] - 1) field[4] substr($0, field[2] + field[3])
        gsub(/  +/, " ", text)
        print hash(text), file, list[n], tests
    }
}
function hash(text, i, sum) {
    sum = 5381
    for (i = 1; i <= length(text); i++)
        sum = (sum * 33 + index(letters, substr(text, i, 1))) % 268435399
    # Mixes once more, so that lines with the same ending are drawn independently.
    return sum * 7919 % 268435399
}
BEGIN {
    for (i = 32; i < 127; i++)
        letters = letters sprintf("%c", i)
}
