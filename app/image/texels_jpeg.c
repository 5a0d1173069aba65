/* SPDX-License-Identifier: MIT */
/* texels_jpeg.c - JPEG by libjpeg-turbo: baseline, progressive and arithmetic; gray, YCbCr, RGB,
 * CMYK and YCCK. A damaged or truncated file is decoded as far as possible, as in browsers. */
#include "app/image/texels.h"

#include <setjmp.h>
#include <stdio.h>
#include <string.h>

#include <jpeglib.h>

/* The most scans of a progressive image: more would take unlimited time for few bytes. */
#define SCANS_MAX 500

typedef struct reading {
    struct jpeg_decompress_struct jpeg; /* first, so that a pointer to it points to the whole */
    struct jpeg_error_mgr errors;
    struct jpeg_progress_mgr progress;
    jmp_buf failed;
    texels_reason *reason;
} reading;

static _Noreturn void on_error(j_common_ptr jpeg) {
    reading *const r = (reading *)jpeg;
    char text[JMSG_LENGTH_MAX];
    r->errors.format_message(jpeg, text);
    snprintf(r->reason->text, sizeof r->reason->text, "libjpeg: %.140s", text);
    longjmp(r->failed, 1);
}

static void on_message(j_common_ptr jpeg) {
    (void)jpeg;
}

static void count_scans(j_common_ptr jpeg) {
    const reading *const r = (reading *)jpeg;
    if (r->jpeg.input_scan_number <= SCANS_MAX)
        return;
    snprintf(r->reason->text, sizeof r->reason->text, "it has more than %d scans", SCANS_MAX);
    longjmp(((reading *)jpeg)->failed, 1);
}

/* Initializes what jpeg_destroy_decompress can clean up at any later time. */
static void begin(reading *r, texels_reason *reason) {
    memset(r, 0, sizeof *r);
    r->reason = reason;
    r->jpeg.err = jpeg_std_error(&r->errors);
    r->errors.error_exit = on_error;
    r->errors.output_message = on_message;
}

static void read_header(reading *r, const unsigned char *data, size_t size) {
    jpeg_create_decompress(&r->jpeg);
    r->progress.progress_monitor = count_scans;
    r->jpeg.progress = &r->progress;
    jpeg_mem_src(&r->jpeg, data, size);
    jpeg_read_header(&r->jpeg, TRUE);
}

static bool begins(const unsigned char *data, size_t size) {
    return size >= 3 && memcmp(data, "\xff\xd8\xff", 3) == 0;
}

static bool measure(const unsigned char *data, size_t size, int *width, int *height,
                    texels_reason *reason) {
    reading r;
    begin(&r, reason);
    const bool ok = setjmp(r.failed) == 0;
    if (ok) {
        read_header(&r, data, size);
        *width = (int)r.jpeg.image_width;
        *height = (int)r.jpeg.image_height;
    }
    jpeg_destroy_decompress(&r.jpeg);
    return ok;
}

/* Returns a b / 255, rounded. */
static unsigned char product(unsigned a, unsigned b) {
    const unsigned t = a * b + 128;
    return (unsigned char)((t + (t >> 8)) >> 8);
}

/* Converts four inks to RGBA in place. Adobe's files store inverted values: 255 means no ink. */
static void mix_inks(unsigned char *row, size_t width, bool adobe) {
    const unsigned flip = adobe ? 0 : 255;
    for (size_t x = 0; x < width; x++, row += 4) {
        for (int i = 0; i < 3; i++)
            row[i] = product(row[i] ^ flip, row[3] ^ flip);
        row[3] = 255;
    }
}

static void read_rows(reading *r, int width, unsigned char *rgba) {
    struct jpeg_decompress_struct *const jpeg = &r->jpeg;
    const bool inks = jpeg->num_components == 4;
    jpeg->out_color_space = inks ? JCS_CMYK : JCS_EXT_RGBA;
    jpeg_start_decompress(jpeg);
    while (jpeg->output_scanline < jpeg->output_height) {
        unsigned char *row = rgba + 4 * (size_t)width * jpeg->output_scanline;
        jpeg_read_scanlines(jpeg, &row, 1);
        if (inks)
            mix_inks(row, (size_t)width, jpeg->saw_Adobe_marker);
    }
}

static bool decode(const unsigned char *data, size_t size, int width, int height,
                   unsigned char *rgba, texels_reason *reason) {
    reading r;
    begin(&r, reason);
    volatile bool ok = false;
    if (setjmp(r.failed) == 0) {
        read_header(&r, data, size);
        ok = r.jpeg.image_width == (JDIMENSION)width && r.jpeg.image_height == (JDIMENSION)height;
        if (ok)
            read_rows(&r, width, rgba);
    }
    jpeg_destroy_decompress(&r.jpeg);
    return ok;
}

const texels_decoder texels_jpeg = { begins, measure, decode };
