# SPDX-License-Identifier: MIT
# Each public header stands alone, as C11 and as C++17, under both compilers, and bears inclusion
# twice; its macros and initializers, too, give C++ no warnings.
set -eu
. tests/checks/common.sh

compile() {
    for header in include/lampion/*.h; do
        name=${header#include/}
        printf '#include <%s>\n#include <%s>\n' "$name" "$name" |
            "$@" -Iinclude -Wall -Wextra -Wpedantic -Werror -fsyntax-only - ||
            fail "$header does not stand alone: $*"
    done
}

for compiler in gcc clang; do
    compile "$compiler" -std=c11 -xc
done
for compiler in g++ clang++; do
    compile "$compiler" -std=c++17 -Wold-style-cast -xc++
    "$compiler" -std=c++17 -xc++ -Iinclude -Wall -Wextra -Wpedantic -Wold-style-cast -Werror \
        -fsyntax-only - <<'END' || fail "$compiler warns where the headers are used"
#include <lampion/lampion.h>
int main() {
    float sh[LMP_SH_COUNT(3)], half[LMP_SH_HALF_COUNT(3)], matrices[LMP_SH_ROTATION_COUNT(3)];
    lmp_light light{};
    const lmp_vec3 point{ 0, 0, 0 };
    const lmp_material material{};
    const lmp_host host{};
    lmp_cubemap cube{};
    lmp_latlong panorama{};
    lmp_probe_convention convention{};
    lmp_probe_samples samples{};
    const lmp_spheres spheres = lmp_spheres_of(&light);
    sh[LMP_SH_INDEX(2, -1)] = half[LMP_SH_HALF_INDEX(2, 1)] = matrices[0] = 0;
    return cube.size || panorama.width || convention.axes[0] || samples.count ||
           material.kind != LMP_MATERIAL_LOBES || host.user || spheres.radius.stride == 0 ||
           lmp_vec3_array_of(&point).stride == 0 || sh[0] > half[0];
}
END
done
if echo '#include <lampion/nothing.h>' | gcc -Iinclude -fsyntax-only -xc - 2>/dev/null; then
    fail "a header that is not there was found"
fi

# MSVC takes them, too: by clang's imitation of it, which brings its own headers of C.
for language in 'c -std=c11' 'c++ -std=c++17'; do
    for dll in '' -DLMP_DLL -DLMP_DLL_BUILD; do
        echo '#include <lampion/lampion.h>' | clang --target=x86_64-pc-windows-msvc -ffreestanding -nostdlibinc -x $language $dll -Iinclude -Wall -Wextra \
            -Werror -fsyntax-only - || fail "the headers do not compile as $language for MSVC $dll"
    done
done
