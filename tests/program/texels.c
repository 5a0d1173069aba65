/* SPDX-License-Identifier: MIT */
/* Images as textures: each kind of PNG, JPEG and WebP that libpng, libjpeg-turbo and libwebp encode
 * gives the texels that were put in. */
#include "app/scene/texture.h"
#include "tests/oracle/check.h"

#include <math.h>
#include <png.h>
#include <stdlib.h>
#include <string.h>
#include <webp/encode.h>

#include <jpeglib.h>

enum { WIDTH = 21, HEIGHT = 13, PIXELS = WIDTH * HEIGHT };

typedef struct encoded {
    unsigned char *bytes;
    size_t size;
} encoded;

static base_error error;

/* Returns the texels of an image of WIDTH x HEIGHT, which the builder keeps. */
static const unsigned char *decode(scene_builder *builder, encoded file) {
    scene_texture texture = { .width = 0 };
    *builder = (scene_builder) { .out_of_memory = false };
    error.text[0] = 0;
    if (!texture_keep(builder, file.bytes, file.size, TEXTURE_GLTF, "scene", "image", &texture,
                      &error) ||
        !texture_decode_all(builder, "scene", &error) ||
        builder_count(builder, BLOB_UNSUPPORTED) > 0)
        return NULL;
    assert_int_equal(texture.width, WIDTH);
    assert_int_equal(texture.height, HEIGHT);
    return builder_items(builder, BLOB_TEXELS);
}

/* --- PNG -------------------------------------------------------------------------------------- */

static void put_bytes(png_structp png, png_bytep data, size_t size) {
    encoded *const file = png_get_io_ptr(png);
    file->bytes = realloc(file->bytes, file->size + size);
    assert_non_null(file->bytes);
    memcpy(file->bytes + file->size, data, size);
    file->size += size;
}

typedef struct png_kind {
    int color, depth;
    bool interlaced, transparent;
} png_kind;

/* Returns sample `s` of a pixel. */
static unsigned sample(int depth, int pixel, int s) {
    return (unsigned)(pixel * 40503 + s * 30011 + 12345) % (1u << depth);
}

enum { CLEAR = 5 }; /* the pixel of the transparent color */

static int channels_of(int color) {
    return color == PNG_COLOR_TYPE_GRAY || color == PNG_COLOR_TYPE_PALETTE ? 1
           : color == PNG_COLOR_TYPE_GRAY_ALPHA                            ? 2
           : color == PNG_COLOR_TYPE_RGB                                   ? 3
                                                                           : 4;
}

static void put_palette(png_structp png, png_infop info, const png_kind *kind) {
    png_color colors[256];
    unsigned char alphas[256];
    for (int i = 0; i < 1 << kind->depth; i++) {
        colors[i] = (png_color) { (png_byte)(i * 7), (png_byte)(i * 13), (png_byte)(255 - i) };
        alphas[i] = (unsigned char)(255 - 3 * i);
    }
    png_set_PLTE(png, info, colors, 1 << kind->depth);
    if (kind->transparent)
        png_set_tRNS(png, info, alphas, 1 << kind->depth, NULL);
}

static void put_rows(png_structp png, const png_kind *kind) {
    const int count = channels_of(kind->color);
    unsigned char rows[HEIGHT][WIDTH * 8] = { { 0 } }, *pointers[HEIGHT];
    for (int y = 0; y < HEIGHT; y++) {
        pointers[y] = rows[y];
        for (int i = 0; i < WIDTH * count; i++) {
            const unsigned value = sample(kind->depth, y * WIDTH + i / count, i % count);
            const int bit = i * kind->depth;
            if (kind->depth == 16) {
                rows[y][2 * i] = (unsigned char)(value >> 8);
                rows[y][2 * i + 1] = (unsigned char)value;
            } else {
                rows[y][bit / 8] |= (unsigned char)(value << (8 - kind->depth - bit % 8));
            }
        }
    }
    png_write_image(png, pointers);
}

static encoded make_png(const png_kind *kind) {
    encoded file = { NULL, 0 };
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    png_set_write_fn(png, &file, put_bytes, NULL);
    png_set_IHDR(png, info, WIDTH, HEIGHT, kind->depth, kind->color,
                 kind->interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_gAMA(png, info, 1.0); /* glTF requires it to be ignored */
    const png_uint_16 v[3] = { (png_uint_16)sample(kind->depth, CLEAR, 0),
                               (png_uint_16)sample(kind->depth, CLEAR, 1),
                               (png_uint_16)sample(kind->depth, CLEAR, 2) };
    const png_color_16 clear = { .red = v[0], .green = v[1], .blue = v[2], .gray = v[0] };
    if (kind->color == PNG_COLOR_TYPE_PALETTE)
        put_palette(png, info, kind);
    else if (kind->transparent)
        png_set_tRNS(png, info, NULL, 0, &clear);
    png_write_info(png, info);
    put_rows(png, kind);
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    return file;
}

static unsigned char scaled(int depth, unsigned value) {
    return (unsigned char)(depth == 16 ? value >> 8 : value * 255 / ((1u << depth) - 1));
}

static void expect_png(const png_kind *kind, int pixel, unsigned char rgba[4]) {
    const int count = channels_of(kind->color);
    unsigned v[4] = { 0 };
    bool clear = kind->transparent;
    for (int s = 0; s < count; s++) {
        v[s] = sample(kind->depth, pixel, s);
        clear = clear && v[s] == sample(kind->depth, CLEAR, s);
    }
    for (int s = 0; s < 3; s++)
        rgba[s] = scaled(kind->depth, v[count < 3 ? 0 : s]);
    rgba[3] = clear ? 0 : count % 2 == 0 ? scaled(kind->depth, v[count - 1]) : 255;
    if (kind->color == PNG_COLOR_TYPE_PALETTE) {
        rgba[0] = (unsigned char)(v[0] * 7);
        rgba[1] = (unsigned char)(v[0] * 13);
        rgba[2] = (unsigned char)(255 - v[0]);
        rgba[3] = (unsigned char)(kind->transparent ? 255 - 3 * v[0] : 255);
    }
}

static void check_png(const png_kind *kind) {
    scene_builder builder;
    const encoded file = make_png(kind);
    const unsigned char *texels = decode(&builder, file);
    if (!texels)
        fail_msg("%s", error.text);
    for (int i = 0; i < PIXELS; i++) {
        unsigned char expected[4];
        expect_png(kind, i, expected);
        if (memcmp(texels + 4 * i, expected, 4) != 0)
            fail_msg("color type %d of %d bits%s: pixel %d is %d %d %d %d, not %d %d %d %d",
                     kind->color, kind->depth, kind->interlaced ? ", interlaced" : "", i,
                     texels[4 * i], texels[4 * i + 1], texels[4 * i + 2], texels[4 * i + 3],
                     expected[0], expected[1], expected[2], expected[3]);
    }
    builder_free(&builder);
    free(file.bytes);
}

static void every_kind_of_png_gives_its_texels(void **state) {
    (void)state;
    static const int colors[] = { PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_RGB, PNG_COLOR_TYPE_PALETTE,
                                  PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB_ALPHA };
    for (size_t c = 0; c < sizeof colors / sizeof *colors; c++)
        for (int depth = 1; depth <= 16; depth *= 2)
            for (int k = 0; k < 4; k++) {
                const png_kind kind = { colors[c], depth, k & 1, k & 2 };
                const bool alpha = colors[c] & PNG_COLOR_MASK_ALPHA;
                const bool palette = colors[c] == PNG_COLOR_TYPE_PALETTE;
                const bool small = palette || colors[c] == PNG_COLOR_TYPE_GRAY;
                if (!(depth < 8 && !small) && !(depth == 16 && palette) &&
                    !(alpha && kind.transparent))
                    check_png(&kind);
            }
}

static void a_damaged_png_is_refused_by_its_reason(void **state) {
    (void)state;
    scene_builder builder;
    const png_kind kind = { PNG_COLOR_TYPE_RGB, 8, false, false };
    encoded file = make_png(&kind);
    file.size -= 40;
    assert_null(decode(&builder, file));
    assert_string_equal(error.text, "scene: has a texture \"image\" that cannot be decoded: it is "
                                    "truncated");
    builder_free(&builder);
    free(file.bytes);
}

/* --- JPEG ------------------------------------------------------------------------------------- */

typedef struct jpeg_kind {
    J_COLOR_SPACE from, stored;
    bool progressive, without_adobe;
} jpeg_kind;

/* A channel has one value in the upper rows and another in the lower ones. */
static unsigned char ink(int y, int channel) {
    return (unsigned char)(y < 8 ? 250 - 30 * channel : 40 + 60 * channel);
}

static encoded make_jpeg(const jpeg_kind *kind) {
    encoded file = { NULL, 0 };
    struct jpeg_compress_struct jpeg;
    struct jpeg_error_mgr errors;
    unsigned long size = 0;
    jpeg.err = jpeg_std_error(&errors);
    jpeg_create_compress(&jpeg);
    jpeg_mem_dest(&jpeg, &file.bytes, &size);
    jpeg.image_width = WIDTH;
    jpeg.image_height = HEIGHT;
    jpeg.in_color_space = kind->from;
    jpeg.input_components = kind->from == JCS_CMYK ? 4 : kind->from == JCS_GRAYSCALE ? 1 : 3;
    jpeg_set_defaults(&jpeg);
    jpeg_set_colorspace(&jpeg, kind->stored);
    jpeg_set_quality(&jpeg, 100, TRUE);
    for (int i = 0; i < jpeg.num_components; i++)
        jpeg.comp_info[i].h_samp_factor = jpeg.comp_info[i].v_samp_factor = 1;
    if (kind->progressive)
        jpeg_simple_progression(&jpeg);
    if (kind->without_adobe)
        jpeg.write_Adobe_marker = FALSE;
    jpeg_start_compress(&jpeg, TRUE);
    for (int y = 0; y < HEIGHT; y++) {
        unsigned char row[4 * WIDTH], *rows[] = { row };
        for (int i = 0; i < WIDTH * jpeg.input_components; i++)
            row[i] = ink(y, i % jpeg.input_components);
        jpeg_write_scanlines(&jpeg, rows, 1);
    }
    jpeg_finish_compress(&jpeg);
    jpeg_destroy_compress(&jpeg);
    file.size = size;
    return file;
}

/* Rows of 8 are blocks: each is flat, and so exact except for the rounding of colors. */
static void check_jpeg(const jpeg_kind *kind) {
    scene_builder builder;
    const encoded file = make_jpeg(kind);
    const unsigned char *texels = decode(&builder, file);
    if (!texels)
        fail_msg("%s", error.text);
    for (int i = 0; i < PIXELS; i++) {
        const int y = i / WIDTH;
        for (int c = 0; c < 3; c++) {
            double expected = ink(y, kind->from == JCS_GRAYSCALE ? 0 : c);
            if (kind->from == JCS_CMYK)
                expected = kind->without_adobe ? (255 - expected) * (255 - ink(y, 3)) / 255
                                               : expected * ink(y, 3) / 255;
            if (!(fabs(texels[4 * i + c] - expected) <= 2))
                fail_msg("pixel %d, channel %d: %d, not %g", i, c, texels[4 * i + c], expected);
        }
        assert_int_equal(texels[4 * i + 3], 255);
    }
    builder_free(&builder);
    free(file.bytes);
}

static void every_kind_of_jpeg_gives_its_colors(void **state) {
    (void)state;
    static const jpeg_kind kinds[] = {
        { JCS_GRAYSCALE, JCS_GRAYSCALE, false, false },
        { JCS_RGB, JCS_YCbCr, false, false },
        { JCS_RGB, JCS_YCbCr, true, false },
        { JCS_RGB, JCS_RGB, false, false },
        { JCS_CMYK, JCS_CMYK, false, false },
        { JCS_CMYK, JCS_YCCK, true, false },
        { JCS_CMYK, JCS_CMYK, false, true },
    };
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        check_jpeg(&kinds[i]);
}

/* Some encoders pad by 0xff 0x00 after a segment, before the next marker. */
static void bytes_before_a_marker_of_a_jpeg_are_skipped(void **state) {
    (void)state;
    const jpeg_kind kind = { JCS_RGB, JCS_YCbCr, true, false };
    encoded file = make_jpeg(&kind), padded = { NULL, 0 };
    padded.bytes = malloc(2 * file.size);
    assert_non_null(padded.bytes);
    for (size_t i = 0; i < file.size; i++) {
        if (i + 1 < file.size && file.bytes[i] == 0xff && file.bytes[i + 1] == 0xda) {
            padded.bytes[padded.size++] = 0xff;
            padded.bytes[padded.size++] = 0;
        }
        padded.bytes[padded.size++] = file.bytes[i];
    }
    assert_true(padded.size > file.size);
    scene_builder one, other;
    const unsigned char *plain = decode(&one, file), *texels = decode(&other, padded);
    if (!plain || !texels)
        fail_msg("%s", error.text);
    assert_memory_equal(texels, plain, 4 * PIXELS);
    builder_free(&one);
    builder_free(&other);
    free(padded.bytes);
    free(file.bytes);
}

/* --- WebP ------------------------------------------------------------------------------------- */

static void a_webp_gives_its_texels(void **state) {
    (void)state;
    unsigned char rgba[4 * PIXELS];
    for (int i = 0; i < 4 * PIXELS; i++) /* alpha is above 0, so that the color is kept */
        rgba[i] = (unsigned char)(i % 4 == 3 ? 1 + i % 255 : i * i / 7);
    scene_builder builder;
    encoded file;
    file.size = WebPEncodeLosslessRGBA(rgba, WIDTH, HEIGHT, 4 * WIDTH, &file.bytes);
    const unsigned char *texels = decode(&builder, file);
    if (!texels)
        fail_msg("%s", error.text);
    assert_memory_equal(texels, rgba, sizeof rgba);
    builder_free(&builder);
    file.size -= 5;
    assert_null(decode(&builder, file));
    assert_string_equal(error.text, "scene: has a texture \"image\" that cannot be decoded: it is "
                                    "damaged or truncated");
    builder_free(&builder);
    WebPFree(file.bytes);
    memset(rgba, 100, sizeof rgba);
    file.size = WebPEncodeRGBA(rgba, WIDTH, HEIGHT, 4 * WIDTH, 90, &file.bytes);
    texels = decode(&builder, file);
    if (!texels)
        fail_msg("%s", error.text);
    for (int i = 0; i < 4 * PIXELS; i++)
        CHECK_WITHIN(fabs(texels[i] - 100.0), 2);
    builder_free(&builder);
    WebPFree(file.bytes);
}

/* 30 bytes that claim 16384 x 16384 pixels: 1 GB must not be allocated for them. */
static void a_webp_of_few_bytes_is_not_many_pixels(void **state) {
    (void)state;
    unsigned char bytes[40] = "RIFF\40\0\0\0WEBPVP8L\24\0\0\0\x2f\xff\xff\xff\x0f";
    scene_builder builder;
    assert_null(decode(&builder, (encoded) { bytes, sizeof bytes }));
    assert_string_equal(error.text, "scene: has a texture \"image\" of 16384 x 16384 pixels in 40 "
                                    "bytes (is it truncated?)");
    builder_free(&builder);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_kind_of_png_gives_its_texels),
        cmocka_unit_test(a_damaged_png_is_refused_by_its_reason),
        cmocka_unit_test(every_kind_of_jpeg_gives_its_colors),
        cmocka_unit_test(bytes_before_a_marker_of_a_jpeg_are_skipped),
        cmocka_unit_test(a_webp_gives_its_texels),
        cmocka_unit_test(a_webp_of_few_bytes_is_not_many_pixels),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
