/* SPDX-License-Identifier: MIT */
#include "app/image/exr.h"
#include "app/base/file_writer.h"

#include <errno.h>
#include <openexr.h>
#include <stdlib.h>
#include <string.h>

enum { CHANNELS_MAX = 3 * IMAGE_LAYERS_MAX };

/* Swallows OpenEXR's errors, which it would otherwise print itself. */
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

/* Writes the name of a channel, "R" or "name.R". */
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

/* Sets where the encoder takes the rows of its channels from; the file has them sorted by name. */
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

/* Stores a chunk uncompressed if compression does not shrink it: readers assume that a chunk of the
 * unpacked size is not compressed, but OpenEXRCore 3.1 keeps deflated bytes of just that size. */
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
                            base_error *error) {
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
