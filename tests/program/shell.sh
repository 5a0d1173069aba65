# SPDX-License-Identifier: MIT
# What the program prints for others to read: manual pages that groff takes without a word, and
# completion that completes.
set -eu
. tests/checks/common.sh

# absent TOOL: reports once that it is missing.
absent() {
    command -v "$1" >/dev/null && return 1
    echo "skipped: $1 is not installed"
}

# clean PAGE: groff must not warn.
clean() {
    groff -man -Tutf8 -Kutf8 -ww -z "$1" >"$WORK/log" 2>&1 && [ ! -s "$WORK/log" ]
}
commands=$("$PROGRAM" --help | sed -n '/^Commands:/,/^$/s/^  \([a-z]*\) .*/\1/p')
if ! absent groff; then
    "$PROGRAM" man >"$WORK/lampion.1"
    clean "$WORK/lampion.1" || fail "lampion.1: $(cat "$WORK/log")"
    for command in $commands; do
        page=$WORK/lampion-$command.1
        "$PROGRAM" man "$command" >"$page"
        clean "$page" || fail "$page: $(cat "$WORK/log")"
        grep -q "lampion.*-$command" "$WORK/lampion.1" || fail "lampion.1 does not name lampion-$command"
        for option in $("$PROGRAM" "$command" --help | sed -n 's/^ \{2,6\}\(-., \)\{0,1\}--\([a-z-]*\).*/\2/p'); do
            sed 's/\\-/-/g' "$page" | grep -q -- "--$option\\\\fR" || fail "$page: no --$option"
        done
    done
    printf '.TH A 1\n.XX unknown\n' >"$WORK/bad.1"
    ! clean "$WORK/bad.1" || fail "an unknown macro goes unseen"
fi
refuse() {
    status=0
    line=$("$PROGRAM" "$@" 2>&1 >"$WORK/out") || status=$?
    [ $status = 2 ] || fail "$*: status $status"
}
refuse man rendr
[ "$line" = "lampion: unknown command rendr (did you mean render?); see lampion --help" ] || fail "$line"
refuse completion
refuse completion tcsh

mkdir "$WORK/files"
touch "$WORK/files/scene.gltf" "$WORK/files/with blank.png"
mkdir "$WORK/bin" "$WORK/rooms"
ln -s "$PROGRAM" "$WORK/bin/lampion"
PATH=$WORK/bin:$PATH
printf 'newmtl floor\nnewmtl flowers\nnewmtl wall\n' >"$WORK/rooms/room.mtl"
printf 'mtllib room.mtl\nusemtl floor\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nusemtl flowers\nf 1 3 2\n' >"$WORK/rooms/room.obj"
mkdir "$WORK/files/folder"

# In bash `completes LINE WORD…` checks the words that are offered.
"$PROGRAM" completion bash >"$WORK/bash"
bash -n "$WORK/bash" || fail "bash: syntax"
completes_bash() {
    (cd "$WORK/files" && bash -c 'source ../bash; COMP_LINE=$1 COMP_POINT=${#1}; _lampion; printf "%s\n" "${COMPREPLY[@]}"' \
        - "$1" | sort | paste -sd ' ')
}
# In fish only the words count, without their descriptions.
"$PROGRAM" completion fish >"$WORK/fish"
completes_fish() {
    (cd "$WORK/files" && HOME=$WORK fish --no-config -c 'source ../fish; complete -C $argv[1]' "$1" | cut -f 1 | sort | paste -sd ' ')
}
shells=bash
absent fish || shells="bash fish"
completes() {
    for shell in $shells; do
        offered=$(completes_$shell "$1")
        [ "$offered" = "$2" ] || fail "$shell: \"$1\" is completed by \"$offered\", not \"$2\""
    done
}
completes 'lampion ren' 'render'
completes 'lampion man ref' 'reference'
completes 'lampion help ref' 'reference'
completes 'lampion render --met' '--method'
completes 'lampion render --method pre' 'preintegrated'
completes 'lampion render scene.gltf --device ' 'auto cpu gpu'
completes 'lampion render --bands ' ''
completes 'lampion render --animate bou' 'bounce'
completes 'lampion info --no-' '--no-cache'
completes 'lampion brdf ba' 'bake bands'
completes 'lampion bench ' 'cpu gpu'
completes 'lampion completion z' 'zsh'
completes 'lampion render sce' 'scene.gltf'
completes 'lampion render --lights sc' 'scene.gltf'
completes "lampion render $WORK/rooms/room.obj --material fl" 'floor= flowers='
completes "lampion view $WORK/rooms/room.obj --bands 3 --material floo" 'floor='
if [ "$shells" != bash ]; then
    shells=fish
    completes 'lampion brdf info sgd:gold-p' 'sgd:gold-paint'
    completes 'lampion render x.gltf --material floor=sgd:two-layer-g' 'floor=sgd:two-layer-gold'
fi
shells=bash
completes 'lampion brdf info sgd:gold-p' 'gold-paint'
completes 'lampion render x.gltf --material floor=sgd:two-layer-g' 'two-layer-gold'
completes 'lampion render x.gltf --material flo' ''
completes 'lampion render --window=ha' 'hanning' # as readline wants it, what follows = or : alone
completes 'lampion render builtin:at' 'atrium'
completes 'lampion render ' 'builtin:atrium builtin:ball builtin:balls builtin:room folder scene.gltf with\ blank.png'
completes 'lampion paper -o ' 'folder'
completes 'lampion paper --data ' 'folder'
completes 'lampion brdf info sce' 'scene.gltf'
# A name is never run as a command, whatever it contains: it is quoted here, or by readline where that does it well.
hostile='hole$(touch pwned).gltf' quoted='hole\$\(touch\ pwned\).gltf'
touch "$WORK/files/builtin:$hostile" "$WORK/files/sgd:$hostile" "$WORK/files/$hostile" "$WORK/files/builtin:ball;x"
completes 'lampion info builtin:ho' "$quoted"
completes 'lampion info ./builtin:ho' "$quoted"
completes 'lampion render scene.gltf --material floor=sgd:ho' "$quoted"
completes 'lampion info builtin:ball' 'ball ball\;x balls'
sed 's/compopt/told/' "$WORK/bash" >"$WORK/files/told"
tells() {
    told=$(cd "$WORK/files" && bash -c 'told() { echo "$*:"; }; source ./told; COMP_LINE=$1 COMP_POINT=${#1}; _lampion; echo "${COMPREPLY[@]}"' - "$1" | paste -s -d ' ')
    [ "$told" = "$2" ] || fail "\"$1\" is completed by \"$told\", not \"$2\""
}
tells 'lampion info hol' "-o filenames: $hostile"
tells 'lampion info builtin:hol' "$quoted"

"$PROGRAM" completion zsh >"$WORK/zsh"
absent zsh || zsh -n "$WORK/zsh" || fail "zsh: syntax"
