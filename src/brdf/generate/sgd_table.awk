# SPDX-License-Identifier: MIT
# Writes sgd_table.c from merl_sgd.csv (columns: material, alias, 12 parameters of 3 channels):
#     cd src/brdf/generate && awk -f sgd_table.awk merl_sgd.csv > ../sgd_table.c
# The numbers were published with the paper named below and were taken from dj_brdf.h by Jonathan Dupuy,
# which is in the public domain; as a table they are available under CC0 1.0.
# The last parameter, the residual of the fit, is not needed for evaluation and is omitted.
BEGIN {
    FS = ","
    print "/* SPDX-License-Identifier: MIT */"
    print "/* clang-format off */"
    print "/* Written by generate/sgd_table.awk: do not edit."
    print " *"
    print " * SGD parameters fitted to the materials of the MERL BRDF database by M. Bagher, C. Soler and"
    print " * N. Holzschuch: \"Accurate fitting of measured reflectances using a Shifted Gamma micro-facet"
    print " * distribution\", Computer Graphics Forum 31(4), 2012. The materials were measured by W. Matusik,"
    print " * H. Pfister, M. Brand and L. McMillan: \"A Data-Driven Reflectance Model\", ACM TOG 22(3), 2003."
    print " * The numbers are available under CC0 1.0. */"
    print "#include \"src/brdf/sgd_table.h\""
    print ""
    print "const brdf_sgd_row lmpi_sgd_rows[] = {"
}
NR > 1 {
    printf "    { \"%s\", \"%s\", {\n", $1, $2
    for (parameter = 0; parameter < 11; parameter++) {
        i = 3 + 3 * parameter
        printf "        { %s, %s, %s }%s\n", $i, $(i + 1), $(i + 2), parameter < 10 ? "," : " } },"
    }
}
END {
    print "};"
    print "const size_t lmpi_sgd_row_count = sizeof lmpi_sgd_rows / sizeof *lmpi_sgd_rows;"
}
