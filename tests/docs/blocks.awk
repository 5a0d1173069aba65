# SPDX-License-Identifier: MIT
# Takes the fenced blocks of a Markdown file apart: block k goes to FOLDER/k, and a line "k line
# language annotation" to standard output. The annotation is the HTML comment on the line before.
# An indented block that holds a command is an error: nobody would run it.
function strip(text, width) { return substr(text, 1, width) ~ /^ *$/ ? substr(text, width + 1) : text }

!inside && /^ *```/ {
    match($0, /^ */)
    indent = RLENGTH
    language = substr($0, indent + 4)
    sub(/ .*/, "", language)
    inside = 1
    count++
    print count, FNR, language == "" ? "text" : language, previous ~ /^ *<!-- .* -->$/ ? substr(previous, index(previous, "<!-- ") + 5, length(previous) - index(previous, "<!-- ") - 8) : ""
    printf "" > (folder "/" count)
    next
}
inside && /^ *```$/ { inside = 0; close(folder "/" count); previous = ""; next }
inside { print strip($0, indent) > (folder "/" count); next }
/^    (\.\/dev|lampion|build\/|cmake|cc) / && previous == "" {
    print FILENAME ":" FNR ": a command outside a fenced block" > "/dev/stderr"
    failed = 1
}
{ previous = $0 }
END { exit failed }
