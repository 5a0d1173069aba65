# SPDX-License-Identifier: MIT
# Files appear whole or not at all: on a full disk, in a folder that vanishes, under a limit of size, when
# the program is interrupted or killed at any time; and nothing is left beside them.
set -eu
. tests/checks/common.sh

temporaries() {
    find "$WORK" -name '.lampion-*' | wc -l
}

# refuses TEXT COMMAND…: the command must fail with one line that contains TEXT, and leave no temporary file.
refuses() {
    text=$1
    shift
    status=0
    "$@" >"$WORK/out" 2>"$WORK/err" || status=$?
    [ $status = 1 ] || fail "$*: status $status"
    grep -q "^lampion: .*$text" "$WORK/err" || fail "$*: said $(cat "$WORK/err")"
    [ "$(wc -l <"$WORK/err")" = 1 ] || fail "$*: more than a line"
    [ "$(temporaries)" = 0 ] || fail "$*: left a temporary"
}

draw() { # BANDS FILE
    "$PROGRAM" basis --bands "$1" --size 256x256 -o "$2"
}

bake() { # FILE
    "$PROGRAM" brdf bake ggx:0.5 --bands 4 --views 32 -o "$1"
}

cd "$WORK"
draw 2 old.png
draw 3 new.png
draw 2 old.exr
draw 3 new.exr

# --- a limit of size, and a disk that is full ------------------------------------------------------
limited() { (ulimit -f 1 && "$@"); }
for kind in png exr; do
    cp old.$kind image.$kind
    refuses 'File too large' limited draw 3 image.$kind
    cmp -s old.$kind image.$kind || fail "the old image.$kind is damaged"
done
refuses 'File too large' limited bake table.lmpt
refuses 'File too large' limited "$PROGRAM" brdf convert sgd:red-fabric -o cloth.bsdf
refuses 'File too large' limited "$PROGRAM" brdf convert sgd:red-fabric -o cloth.binary
for kind in json csv npy lmpf; do
    refuses 'File too large' limited "$PROGRAM" field builtin:atrium -o probes.$kind
    [ ! -e probes.$kind ] || fail "a part of a volume appeared"
done
[ ! -e table.lmpt ] && [ ! -e cloth.bsdf ] && [ ! -e cloth.binary ] || fail "a part of a file appeared"
full() { "$@" >/dev/full; }
refuses 'No space left on device' full "$PROGRAM" completion bash
refuses 'No space left on device' full "$PROGRAM" info --json builtin:atrium
refuses 'No space left on device' full "$PROGRAM" project --light 0,3,0 --radius 1 --bands 64
mkdir disk
if mount -t tmpfs -o size=8k none disk 2>/dev/null; then
    for kind in png exr; do
        status=0
        draw 5 disk/image.$kind 2>err || status=$?
        [ $status = 1 ] && grep -q 'No space left on device' err || { umount disk; fail "full: $(cat err)"; }
        [ -z "$(ls -A disk)" ] || { umount disk; fail "a full disk keeps a part"; }
    done
    umount disk
else
    echo "skipped: a small disk needs the right to mount one"
fi

# --- folders, pipes --------------------------------------------------------------------------------
refuses 'No such file or directory' draw 2 none/image.png
"$PROGRAM" info --json builtin:atrium | head -c 1 >/dev/null

# --- interrupted and killed ------------------------------------------------------------------------
tries=8
[ -z "${LAMPION_LONG:-}" ] || tries=300
for signal in INT TERM KILL; do
    cp old.exr image.exr
    for i in $(seq $tries); do
        # In a shell of its own, because background commands ignore SIGINT.
        timeout --signal=$signal --preserve-status "0.0$((i * 7 % 90 + 10))" "$PROGRAM" basis --bands 3 \
            --size 256x256 -o image.exr 2>/dev/null || true
        cmp -s old.exr image.exr || cmp -s new.exr image.exr || fail "SIG$signal left a part of a file"
    done
    [ $signal = KILL ] || [ "$(temporaries)" = 0 ] || fail "SIG$signal left a temporary"
    echo "tried: $tries signals while a file was written"
done

# --- what killed runs left -------------------------------------------------------------------------
sh -c 'echo $$' >dead
dead=$(cat dead)
mkdir swept
touch "swept/.lampion-$dead-abcdef" "swept/.lampion-$$-abcdef" "swept/.lampion-$dead-abc" \
    "swept/.lampion-x-abcdef" "swept/lampion-$dead-abcdef"
ln -s ../old.png "swept/.lampion-$dead-ghijkl"
draw 2 swept/image.png
[ ! -e "swept/.lampion-$dead-abcdef" ] || fail "a dead run's temporary was kept"
for kept in ".lampion-$$-abcdef" ".lampion-$dead-abc" .lampion-x-abcdef "lampion-$dead-abcdef" \
    ".lampion-$dead-ghijkl"; do
    [ -e "swept/$kept" ] || fail "$kept is not the program's to remove"
done
rm -rf swept
draw 2 image.png
[ "$(temporaries)" = 0 ] || fail "temporaries of killed runs are left: $(find . -name '.lampion-*')"
