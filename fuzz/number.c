/* SPDX-License-Identifier: MIT */
/* Numbers as text: they are read if and only if they are decimal and finite, with the value that C
 * reads from the whole text; nothing after the text is read. */
#include "app/base/number.h"
#include "app/base/csv.h"
#include "app/scene/load/words.h"
#include "fuzz/numbers.h"

#include <ctype.h>

enum { LENGTH_MAX = 63 };

static const char *skip_digits(const char *at, int *count) {
    for (; isdigit((unsigned char)*at); at++)
        ++*count;
    return at;
}

/* Whether a text is [+-] digits [. digits] [e [+-] digits], with a digit before the e. */
static bool is_decimal(const char *at) {
    int digits = 0, exponent = 0;
    at += *at == '+' || *at == '-';
    at = skip_digits(at, &digits);
    if (*at == '.')
        at = skip_digits(at + 1, &digits);
    if (*at == 'e' || *at == 'E') {
        at++;
        at += *at == '+' || *at == '-';
        at = skip_digits(at, &exponent);
        if (exponent == 0)
            return false;
    }
    return digits > 0 && *at == '\0';
}

/* Checks that a float is written so that it reads back unchanged. */
static void check_round_trip(float value) {
    char text[CSV_TEXT_MAX + 1];
    text[csv_format(value, text)] = '\0';
    fuzz_expect(strtof(text, NULL) == value);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    char text[LENGTH_MAX + 2];
    double value = 0;
    float word = 0;
    const size_t length = size < LENGTH_MAX ? size : LENGTH_MAX;
    memcpy(text, data, length);
    for (size_t i = 0; i < length; i++)
        text[i] = text[i] ? text[i] : '0';
    text[length] = '7'; /* a digit after the end of the text */
    text[length + 1] = '\0';
    const bool read = number_read(text, length, &value);
    text[length] = '\0';
    const double expected = strtod(text, NULL);
    fuzz_expect(read == (is_decimal(text) && isfinite(expected)));
    fuzz_expect(!read || value == expected);
    if (words_number(text, &word)) {
        fuzz_expect(read && word == strtof(text, NULL) && isfinite(word));
        check_round_trip(word);
    }
    return 0;
}
