/* SPDX-License-Identifier: MIT */
/* texels_png.c - PNG by libpng: every color type and depth, interlaced or not. */
#include "app/image/texels.h"

#include <png.h>
#include <setjmp.h>
#include <stdio.h>
#include <string.h>

enum { SIGNATURE = 8, SIZE_AT = 16, SIZE_END = 24 };

static bool begins(const unsigned char *data, size_t size) {
    return size >= SIGNATURE && png_sig_cmp(data, 0, SIGNATURE) == 0;
}

static bool measure(const unsigned char *data, size_t size, int *width, int *height,
                    texels_reason *reason) {
    if (size < SIZE_END || memcmp(data + SIZE_AT - 4, "IHDR", 4) != 0) {
        snprintf(reason->text, sizeof reason->text, "it has no header");
        return false;
    }
    const png_uint_32 w = png_get_uint_32(data + SIZE_AT), h = png_get_uint_32(data + SIZE_AT + 4);
    *width = w <= PNG_UINT_31_MAX ? (int)w : 0;
    *height = h <= PNG_UINT_31_MAX ? (int)h : 0;
    return true;
}

typedef struct reading {
    const unsigned char *at;
    size_t left;
    int width, height;
    unsigned char *rgba;
    texels_reason *reason;
} reading;

static void read_bytes(png_structp png, png_bytep to, size_t count) {
    reading *const r = png_get_io_ptr(png);
    if (count > r->left)
        png_error(png, "it is truncated");
    memcpy(to, r->at, count);
    r->at += count;
    r->left -= count;
}

static _Noreturn void on_error(png_structp png, png_const_charp message) {
    reading *const r = png_get_error_ptr(png);
    snprintf(r->reason->text, sizeof r->reason->text, "%s", message);
    png_longjmp(png, 1);
}

static void on_warning(png_structp png, png_const_charp message) {
    (void)png;
    (void)message;
}

/* Requests 8-bit RGBA whatever is stored; of 16 bits the upper 8 are used. */
static void ask_for_rgba(png_structp png) {
    png_set_expand(png);
    png_set_strip_16(png);
    png_set_gray_to_rgb(png);
    png_set_add_alpha(png, 0xff, PNG_FILLER_AFTER);
}

static void read_image(png_structp png, png_infop info, const reading *r) {
    const size_t row = 4 * (size_t)r->width;
    /* ignore color spaces, texts and thumbnails */
    png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, NULL, -1);
    png_read_info(png, info);
    ask_for_rgba(png);
    const int passes = png_set_interlace_handling(png);
    png_read_update_info(png, info);
    if (png_get_rowbytes(png, info) != row ||
        png_get_image_height(png, info) != (png_uint_32)r->height)
        png_error(png, "its header is there twice");
    for (int pass = 0; pass < passes; pass++)
        for (int y = 0; y < r->height; y++)
            png_read_row(png, r->rgba + row * (size_t)y, NULL);
}

static bool decode(const unsigned char *data, size_t size, int width, int height,
                   unsigned char *rgba, texels_reason *reason) {
    reading r = { data, size, width, height, rgba, reason };
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &r, on_error, on_warning);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    bool ok = false;
    if (!info) {
        snprintf(reason->text, sizeof reason->text, "out of memory");
    } else if (setjmp(png_jmpbuf(png)) == 0) {
        png_set_read_fn(png, &r, read_bytes);
        read_image(png, info, &r);
        ok = true;
    }
    png_destroy_read_struct(&png, &info, NULL);
    return ok;
}

const texels_decoder texels_png = { begins, measure, decode };
