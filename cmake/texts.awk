# SPDX-License-Identifier: MIT
# The module lampion.js: awk -f texts.awk lampion.js FILE.wgsl… prints it with the files' texts, which are named
# by their folder and name.
NR == FNR {
    print
    next
}
FNR == 1 {
    count = split(FILENAME, part, "/")
    sub(/\.wgsl$/, "", part[count])
    print (begun ? "`,\n" : "const texts = {\n") "    '" part[count - 1] "/" part[count] "': `"
    begun = 1
}
{
    gsub(/[\\`$]/, "\\\\&")
    print
}
END {
    print "`,\n};"
}
