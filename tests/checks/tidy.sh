# SPDX-License-Identifier: MIT
# What clang-tidy's analyzer and its checks of error-prone code say of the library, against tests/checks/tidy.txt: a list of
# warnings that were judged to be false. The kernels are left out, for paths through their loops of constant
# length take the analyzer minutes and gigabytes; the sanitizers judge them.
set -eu
. tests/checks/common.sh
command -v clang-tidy >/dev/null || { echo "skipped: clang-tidy is not installed"; exit 0; }

# These checks are off, because most files of the library do on purpose what they warn of.
checks='-*,clang-analyzer-*,bugprone-*'
for off in bugprone-easily-swappable-parameters bugprone-narrowing-conversions bugprone-macro-parentheses \
    bugprone-implicit-widening-of-multiplication-result bugprone-reserved-identifier \
    clang-analyzer-security.insecureAPI.DeprecatedOrUnsafeBufferHandling; do
    checks=$checks,-$off
done

# tidy FILE…: prints FILE CHECK for each warning.
tidy() {
    printf '%s\n' "$@" | xargs -P "$(nproc)" -n 1 clang-tidy -p "$BUILD" --quiet --checks="$checks" >"$WORK/log" 2>"$WORK/err" || true
    sed -n "s,^$SOURCE/\([^:]*\):.*: [a-z]*: .*\[\([A-Za-z.,-]*\)\]\$,\1 \2,p" "$WORK/log" | LC_ALL=C sort -u
}

tidy $(git ls-files 'src/*.c' | grep -v '^src/kernels/\|/generate/') >"$WORK/found"
sed 's/ *#.*//; /^$/d' tests/checks/tidy.txt | LC_ALL=C sort -u >"$WORK/listed"
diff "$WORK/listed" "$WORK/found" >"$WORK/difference" ||
    fail "warnings (>) that tests/checks/tidy.txt does not list, or lists (<) in vain:" "$(cat "$WORK/difference")" "$(cat "$WORK/log")"
