/* SPDX-License-Identifier: MIT */
/* Images of the environment, latitude-longitude and cube maps, in any layout: nothing outside their
 * texels is read, and the sums are no larger than the brightest texel allows. */
#include "fuzz/numbers.h"

#include <lampion/sh.h>

enum { BANDS = 6, VALUES = LMP_SH_COUNT(BANDS), CHANNELS = 4 };

typedef struct layout {
    int columns, rows, channels;
    lmp_texel texel;
    size_t row_stride, texel_stride, channel_stride, bytes;
} layout;

static layout take_layout(fuzz_input *in, bool square) {
    layout l = { .columns = fuzz_int(in, 1, 20), .rows = fuzz_int(in, 1, 20) };
    l.channels = fuzz_int(in, 1, CHANNELS);
    l.texel = (lmp_texel)fuzz_int(in, 0, 1);
    if (square)
        l.rows = l.columns;
    const size_t item = l.texel == LMP_TEXEL_HALF ? 2 : 4, columns = (size_t)l.columns;
    const size_t rows = (size_t)l.rows, channels = (size_t)l.channels;
    const size_t padding = item * (size_t)fuzz_int(in, 0, 3);
    if (fuzz_int(in, 0, 1)) { /* a planar layout */
        l.channel_stride = item * columns * rows + rows * padding;
        l.texel_stride = item;
        l.row_stride = item * columns + padding;
    } else {
        l.channel_stride = item;
        l.texel_stride = item * channels;
        l.row_stride = item * channels * columns + padding;
    }
    l.bytes = (channels - 1) * l.channel_stride + (rows - 1) * l.row_stride +
              (columns - 1) * l.texel_stride + item;
    return l;
}

/* Takes texels into memory of exactly their size: finite floats, or halves below infinity. */
static void *take_texels(fuzz_input *in, const layout *l) {
    void *pixels = malloc(l->bytes);
    if (!pixels)
        abort();
    fuzz_take(in, pixels, l->bytes);
    if (l->texel == LMP_TEXEL_HALF) {
        uint16_t *halves = pixels;
        for (size_t i = 0; i < l->bytes / 2; i++)
            halves[i] = (halves[i] & 0x7c00) == 0x7c00 ? 0 : halves[i];
    } else {
        float *floats = pixels;
        for (size_t i = 0; i < l->bytes / 4; i++)
            floats[i] = fabsf(floats[i]) <= 1e6f ? floats[i] : 0;
    }
    return pixels;
}

static void check(const layout *l, int bands, const float *sh) {
    const double brightest = l->texel == LMP_TEXEL_HALF ? 65504 : 1e6;
    for (size_t c = 0; c < (size_t)l->channels; c++)
        for (int band = 0; band < bands; band++)
            for (size_t i = (size_t)(band * band); i < LMP_SH_COUNT(band + 1); i++)
                fuzz_expect(fabs((double)sh[c * LMP_SH_COUNT(bands) + i]) <=
                            3.55 * sqrt(2 * band + 1) * brightest); /* 4 pi max |Y_lm| */
}

static void project_latlong(fuzz_input *in, int bands, float *sh) {
    const layout l = take_layout(in, false);
    lmp_latlong image = { .width = l.columns,
                          .height = l.rows,
                          .channels = l.channels,
                          .texel = l.texel,
                          .row_stride = l.row_stride,
                          .texel_stride = l.texel_stride,
                          .channel_stride = l.channel_stride };
    image.azimuth = fuzz_float(in, 0, 100);
    image.mirrored = fuzz_int(in, 0, 1);
    image.z_up = fuzz_int(in, 0, 1);
    void *const pixels = take_texels(in, &l);
    image.pixels = pixels;
    lmp_sh_project_latlong(bands, &image, sh);
    check(&l, bands, sh);
    free(pixels);
}

static void project_cubemap(fuzz_input *in, int bands, float *sh) {
    const layout l = take_layout(in, true);
    lmp_cubemap map = { .size = l.columns,
                        .channels = l.channels,
                        .texel = l.texel,
                        .row_stride = l.row_stride,
                        .texel_stride = l.texel_stride,
                        .channel_stride = l.channel_stride };
    map.left_handed = fuzz_int(in, 0, 1);
    void *faces[6];
    for (int i = 0; i < 6; i++)
        map.faces[i] = faces[i] = take_texels(in, &l);
    lmp_sh_project_cubemap(bands, &map, sh);
    check(&l, bands, sh);
    for (int i = 0; i < 6; i++)
        free(faces[i]);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static float sh[CHANNELS * VALUES];
    fuzz_input in = { data, size };
    const int bands = fuzz_int(&in, 1, BANDS);
    if (fuzz_int(&in, 0, 1))
        project_latlong(&in, bands, sh);
    else
        project_cubemap(&in, bands, sh);
    return 0;
}
