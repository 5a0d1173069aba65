/* SPDX-License-Identifier: MIT */
/* Untrusted images: the bytes are read here, decoded in the sandbox, and checked when they come
 * back. */
#include "app/image/image.h"

#include "app/base/file.h"
#include "app/base/sandbox.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/mman.h>
#include <unistd.h>

#define FILE_SIZE_MAX ((size_t)2 << 30)

typedef bool image_decoder(const image_source *source, image *image, base_error *error);

typedef struct decoding {
    image_source source;
    image_decoder *decoder;
    const char *key; /* of the requested text; NULL: the pixels are requested */
} decoding;

/* The header of the child's output, which the rows of the image follow. */
typedef struct decoded_size {
    int32_t width, height;
} decoded_size;

/* --- in the child ----------------------------------------------------------------------------- */

static bool write_all(int output, const void *data, size_t size) {
    const char *bytes = data;
    for (size_t done = 0; done < size;) {
        const ssize_t written = write(output, bytes + done, size - done);
        if (written < 0 && errno != EINTR)
            return false;
        done += written > 0 ? (size_t)written : 0;
    }
    return true;
}

static bool decode_pixels(void *context, int output, base_error *error) {
    const decoding *const d = context;
    image pixels;
    if (!d->decoder(&d->source, &pixels, error))
        return false;
    const decoded_size size = { pixels.width, pixels.height };
    const size_t bytes = 3 * sizeof(float) * (size_t)pixels.width * (size_t)pixels.height;
    return (write_all(output, &size, sizeof size) && write_all(output, pixels.rgb, bytes)) ||
           base_fail(error, d->source.path, "does not fit into memory");
}

static bool decode_text(void *context, int output, base_error *error) {
    const decoding *const d = context;
    char *text;
    return image_decode_png_text(&d->source, d->key, &text, error) &&
           (write_all(output, text, strlen(text)) ||
            base_fail(error, d->source.path, "does not fit into memory"));
}

/* --- in the parent ---------------------------------------------------------------------------- */

static bool decode(decoding *d, const char *path, void **block, size_t *size, base_error *error) {
    void *data;
    if (!file_read(path, FILE_SIZE_MAX, &data, &d->source.size, error))
        return false;
    d->source.path = path;
    d->source.data = data;
    /* a small file of a uniform color may legitimately be a large image */
    const sandbox_job job = { .subject = path,
                              .input_bytes = d->source.size + (uint64_t)d->source.pixels_max / 2,
                              .context = d,
                              .work = d->key ? decode_text : decode_pixels };
    const bool ok = sandbox_run(&job, block, size, error);
    free(data);
    return ok;
}

static bool take_image(const decoding *d, const void *block, size_t size, image *pixels,
                       base_error *error) {
    decoded_size claimed = { 0, 0 };
    if (size >= sizeof claimed)
        memcpy(&claimed, block, sizeof claimed);
    if (!image_create_decoded(&d->source, claimed.width, claimed.height, pixels, error))
        return false;
    const size_t bytes = 3 * sizeof(float) * (size_t)pixels->width * (size_t)pixels->height;
    if (size - sizeof claimed == bytes) {
        memcpy(pixels->rgb, (const char *)block + sizeof claimed, bytes);
        return true;
    }
    image_free(pixels);
    return base_fail(error, d->source.path, "cannot be read (is it damaged?)");
}

/* Returns the decoder for the extension of path, ignoring case; NULL if it is unknown. */
static image_decoder *decoder_of(const char *path) {
    static const struct {
        const char *extension;
        image_decoder *decoder;
    } known[] = { { ".png", image_decode_png },
                  { ".exr", image_decode_exr },
                  { ".hdr", image_decode_hdr } };
    const char *dot = strrchr(path, '.');
    for (size_t i = 0; dot && i < sizeof known / sizeof *known; i++)
        if (strcasecmp(dot, known[i].extension) == 0)
            return known[i].decoder;
    return NULL;
}

static bool read_pixels(decoding *d, const char *path, image *pixels, base_error *error) {
    void *block;
    size_t size;
    memset(pixels, 0, sizeof *pixels);
    if (!decode(d, path, &block, &size, error))
        return false;
    const bool ok = take_image(d, block, size, pixels, error);
    munmap(block, size);
    return ok;
}

bool image_read(const char *path, long long pixels_max, image *pixels, base_error *error) {
    decoding d = { .source.pixels_max = pixels_max, .decoder = decoder_of(path) };
    if (!d.decoder)
        return base_fail(error, path, "unknown kind of image (.png, .exr and .hdr are read)");
    return read_pixels(&d, path, pixels, error);
}

bool image_read_layer(const char *path, const char *layer, image *pixels, base_error *error) {
    decoding d = { .source = { .pixels_max = IMAGE_READ_PIXELS, .layer = layer },
                   .decoder = image_decode_exr };
    return read_pixels(&d, path, pixels, error);
}

bool image_read_png_text(const char *path, const char *key, char **text, base_error *error) {
    decoding d = { .key = key };
    void *block;
    size_t size;
    if (!decode(&d, path, &block, &size, error))
        return false;
    const bool fits = size <= IMAGE_TEXT_MAX;
    *text = fits ? strndup(block, size) : NULL;
    munmap(block, size);
    return *text || (!fits && base_fail(error, path, "holds more text than a scene of ours has")) ||
           base_fail(error, path, "out of memory");
}
