# SPDX-License-Identifier: MIT
# A wheel is made, without a network, and holds the shared library: installed in a fresh environment, it runs where nothing
# else of Lampion is.
set -eu
. tests/checks/common.sh
. tests/python/package.sh

python=$(python_with numpy _cffi_backend setuptools wheel.bdist_wheel venv pip)
if [ -z "$python" ]; then
    echo "skipped: the wheel needs python3-pip, python3-setuptools, python3-venv and python3-wheel"
    exit 0
fi
unset PYTHONPATH LD_LIBRARY_PATH
PYTHON=$python sh python/wheel.sh "$usr" "$WORK/wheels" >"$WORK/log" 2>&1 || fail "$(cat "$WORK/log")"
version=$("$PROGRAM" --version | sed 's/lampion //')
set -- "$WORK"/wheels/*.whl
case $(basename "$1") in
lampion-"$version"-py3-none-linux_*.whl) ;;
*) fail "the wheel is called $(basename "$1")" ;;
esac

"$python" -m venv --system-site-packages --without-pip "$WORK/venv" # whose own pip would take most of the time
"$python" -m pip --python "$WORK/venv/bin/python" --quiet --disable-pip-version-check install --no-index --no-deps "$1" >"$WORK/log" 2>&1 ||
    fail "$(cat "$WORK/log")"
cd "$WORK"
cat >try.py <<'TRY'
import os
import lampion
here = os.path.dirname(lampion.__file__)
assert here.startswith(os.path.realpath("venv")), here
libraries = {line.split()[-1] for line in open("/proc/self/maps") if "liblampion" in line}
assert libraries == {os.path.join(here, "liblampion.so." + lampion.version().rpartition(".")[0])}, libraries
zonal = lampion.sphere.project_zonal(3, 0.5, 2)
print(*zonal)
TRY
PYTHONDONTWRITEBYTECODE=1 venv/bin/python try.py >printed || fail "the installed wheel does not run"
# sin²a = 1/16: pi/2 sqrt(1/pi) sin²a 2/(1 + cos a), and the next by R_1 = 1
awk '{ a = sqrt(15 / 16); e0 = $1 - sqrt(3.14159265) / 16 / (1 + a); e1 = $2 - sqrt(3 * 3.14159265) / 32
    exit !(e0 * e0 <= 1e-12 && e1 * e1 <= 1e-12) }' printed || fail "the installed wheel computes $(cat printed)"
