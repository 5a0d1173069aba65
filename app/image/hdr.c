/* SPDX-License-Identifier: MIT */
#include "app/image/hdr.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LINE_SIZE = 256, PACKED_WIDTH_MIN = 8, PACKED_WIDTH_MAX = 32767, SHIFT_MAX = 24 };

/* What is left of a file. */
typedef struct rest {
    const unsigned char *at;
    size_t size;
} rest;

static const unsigned char *take(rest *file, size_t size) {
    const unsigned char *bytes = file->at;
    if (file->size < size)
        return NULL;
    file->at += size;
    file->size -= size;
    return bytes;
}

/* --- the header ------------------------------------------------------------------------------- */

/* A line without its end; false if there is none, or a longer one. */
static bool take_line(rest *file, char line[LINE_SIZE]) {
    const unsigned char *end = file->size ? memchr(file->at, '\n', file->size) : NULL;
    const size_t length = end ? (size_t)(end - file->at) : LINE_SIZE;
    if (length >= LINE_SIZE)
        return false;
    memcpy(line, file->at, length);
    line[length] = '\0';
    take(file, length + 1);
    return strlen(line) == length;
}

/* "-Y 512 +X 1024" */
static bool parse_size(const char *line, long *width, long *height) {
    char *end;
    if (strncmp(line, "-Y ", 3) != 0)
        return false;
    *height = strtol(line + 3, &end, 10);
    if (strncmp(end, " +X ", 4) != 0)
        return false;
    *width = strtol(end + 4, &end, 10);
    return *end == '\0';
}

/* *scale turns what is stored into radiance. */
static bool read_header(rest *file, long *width, long *height, double *scale, const char *path,
                        cli_error *error) {
    char line[LINE_SIZE];
    *scale = 1;
    if (!take_line(file, line) || strncmp(line, "#?", 2) != 0)
        return cli_fail(error, path, "no Radiance image (it does not begin with #?)");
    while (take_line(file, line) && line[0]) {
        if (strncmp(line, "FORMAT=", 7) == 0 && strcmp(line + 7, "32-bit_rle_rgbe") != 0)
            return cli_fail(error, path, "of format \"%.40s\" (32-bit_rle_rgbe is read)", line + 7);
        if (strncmp(line, "EXPOSURE=", 9) == 0) {
            const double exposure = strtod(line + 9, NULL);
            if (!(exposure > 1e-30 && exposure < 1e30))
                return cli_fail(error, path, "has an exposure that makes no sense");
            *scale /= exposure;
        }
    }
    if (!(*scale > 1e-30 && *scale < 1e30))
        return cli_fail(error, path, "has an exposure that makes no sense");
    return (take_line(file, line) && parse_size(line, width, height)) ||
           cli_fail(error, path, "has rows that do not run from the top and from the left");
}

/* --- rows ------------------------------------------------------------------------------------- */

/* One channel of a packed row: runs of one byte (128 + n, byte) and of others (n, bytes). */
static bool unpack(rest *file, size_t width, unsigned char *to) {
    for (size_t x = 0; x < width;) {
        const unsigned char *head = take(file, 1);
        if (!head || *head == 0)
            return false;
        const size_t count = *head > 128 ? *head - 128u : *head;
        const unsigned char *bytes = take(file, *head > 128 ? 1 : count);
        if (!bytes || count > width - x)
            return false;
        for (size_t i = 0; i < count; i++)
            to[4 * (x + i)] = *head > 128 ? bytes[0] : bytes[i];
        x += count;
    }
    return true;
}

/* Pixel by pixel; 1, 1, 1, n is the pixel before n times more, in digits of 256. */
static bool read_plain(rest *file, size_t width, unsigned char *row) {
    unsigned shift = 0;
    for (size_t x = 0; x < width;) {
        const unsigned char *pixel = take(file, 4);
        if (!pixel)
            return false;
        if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
            memcpy(row + 4 * x++, pixel, 4);
            shift = 0;
            continue;
        }
        const size_t count = (size_t)pixel[3] << shift;
        if (x == 0 || shift > SHIFT_MAX || count > width - x)
            return false;
        for (size_t i = 0; i < count; i++, x++)
            memcpy(row + 4 * x, row + 4 * (x - 1), 4);
        shift += 8;
    }
    return true;
}

static bool read_row(rest *file, size_t width, unsigned char *row) {
    const unsigned char *at = file->at;
    const bool packed = width >= PACKED_WIDTH_MIN && width <= PACKED_WIDTH_MAX && file->size >= 4 &&
                        at[0] == 2 && at[1] == 2 && at[2] < 128;
    if (!packed)
        return read_plain(file, width, row);
    if ((size_t)at[2] << 8 != (width & 0xff00) || at[3] != (width & 0xff))
        return false;
    take(file, 4);
    for (size_t channel = 0; channel < 4; channel++)
        if (!unpack(file, width, row + channel))
            return false;
    return true;
}

static void decode_row(const unsigned char *row, size_t width, double scale, float *rgb) {
    for (size_t x = 0; x < width; x++) {
        const unsigned char *pixel = row + 4 * x;
        const double unit = pixel[3] ? ldexp(scale, pixel[3] - 136) : 0;
        for (size_t c = 0; c < 3; c++)
            rgb[3 * x + c] = (float)(pixel[c] * unit);
    }
}

bool image_decode_hdr(const image_source *source, image *pixels, cli_error *error) {
    rest file = { source->data, source->size };
    long width = 0, height = 0;
    double scale;
    if (!read_header(&file, &width, &height, &scale, source->path, error) ||
        !image_create_decoded(source, width, height, pixels, error))
        return false;
    const size_t count = (size_t)pixels->width;
    unsigned char *row = malloc(4 * count);
    bool ok = row || cli_fail(error, source->path, "out of memory");
    for (int y = 0; ok && y < pixels->height; y++) {
        ok = read_row(&file, count, row) ||
             cli_fail(error, source->path, "damaged Radiance image, row %d", y);
        if (ok)
            decode_row(row, count, scale, pixels->rgb + 3 * count * (size_t)y);
    }
    free(row);
    if (!ok)
        image_free(pixels);
    return ok;
}
