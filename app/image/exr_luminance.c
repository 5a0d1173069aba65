/* SPDX-License-Identifier: MIT */
#include "app/image/exr_luminance.h"

#include <stdlib.h>

static double determinant(double m[3][3]) {
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/* Returns the XYZ of a color with Y = 1. */
static void xyz_of(const float xy[2], double xyz[3]) {
    const double x = (double)xy[0], y = (double)xy[1];
    xyz[0] = x / y;
    xyz[1] = 1;
    xyz[2] = (1 - x - y) / y;
}

/* Finds the weights of the primaries whose sum is white, by Cramer's rule. */
void exr_luminance_weights(const float primaries[3][2], const float white[2], double weights[3]) {
    static const double rec709[3] = { 0.2126, 0.7152, 0.0722 };
    double m[3][3], w[3];
    bool valid = true;
    for (int c = 0; c < 3; c++)
        xyz_of(primaries[c], m[c]);
    xyz_of(white, w);
    const double whole = determinant(m);
    for (int c = 0; c < 3; c++) {
        double replaced[3][3];
        for (int i = 0; i < 3; i++)
            for (int k = 0; k < 3; k++)
                replaced[i][k] = i == c ? w[k] : m[i][k];
        weights[c] = determinant(replaced) / whole;
        valid = valid && weights[c] > 0.001 && weights[c] < 1;
    }
    for (int c = 0; c < 3 && !valid; c++)
        weights[c] = rec709[c];
}

/* OpenEXR's filter between two samples, from the nearest on either side outward. */
enum { TAPS = 7 };
static const double taps[TAPS] = { 0.627123, -0.186077, 0.087929, -0.043159,
                                   0.019597, -0.007540, 0.002128 };

static int clamp(int i, int count) {
    return i < 0 ? 0 : i >= count ? count - 1 : i;
}

/* Interpolates the value at `at` in a line of `count` samples, `stride` floats apart. */
static double at_position(const float *samples, int count, size_t stride, int step, int at) {
    const int below = at / step;
    if (at % step == 0)
        return (double)samples[(size_t)below * stride];
    double sum = 0;
    for (int k = 0; k < TAPS; k++)
        sum += taps[k] * ((double)samples[(size_t)clamp(below - k, count) * stride] +
                          (double)samples[(size_t)clamp(below + 1 + k, count) * stride]);
    return sum;
}

/* Interpolates row y of the chroma at full height, at every `step`-th pixel. */
static void fill_row(const exr_chroma *chroma, int width, int height, int y, float *row) {
    const int columns = (width + chroma->step - 1) / chroma->step;
    const int rows = (height + chroma->step - 1) / chroma->step;
    for (int i = 0; i < columns; i++)
        row[i] = (float)at_position(chroma->samples + i, rows, (size_t)columns, chroma->step, y);
}

static void color_row(float *rgb, int width, const float *ry, const float *by, int step,
                      const double weights[3]) {
    const int columns = (width + step - 1) / step;
    for (int x = 0; x < width; x++, rgb += 3) {
        const double y = (double)rgb[1];
        const double r = (at_position(ry, columns, 1, step, x) + 1) * y;
        const double b = (at_position(by, columns, 1, step, x) + 1) * y;
        rgb[0] = (float)r;
        rgb[1] = (float)((y - weights[0] * r - weights[2] * b) / weights[1]);
        rgb[2] = (float)b;
    }
}

bool exr_luminance_to_rgb(image *pixels, const exr_chroma *ry, const exr_chroma *by,
                          const double weights[3]) {
    const int width = pixels->width, height = pixels->height;
    float *const row = malloc(2 * (size_t)width * sizeof *row);
    for (int y = 0; row && y < height; y++) {
        float *const rgb = pixels->rgb + 3 * (size_t)width * (size_t)y;
        fill_row(ry, width, height, y, row);
        fill_row(by, width, height, y, row + width);
        color_row(rgb, width, row, row + width, ry->step, weights);
    }
    free(row);
    return row;
}
