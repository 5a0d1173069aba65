/* SPDX-License-Identifier: MIT */
/* Images for `compare`: .exr. An input that is not a file describes one, so that the pixels behind
 * the header and the deflated streams are reached. */
#include "app/image/exr.h"
#include "fuzz/numbers.h"

#include <zlib.h>

enum { SIDE_MAX = 40, FILE_MAX_BYTES = 1 << 16, UNPACKED_MAX = SIDE_MAX * SIDE_MAX * 12 };

typedef struct exr_file {
    unsigned char *bytes;
    size_t size;
} exr_file;

typedef struct exr_shape {
    int compression, width, height, left, top, channels, types[4], tile;
    int chroma; /* 0: the channels are colors; else the spacing of RY and BY in pixels */
} exr_shape;

/* Scan lines per chunk by compression, from none to DWAB. */
static const int chunk_lines[] = { 1, 1, 1, 16, 32, 16, 32, 32, 32, 256 };

static void add(exr_file *file, const void *data, size_t size) {
    if (size > FILE_MAX_BYTES - file->size)
        return;
    memcpy(file->bytes + file->size, data, size);
    file->size += size;
}

static void add_number(exr_file *file, int32_t number) {
    add(file, &number, sizeof number);
}

static void add_attribute(exr_file *file, const char *name, const char *type, const void *data,
                          size_t size) {
    add(file, name, strlen(name) + 1);
    add(file, type, strlen(type) + 1);
    add_number(file, (int32_t)size);
    add(file, data, size);
}

static void add_channels(exr_file *file, const exr_shape *shape) {
    static const char *const names[2][4] = { { "B", "G", "R", "Z" }, { "BY", "RY", "Y", "Z" } };
    unsigned char list[4 * 19 + 1] = { 0 };
    size_t size = 0;
    for (int i = 0; i < shape->channels; i++) {
        const char *const name = names[shape->chroma > 0][i];
        const int32_t sampling = shape->chroma > 0 && i < 2 ? shape->chroma : 1;
        memcpy(list + size, name, strlen(name));
        size += strlen(name) + 1;
        memcpy(list + size, &shape->types[i], 4);
        memcpy(list + size + 8, &sampling, 4);
        memcpy(list + size + 12, &sampling, 4);
        size += 16;
    }
    add_attribute(file, "channels", "chlist", list, size + 1);
}

static void add_header(exr_file *file, const exr_shape *shape) {
    const int32_t version = shape->tile ? 0x202 : 2;
    const int32_t window[] = { shape->left, shape->top, shape->left + shape->width - 1,
                               shape->top + shape->height - 1 };
    const float one = 1, center[] = { 0, 0 };
    const unsigned char compression = (unsigned char)shape->compression, order = 0;
    const uint32_t tile[] = { (uint32_t)shape->tile, (uint32_t)shape->tile };
    unsigned char tiles[9] = { 0 };
    memcpy(tiles, tile, sizeof tile);
    add(file, "\x76\x2f\x31\x01", 4);
    add_number(file, version);
    add_channels(file, shape);
    add_attribute(file, "compression", "compression", &compression, 1);
    add_attribute(file, "dataWindow", "box2i", window, sizeof window);
    add_attribute(file, "displayWindow", "box2i", window, sizeof window);
    add_attribute(file, "lineOrder", "lineOrder", &order, 1);
    add_attribute(file, "pixelAspectRatio", "float", &one, sizeof one);
    add_attribute(file, "screenWindowCenter", "v2f", center, sizeof center);
    add_attribute(file, "screenWindowWidth", "float", &one, sizeof one);
    if (shape->tile)
        add_attribute(file, "tiles", "tiledesc", tiles, sizeof tiles);
    add(file, "", 1);
}

/* Adds the data of a chunk of that size from row y on: deflated, uncompressed, or too short. */
static void add_data(exr_file *file, fuzz_input *in, const exr_shape *shape, int wide, int tall,
                     int y) {
    static unsigned char unpacked[UNPACKED_MAX + 64], packed[2 * UNPACKED_MAX];
    size_t size = 0;
    for (int i = 0; i < shape->channels; i++) {
        const bool halved = shape->chroma == 2 && i < 2;
        const int samples = halved ? wide / 2 * ((tall + 1 - y % 2) / 2) : wide * tall;
        size += (size_t)samples * (shape->types[i] == 1 ? 2 : 4);
    }
    const int way = fuzz_int(in, 0, 2);
    if (way == 2)
        size = (size_t)fuzz_int(in, 0, 255);
    if (size > UNPACKED_MAX)
        size = UNPACKED_MAX;
    fuzz_take(in, unpacked, size);
    uLongf length = sizeof packed;
    const bool deflated = way == 0 && compress2(packed, &length, unpacked, size, 1) == Z_OK;
    add_number(file, (int32_t)(deflated ? length : size));
    add(file, deflated ? packed : unpacked, deflated ? length : size);
}

static void add_chunks(exr_file *file, fuzz_input *in, const exr_shape *shape) {
    const int step_y = shape->tile ? shape->tile : chunk_lines[shape->compression];
    const int step_x = shape->tile ? shape->tile : shape->width;
    const int rows = (shape->height + step_y - 1) / step_y;
    const int columns = (shape->width + step_x - 1) / step_x;
    const size_t table = file->size;
    for (int i = 0; i < rows * columns; i++)
        add(file, "\0\0\0\0\0\0\0", 8);
    for (int y = 0; y < rows; y++)
        for (int x = 0; x < columns; x++) {
            const uint64_t offset = file->size;
            const int tall = shape->height - y * step_y, wide = shape->width - x * step_x;
            memcpy(file->bytes + table + 8 * (size_t)(y * columns + x), &offset, 8);
            if (shape->tile) {
                add_number(file, x);
                add_number(file, y);
                add(file, "\0\0\0\0\0\0\0", 8);
            } else {
                add_number(file, shape->top + y * step_y);
            }
            add_data(file, in, shape, wide < step_x ? wide : step_x, tall < step_y ? tall : step_y,
                     y * step_y);
        }
}

static void describe(exr_file *file, fuzz_input *in) {
    exr_shape shape = { .compression = fuzz_int(in, 0, 9),
                        .width = fuzz_int(in, 1, SIDE_MAX),
                        .height = fuzz_int(in, 1, SIDE_MAX),
                        .left = fuzz_int(in, -8, 8),
                        .top = fuzz_int(in, -8, 8),
                        .channels = fuzz_int(in, 0, 11) };
    shape.chroma = shape.channels / 4;
    shape.channels = shape.channels % 4 + 1;
    if (shape.chroma == 2) { /* windows consist of whole samples */
        shape.width += shape.width % 2;
        shape.height += shape.height % 2;
        shape.left *= 2;
        shape.top *= 2;
    }
    for (int i = 0; i < 4; i++)
        shape.types[i] = fuzz_int(in, 0, 2);
    if (fuzz_int(in, 0, 3) == 3 && shape.chroma < 2)
        shape.tile = fuzz_int(in, 1, SIDE_MAX);
    add_header(file, &shape);
    add_chunks(file, in, &shape);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_input in = { data, size };
    exr_file file = { .bytes = malloc(FILE_MAX_BYTES) };
    if (!file.bytes)
        abort();
    if (size >= 4 && memcmp(data, "\x76\x2f\x31\x01", 4) == 0)
        add(&file, data, size);
    else
        describe(&file, &in);
    const image_source source = {
        .path = "input", .data = file.bytes, .size = file.size, .pixels_max = 1 << 16
    };
    image pixels;
    base_error error;
    if (image_decode_exr(&source, &pixels, &error))
        image_free(&pixels);
    free(file.bytes);
    return 0;
}
