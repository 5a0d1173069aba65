/* SPDX-License-Identifier: MIT */
/* Lampion's tables, .lmpt. */
#include "fuzz/checksum.h"
#include "src/brdf/table.h"

static void use(const lmp_brdf_table *table) {
    float *rgb = malloc(3 * lmp_brdf_table_describe(table).count * sizeof *rgb);
    if (!rgb)
        return;
    for (int i = 0; i < 4; i++)
        lmp_brdf_table_interpolate(table, (float)i / 3, (float)i - 1, rgb);
    free(rgb);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    lmp_brdf_table *table;
    lmp_parse_error error;
    lmp_result result = lmp_brdf_table_read(NULL, data, size, &error, &table);
    if (result == LMP_ERROR_CHECKSUM) {
        unsigned char *valid = fuzz_checksum(data, size);
        if (!valid)
            return 0;
        result = lmp_brdf_table_read(NULL, valid, size, &error, &table);
        free(valid);
    }
    if (result == LMP_OK)
        use(table);
    lmp_brdf_table_destroy(table);
    return 0;
}
