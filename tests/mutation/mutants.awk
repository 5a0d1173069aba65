# SPDX-License-Identifier: MIT
# The mutants of a C file, one a line: LINE, COLUMN, LENGTH and the text to put there, between tabs. Signs,
# comparisons and logic become their neighbors, numbers one more; comments and texts stay as they are.
BEGIN {
    split("+ - * / < <= > >= == != && ||", from, " ")
    split("- + / * <= < >= > != == || &&", to, " ")
}
# Keeps the code alone, as many characters as before.
{
    line = $0
    if (inside || line ~ /^ *#/ || line ~ /"/)
        line = inside && (end = index(line, "*/")) ? blank(end + 1) substr(line, end + 2) : ""
    inside = inside && !end
    end = 0
    if (start = index(line, "/*")) {
        inside = !index(substr(line, start), "*/")
        line = substr(line, 1, start - 1)
    }
    for (i in from) {
        sign = " " from[i] " "
        for (at = index(line, sign); at; at = (next_at = index(substr(line, at + 1), sign)) ? at + next_at : 0)
            print NR "\t" at + 1 "\t" length(from[i]) "\t" to[i]
    }
    rest = line
    for (at = 0; match(rest, /[^A-Za-z0-9_.][0-9]+/); ) {
        if (substr(rest, RSTART + RLENGTH, 1) != "x") # but those of 16 digits
            print NR "\t" at + RSTART + 1 "\t" RLENGTH - 1 "\t" substr(rest, RSTART + 1, RLENGTH - 1) + 1
        at += RSTART + RLENGTH - 1
        rest = substr(rest, RSTART + RLENGTH)
    }
}
function blank(count) {
    return sprintf("%" count "s", "")
}
