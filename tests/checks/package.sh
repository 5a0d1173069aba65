# SPDX-License-Identifier: MIT
# The Debian packages: what is in them, that they install, serve and leave nothing behind, and that
# the same source gives the same bytes.
set -eu
. tests/checks/common.sh

if ! command -v dpkg-shlibdeps >/dev/null; then
    echo "skipped: not a Debian system with dpkg-dev"
    exit 0
fi
./dev package "$WORK/one" >"$WORK/log" 2>&1 || fail "$(tail -n 40 "$WORK/log")"
multiarch=$(gcc -print-multiarch)
version=$("$PROGRAM" --version | sed 's/lampion //')
soversion=${version%.*}
packages="liblampion$soversion liblampion-dev liblampion-doc python3-lampion lampion"
root=$WORK/root
lib=$root/usr/lib/$multiarch

# Built again, in another folder than the tests' own, the packages must have the same bytes.
touch LICENSE # times of files do not count
rm -rf build/package/_CPack_Packages
./dev package "$WORK/two" >"$WORK/log" 2>&1 || fail "$(tail -n 40 "$WORK/log")"
diff -r "$WORK/one" "$WORK/two" >"$WORK/log" || fail "a second build differs: $(cat "$WORK/log")"

for package in $packages; do
    set -- "$WORK/one/${package}_$version"-*.deb
    [ -f "$1" ] || fail "no package $package"
    dpkg-deb -x "$1" "$root"
    for file in copyright changelog.Debian.gz; do
        [ -f "$root/usr/share/doc/$package/$file" ] || fail "$package: no $file"
    done
    dpkg-deb -f "$1" Depends >"$WORK/$package.depends"
done
# The program and the library must be the same from other folders; the program names its commit.
commit_of() {
    grep -om1 'LAMPION_COMMIT=[^ ]*' "$1/build.ninja"
}
[ -f "$BUILD/liblampion.a" ] && cmp "$BUILD/liblampion.a" build/package/liblampion.a ||
    fail "the library differs from that of $BUILD"
cmp "$WORK/../libraries/build/liblampion.so.$version" build/package/liblampion.so ||
    fail "the shared library differs from that of checks.libraries"
if [ "$(commit_of "$BUILD")" = "$(commit_of build/package)" ]; then
    strip -o "$WORK/program" "$PROGRAM"
    cmp "$WORK/program" "$root/usr/bin/lampion" || fail "the program differs from that of $BUILD"
else
    echo "skipped: $BUILD was configured at another commit than the packages"
fi
for file in "$root/usr/bin/lampion" "$lib/liblampion.so.$version" "$lib/liblampion.a"; do
    ! grep -qF "$SOURCE" "$file" || fail "$file names the folder it was built in"
done

if git rev-parse HEAD >/dev/null 2>&1; then # the archive knows its commit
    tar -xOzf "$WORK/one/lampion-$version.tar.gz" "lampion-$version/cmake/commit.txt" >"$WORK/commit"
    grep -q "$(git rev-parse --short HEAD)" "$WORK/commit" || fail "the source archive is of commit $(cat "$WORK/commit")"
fi

# Dependencies between the packages.
grep -q "liblampion$soversion (= $version" "$WORK/liblampion-dev.depends" || fail "dev: $(cat "$WORK/liblampion-dev.depends")"
for library in libassimp5 libdraco7 libembree3-3 libglfw3 libjpeg62-turbo libmeshoptimizer2d libpng16-16 libopenexr libseccomp2 libwebp7 libxxhash0 libepoxy0 libegl1 libgl1 libgl1-mesa-dri; do
    grep -q "$library" "$WORK/lampion.depends" || fail "lampion does not depend on $library"
done
[ "$(sed 's/ (.*//' "$WORK/liblampion$soversion.depends")" = libc6 ] || fail "the library depends on more than libc6"
[ "$(objdump -p "$lib/liblampion.so.$version" | sed -n 's/ *SONAME *//p')" = "liblampion.so.$soversion" ] || fail "soname"

for package in "liblampion$soversion (>= $version)" python3:any python3-cffi-backend python3-numpy; do
    grep -qF "$package" "$WORK/python3-lampion.depends" || fail "python3-lampion does not depend on $package"
done

# The Python package, with the library and the program beside it.
python=$(python_with numpy _cffi_backend)
if [ -n "$python" ]; then
    cat >"$WORK/try.py" <<'TRY'
import lampion
print(lampion.version(), *lampion.render("builtin:ball", size=(16, 8), bands=3).shape)
TRY
    PYTHONPATH=$root/usr/lib/python3/dist-packages LD_LIBRARY_PATH=$lib PATH=$root/usr/bin:$PATH \
        PYTHONDONTWRITEBYTECODE=1 "$python" "$WORK/try.py" >"$WORK/python.txt" || fail "the Python package does not run"
    [ "$(cat "$WORK/python.txt")" = "$version 8 16 3" ] || fail "the Python package prints $(cat "$WORK/python.txt")"
fi

# The program, its manual and its completion.
"$root/usr/bin/lampion" project --light 0,3,0 --radius 0.5 --bands 2 >/dev/null || fail "the program does not run"
for command in $("$PROGRAM" --help | sed -n '/^Commands:/,/^$/s/^  \([a-z]*\) .*/\1/p'); do
    [ -f "$root/usr/share/man/man1/lampion-$command.1.gz" ] || fail "no manual page of $command"
done
zgrep -q "timed events" "$root/usr/share/man/man5/lampion-formats.5.gz" || fail "the manual page of formats has no scripts"
zgrep -q 'lights.json\|lights file' "$root/usr/share/man/man5/lampion-formats.5.gz" || fail "no manual page of formats"
grep -q '<h1' "$root/usr/share/doc/liblampion-doc/html/index.html" || fail "no documents"
for file in bash-completion/completions/lampion zsh/vendor-completions/_lampion fish/vendor_completions.d/lampion.fish \
    lampion/shaders/lampion.glsl lampion/shaders/hlsl/lampion.hlsl lampion/shaders/metal/lampion.metal \
    lampion/shaders/wgsl/lampion.js lampion/shaders/wgsl/ggx/lampion.wgsl; do
    [ -s "$root/usr/share/$file" ] || fail "no $file"
done

# The library as installed, of which checks.install tests more.
export PKG_CONFIG_PATH="$lib/pkgconfig"
gcc examples/first_light.c $(pkg-config --cflags --libs lampion) -o "$WORK/shared" || fail "pkg-config"
objdump -p "$WORK/shared" | grep -q "NEEDED *liblampion.so.$soversion" || fail "not linked to the shared library"
LD_LIBRARY_PATH=$lib "$WORK/shared" >"$WORK/shared.txt"
[ -s "$WORK/shared.txt" ] || fail "the example prints nothing"

# The steps of the README's reader: a scene, three lights, a material, the truth.
mkdir "$WORK/reader"
own_scene "$WORK/reader/scene.gltf"
code_blocks README.md json >"$WORK/reader/lights.json"
code_blocks README.md sh | grep -E '^lampion (.* scene\.|compare )' | grep -v '^lampion view' | # small: the last --size counts
    sed 's/ lights.json .*/& --size 160x90/' >"$WORK/reader/commands"
[ "$(wc -l <"$WORK/reader/commands")" -ge 6 ] || fail "the README's way is not there"
(cd "$WORK/reader" && PATH=$root/usr/bin:$PATH XDG_CACHE_HOME=$WORK/cache sh -eu commands >log 2>&1) ||
    fail "the README's way: $(cat "$WORK/reader/log")"
awk '$1 == "relmse" { found = $2 } END { exit !(found != "" && found < 0.01) }' "$WORK/reader/log" ||
    fail "the image is far from the truth: $(cat "$WORK/reader/log")"
for image in mine.png gold.png; do
    [ -s "$WORK/reader/$image" ] || fail "no $image"
done
! cmp -s "$WORK/reader/mine.png" "$WORK/reader/gold.png" || fail "the material changes nothing"

# dpkg's own account, in a separate root: installed, then purged without a trace.
if [ "$(id -u)" = 0 ]; then
    system=$WORK/system
    mkdir -p "$system/var/lib/dpkg/info" "$system/var/lib/dpkg/updates"
    : >"$system/var/lib/dpkg/status"
    own() {
        dpkg --root="$system" --log="$WORK/dpkg.log" --force-depends --force-script-chrootless "$@" >"$WORK/log" 2>&1 ||
            fail "dpkg $1: $(cat "$WORK/log")"
    }
    own --install "$WORK"/one/*.deb
    for package in $packages; do
        dpkg-query --admindir="$system/var/lib/dpkg" -W -f '${db:Status-Status}\n' "$package" | grep -qx installed ||
            fail "$package is not installed"
    done
    own --purge $packages
    left=$(find "$system" -path "$system/var/lib/dpkg" -prune -o ! -type d -print)
    [ -z "$left" ] || fail "left behind: $left"
fi
