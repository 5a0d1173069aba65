# SPDX-License-Identifier: MIT
# methods.sh PART: field, for which drivers compile longest, or the others.
# Where each method runs, and to how many bands: every pair of a method and a device renders at the limit that
# docs/shading.md states and refuses one band more by that limit, and the help names whatever is less than all.
set -eu
. tests/checks/common.sh
export XDG_CACHE_HOME="$WORK/cache"
most=128 part=$1 tried=0

# limit METHOD DEVICE: prints the document's limit ("GPU to 20 bands, CPU to 128", "GPU and CPU to 128 bands"), 0 for
# none.
limit() {
    awk -F '|' -v method=" \`$1\` " -v device="$2" '$2 == method {
        for (n = split($4, part, "[,;]"); n; n--)
            if (part[n] ~ device && match(part[n], /to [0-9]+/)) { print substr(part[n], RSTART + 3, RLENGTH - 3); exit }
    }' docs/shading.md
}

methods=$("$PROGRAM" render --help | sed -n '/--method METHOD/,/--device/p' | tr -d '\n' |
    sed 's/.*: auto, *//; s/ *\[auto\].*//; s/, */ /g')
[ "$(echo "$methods" | wc -w)" -ge 4 ] || fail "methods of the help: $methods"
help=$("$PROGRAM" render --help | tr -s ' \n' ' ')
for method in $methods; do
    case $part:$method in
    field:field) ;;
    field:* | others:field) continue ;;
    esac
    tried=$((tried + 1))
    for device in GPU CPU; do
        bands=$(limit "$method" $device)
        bands=${bands:-0}
        set -- --method "$method" --device "$(echo $device | tr A-Z a-z)" --size 8x4
        status=0
        "$PROGRAM" render builtin:ball "$@" --bands $((bands + 1)) -o "$WORK/more.exr" 2>"$WORK/err" || status=$?
        [ $status = 2 ] && [ ! -e "$WORK/more.exr" ] || fail "$method, $device, $((bands + 1)) bands: status $status"
        if [ "$bands" = 0 ]; then
            said="$method does not run on the $device"
            listed="(on the $([ $device = GPU ] && echo CPU || echo GPU) alone)"
        elif [ "$bands" = $most ]; then
            said="(1 to $most)" listed=
        else
            said="$method takes 1 to $bands"
            listed="(on the $device to $bands bands)"
            [ $device = GPU ] && [ "$bands" != "$(limit "$method" CPU)" ] || listed="(to $bands bands)"
        fi
        grep -qF -e "$said" "$WORK/err" || fail "$method, $device, $((bands + 1)) bands: $(cat "$WORK/err")"
        own=${help#*[\;,] "$method" } own=${own%%, *}
        case $own in *"$listed"*) ;; *) fail "the help of $method has no $listed" ;; esac
        [ "$bands" != 0 ] || continue
        "$PROGRAM" render builtin:ball "$@" --bands "$bands" --window none -o "$WORK/$method-$device.exr" \
            2>"$WORK/err" || fail "$method, $device, $bands bands: $(cat "$WORK/err")"
    done
done
[ $tried -gt 0 ] || fail "no method is of the part $part"
