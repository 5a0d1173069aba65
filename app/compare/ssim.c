/* SPDX-License-Identifier: MIT */
#include "app/compare/ssim.h"

#include <math.h>
#include <stdlib.h>

#define REACH 5
#define SIGMA 1.5

/* The windowed means SSIM is made of. */
enum { X, Y, XX, YY, XY, MEANS };

static void luminance_products(const image *candidate, const image *reference, double *planes) {
    const size_t pixels = (size_t)candidate->width * (size_t)candidate->height;
    for (size_t p = 0; p < pixels; p++) {
        const float *a = candidate->rgb + 3 * p, *b = reference->rgb + 3 * p;
        const double x = 0.2126 * (double)a[0] + 0.7152 * (double)a[1] + 0.0722 * (double)a[2];
        const double y = 0.2126 * (double)b[0] + 0.7152 * (double)b[1] + 0.0722 * (double)b[2];
        planes[X * pixels + p] = x;
        planes[Y * pixels + p] = y;
        planes[XX * pixels + p] = x * x;
        planes[YY * pixels + p] = y * y;
        planes[XY * pixels + p] = x * y;
    }
}

/* Gaussian mean along one line of `count` values `stride` apart; weights add up to 1 at the ends
 * too. */
static void blur_line(const double *in, double *out, int count, size_t stride) {
    double weights[REACH + 1];
    for (int i = 0; i <= REACH; i++)
        weights[i] = exp(-i * i / (2 * SIGMA * SIGMA));
    for (int i = 0; i < count; i++) {
        double sum = 0, all = 0;
        for (int j = i < REACH ? -i : -REACH; j <= REACH && i + j < count; j++) {
            sum += weights[abs(j)] * in[(size_t)(i + j) * stride];
            all += weights[abs(j)];
        }
        out[(size_t)i * stride] = sum / all;
    }
}

static void blur(double *plane, double *scratch, int width, int height) {
    for (int y = 0; y < height; y++)
        blur_line(plane + (size_t)y * (size_t)width, scratch + (size_t)y * (size_t)width, width, 1);
    for (int x = 0; x < width; x++)
        blur_line(scratch + x, plane + x, height, (size_t)width);
}

bool compare_ssim(const image *candidate, const image *reference, double peak, double *ssim) {
    const size_t pixels = (size_t)candidate->width * (size_t)candidate->height;
    const double c1 = (0.01 * peak) * (0.01 * peak), c2 = (0.03 * peak) * (0.03 * peak);
    double *planes = malloc((MEANS + 1) * pixels * sizeof *planes), sum = 0;
    if (!planes)
        return false;
    luminance_products(candidate, reference, planes);
    for (int m = 0; m < MEANS; m++)
        blur(planes + (size_t)m * pixels, planes + MEANS * pixels, candidate->width,
             candidate->height);
    for (size_t p = 0; p < pixels; p++) {
        const double x = planes[X * pixels + p], y = planes[Y * pixels + p];
        const double xx = planes[XX * pixels + p] - x * x, yy = planes[YY * pixels + p] - y * y;
        const double xy = planes[XY * pixels + p] - x * y;
        const double under = (x * x + y * y + c1) * (xx + yy + c2);
        sum += under > 0 ? (2 * x * y + c1) * (2 * xy + c2) / under : 1;
    }
    free(planes);
    *ssim = sum / (double)pixels;
    return true;
}
