# SPDX-License-Identifier: MIT
# The program explains itself, and treats its output streams as a good Unix program does.
set -eu
. tests/checks/common.sh

version=$(sed -n 's/^#define LMP_VERSION_[A-Z]* //p' include/lampion/base.h | paste -sd .)
[ "$("$PROGRAM" --version)" = "lampion $version" ] || fail "--version is not $version"
cached=$(sed -n 's/^CMAKE_PROJECT_VERSION:STATIC=//p' "$BUILD/CMakeCache.txt")
[ "$cached" = "$version" ] || fail "CMake thinks the version is $cached"
grep -q "^## .*$version" CHANGELOG.md || fail "CHANGELOG.md does not know version $version"

commands=$("$PROGRAM" --help | sed -n '/^Commands:/,/^$/s/^  \([a-z]*\) .*/\1/p')
[ -n "$commands" ] || fail "--help lists no command"
[ "$("$PROGRAM")" = "$("$PROGRAM" --help)" ] || fail "no argument at all does not print the help"
for command in $commands; do
    help=$("$PROGRAM" "$command" --help) || fail "$command --help fails"
    [ "$help" = "$("$PROGRAM" help "$command")" ] || fail "help $command is not $command --help"
    printf '%s\n' "$help" | sed '1,/^Examples:/d' | grep -q "lampion $command" ||
        fail "$command --help has no example"
    status=0
    line=$("$PROGRAM" "$command" --no-such-option 2>&1 >/dev/null </dev/null) || status=$?
    [ $status = 2 ] || fail "$command --no-such-option: status $status"
    [ "$(printf '%s\n' "$line" | wc -l)" = 1 ] || fail "$command --no-such-option: $line"
done

status=0
line=$("$PROGRAM" projcet 2>&1) || status=$?
[ "$status: $line" = "2: lampion: unknown command projcet (did you mean project?); see lampion --help" ] ||
    fail "projcet: $status: $line"

# hints 'WORD' ARGUMENT…: a misspelt word must be answered by the nearest.
hints() {
    word=$1
    shift
    line=$("$PROGRAM" "$@" 2>&1 </dev/null) && fail "$*: succeeds"
    printf '%s\n' "$line" | grep -qF "(did you mean $word?)" || fail "$*: $line"
}
hints --version --verson
"$PROGRAM" box.glb 2>&1 | grep -qF "lampion render box.glb -o image.png" || fail "a scene without a command"
out="-o $WORK/x.png"
hints --bands render builtin:ball $out --bnads 3
hints zonal render builtin:ball $out --method zonl
hints balls render builtin:bals $out
hints builtin:atrium render atrium $out
hints builtin:atrium:lanterns=3 info biultin:atrium:lanterns=3
hints test_material render builtin:ball $out --material tset_material=ggx:0.3
hints ggx render builtin:ball $out --material test_material=gxx:0.3
hints default render builtin:ball $out --camera defualt
hints bake brdf baek ggx:0.3
hints rmse compare a.exr b.exr --fail-above rsme=1
hints operations paper -o "$WORK/page" --step opertions
hints cpu bench cpuu
hints fish completion fihs
hints render man rendr

# Progress is for terminals: there is none in a pipe (above), nor on a dumb terminal, which gets no color either.
if command -v script >/dev/null; then
    for terminal in dumb xterm; do
        script -qec "TERM=$terminal '$PROGRAM' reference builtin:ball --size 96x64 --spp 64 -o '$WORK/t.png'" \
            /dev/null >"$WORK/$terminal" </dev/null
        [ -s "$WORK/t.png" ] || fail "no image on a terminal"
        ! grep -q "$(printf '\033\\[[0-9;]*m')" "$WORK/$terminal" || fail "colors on $terminal"
    done
    [ ! -s "$WORK/dumb" ] || fail "progress on a dumb terminal: $(cat "$WORK/dumb")"
    # The program's name is colored in an error and in a note, on a terminal that supports it.
    says() {
        script -qec "$1 '$PROGRAM' $2" /dev/null </dev/null | tr -d '\r'
    }
    small="reference builtin:ball --size 8x8 --spp 1 --seed 3 -o '$WORK/t.png'"
    escape=$(printf '\033')
    says TERM=xterm 'info none.gltf' | grep -q "^$escape\[1;31mlampion:$escape\[0m none.gltf: " || fail "an error is not red"
    says TERM=xterm "$small" | grep -q "$escape\[33mlampion:$escape\[0m --seed: " || fail "a note is not yellow"
    for plain in 'TERM=xterm NO_COLOR=1' TERM=dumb; do
        says "$plain" 'info none.gltf' | grep -q '^lampion: none.gltf: ' || fail "colors with $plain"
    done
    says 'TERM=xterm NO_COLOR=' 'info none.gltf' | grep -q "^$escape" || fail "an empty NO_COLOR counts"
    [ -z "$(says TERM=xterm "$small --quiet")" ] || fail "--quiet is not"
    says TERM=xterm 'info none.gltf -q' | grep -q none.gltf || fail "--quiet hides errors"
fi

status=0
line=$("$PROGRAM" --help 2>&1 >/dev/full) || status=$?
[ $status = 1 ] || fail "a full disk goes unseen: $status"
[ "$line" = "lampion: standard output: cannot write: No space left on device" ] || fail "full: $line"
status=0
"$PROGRAM" --help >&- 2>/dev/null || status=$?
[ $status = 1 ] || fail "a closed output goes unseen: $status"

# A reader that leaves early is no error.
awk 'BEGIN { print "light_x,light_y,light_z,radius,recv_x,recv_y,recv_z"
    for (i = 0; i < 100000; i++) print "0,0,1,0.1,0,0,0" }' >"$WORK/table"
{ "$PROGRAM" project --batch "$WORK/table" 2>"$WORK/early" || echo $? >"$WORK/status"; } |
    head -n 1 >/dev/null
[ ! -s "$WORK/early" ] || fail "a closed pipe is reported: $(cat "$WORK/early")"
[ "$(cat "$WORK/status")" = 1 ] || fail "a closed pipe ends in status $(cat "$WORK/status")"
