# SPDX-License-Identifier: MIT
# determinism.sh threads: the same bytes from run to run and from any number of threads; determinism.sh machines: by every
# instruction set, and under locales that write numbers (German) and letters (Turkish) another way.
set -eu
. tests/checks/common.sh

awk 'BEGIN {
    print "light_x,light_y,light_z,radius,recv_x,recv_y,recv_z"
    for (i = 1; i <= 500; i++) print i % 7 - 3 ",3," i % 5 ",0." i ",0,0,0"
}' >"$WORK/lights.csv"

# outputs NAME [OPTION…]: writes what the commands print, in a folder of that name.
outputs() {
    folder=$WORK/$1
    shift
    batches=${mask:+--cpu-mask $mask} # of the commands that run the batch functions
    mkdir "$folder"
    export XDG_CACHE_HOME="$folder/cache"
    set -- "$@" --bands 6
    "$PROGRAM" render builtin:ball --device cpu --method zonal --size 96x54 -o "$folder/zonal.exr" $batches "$@"
    "$PROGRAM" render builtin:atrium --device cpu --size 96x54 --samples 2 -o "$folder/image.png" $batches "$@"
    "$PROGRAM" render builtin:ball --device cpu --size 48x27 --bounces 2 -o "$folder/bounces.exr" $batches "$@"
    "$PROGRAM" reference builtin:ball --size 48x27 --spp 4 --threads "${OMP_NUM_THREADS:-0}" \
        -o "$folder/reference.exr" "$@"
    "$PROGRAM" brdf bake sgd:white-fabric --views 8 -o "$folder/table.lmpt" "$@"
    "$PROGRAM" project --batch "$WORK/lights.csv" $batches "$@" >"$folder/project.csv"
    "$PROGRAM" field builtin:balls --grid 4x3x5 --shadows -o "$folder/probes.csv" $batches "$@"
    "$PROGRAM" field builtin:atrium --grid 4x3x5 -o "$folder/probes.lmpf" $batches "$@"
    rm -r "$folder/cache"
}

# same NAME [OPTION…]: the outputs must be those of the first run.
same() {
    outputs "$@" >"$WORK/log" 2>&1 || fail "$1: $(cat "$WORK/log")"
    compare "$1"
}

# compare NAME: compares with the outputs of the first run.
compare() {
    diff -rq "$WORK/first" "$WORK/$1" || fail "$1: other bytes than the first run"
}

by_threads() {
    same again
    for threads in 1 2 7; do
        export OMP_NUM_THREADS=$threads LP_NUM_THREADS=$threads
        same "threads-$threads"
    done
    unset OMP_NUM_THREADS LP_NUM_THREADS
}

by_machines() {
    for mask in 1 2 4 8; do
        same "mask-$mask"
    done
    unset mask

    # The locales are made here, because few systems have them.
    export LOCPATH="$WORK/locale"
    mkdir "$LOCPATH"
    for name in de_DE tr_TR; do
        if ! localedef -i "$name" -f UTF-8 "$LOCPATH/$name.UTF-8" >"$WORK/log" 2>&1; then
            echo "skipped: no locale $name (the package locales has it)"
            continue
        fi
        LC_ALL=$name.UTF-8 same "$name"
    done
}

outputs first >"$WORK/log" 2>&1 || fail "$(cat "$WORK/log")"
[ "$(ls "$WORK/first" | wc -l)" = 8 ] || fail "not every command wrote its file"
"by_$1"

# A difference must be found.
cp -r "$WORK/first" "$WORK/altered"
printf x >>"$WORK/altered/project.csv"
if (compare altered) >/dev/null 2>&1; then fail "a difference goes unseen"; fi
