/* SPDX-License-Identifier: MIT */
/* exr_read.c - OpenEXR images as linear RGB: from colors, from luminance, or from luminance and
 * chroma. */
#include "app/image/exr.h"
#include "app/image/exr_luminance.h"

#include <math.h>
#include <openexr.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Swallows OpenEXR's errors, which it would otherwise print itself. */
static void on_error(exr_const_context_t context, exr_result_t code, const char *message) {
    (void)context;
    (void)code;
    (void)message;
}

/* The destination of a channel's samples. */
typedef struct plane {
    char name[256];
    float *samples;
    int stride;              /* floats from one sample to the next */
    int width, height, step; /* in samples, one each `step` pixels along both axes */
} plane;

/* The channels that are read: R, G and B, or Y, or Y, RY and BY. */
typedef struct planes {
    plane items[3];
    int count;
} planes;

/* Directs a chunk's channels to their planes; others are skipped. */
static exr_result_t set_decoder(exr_decode_pipeline_t *decoder, const planes *to, int64_t column,
                                int64_t row) {
    int found = 0;
    for (int c = 0; c < decoder->channel_count; c++) {
        exr_coding_channel_info_t *channel = &decoder->channels[c];
        channel->decode_to_ptr = NULL;
        for (int i = 0; i < to->count; i++) {
            const plane *const p = &to->items[i];
            if (strcmp(channel->channel_name, p->name) != 0)
                continue;
            /* the first row of the chunk that has samples */
            const int64_t first = (row + p->step - 1) / p->step;
            if (channel->x_samples != p->step || channel->y_samples != p->step ||
                channel->data_type == EXR_PIXEL_UINT || channel->width + column > p->width ||
                channel->height + first > p->height || column < 0 || row < 0)
                return EXR_ERR_FEATURE_NOT_IMPLEMENTED;
            float *const samples = p->samples + (first * p->width + column) * p->stride;
            channel->decode_to_ptr = (uint8_t *)samples;
            channel->user_pixel_stride = p->stride * (int32_t)sizeof(float);
            channel->user_line_stride = p->width * p->stride * (int32_t)sizeof(float);
            channel->user_bytes_per_element = sizeof(float);
            channel->user_data_type = EXR_PIXEL_FLOAT;
            found++;
        }
    }
    return found == to->count ? EXR_ERR_SUCCESS : EXR_ERR_MISSING_REQ_ATTR;
}

static float from_half(uint32_t bits) {
    const int exponent = bits >> 10 & 31, mantissa = bits & 1023;
    const float magnitude = exponent == 31  ? mantissa ? NAN : INFINITY
                            : exponent == 0 ? ldexpf((float)mantissa, -24)
                                            : ldexpf((float)(mantissa + 1024), exponent - 25);
    return bits >> 15 ? -magnitude : magnitude;
}

/* Unpacks one row of a channel, which is stored in little-endian order. */
static void unpack_row(const exr_coding_channel_info_t *channel, const uint8_t *from, float *to,
                       int stride) {
    for (int x = 0; x < channel->width; x++, from += channel->bytes_per_element, to += stride) {
        const uint32_t low = from[0] | (uint32_t)from[1] << 8;
        if (channel->data_type == EXR_PIXEL_HALF) {
            *to = from_half(low);
        } else {
            const uint32_t bits = low | (uint32_t)from[2] << 16 | (uint32_t)from[3] << 24;
            memcpy(to, &bits, sizeof bits);
        }
    }
}

/* Unpacks subsampled channels, some of whose rows OpenEXRCore 3.1 would handle as if they were
 * not. */
static exr_result_t unpack_subsampled(exr_decode_pipeline_t *decoder) {
    const uint8_t *from = decoder->unpacked_buffer;
    uint64_t left = decoder->chunk.unpacked_size;
    for (int y = 0; y < decoder->chunk.height; y++)
        for (int c = 0; c < decoder->channel_count; c++) {
            const exr_coding_channel_info_t *const channel = &decoder->channels[c];
            const uint64_t size =
                (uint64_t)channel->width * (uint64_t)(uint8_t)channel->bytes_per_element;
            if (channel->height == 0 || (decoder->chunk.start_y + y) % channel->y_samples != 0)
                continue;
            if (size > left)
                return EXR_ERR_CORRUPT_CHUNK;
            uint8_t *const to = channel->decode_to_ptr;
            if (to)
                unpack_row(channel, from,
                           (float *)(void *)(to + (ptrdiff_t)(y / channel->y_samples) *
                                                      channel->user_line_stride),
                           channel->user_pixel_stride / (int32_t)sizeof(float));
            from += size;
            left -= size;
        }
    return EXR_ERR_SUCCESS;
}

static exr_result_t decode(exr_const_context_t context, const exr_chunk_info_t *chunk,
                           const planes *to, int64_t column, int64_t row) {
    exr_decode_pipeline_t decoder = EXR_DECODE_PIPELINE_INITIALIZER;
    exr_result_t r = exr_decoding_initialize(context, 0, chunk, &decoder);
    if (r == EXR_ERR_SUCCESS)
        r = set_decoder(&decoder, to, column, row);
    if (r == EXR_ERR_SUCCESS)
        r = exr_decoding_choose_default_routines(context, 0, &decoder);
    if (to->items[to->count - 1].step > 1)
        decoder.unpack_and_convert_fn = unpack_subsampled;
    if (r == EXR_ERR_SUCCESS)
        r = exr_decoding_run(context, 0, &decoder);
    exr_decoding_destroy(context, &decoder);
    return r;
}

static exr_result_t read_scanlines(exr_const_context_t context, int top, int height,
                                   const planes *to) {
    exr_chunk_info_t chunk;
    int32_t step = 1;
    exr_result_t r = exr_get_scanlines_per_chunk(context, 0, &step);
    for (int row = 0; row < height && r == EXR_ERR_SUCCESS; row += step) {
        r = exr_read_scanline_chunk_info(context, 0, top + row, &chunk);
        if (r == EXR_ERR_SUCCESS)
            r = decode(context, &chunk, to, 0, row);
    }
    return r;
}

static exr_result_t read_tiles(exr_const_context_t context, const image *pixels, const planes *to) {
    exr_chunk_info_t chunk;
    int32_t width = 0, height = 0;
    exr_result_t r = exr_get_tile_sizes(context, 0, 0, 0, &width, &height);
    if (r == EXR_ERR_SUCCESS && (width < 1 || height < 1))
        r = EXR_ERR_INVALID_ATTR;
    for (int y = 0; r == EXR_ERR_SUCCESS && y * (int64_t)height < pixels->height; y++)
        for (int x = 0; r == EXR_ERR_SUCCESS && x * (int64_t)width < pixels->width; x++) {
            r = exr_read_tile_chunk_info(context, 0, x, y, 0, 0, &chunk);
            if (r == EXR_ERR_SUCCESS)
                r = decode(context, &chunk, to, x * (int64_t)width, y * (int64_t)height);
        }
    return r;
}

/* --- what a file has -------------------------------------------------------------------------- */

static const exr_attr_chlist_entry_t *find_channel(exr_const_context_t context, const char *name) {
    const exr_attr_chlist_t *list;
    if (exr_get_channels(context, 0, &list) != EXR_ERR_SUCCESS)
        return NULL;
    for (int i = 0; i < list->num_channels; i++)
        if (strcmp(list->entries[i].name.str, name) == 0)
            return &list->entries[i];
    return NULL;
}

static void make_plane(plane *p, const char *layer, const char *channel, float *samples, int stride,
                       const image *pixels, int step) {
    const bool named = layer && layer[0];
    snprintf(p->name, sizeof p->name, "%s%s%s", named ? layer : "", named ? "." : "", channel);
    p->samples = samples;
    p->stride = stride;
    p->width = (pixels->width + step - 1) / step;
    p->height = (pixels->height + step - 1) / step;
    p->step = step;
}

/* Chooses the channels to read: R, G and B if the file has them or has no Y either; else Y as
 * green, and chroma if there is any, into memory of its own. */
static exr_result_t choose_planes(exr_const_context_t context, const char *layer, image *pixels,
                                  planes *to, exr_chroma chroma[2]) {
    static const char *const colors[3] = { "R", "G", "B" }, *const differences[2] = { "RY", "BY" };
    for (int i = 0; i < 3; i++)
        make_plane(&to->items[i], layer, colors[i], pixels->rgb + i, 3, pixels, 1);
    to->count = 3;
    plane y, c[2];
    make_plane(&y, layer, "Y", pixels->rgb + 1, 3, pixels, 1);
    if (find_channel(context, to->items[0].name) || !find_channel(context, y.name))
        return EXR_ERR_SUCCESS;
    to->items[0] = y;
    to->count = 1;
    for (int i = 0; i < 2; i++) {
        make_plane(&c[i], layer, differences[i], NULL, 1, pixels, 1);
        const exr_attr_chlist_entry_t *const entry = find_channel(context, c[i].name);
        if (!entry)
            return EXR_ERR_SUCCESS;
        chroma[i].step = entry->x_sampling == 1 ? 1 : 2;
    }
    for (int i = 0; i < 2; i++) {
        make_plane(&c[i], layer, differences[i], NULL, 1, pixels, chroma[i].step);
        chroma[i].samples = calloc((size_t)c[i].width * (size_t)c[i].height, sizeof(float));
        if (!chroma[i].samples)
            return EXR_ERR_OUT_OF_MEMORY;
        c[i].samples = chroma[i].samples;
        to->items[to->count++] = c[i];
    }
    return chroma[0].step == chroma[1].step ? EXR_ERR_SUCCESS : EXR_ERR_FEATURE_NOT_IMPLEMENTED;
}

static void read_weights(exr_const_context_t context, double weights[3]) {
    exr_attr_chromaticities_t c;
    if (exr_attr_get_chromaticities(context, 0, "chromaticities", &c) != EXR_ERR_SUCCESS)
        c = (exr_attr_chromaticities_t) { 0.64f, 0.33f, 0.3f, 0.6f, 0.15f, 0.06f, 0.3127f, 0.329f };
    const float primaries[3][2] = { { c.red_x, c.red_y },
                                    { c.green_x, c.green_y },
                                    { c.blue_x, c.blue_y } };
    const float white[2] = { c.white_x, c.white_y };
    exr_luminance_weights(primaries, white, weights);
}

static void make_gray(image *pixels) {
    for (size_t i = 0; i < (size_t)pixels->width * (size_t)pixels->height; i++)
        pixels->rgb[3 * i] = pixels->rgb[3 * i + 2] = pixels->rgb[3 * i + 1];
}

static exr_result_t read_pixels(exr_const_context_t context, const char *layer, int top,
                                exr_storage_t storage, image *pixels) {
    planes to;
    exr_chroma chroma[2] = { { NULL, 0 }, { NULL, 0 } };
    double weights[3];
    exr_result_t r = choose_planes(context, layer, pixels, &to, chroma);
    if (r == EXR_ERR_SUCCESS)
        r = storage == EXR_STORAGE_TILED ? read_tiles(context, pixels, &to)
                                         : read_scanlines(context, top, pixels->height, &to);
    if (r == EXR_ERR_SUCCESS && chroma[1].samples) {
        read_weights(context, weights);
        if (!exr_luminance_to_rgb(pixels, &chroma[0], &chroma[1], weights))
            r = EXR_ERR_OUT_OF_MEMORY;
    } else if (r == EXR_ERR_SUCCESS && to.count == 1) {
        make_gray(pixels);
    }
    free(chroma[0].samples);
    free(chroma[1].samples);
    return r;
}

static bool decode_part(exr_const_context_t context, const image_source *source, image *pixels,
                        base_error *error) {
    const char *const path = source->path;
    exr_attr_box2i_t window;
    exr_storage_t storage = EXR_STORAGE_LAST_TYPE;
    exr_result_t r = exr_get_data_window(context, 0, &window);
    if (r == EXR_ERR_SUCCESS)
        r = exr_get_storage(context, 0, &storage);
    if (r != EXR_ERR_SUCCESS)
        return base_fail(error, path, "is damaged, or not an OpenEXR image (%s)",
                         exr_get_default_error_message(r));
    if (storage != EXR_STORAGE_SCANLINE && storage != EXR_STORAGE_TILED)
        return base_fail(error, path, "deep OpenEXR images are not supported");
    if (!image_create_decoded(source, (long long)window.max.x - window.min.x + 1,
                              (long long)window.max.y - window.min.y + 1, pixels, error))
        return false;
    r = read_pixels(context, source->layer, window.min.y, storage, pixels);
    if (r == EXR_ERR_SUCCESS)
        return true;
    image_free(pixels);
    if (r == EXR_ERR_MISSING_REQ_ATTR && source->layer)
        return base_fail(error, path, "has no layer \"%s\"", source->layer);
    if (r == EXR_ERR_MISSING_REQ_ATTR || r == EXR_ERR_FEATURE_NOT_IMPLEMENTED)
        return base_fail(error, path, "needs channels R, G and B, or Y, of half or float");
    return base_fail(error, path, "damaged OpenEXR: %s", exr_get_default_error_message(r));
}

static int64_t size_of_source(exr_const_context_t context, void *user) {
    (void)context;
    return (int64_t)((const image_source *)user)->size;
}

static int64_t read_at(exr_const_context_t context, void *user, void *to, uint64_t size,
                       uint64_t offset, exr_stream_error_func_ptr_t fail) {
    const image_source *const source = user;
    (void)context;
    (void)fail;
    const uint64_t left = offset < source->size ? source->size - offset : 0;
    const uint64_t count = size < left ? size : left;
    if (count > 0)
        memcpy(to, source->data + offset, count);
    return (int64_t)count;
}

bool image_decode_exr(const image_source *source, image *pixels, base_error *error) {
    image_source bytes = *source;
    exr_context_initializer_t setup = EXR_DEFAULT_CONTEXT_INITIALIZER;
    setup.user_data = &bytes;
    setup.read_fn = read_at;
    setup.size_fn = size_of_source;
    setup.error_handler_fn = on_error;
    exr_context_t context = NULL;
    const exr_result_t r = exr_start_read(&context, source->path, &setup);
    if (r != EXR_ERR_SUCCESS)
        return base_fail(error, source->path, "is damaged, or not an OpenEXR image (%s)",
                         exr_get_default_error_message(r));
    const bool ok = decode_part(context, source, pixels, error);
    exr_finish(&context);
    return ok;
}
