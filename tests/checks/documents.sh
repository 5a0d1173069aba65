# SPDX-License-Identifier: MIT
# What the documents promise exists: commands, options, files that are linked to.
set -eu
. tests/checks/common.sh

documents="README.md CONTRIBUTING.md CHANGELOG.md $(find docs -name '*.md')"

# options_exist WHERE COMMAND WORD…: the command and its options are known to its --help, and no
# word is left over that is neither an option's value nor an operand.
options_exist() {
    where=$1 command=$2
    shift 2
    help=$("$PROGRAM" "$command" --help 2>/dev/null) || fail "$where: no command lampion $command"
    operands=$(printf '%s\n' "$help" | sed -n 's/^Usage: lampion [a-z]* \[OPTION…\]//p' | sed 's/.*…$/& & & &/' | wc -w)
    value=no
    for word in "$@"; do
        case $value$word in
        yes*) value=no ;;
        no--help) ;;
        no-*)
            row=$(printf '%s\n' "$help" | grep -e "^ [-a-z, ]*${word%%=*}\([ ,]\|$\)" | head -n 1)
            [ -n "$row" ] || fail "$where: lampion $command has no ${word%%=*}"
            # one blank, then the name of a value
            if printf '%s\n' "$row" | grep -q '^ *\(-., \)\{0,1\}--[a-z-]* [^ ]'; then
                case $word in *=*) ;; *) value=yes ;; esac
            fi
            ;;
        no*)
            operands=$((operands - 1))
            [ "$operands" -ge 0 ] || fail "$where: lampion $command takes no $word"
            ;;
        esac
    done
}

# check_command WHERE LINE: the last lampion or ./dev of a line of shell.
check_command() {
    where=$1
    case $2 in
    *'lampion --'*) ;;
    *'lampion '*)
        set -f
        options_exist "$where" ${2##*lampion }
        set +f
        ;;
    *'./dev '*)
        name=${2##*./dev }
        ./dev help | grep -q "^  ${name%% *}\( \|$\)" || fail "$where: no ./dev ${name%% *}"
        ;;
    esac
}

for document in $documents; do
    code_blocks "$document" sh | sed 's/ [#>].*//; s/|.*lampion/ lampion/; s/ | .*//; s/ <<.*//' >"$WORK/lines"
    # and those in the text, between back ticks
    sed '/^ *```/,/^ *```/d' "$document" | grep -o '`\(lampion\|\./dev\) [^`]*`' |
        sed 's/`//g; s/ [#>].*//' >>"$WORK/lines" || true
    while read -r line; do
        check_command "$document" "$line"
    done <"$WORK/lines"
    folder=$(dirname "$document")
    for link in $(grep -o '](\([^)#]*\)' "$document" | sed 's/^](//' | grep -v '^http' || true); do
        [ -e "$folder/$link" ] || fail "$document: links to $link, which is not there"
    done
done

# the examples of every --help
for command in $("$PROGRAM" --help | sed -n '/^Commands:/,/^$/s/^  \([a-z]*\) .*/\1/p'); do
    "$PROGRAM" "$command" --help | sed '1,/^Examples:/d; s/ [#>].*//' >"$WORK/lines"
    while read -r line; do
        check_command "$command --help" "$line"
    done <"$WORK/lines"
done

# and what ./dev demo tells people to try
./dev help >/dev/null
sed -n "/<<'NEXT'/,/^NEXT/p" dev | grep 'lampion ' >"$WORK/lines"
while read -r line; do
    check_command "./dev demo" "$line"
done <"$WORK/lines"
