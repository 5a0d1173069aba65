/* SPDX-License-Identifier: MIT */
/* %.9g for floats, some ten times faster than printf. The value is scaled to an integer of nine
 * digits in double precision, which is off by less than 1e-6; only where that could change the
 * rounding does printf decide. */
#include "app/base/csv.h"

#include <math.h>
#include <string.h>

#define DIGITS      9
#define LEAST       100000000u /* the least integer of nine digits */
#define DOUBT       1e-6       /* the scaled value is within this of its exact value */
#define POWER_FIRST (-31)      /* of the powers of ten below: 10^(8 - exponent) of any float */

static const double powers[] = {
    1e-31, 1e-30, 1e-29, 1e-28, 1e-27, 1e-26, 1e-25, 1e-24, 1e-23, 1e-22, 1e-21, 1e-20, 1e-19,
    1e-18, 1e-17, 1e-16, 1e-15, 1e-14, 1e-13, 1e-12, 1e-11, 1e-10, 1e-9,  1e-8,  1e-7,  1e-6,
    1e-5,  1e-4,  1e-3,  1e-2,  1e-1,  1e0,   1e1,   1e2,   1e3,   1e4,   1e5,   1e6,   1e7,
    1e8,   1e9,   1e10,  1e11,  1e12,  1e13,  1e14,  1e15,  1e16,  1e17,  1e18,  1e19,  1e20,
    1e21,  1e22,  1e23,  1e24,  1e25,  1e26,  1e27,  1e28,  1e29,  1e30,  1e31,  1e32,  1e33,
    1e34,  1e35,  1e36,  1e37,  1e38,  1e39,  1e40,  1e41,  1e42,  1e43,  1e44,  1e45,  1e46,
    1e47,  1e48,  1e49,  1e50,  1e51,  1e52,  1e53,  1e54,
};

/* Finds digits and exponent such that magnitude = digits * 10^(exponent - 8), digits rounded;
 * returns false if the rounding is in doubt. */
static bool to_decimal(double magnitude, uint32_t *digits, int *exponent) {
    int binary;
    frexp(magnitude, &binary);
    /* floor(log10(magnitude)), or one more */
    int decimal = (int)floor((binary)*0.30102999566398120);
    double scaled = magnitude * powers[DIGITS - 1 - decimal - POWER_FIRST];
    if (scaled < LEAST)
        scaled = magnitude * powers[DIGITS - 1 - --decimal - POWER_FIRST];
    const double whole = floor(scaled), rest = scaled - whole;
    *digits = (uint32_t)whole + (rest > 0.5);
    if (*digits == 10 * LEAST) {
        *digits = LEAST;
        decimal++;
    }
    *exponent = decimal;
    return fabs(rest - 0.5) > DOUBT;
}

static void split_digits(uint32_t number, char digits[DIGITS]) {
    for (int i = DIGITS - 1; i >= 0; i--, number /= 10)
        digits[i] = (char)('0' + number % 10);
}

/* Writes digits without an exponent, such as 0.000123 and 1234.5. */
static char *write_plain(char *out, const char *digits, int count, int exponent) {
    if (exponent < 0) {
        memcpy(out, "0.0000", 6);
        out += 1 - exponent;
        memcpy(out, digits, (size_t)count);
        return out + count;
    }
    for (int i = 0; i < count || i <= exponent; i++) {
        if (i == exponent + 1)
            *out++ = '.';
        *out++ = i < count ? digits[i] : '0';
    }
    return out;
}

/* Writes digits with an exponent, such as 1.23e-07. */
static char *write_scientific(char *out, const char *digits, int count, int exponent) {
    *out++ = digits[0];
    if (count > 1) {
        *out++ = '.';
        memcpy(out, digits + 1, (size_t)count - 1);
        out += count - 1;
    }
    *out++ = 'e';
    *out++ = exponent < 0 ? '-' : '+';
    const int size = exponent < 0 ? -exponent : exponent;
    *out++ = (char)('0' + size / 10);
    *out++ = (char)('0' + size % 10);
    return out;
}

size_t csv_format(float value, char text[CSV_TEXT_MAX]) {
    char *out = text;
    if (value == 0.0f) {
        *out = '0';
        return 1;
    }
    uint32_t number;
    int exponent;
    if (!to_decimal(fabs((double)value), &number, &exponent)) {
        char printed[CSV_TEXT_MAX + 1];
        const int length = snprintf(printed, sizeof printed, "%.9g", (double)value);
        memcpy(text, printed, (size_t)length);
        return (size_t)length;
    }
    char digits[DIGITS];
    split_digits(number, digits);
    int count = DIGITS;
    while (digits[count - 1] == '0')
        count--;
    if (value < 0.0f)
        *out++ = '-';
    const bool plain = exponent >= -4 && exponent < DIGITS;
    out = plain ? write_plain(out, digits, count, exponent)
                : write_scientific(out, digits, count, exponent);
    return (size_t)(out - text);
}
