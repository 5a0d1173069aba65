# SPDX-License-Identifier: MIT
# What the documents promise exists: commands, options, files that are linked to.
set -eu
. tests/checks/common.sh

documents="README.md CONTRIBUTING.md CHANGELOG.md SECURITY.md $(find docs -name '*.md')"

# check_lines LINES: of each line "where, tab, line of shell" the last lampion or ./dev: the command and its options
# are known to its --help, and no word is left over that is neither an option's value nor an operand.
check_lines() {
    mkdir -p "$WORK/help"
    sed -n '/lampion --/d; s/.*lampion \([^ ]*\).*/\1/p' "$1" | sort -u | while read -r command; do
        "$PROGRAM" "$command" --help >"$WORK/help/$command" 2>/dev/null || rm -f "$WORK/help/$command"
    done
    ./dev help >"$WORK/dev"
    awk -F '\t' -v dev="$WORK/dev" '
        function fail(text) { print text; bad = 1; exit 1 }
        # row_of COMMAND OPTION: prints the first line of the help that begins with it.
        function row_of(command, option, i, at) {
            for (i = 1; i <= rows[command]; i++) {
                at = index(row[command, i] " ", option " ")
                if (!at) at = index(row[command, i], option ",")
                if (at > 1 && substr(row[command, i], 1, at - 1) ~ /^ [-a-z, ]*$/) return row[command, i]
            }
        }
        function check_options(where, text, word, count, command, left, value, i, name) {
            count = split(text, word, " ")
            command = word[1]
            if (!(command in rows)) fail(where ": no command lampion " command)
            left = operands[command]
            for (i = 2; i <= count; i++) {
                name = word[i]
                sub(/=.*/, "", name)
                if (value) value = 0
                else if (word[i] == "--help") continue
                else if (word[i] ~ /^-/) {
                    if (row_of(command, name) == "") fail(where ": lampion " command " has no " name)
                    # one blank, then the name of a value
                    value = row_of(command, name) ~ /^ *(-., )?--[a-z-]* [^ ]/ && word[i] == name
                } else if (--left < 0) fail(where ": lampion " command " takes no " word[i])
            }
        }
        BEGIN { while ((getline line <dev) > 0) if (split(line, part, " ") && line ~ /^  [^ ]/) known[part[1]] }
        FILENAME != ARGV[ARGC - 1] {
            if (FNR == 1) { command = FILENAME; sub(/.*\//, "", command) }
            row[command, ++rows[command]] = $0
            if (sub(/^Usage: lampion [a-z]* \[OPTION…\]/, "")) operands[command] += split($0, part, " ") * (/…$/ ? 4 : 1)
            next
        }
        $2 ~ /lampion --/ { next }
        $2 ~ /lampion / { sub(/.*lampion /, "", $2); check_options($1, $2); next }
        $2 ~ /\.\/dev / {
            sub(/.*\.\/dev /, "", $2)
            sub(/ .*/, "", $2)
            if (!($2 in known)) fail($1 ": no ./dev " $2)
        }
        END { exit bad }' "$WORK"/help/* "$1" >"$WORK/log" || fail "$(cat "$WORK/log")"
}

# those_of WHERE: puts WHERE before each line of standard input.
those_of() {
    sed "s,^,$1$(printf '\t'),"
}

for document in $documents; do
    code_blocks "$document" sh | sed 's/ [#>].*//; s/|.*lampion/ lampion/; s/ | .*//; s/ <<.*//' | those_of "$document"
    # Commands in the text stand between back ticks.
    sed '/^ *```/,/^ *```/d' "$document" | grep -o '`\(lampion\|\./dev\) [^`]*`' |
        sed 's/`//g; s/ [#>].*//' | those_of "$document" || true
done >"$WORK/lines"
for document in $documents; do
    folder=$(dirname "$document")
    for link in $(grep -o '](\([^)#]*\)' "$document" | sed 's/^](//' | grep -v '^http' || true); do
        [ -e "$folder/$link" ] || fail "$document: links to $link, which is not there"
    done
done

# Examples of every --help are checked.
for command in $("$PROGRAM" --help | sed -n '/^Commands:/,/^$/s/^  \([a-z]*\) .*/\1/p'); do
    "$PROGRAM" "$command" --help | sed '1,/^Examples:/d; s/ [#>].*//' | those_of "$command --help"
done >>"$WORK/lines"

# Commands that ./dev demo suggests are checked.
sed -n "/<<'NEXT'/,/^NEXT/p" dev | grep 'lampion ' | those_of "./dev demo" >>"$WORK/lines"
[ "$(grep -c 'lampion \|\./dev ' "$WORK/lines")" -gt 300 ] || fail "too few commands to be all"
check_lines "$WORK/lines"

# A wrong command must be found.
for line in 'lampion rendre' 'lampion render --badns 3 x' 'lampion render a b --size 8x8' './dev tset'; do
    echo "$line" | those_of planted >"$WORK/planted"
    ! (check_lines "$WORK/planted") 2>/dev/null || fail "$line goes unseen"
done
