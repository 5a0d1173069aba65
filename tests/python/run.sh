# SPDX-License-Identifier: MIT
# run.sh NAME: the tests of test_NAME.py, on the package that checks.libraries has installed.
set -eu
. tests/checks/common.sh
. tests/python/package.sh

cd tests/python
export PYTHONDONTWRITEBYTECODE=1 LAMPION_PROGRAM="$PROGRAM" LAMPION_HEADERS="$SOURCE/include/lampion"
exec "$python" -W error -m unittest -q "test_$1"
