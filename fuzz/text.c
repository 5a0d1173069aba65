/* SPDX-License-Identifier: MIT */
/* Text files: UTF-16 becomes UTF-8, and nothing is written past the allocated memory; and the
 * accessors of COLLADA. */
#include "app/scene/load/text.h"
#include "app/scene/load/collada.h"
#include "fuzz/numbers.h"

#include <stdlib.h>
#include <string.h>

/* Whether every UTF-8 sequence is complete. */
static bool is_utf8(const unsigned char *text, size_t size) {
    for (size_t i = 0; i < size;) {
        const size_t more = text[i] < 0x80 ? 0 : text[i] < 0xe0 ? 1 : text[i] < 0xf0 ? 2 : 3;
        if ((text[i] >= 0x80 && text[i] < 0xc2) || text[i] > 0xf4 || i + more >= size)
            return false;
        for (size_t k = 1; k <= more; k++)
            if ((text[i + k] & 0xc0) != 0x80)
                return false;
        i += more + 1;
    }
    return true;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    void *text = malloc(size + 1);
    if (!text)
        return 0;
    memcpy(text, data, size);
    const bool marked = size >= 2 && data[0] + data[1] == 0xff + 0xfe && data[0] >= 0xfe;
    size_t used = size;
    if (text_to_utf8(&text, &used)) {
        fuzz_expect(marked ? is_utf8(text, used) : used == size && !memcmp(text, data, size));
        const size_t trimmed = text_trim_xml(text, used);
        base_error error;
        fuzz_expect(trimmed <= used);
        collada_check(text, trimmed, "input", &error);
    }
    free(text);
    return 0;
}
