# SPDX-License-Identifier: MIT
# The type hints of the Python package agree with its code, and a program that breaks them is told so.
set -eu
. tests/checks/common.sh
. tests/python/package.sh

if ! command -v mypy >/dev/null; then
    echo "skipped: mypy is not installed"
    exit 0
fi
unset PYTHONPATH LD_LIBRARY_PATH
check() {
    MYPYPATH=$packages mypy --ignore-missing-imports --cache-dir "$WORK/cache" --python-executable "$python" "$@" >"$WORK/log" 2>&1
}
check "$packages/lampion" || fail "$(cat "$WORK/log")"

cat >"$WORK/wrong.py" <<'WRONG'
import lampion
spectrum: str = lampion.sphere.project_zonal(3, 1, 2)
WRONG
! check "$WORK/wrong.py" || fail "a wrong type goes unseen"
grep -q 'wrong.py:2: error: Incompatible types' "$WORK/log" || fail "$(cat "$WORK/log")"
