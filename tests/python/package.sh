# SPDX-License-Identifier: MIT
# Sets python to a Python that runs the package which checks.libraries has installed, or ends the test as skipped.

python=$(python_with numpy _cffi_backend)
usr=$BUILD/tests/checks/libraries/usr
packages=$usr/lib/python3/dist-packages
if [ -z "$python" ] || [ ! -d "$packages/lampion" ]; then
    echo "skipped: the Python package needs python3-numpy and python3-cffi"
    exit 0
fi
library=$(dirname "$(find "$usr" -name liblampion.so)")
export PYTHONPATH="$packages" LD_LIBRARY_PATH="$library"
