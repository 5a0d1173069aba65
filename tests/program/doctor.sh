# SPDX-License-Identifier: MIT
# lampion doctor, and the cache it tells of: where it lies, how it is held to its limit, cleared.
set -eu
. tests/checks/common.sh
cd "$WORK" # a driver takes a relative XDG_CACHE_HOME for what it says
export ASAN_OPTIONS=detect_leaks=0 # GL drivers leak at exit

export XDG_CACHE_HOME="$WORK/cache"
folder=$XDG_CACHE_HOME/lampion
"$PROGRAM" doctor >"$WORK/out" || fail "doctor: $(cat "$WORK/out")"
for word in 'lampion  *[0-9]' 'CPU .* threads' 'kernels .*scalar' 'OpenGL .*4\.' 'Assimp [0-9]' 'Embree [0-9]' \
    'OpenEXR [0-9]' 'libpng [0-9]' 'jansson [0-9]' 'GLFW [0-9]' 'Dear ImGui [0-9]' "cache  *$folder: 0 files, 0.0 of at most 2048 MiB" 'configuration'; do
    grep -q "$word" "$WORK/out" || fail "doctor tells nothing of $word: $(cat "$WORK/out")"
done
"$PROGRAM" doctor --cpu-mask 1 | grep -q '^kernels  *scalar (of' || fail "doctor ignores --cpu-mask"
status=0
"$PROGRAM" doctor --gl-device none-such >"$WORK/out" || status=$?
[ $status = 1 ] && grep -q '^OpenGL  *none: ' "$WORK/out" || fail "doctor is content without OpenGL"
HOME=$WORK/home XDG_CACHE_HOME=relative "$PROGRAM" doctor | grep -q "^cache  *$WORK/home/.cache/lampion: " &&
    fail "a home that is not there"
mkdir "$WORK/home"
HOME=$WORK/home XDG_CACHE_HOME=relative "$PROGRAM" doctor | grep -q "^cache  *$WORK/home/.cache/lampion: " ||
    fail "a relative XDG_CACHE_HOME is not ignored"

# As JSON, for programs, the report says the same.
"$PROGRAM" doctor --json --cpu-mask 1 >"$WORK/out" || fail "doctor --json: $(cat "$WORK/out")"
for word in '"lampion": "[0-9]' '"threads": [0-9]' '"kernels": "scalar"' '"available": true' '"Assimp": "[0-9]' \
    '"Embree": "[0-9]' "\"folder\": \"$folder\"" '"files": 0'; do
    grep -q "$word" "$WORK/out" || fail "doctor --json tells nothing of $word: $(cat "$WORK/out")"
done
"$PROGRAM" doctor --json --gl-device none-such >"$WORK/out" && fail "doctor --json is content without OpenGL"
grep -q '"reason": "' "$WORK/out" || fail "doctor --json gives no reason: $(cat "$WORK/out")"

# bake NAME: makes a table of 1.2 MiB.
bake() {
    "$PROGRAM" brdf bake "phong:$1" --bands 32 --views 160 -o "$WORK/$1.lmpt"
}
bake 1
size=$(wc -c <"$WORK/1.lmpt")
[ "$(ls "$folder" | wc -l)" = 1 ] || fail "a table is not cached"
first=$(ls "$folder")
bake 2
second=$(ls "$folder" | grep -v "$first")
touch -d '2 days ago' "$folder/$first"
touch -d '1 day ago' "$folder/$second"
"$PROGRAM" doctor | grep -q 'cache.*: 2 files' || fail "doctor does not count two files"

# The cache has room for two and a half tables: a third evicts the one unused for longest, which the use just now
# changed.
bake 1
mkdir "$folder/foreign"
LAMPION_CACHE_MIB=$(awk "BEGIN { print 2.5 * $size / 1048576 }") bake 3
[ -e "$folder/$first" ] || fail "a file used just now was removed"
[ ! -e "$folder/$second" ] || fail "the oldest file was not removed"
[ "$(find "$folder" -type f | wc -l)" = 2 ] || fail "not two files are left: $(ls "$folder")"

"$PROGRAM" doctor --clear-cache | grep -q 'cache.*: 0 files, 0.0 of' || fail "the cache is not cleared"
[ -d "$folder/foreign" ] || fail "what is not of the cache was cleared"

# A cache that cannot be written does not stop the program.
XDG_CACHE_HOME=/proc/none "$PROGRAM" brdf bake phong:4 --views 4 --bands 4 -o "$WORK/4.lmpt"
XDG_CACHE_HOME=/proc/none "$PROGRAM" doctor | grep -q '^cache  *none: ' || fail "no cache is not told"
