# SPDX-License-Identifier: MIT
# Static and shared library of one compilation, that of $BUILD, made and installed in usr as ./dev package does, without
# the program but with the Python package, for the tests that look at them from outside. checks.package compares them with
# those that it compiles.
set -eu
. tests/checks/common.sh

objects=$(library_objects)
export SOURCE_DATE_EPOCH=0
python=OFF components='library development' targets='lampion lampion_other lampion_hlsl lampion_metal lampion_wgsl'
if [ -n "$(python_with cffi)" ]; then
    python=ON components="$components python" targets="$targets lampion_python"
fi
{
    cmake --preset package -B "$WORK/build" -DLAMPION_PROGRAM=OFF -DLAMPION_PYTHON=$python "-DLAMPION_OBJECTS=$objects" &&
        cmake --build "$WORK/build" --target $targets &&
        for component in $components; do
            cmake --install "$WORK/build" --prefix "$WORK/usr" --component $component || exit 1
        done
} >"$WORK/log" 2>&1 || fail "$(tail -n 40 "$WORK/log")"
