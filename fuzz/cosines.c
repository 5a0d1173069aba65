/* SPDX-License-Identifier: MIT */
/* Tables of linearly transformed cosines: every node of an accepted table has an inverse. */
#include "app/truth/scoreboard_cosines_table.h"
#include "fuzz/numbers.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    cosines_table table;
    base_error error;
    char *const text = fuzz_text(data, size);
    if (!text)
        return 0;
    if (cosines_parse("input", text, size, &table, &error)) {
        for (int i = 0; i < table.size * table.size; i++)
            fuzz_expect(table.nodes[i][0] * table.nodes[i][3] >
                        table.nodes[i][1] * table.nodes[i][2]);
        cosines_free(&table);
    }
    free(text);
    return 0;
}
