/* SPDX-License-Identifier: MIT */
/* png.h - turns inputs into PNG files that pass the checksums and the deflated streams, which the
 * rest of a reader lies behind. A file gets valid checksums. Any other input describes a file: 13
 * bytes of header, then chunks, each with a byte for its name, one for its length, and its data,
 * deflated if the chunk requires it. */
#ifndef LAMPION_FUZZ_PNG_H
#define LAMPION_FUZZ_PNG_H

#include "fuzz/file.h"

#include <stdlib.h>
#include <string.h>
#include <zlib.h>

typedef struct fuzz_png {
    unsigned char *bytes;
    size_t size;
} fuzz_png;

static inline uint32_t fuzz_png_number(const unsigned char *at) {
    return (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 | (uint32_t)at[2] << 8 | at[3];
}

static inline void fuzz_png_store(unsigned char *at, uint32_t number) {
    for (int i = 0; i < 4; i++)
        at[i] = (unsigned char)(number >> (24 - 8 * i));
}

static inline void fuzz_png_mend(const fuzz_png *png) {
    for (size_t at = 8; png->size >= 12 && at <= png->size - 12;) {
        const uint32_t length = fuzz_png_number(png->bytes + at);
        if (length > png->size - 12 - at)
            return;
        unsigned char *const name = png->bytes + at + 4;
        fuzz_png_store(name + 4 + length, (uint32_t)crc32(0, name, 4 + length));
        at += 12 + length;
    }
}

static inline void fuzz_png_add(fuzz_png *png, const char *name, const void *data, size_t size) {
    unsigned char *const at = png->bytes + png->size;
    fuzz_png_store(at, (uint32_t)size);
    memcpy(at + 4, name, 4);
    if (size > 0)
        memcpy(at + 8, data, size);
    png->size += 12 + size;
}

/* Adds a chunk whose first `plain` bytes are as they are, and the rest deflated. */
static inline void fuzz_png_add_deflated(fuzz_png *png, const char *name, const uint8_t *data,
                                         size_t size, size_t plain) {
    unsigned char chunk[1024];
    const size_t before = plain < size ? plain : size;
    uLongf length = sizeof chunk - before;
    memcpy(chunk, data, before);
    if (compress2(chunk + before, &length, data + before, size - before, 1) == Z_OK)
        fuzz_png_add(png, name, chunk, before + length);
}

/* Makes a file of the common chunks; the table tells how many bytes precede the deflated part of
 * each. */
static inline void fuzz_png_describe(fuzz_png *png, const uint8_t *data, size_t size) {
    static const struct {
        char name[5];
        int plain; /* -1: all bytes */
    } chunks[] = { { "IDAT", 0 },  { "IDAT", -1 }, { "PLTE", -1 }, { "tRNS", -1 }, { "gAMA", -1 },
                   { "sRGB", -1 }, { "tEXt", -1 }, { "zTXt", 9 },  { "iTXt", -1 }, { "iTXt", 12 },
                   { "iCCP", 9 },  { "cHRM", -1 }, { "sBIT", -1 }, { "bKGD", -1 }, { "IEND", -1 } };
    memcpy(png->bytes, "\x89PNG\r\n\x1a\n", 8);
    png->size = 8;
    fuzz_png_add(png, "IHDR", data, 13);
    for (size_t at = 13; at + 2 <= size;) {
        const size_t kind = data[at] % (sizeof chunks / sizeof *chunks);
        const size_t left = size - at - 2, length = data[at + 1] < left ? data[at + 1] : left;
        if (chunks[kind].plain < 0)
            fuzz_png_add(png, chunks[kind].name, data + at + 2, length);
        else
            fuzz_png_add_deflated(png, chunks[kind].name, data + at + 2, length,
                                  (size_t)chunks[kind].plain);
        at += 2 + length;
    }
    fuzz_png_add(png, "IEND", NULL, 0);
}

/* Makes a PNG file of the input. Free its bytes, which are NULL for inputs that are too short. */
static inline fuzz_png fuzz_png_make(const uint8_t *data, size_t size) {
    fuzz_png png = { .bytes = NULL };
    if (size < 13)
        return png;
    png.bytes = calloc(1, 16 * size + 1024);
    if (!png.bytes)
        abort();
    if (memcmp(data, "\x89PNG", 4) == 0) {
        memcpy(png.bytes, data, size);
        png.size = size;
    } else {
        fuzz_png_describe(&png, data, size);
    }
    fuzz_png_mend(&png);
    return png;
}

#endif
