# SPDX-License-Identifier: MIT
# Writes sgd_table.c from merl_sgd.csv (columns: material, alias, 12 parameters of 3 channels):
#     cd src/brdf/generate && awk -f sgd_table.awk merl_sgd.csv > ../sgd_table.c
# The numbers were published with the paper named below and read from dj_brdf.h by Jonathan Dupuy, which
# is in the public domain; as a table they are CC0 1.0.
# The last parameter, the residual of the fit, takes no part in the evaluation and stays out.
BEGIN {
    FS = ","
    print "/* SPDX-License-Identifier: MIT */"
    print "/* clang-format off */"
    print "/* Written by generate/sgd_table.awk: do not edit."
    print " *"
    print " * Parameters that M. Bagher, C. Soler and N. Holzschuch fitted to the materials of the MERL BRDF"
    print " * database: \"Accurate fitting of measured reflectances using a Shifted Gamma micro-facet"
    print " * distribution\", Computer Graphics Forum 31(4), 2012; measurements by W. Matusik, H. Pfister, M. Brand"
    print " * and L. McMillan, \"A Data-Driven Reflectance Model\", ACM TOG 22(3), 2003. The numbers are CC0 1.0. */"
    print "#include \"src/brdf/sgd_table.h\""
    print ""
    print "const brdf_sgd_row lmp_sgd_rows[] = {"
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
    print "const size_t lmp_sgd_row_count = sizeof lmp_sgd_rows / sizeof *lmp_sgd_rows;"
}
