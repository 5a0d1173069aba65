/* SPDX-License-Identifier: MIT */
/* number.h - strict reading of decimal numbers. */
#ifndef LAMPION_BASE_NUMBER_H
#define LAMPION_BASE_NUMBER_H

#include <stdbool.h>
#include <stddef.h>

/* Reads a decimal number that takes up all of `length` bytes: no blanks, hexadecimal, nan or
 * infinity, nor anything outside the range of a double. */
bool number_read(const char *text, size_t length, double *value);

#endif
