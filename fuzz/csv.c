/* SPDX-License-Identifier: MIT */
/* Tables of numbers, read from a stream in memory; what is read prints and reads back unchanged. */
#include "app/base/csv.h"

#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void check_round_trip(float value) {
    char text[CSV_TEXT_MAX + 1];
    text[csv_format(value, text)] = '\0';
    if (strtof(text, NULL) != value)
        abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static const char *const names[] = { "a", "b", "c" };
    static csv_reader reader;
    FILE *const stream = size > 0 ? fmemopen((void *)(uintptr_t)data, size, "rb") : NULL;
    if (!stream)
        return 0;
    base_error error;
    float row[3];
    if (csv_open_stream(&reader, stream, "input", "a,b,c", &error)) {
        while (csv_read_row(&reader, names, 3, row, &error) == CSV_ROW)
            for (int i = 0; i < 3; i++)
                check_round_trip(row[i]);
        csv_close(&reader);
    }
    return 0;
}
