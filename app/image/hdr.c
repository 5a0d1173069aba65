/* SPDX-License-Identifier: MIT */
#include "app/image/hdr.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PACKED_WIDTH_MIN = 8, PACKED_WIDTH_MAX = 32767, SHIFT_MAX = 24 };

/* The unread rest of a file. */
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

/* A line of any length without its end, LF or CRLF. */
typedef struct line {
    const char *text;
    size_t length;
} line;

static bool is_blank(char c) {
    return c == ' ' || c == '\t';
}

static bool take_line(rest *file, line *l) {
    const unsigned char *end = file->size ? memchr(file->at, '\n', file->size) : NULL;
    if (!end)
        return false;
    *l = (line) { (const char *)file->at, (size_t)(end - file->at) };
    take(file, l->length + 1);
    if (l->length > 0 && l->text[l->length - 1] == '\r')
        l->length--;
    return true;
}

/* Whether the line begins with a name; *value is the text after it, without surrounding blanks. */
static bool begins(const line *l, const char *name, line *value) {
    const size_t length = strlen(name);
    if (l->length < length || memcmp(l->text, name, length) != 0)
        return false;
    *value = (line) { l->text + length, l->length - length };
    for (; value->length > 0 && is_blank(*value->text); value->length--)
        value->text++;
    while (value->length > 0 && is_blank(value->text[value->length - 1]))
        value->length--;
    return true;
}

static bool is(const line *l, const char *text) {
    return l->length == strlen(text) && memcmp(l->text, text, l->length) == 0;
}

/* Reads exactly `count` numbers separated by blanks. */
static bool parse_numbers(const line *l, int count, double *numbers) {
    char text[128];
    snprintf(text, sizeof text, "%.*s", l->length < sizeof text ? (int)l->length : 0, l->text);
    char *at = text;
    for (int i = 0; i < count; i++) {
        char *const begin = at;
        numbers[i] = strtod(begin, &at);
        if (at == begin)
            return false;
    }
    return at[strspn(at, " \t")] == '\0';
}

/* The contents of the header. */
typedef struct description {
    bool xyz;
    double scale[3];     /* factors from stored values to radiance */
    long lines, columns; /* number of scanlines, and pixels per scanline */
    bool upright;        /* whether a scanline is a column of the image */
    bool x_falls, y_rises;
} description;

static bool scale_by(description *d, const line *l, int count) {
    double factors[3];
    if (!parse_numbers(l, count, factors))
        return false;
    for (int c = 0; c < 3; c++) {
        const double factor = factors[count == 1 ? 0 : c];
        if (!(factor > 1e-30 && factor < 1e30))
            return false;
        d->scale[c] /= factor;
        if (!(d->scale[c] > 1e-30 && d->scale[c] < 1e30))
            return false;
    }
    return true;
}

/* Parses the size, such as "-Y 512 +X 1024": rows from the top, pixels from the left. The axis of
 * the scanlines comes first. */
static bool parse_size(const line *l, description *d) {
    char text[64], sign[2], axis[2];
    int end = 0;
    snprintf(text, sizeof text, "%.*s", l->length < sizeof text ? (int)l->length : 0, l->text);
    if (sscanf(text, "%c%c %9ld %c%c %9ld %n", &sign[0], &axis[0], &d->lines, &sign[1], &axis[1],
               &d->columns, &end) != 6 ||
        text[end] != '\0' || axis[0] == axis[1])
        return false;
    for (int i = 0; i < 2; i++)
        if (!strchr("+-", sign[i]) || !strchr("XY", axis[i]))
            return false;
    d->upright = axis[0] == 'X';
    d->x_falls = sign[axis[0] == 'X' ? 0 : 1] == '-';
    d->y_rises = sign[axis[0] == 'Y' ? 0 : 1] == '+';
    return true;
}

static bool read_header(rest *file, description *d, const char *path, base_error *error) {
    line l, value;
    *d = (description) { .scale = { 1, 1, 1 } };
    if (!take_line(file, &l) || !begins(&l, "#?", &value))
        return base_fail(error, path, "no Radiance image (it does not begin with #?)");
    while (take_line(file, &l) && l.length > 0) {
        if (begins(&l, "FORMAT=", &value)) {
            d->xyz = is(&value, "32-bit_rle_xyze");
            if (!d->xyz && !is(&value, "32-bit_rle_rgbe"))
                return base_fail(
                    error, path,
                    "of format \"%.*s\" (32-bit_rle_rgbe and 32-bit_rle_xyze are read)",
                    (int)(value.length < 40 ? value.length : 40), value.text);
        }
        if (begins(&l, "EXPOSURE=", &value) && !scale_by(d, &value, 1))
            return base_fail(error, path, "has an invalid exposure");
        if (begins(&l, "COLORCORR=", &value) && !scale_by(d, &value, 3))
            return base_fail(error, path, "has an invalid color correction");
    }
    return (take_line(file, &l) && parse_size(&l, d)) ||
           base_fail(error, path, "has no size as \"-Y 512 +X 1024\" after its header");
}

/* --- rows ------------------------------------------------------------------------------------- */

/* Unpacks one channel of a row: runs of one byte (128 + n, byte) and of different bytes (n,
 * bytes). */
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

/* Reads pixel by pixel; 1, 1, 1, n repeats the pixel before n times, n in digits of 256. */
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

/* Converts CIE XYZ to linear RGB with Rec. 709's primaries and its white, D65, without a change of
 * Y. Colors out of gamut are clipped to its boundary. */
static void to_rec709(double color[3]) {
    static const double matrix[3][3] = { { 3.2409699419, -1.5373831776, -0.4986107603 },
                                         { -0.9692436363, 1.8759675015, 0.0415550574 },
                                         { 0.0556300797, -0.2039769589, 1.0569715142 } };
    const double xyz[3] = { color[0], color[1], color[2] };
    for (int c = 0; c < 3; c++)
        color[c] = fmax(0, matrix[c][0] * xyz[0] + matrix[c][1] * xyz[1] + matrix[c][2] * xyz[2]);
}

/* Decodes the pixels of a scanline to their positions, `step` apart. */
static void decode_line(const unsigned char *packed, const description *d, float *rgb,
                        ptrdiff_t step) {
    for (long i = 0; i < d->columns; i++, packed += 4, rgb += 3 * step) {
        const double unit = packed[3] ? ldexp(1, packed[3] - 136) : 0;
        double color[3];
        for (int c = 0; c < 3; c++)
            color[c] = packed[c] * unit * d->scale[c];
        if (d->xyz)
            to_rec709(color);
        for (int c = 0; c < 3; c++)
            rgb[c] = (float)color[c];
    }
}

/* Returns the image's pixel at which scanline `i` begins; *step leads to the next. */
static float *first_of(const image *pixels, const description *d, long i, ptrdiff_t *step) {
    const ptrdiff_t width = pixels->width, height = pixels->height;
    const ptrdiff_t x = d->upright ? i : 0, y = d->upright ? 0 : i;
    const ptrdiff_t column = d->x_falls ? width - 1 - x : x, row = d->y_rises ? height - 1 - y : y;
    *step = d->upright ? (d->y_rises ? -width : width) : (d->x_falls ? -1 : 1);
    return pixels->rgb + 3 * (row * width + column);
}

bool image_decode_hdr(const image_source *source, image *pixels, base_error *error) {
    rest file = { source->data, source->size };
    description d;
    if (!read_header(&file, &d, source->path, error) ||
        !image_create_decoded(source, d.upright ? d.lines : d.columns,
                              d.upright ? d.columns : d.lines, pixels, error))
        return false;
    const size_t count = (size_t)d.columns;
    unsigned char *packed = malloc(4 * count);
    bool ok = packed || base_fail(error, source->path, "out of memory");
    for (long i = 0; ok && i < d.lines; i++) {
        ptrdiff_t step;
        float *const rgb = first_of(pixels, &d, i, &step);
        ok = read_row(&file, count, packed) ||
             base_fail(error, source->path, "damaged Radiance image, row %ld", i);
        if (ok)
            decode_line(packed, &d, rgb, step);
    }
    free(packed);
    if (!ok)
        image_free(pixels);
    return ok;
}
