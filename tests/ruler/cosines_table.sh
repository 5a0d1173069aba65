# SPDX-License-Identifier: MIT
# The table of linearly transformed cosines is what its generator, the first argument, writes: to a
# hundredth, for another compiler or C library rounds the steps of its fits otherwise.
set -eu

numbers() {
    grep '^    { ' "$1" | tr -c '0-9.e\n-' '\n' | grep '[0-9]'
}

"$1" >"$WORK/table.c"
numbers app/truth/scoreboard_cosines_table.c >"$WORK/expected"
numbers "$WORK/table.c" >"$WORK/actual"
paste "$WORK/expected" "$WORK/actual" | awk '
    { error = $1 - $2; if (error < 0) error = -error; size = $1 < 0 ? -$1 : $1 }
    NF != 2 || !(error <= 0.01 + 0.01 * size) { wrong++ }
    END { print NR " numbers, " wrong + 0 " differ"; exit NR != 32 * 32 * 6 || wrong > 0 }'
