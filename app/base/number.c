/* SPDX-License-Identifier: MIT */
#include "app/base/number.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

bool number_read(const char *text, size_t length, double *value) {
    char number[64], *stop; /* copied, because strtod would read on: 0x480 is also a number */
    if (length == 0 || length >= sizeof number || strspn(text, "+-.eE0123456789") < length)
        return false;
    memcpy(number, text, length);
    number[length] = '\0';
    *value = strtod(number, &stop);
    return *stop == '\0' && isfinite(*value);
}
