/* SPDX-License-Identifier: MIT */
/* PNG with or without a text chunk, which libpng's simplified API does not support. */
#include "app/base/file_writer.h"
#include "app/image/png.h"

#include <errno.h>
#include <png.h>
#include <stdlib.h>
#include <string.h>

/* Handles an error of libpng, which must not return: stores the message and jumps to setjmp. */
static void on_error(png_structp png, png_const_charp message) {
    base_error *error = png_get_error_ptr(png);
    snprintf(error->text, sizeof error->text, "%s", message);
    png_longjmp(png, 1);
}

static void on_warning(png_structp png, png_const_charp message) {
    (void)png;
    (void)message;
}

/* Takes a third of the time of zlib's default level 6, for 6 % more bytes in a rendered image. */
static const int compression = 4;

/* --- writing ---------------------------------------------------------------------------------- */

static void set_text(png_structp png, png_infop info, const image_text *text) {
    /* libpng takes pointers to non-const texts, which it only reads */
    char *key = strdup(text->key), *value = strdup(text->text);
    png_text chunk = { .compression = PNG_ITXT_COMPRESSION_zTXt, .key = key, .text = value };
    if (key && value)
        png_set_text(png, info, &chunk, 1);
    free(key);
    free(value);
}

static bool write_stream(png_structp png, png_infop info, FILE *stream, const unsigned char *rgb8,
                         int width, int height, const image_text *text) {
    if (setjmp(png_jmpbuf(png)))
        return false;
    png_init_io(png, stream);
    png_set_compression_level(png, compression);
    png_set_IHDR(png, info, (png_uint_32)width, (png_uint_32)height, 8, PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    if (text)
        set_text(png, info, text);
    png_write_info(png, info);
    for (int y = 0; y < height; y++)
        png_write_row(png, rgb8 + 3 * (size_t)width * (size_t)y);
    png_write_end(png, NULL);
    return true;
}

bool image_write_png8_text(const unsigned char *rgb8, int width, int height, const image_text *text,
                           const char *path, base_error *error) {
    file_writer writer;
    base_error complaint = { "out of memory" };
    if (!file_write_begin(&writer, path, error))
        return false;
    png_structp png =
        png_create_write_struct(PNG_LIBPNG_VER_STRING, &complaint, on_error, on_warning);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    const bool ok = info && write_stream(png, info, writer.stream, rgb8, width, height, text);
    png_destroy_write_struct(&png, &info);
    return ok ? file_write_commit(&writer, error) : file_write_fail(&writer, complaint.text, error);
}

/* --- reading ---------------------------------------------------------------------------------- */

static const char *find_text(png_structp png, png_infop info, const char *key) {
    png_textp chunks = NULL;
    int count = 0;
    png_get_text(png, info, &chunks, &count);
    for (int i = 0; i < count; i++)
        if (strcmp(chunks[i].key, key) == 0)
            return chunks[i].text;
    return NULL;
}

/* The unread rest of a file in memory. */
typedef struct remainder {
    const unsigned char *data;
    size_t size;
} remainder;

static void take_bytes(png_structp png, png_bytep bytes, size_t count) {
    remainder *const rest = png_get_io_ptr(png);
    if (count > rest->size)
        png_error(png, "it ends early");
    memcpy(bytes, rest->data, count);
    rest->data += count;
    rest->size -= count;
}

/* Reads the chunks before the pixels. */
static bool decode_chunks(png_structp png, png_infop info, remainder *rest) {
    if (setjmp(png_jmpbuf(png)))
        return false;
    png_set_read_fn(png, rest, take_bytes);
    png_set_chunk_malloc_max(png, IMAGE_TEXT_MAX);
    png_set_chunk_cache_max(png, 64);
    png_read_info(png, info);
    return true;
}

bool image_decode_png_text(const image_source *source, const char *key, char **text,
                           base_error *error) {
    base_error complaint = { "out of memory" };
    remainder rest = { source->data, source->size };
    *text = NULL;
    png_structp png =
        png_create_read_struct(PNG_LIBPNG_VER_STRING, &complaint, on_error, on_warning);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    const bool ok = info && decode_chunks(png, info, &rest);
    const char *found = ok ? find_text(png, info, key) : NULL;
    if (found)
        *text = strdup(found);
    else if (ok)
        base_fail(error, source->path,
                  "holds no settings of Lampion (a screenshot of lampion view does)");
    else
        base_fail(error, source->path, "is damaged, truncated or not a PNG (%s)", complaint.text);
    png_destroy_read_struct(&png, &info, NULL);
    return found && (*text || base_fail(error, source->path, "out of memory"));
}
