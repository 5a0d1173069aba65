# SPDX-License-Identifier: MIT
# Names of files on standard output: a terminal obeys nothing in them, and JSON tells them nevertheless.
set -eu
. tests/checks/common.sh
export XDG_CACHE_HOME="$WORK/cache"

# ESC, BEL, DEL, C1 as UTF-8 and as a byte, a change of text direction.
name=$(printf 'e\033]0;told\a\177\302\233m\233m\342\200\256ü')
shown='e?]0;told????m?m???ü'
escaped='e\\u001B]0;told\\u0007\\u007F\\u009Bm\357\277\275m\\u202Eü'
mkdir "$WORK/files"
cd "$WORK/files"
own_scene "$name.gltf"
"$PROGRAM" field builtin:ball --grid 2x2x2 --bands 2 -o "$name.lmpf"
"$PROGRAM" brdf bake lambert:0.5 --bands 2 --views 4 -o "$name.lmpt"

# prints EXPECTED ARGUMENT…: the first line with the name must hold EXPECTED, and no line a control character.
prints() {
    expected=$1
    shift
    "$PROGRAM" "$@" >"$WORK/out" || fail "$1: status $?"
    grep -qF -e "$expected" "$WORK/out" || fail "$1 prints: $(cat -v "$WORK/out")"
    ! LC_ALL=C tr -d '\t\n' <"$WORK/out" | LC_ALL=C grep -qe '[[:cntrl:]]' || fail "$1 prints a control character"
    ! LC_ALL=C grep -qF -e "$(printf '\233')" "$WORK/out" || fail "$1 prints C1"
}
prints "$shown.gltf" info "$name.gltf"
prints "$shown.lmpf" info "$name.lmpf"
prints "$shown.lmpt" brdf info "$name.lmpt"
prints "\"$(printf "$escaped").gltf\"" info --json "$name.gltf"
prints "\"$(printf "$escaped").lmpf\"" info --json "$name.lmpf"
