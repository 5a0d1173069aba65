/* SPDX-License-Identifier: MIT */
/* OpenEXR files as another program reads them: this test parses the format itself, with only zlib,
 * and finds every float that was written. LAMPION_LONG=1 tries every size from 1 to 40 squared. */
#include "app/image/image.h"
#include "tests/program/folder.h"

#include "app/base/error.h"
#include "app/base/file.h"

#include <math.h>
#include <stdint.h>
#include <zlib.h>

enum { LONGEST_SIDE = 40, ROWS_A_CHUNK = 16, LAYERS = 3 };

/* --- the reader: a file in memory, and how far it is read ------------------------------------- */

typedef struct reader {
    const unsigned char *bytes;
    size_t size, at;
} reader;

static const unsigned char *take(reader *r, size_t count) {
    assert_true(count <= r->size - r->at);
    const unsigned char *bytes = r->bytes + r->at;
    r->at += count;
    return bytes;
}

static uint32_t take_u32(reader *r) {
    const unsigned char *b = take(r, 4);
    return b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
}

static const char *take_text(reader *r) {
    const char *text = (const char *)r->bytes + r->at;
    (void)take(r, strnlen(text, r->size - r->at) + 1);
    return text;
}

typedef struct exr_header {
    int width, height, channel_count;
    const char *channels[3 * IMAGE_LAYERS_MAX]; /* sorted by name, as in the rows */
} exr_header;

static void read_channels(reader r, exr_header *header) {
    for (const char *name = take_text(&r); *name; name = take_text(&r)) {
        assert_in_range(header->channel_count, 0, 3 * IMAGE_LAYERS_MAX - 1);
        header->channels[header->channel_count++] = name;
        assert_int_equal(take_u32(&r), 2); /* 32-bit float */
        (void)take(&r, 4);                 /* linearity, and 3 reserved bytes */
        assert_int_equal(take_u32(&r), 1);
        assert_int_equal(take_u32(&r), 1); /* sampled everywhere */
    }
}

static exr_header read_header(reader *r) {
    exr_header header = { 0 };
    assert_int_equal(take_u32(r), 20000630);
    assert_int_equal(take_u32(r) & 0xff, 2);
    for (const char *name = take_text(r); *name; name = take_text(r)) {
        (void)take_text(r); /* its type */
        const size_t size = take_u32(r);
        reader value = { take(r, size), size, 0 };
        if (strcmp(name, "channels") == 0)
            read_channels(value, &header);
        if (strcmp(name, "compression") == 0)
            assert_int_equal(*take(&value, 1), 3); /* zip, 16 rows together */
        if (strcmp(name, "dataWindow") == 0) {
            assert_int_equal(take_u32(&value), 0);
            assert_int_equal(take_u32(&value), 0);
            header.width = (int)take_u32(&value) + 1;
            header.height = (int)take_u32(&value) + 1;
        }
    }
    return header;
}

/* The packed bytes of a chunk: stored as they are, or deflated after the predictor, which takes the
 * even bytes before the odd ones and of each byte its difference from the one before, plus 128. */
static void unpack(const unsigned char *data, size_t size, unsigned char *packed,
                   size_t packed_size) {
    static unsigned char planes[LONGEST_SIDE * ROWS_A_CHUNK * 3 * LAYERS * sizeof(float)];
    uLongf length = sizeof planes;
    assert_true(size <= packed_size);
    if (size == packed_size) {
        memcpy(packed, data, size);
        return;
    }
    assert_int_equal(uncompress(planes, &length, data, size), Z_OK);
    assert_int_equal(length, packed_size);
    for (size_t i = 1; i < length; i++)
        planes[i] = (unsigned char)(planes[i] + planes[i - 1] - 128);
    for (size_t i = 0; i < length; i++)
        packed[i] = planes[i / 2 + i % 2 * ((length + 1) / 2)];
}

/* Returns "R" of the layer without a name, or "NAME.R" of another. */
static const float *channel_of(const char *name, const image_layer *layers) {
    const char *dot = strrchr(name, '.');
    for (int i = 0; i < LAYERS; i++)
        if (strlen(layers[i].name) == (size_t)(dot ? dot - name : 0) &&
            strncmp(layers[i].name, name, strlen(layers[i].name)) == 0)
            return layers[i].image->rgb + (strchr("RGB", dot ? dot[1] : *name) - "RGB");
    fail_msg("a channel %s", name);
    return NULL;
}

static void check_chunk(reader *r, const exr_header *header, int top, const image_layer *layers) {
    static unsigned char packed[LONGEST_SIDE * ROWS_A_CHUNK * 3 * LAYERS * sizeof(float)];
    const int rows = header->height - top < ROWS_A_CHUNK ? header->height - top : ROWS_A_CHUNK;
    const size_t floats = (size_t)(rows * header->width * header->channel_count);
    assert_int_equal(take_u32(r), top);
    const size_t size = take_u32(r);
    unpack(take(r, size), size, packed, floats * sizeof(float));
    const unsigned char *at = packed;
    for (int row = top; row < top + rows; row++)
        for (int c = 0; c < header->channel_count; c++) {
            const float *from = channel_of(header->channels[c], layers);
            for (int x = 0; x < header->width; x++, at += sizeof(float))
                if (memcmp(at, from + 3 * (row * header->width + x), sizeof(float)) != 0)
                    fail_msg("%dx%d: %s at %d, %d differs", header->width, header->height,
                             header->channels[c], x, row);
        }
}

static void check_file(const char *name, const image_layer *layers) {
    base_error error;
    void *data;
    size_t size;
    assert_true(file_read(in_folder(name), 1 << 28, &data, &size, &error));
    reader r = { data, size, 0 };
    const exr_header header = read_header(&r);
    assert_int_equal(header.width, layers->image->width);
    assert_int_equal(header.height, layers->image->height);
    assert_int_equal(header.channel_count, 3 * LAYERS);
    (void)take(&r, 8 * (size_t)((header.height + ROWS_A_CHUNK - 1) / ROWS_A_CHUNK)); /* offsets */
    for (int top = 0; top < header.height; top += ROWS_A_CHUNK)
        check_chunk(&r, &header, top, layers);
    assert_int_equal(r.at, r.size);
    free(data);
}

/* --- what is written -------------------------------------------------------------------------- */

static float any_float(void) {
    const uint32_t bits = (uint32_t)(check_random() * 4294967296.0);
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static float noise(double fraction) {
    return check_random() < fraction ? any_float() : 0.25f;
}

static image make(int width, int height, float (*fill)(double), double fraction) {
    image pixels;
    base_error error;
    assert_true(image_create(&pixels, width, height, &error));
    for (size_t i = 0; i < 3 * (size_t)width * (size_t)height; i++)
        pixels.rgb[i] = fill ? fill(fraction) : (float)fraction * (float)i;
    return pixels;
}

/* Checks layers of which one is noise, one a smooth ramp, and one noise in a fraction of its
 * values, so that some chunks deflate to just about their size. */
static void check_size(int width, int height, double fraction) {
    base_error error = { "" };
    image images[LAYERS] = { make(width, height, noise, fraction), make(width, height, noise, 1),
                             make(width, height, fraction < 1 ? NULL : noise, fraction) };
    const image_layer layers[LAYERS] = { { "", &images[0] },
                                         { "noise", &images[1] },
                                         { "other", &images[2] } };
    if (!image_write_exr_layers(in_folder("a.exr"), layers, LAYERS, &error))
        fail_msg("%s", error.text);
    check_file("a.exr", layers);
    for (int i = 0; i < LAYERS; i++)
        image_free(&images[i]);
}

static void every_float_is_found_by_another_reader(void **state) {
    (void)state;
    const bool whole = check_count(0, 1);
    int tried = 0;
    for (int width = 1; width <= LONGEST_SIDE; width++)
        for (int height = 1; height <= LONGEST_SIDE; height++) {
            const bool small = width * height <= 16;
            for (int i = 0; i < (small || whole ? 10 : width % 5 == height % 5); i++, tried++)
                check_size(width, height, i ? check_random() : 1);
        }
    printf("tried: %d OpenEXR files read by zlib alone\n", tried);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_float_is_found_by_another_reader),
    };
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
