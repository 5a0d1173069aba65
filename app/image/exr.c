/* SPDX-License-Identifier: MIT */
#include "app/image/exr.h"

#include "app/file/file.h"

#include <errno.h>
#include <openexr.h>
#include <stdlib.h>
#include <string.h>

enum { CHANNELS_MAX = 3 * IMAGE_LAYERS_MAX };

/* OpenEXR prints its errors by itself unless told where they go. */
static void on_error(exr_const_context_t context, exr_result_t code, const char *message) {
    (void)context;
    (void)code;
    (void)message;
}

/* --- writing ---------------------------------------------------------------------------------- */

static int64_t write_at(exr_const_context_t context, void *user, const void *data, uint64_t size,
                        uint64_t offset, exr_stream_error_func_ptr_t fail) {
    FILE *stream = user;
    if (fseeko(stream, (off_t)offset, SEEK_SET) || fwrite(data, 1, size, stream) != size) {
        fail(context, EXR_ERR_WRITE_IO, "%s", strerror(errno));
        return -1;
    }
    return (int64_t)size;
}

/* "R" or "name.R". */
static void channel_name(const image_layer *layer, int channel, char *name, size_t size) {
    const bool named = layer->name && layer->name[0];
    snprintf(name, size, "%s%s%c", named ? layer->name : "", named ? "." : "", "RGB"[channel]);
}

static exr_result_t define_file(exr_context_t context, const image_layer *layers, int count) {
    int part = 0;
    char name[256];
    exr_result_t r = exr_add_part(context, NULL, EXR_STORAGE_SCANLINE, &part);
    if (r == EXR_ERR_SUCCESS)
        r = exr_initialize_required_attr_simple(context, part, layers->image->width,
                                                layers->image->height, EXR_COMPRESSION_ZIP);
    for (int i = 0; i < 3 * count && r == EXR_ERR_SUCCESS; i++) {
        channel_name(&layers[i / 3], i % 3, name, sizeof name);
        r = exr_add_channel(context, part, name, EXR_PIXEL_FLOAT, EXR_PERCEPTUALLY_LOGARITHMIC, 1,
                            1);
    }
    return r == EXR_ERR_SUCCESS ? exr_write_header(context) : r;
}

/* Where the encoder takes the rows of its channels from; the file has them sorted by name. */
static void set_encoder(exr_encode_pipeline_t *encoder, const image_layer *layers, int count,
                        int row) {
    char name[256];
    for (int c = 0; c < encoder->channel_count; c++)
        for (int i = 0; i < 3 * count; i++) {
            const image *pixels = layers[i / 3].image;
            channel_name(&layers[i / 3], i % 3, name, sizeof name);
            if (strcmp(name, encoder->channels[c].channel_name) != 0)
                continue;
            const float *from =
                pixels->rgb + 3 * (size_t)row * (size_t)pixels->width + (size_t)(i % 3);
            encoder->channels[c].encode_from_ptr = (const uint8_t *)from;
            encoder->channels[c].user_pixel_stride = 3 * sizeof(float);
            encoder->channels[c].user_line_stride = pixels->width * 3 * (int32_t)sizeof(float);
            encoder->channels[c].user_bytes_per_element = sizeof(float);
            encoder->channels[c].user_data_type = EXR_PIXEL_FLOAT;
        }
}

/* Readers take a chunk of the size of its packed bytes for these, but OpenEXRCore 3.1 leaves
 * deflated bytes of just that size. */
static exr_result_t compress_or_store(exr_encode_pipeline_t *encoder) {
    exr_result_t (*const *const compress)(exr_encode_pipeline_t *) = encoder->encoding_user_data;
    const exr_result_t r = (*compress)(encoder);
    if (r == EXR_ERR_SUCCESS && encoder->compressed_bytes >= encoder->packed_bytes) {
        memcpy(encoder->compressed_buffer, encoder->packed_buffer, encoder->packed_bytes);
        encoder->compressed_bytes = encoder->packed_bytes;
    }
    return r;
}

static exr_result_t write_rows(exr_context_t context, const image_layer *layers, int count) {
    exr_encode_pipeline_t encoder = EXR_ENCODE_PIPELINE_INITIALIZER;
    exr_result_t (*compress)(exr_encode_pipeline_t *) = NULL;
    exr_chunk_info_t chunk;
    int32_t step = 1;
    exr_result_t r = exr_get_scanlines_per_chunk(context, 0, &step);
    for (int row = 0; row < layers->image->height && r == EXR_ERR_SUCCESS; row += step) {
        r = exr_write_scanline_chunk_info(context, 0, row, &chunk);
        if (r == EXR_ERR_SUCCESS)
            r = row ? exr_encoding_update(context, 0, &chunk, &encoder)
                    : exr_encoding_initialize(context, 0, &chunk, &encoder);
        if (r != EXR_ERR_SUCCESS)
            break;
        set_encoder(&encoder, layers, count, row);
        if (row == 0) {
            r = exr_encoding_choose_default_routines(context, 0, &encoder);
            compress = encoder.compress_fn;
            encoder.compress_fn = compress_or_store;
            encoder.encoding_user_data = (void *)&compress;
        }
        if (r == EXR_ERR_SUCCESS)
            r = exr_encoding_run(context, 0, &encoder);
    }
    exr_encoding_destroy(context, &encoder);
    return r;
}

bool image_write_exr_layers(const char *path, const image_layer *layers, int count,
                            cli_error *error) {
    file_writer writer;
    if (!file_write_begin(&writer, path, error))
        return false;
    exr_context_initializer_t setup = EXR_DEFAULT_CONTEXT_INITIALIZER;
    setup.user_data = writer.stream;
    setup.write_fn = write_at;
    setup.error_handler_fn = on_error;
    exr_context_t context = NULL;
    exr_result_t r = exr_start_write(&context, path, EXR_WRITE_FILE_DIRECTLY, &setup);
    if (r == EXR_ERR_SUCCESS)
        r = define_file(context, layers, count);
    if (r == EXR_ERR_SUCCESS)
        r = write_rows(context, layers, count);
    if (context) {
        const exr_result_t finished = exr_finish(&context);
        r = r == EXR_ERR_SUCCESS ? finished : r;
    }
    if (r != EXR_ERR_SUCCESS)
        return file_write_fail(&writer, exr_get_default_error_message(r), error);
    return file_write_commit(&writer, error);
}

/* --- reading ---------------------------------------------------------------------------------- */

/* Aims the R, G and B of a chunk at the image; other channels are skipped. */
static exr_result_t set_decoder(exr_decode_pipeline_t *decoder, const image_layer *layer,
                                image *pixels, int64_t column, int64_t row) {
    int found = 0;
    for (int c = 0; c < decoder->channel_count; c++) {
        exr_coding_channel_info_t *channel = &decoder->channels[c];
        channel->decode_to_ptr = NULL;
        for (int i = 0; i < 3; i++) {
            char name[256];
            channel_name(layer, i, name, sizeof name);
            if (strcmp(channel->channel_name, name) != 0)
                continue;
            if (channel->x_samples != 1 || channel->y_samples != 1 ||
                channel->data_type == EXR_PIXEL_UINT || channel->width + column > pixels->width ||
                channel->height + row > pixels->height || column < 0 || row < 0)
                return EXR_ERR_FEATURE_NOT_IMPLEMENTED;
            float *to = pixels->rgb + 3 * (row * pixels->width + column) + i;
            channel->decode_to_ptr = (uint8_t *)to;
            channel->user_pixel_stride = 3 * sizeof(float);
            channel->user_line_stride = pixels->width * 3 * (int32_t)sizeof(float);
            channel->user_bytes_per_element = sizeof(float);
            channel->user_data_type = EXR_PIXEL_FLOAT;
            found++;
        }
    }
    return found == 3 ? EXR_ERR_SUCCESS : EXR_ERR_MISSING_REQ_ATTR;
}

static exr_result_t decode(exr_const_context_t context, const exr_chunk_info_t *chunk,
                           const image_layer *layer, image *pixels, int64_t column, int64_t row) {
    exr_decode_pipeline_t decoder = EXR_DECODE_PIPELINE_INITIALIZER;
    exr_result_t r = exr_decoding_initialize(context, 0, chunk, &decoder);
    if (r == EXR_ERR_SUCCESS)
        r = set_decoder(&decoder, layer, pixels, column, row);
    if (r == EXR_ERR_SUCCESS)
        r = exr_decoding_choose_default_routines(context, 0, &decoder);
    if (r == EXR_ERR_SUCCESS)
        r = exr_decoding_run(context, 0, &decoder);
    exr_decoding_destroy(context, &decoder);
    return r;
}

static exr_result_t read_scanlines(exr_const_context_t context, int top, const image_layer *layer,
                                   image *pixels) {
    exr_chunk_info_t chunk;
    int32_t step = 1;
    exr_result_t r = exr_get_scanlines_per_chunk(context, 0, &step);
    for (int row = 0; row < pixels->height && r == EXR_ERR_SUCCESS; row += step) {
        r = exr_read_scanline_chunk_info(context, 0, top + row, &chunk);
        if (r == EXR_ERR_SUCCESS)
            r = decode(context, &chunk, layer, pixels, 0, row);
    }
    return r;
}

static exr_result_t read_tiles(exr_const_context_t context, const image_layer *layer,
                               image *pixels) {
    exr_chunk_info_t chunk;
    int32_t width = 0, height = 0;
    exr_result_t r = exr_get_tile_sizes(context, 0, 0, 0, &width, &height);
    if (r == EXR_ERR_SUCCESS && (width < 1 || height < 1))
        r = EXR_ERR_INVALID_ATTR;
    for (int y = 0; r == EXR_ERR_SUCCESS && y * (int64_t)height < pixels->height; y++)
        for (int x = 0; r == EXR_ERR_SUCCESS && x * (int64_t)width < pixels->width; x++) {
            r = exr_read_tile_chunk_info(context, 0, x, y, 0, 0, &chunk);
            if (r == EXR_ERR_SUCCESS)
                r = decode(context, &chunk, layer, pixels, x * (int64_t)width, y * (int64_t)height);
        }
    return r;
}

static bool decode_part(exr_const_context_t context, const image_source *source, image *pixels,
                        cli_error *error) {
    const char *const path = source->path;
    exr_attr_box2i_t window;
    exr_storage_t storage = EXR_STORAGE_LAST_TYPE;
    exr_result_t r = exr_get_data_window(context, 0, &window);
    if (r == EXR_ERR_SUCCESS)
        r = exr_get_storage(context, 0, &storage);
    if (r != EXR_ERR_SUCCESS)
        return cli_fail(error, path, "not a readable OpenEXR: %s",
                        exr_get_default_error_message(r));
    if (storage != EXR_STORAGE_SCANLINE && storage != EXR_STORAGE_TILED)
        return cli_fail(error, path, "deep OpenEXR images are not supported");
    if (!image_create_decoded(source, (long long)window.max.x - window.min.x + 1,
                              (long long)window.max.y - window.min.y + 1, pixels, error))
        return false;
    const image_layer layer = { source->layer, pixels };
    r = storage == EXR_STORAGE_TILED ? read_tiles(context, &layer, pixels)
                                     : read_scanlines(context, window.min.y, &layer, pixels);
    if (r == EXR_ERR_SUCCESS)
        return true;
    image_free(pixels);
    if (r == EXR_ERR_MISSING_REQ_ATTR && source->layer)
        return cli_fail(error, path, "has no layer \"%s\"", source->layer);
    if (r == EXR_ERR_MISSING_REQ_ATTR || r == EXR_ERR_FEATURE_NOT_IMPLEMENTED)
        return cli_fail(error, path, "needs channels R, G and B of half or float");
    return cli_fail(error, path, "damaged OpenEXR: %s", exr_get_default_error_message(r));
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

bool image_decode_exr(const image_source *source, image *pixels, cli_error *error) {
    image_source bytes = *source;
    exr_context_initializer_t setup = EXR_DEFAULT_CONTEXT_INITIALIZER;
    setup.user_data = &bytes;
    setup.read_fn = read_at;
    setup.size_fn = size_of_source;
    setup.error_handler_fn = on_error;
    exr_context_t context = NULL;
    const exr_result_t r = exr_start_read(&context, source->path, &setup);
    if (r != EXR_ERR_SUCCESS)
        return cli_fail(error, source->path, "not a readable OpenEXR: %s",
                        exr_get_default_error_message(r));
    const bool ok = decode_part(context, source, pixels, error);
    exr_finish(&context);
    return ok;
}
