# SPDX-License-Identifier: MIT
# A method is a row of a table: no code but the tables compares its name, and a comparison would be found.
set -eu
. tests/checks/common.sh

names=$(sed -n '/^typedef enum lmp_shade_method/,/}/p' include/lampion/shade.h
    sed -n '/^typedef enum method_kind/,/}/p' app/render/method.h)
names=$(printf '%s\n' "$names" | grep -oE '\b(LMP_SHADE|METHOD)_[A-Z_]+\b' | grep -vx LMP_SHADE_METHOD_COUNT |
    sort -u | paste -sd'|')

# compared FILE…: prints where a name is compared, or is a case.
compared() {
    grep -nE "([!=]=|\bcase) *($names)\b|\b($names) *[!=]=" "$@" /dev/null || true
}

found=$(compared $(git ls-files 'src/*.[ch]' 'app/*.[ch]' | grep -vxE 'src/shade/method\.c|app/render/method\.c'))
[ -z "$found" ] || fail "$found"

cat >"$WORK/compares.c" <<'END'
if (method == LMP_SHADE_PREINTEGRATED)
    case METHOD_ZONAL:
END
[ "$(compared "$WORK/compares.c" | wc -l)" -eq 2 ] || fail "a comparison with a method's name is not found"
