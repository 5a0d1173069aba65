/* SPDX-License-Identifier: MIT */
#include "src/sh/column.h"
#include "src/sh/quadrature.h"

#include <lampion/sh.h>

#include <assert.h>
#include <math.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

/* --- any function ----------------------------------------------------------------------------- */

/* Adds weight * value cos(m phi) and sin(m phi) for all m < bands. */
static void add_azimuth(int bands, double c, double s, double value, double *cosine, double *sine) {
    double cm = value, sm = 0;
    for (int m = 0; m < bands; m++) {
        cosine[m] += cm;
        sine[m] += sm;
        const double next = c * cm - s * sm;
        sm = s * cm + c * sm;
        cm = next;
    }
}

void lmp_sh_project_function(int bands, lmp_sh_function function, void *user, int nodes,
                             float *sh) {
    assert(bands >= 1 && bands <= LMP_BANDS_MAX);
    assert(nodes >= 0);
    if (nodes == 0)
        nodes = bands;
    memset(sh, 0, LMP_SH_COUNT(bands) * sizeof *sh);
    for (int i = 0; i < nodes; i++) {
        double cosine[LMP_BANDS_MAX] = { 0 }, sine[LMP_BANDS_MAX] = { 0 }, z, weight;
        lmp_gauss_legendre(nodes, i, &z, &weight);
        const double radius = sqrt((1 - z) * (1 + z));
        for (int j = 0; j < 2 * nodes; j++) {
            const double c = cos(pi * (j + 0.5) / nodes), s = sin(pi * (j + 0.5) / nodes);
            const lmp_vec3 w = { (float)(radius * c), (float)(radius * s), (float)z };
            const double value = (double)function(w, user) * weight * pi / nodes;
            add_azimuth(bands, c, s, value, cosine, sine);
        }
        float q[LMP_BANDS_MAX];
        double power = 1; /* radius^m: the azimuths above are those of unit vectors */
        for (int m = 0; m < bands; m++) {
            lmp_sh_column(bands, m, (float)z, q);
            for (int l = m; l < bands; l++) {
                sh[LMP_SH_INDEX(l, m)] += q[l] * (float)(power * cosine[m]);
                if (m > 0)
                    sh[LMP_SH_INDEX(l, -m)] += q[l] * (float)(power * sine[m]);
            }
            power *= radius;
        }
    }
}

/* --- an image of the surroundings ------------------------------------------------------------ */

enum { GROUP = 4 }; /* channels that go through the image together */

typedef struct latlong {
    const float *pixels;
    int width, height, channels;
    size_t row_stride;
} latlong;

static const float *pixel_at(const latlong *pixels, int row, int column) {
    const char *start = (const char *)pixels->pixels + (size_t)row * pixels->row_stride;
    return (const float *)(const void *)start + (size_t)column * (size_t)pixels->channels;
}

static lmp_azimuth azimuth_power(lmp_vec3 w, int m) {
    lmp_azimuth power = { 1, 0 }, base = { w.x, w.y };
    for (; m > 0; m >>= 1) {
        if (m & 1)
            power = (lmp_azimuth) { power.c * base.c - power.s * base.s,
                                    power.c * base.s + power.s * base.c };
        base = (lmp_azimuth) { base.c * base.c - base.s * base.s, 2 * base.c * base.s };
    }
    return power;
}

/* The coefficients ±m of channels first … first+count-1, summed over the image in double. */
static void project_column(int bands, int m, const latlong *pixels, int first, int count,
                           float *sh) {
    double cosines[GROUP][LMP_BANDS_MAX] = { { 0 } }, sines[GROUP][LMP_BANDS_MAX] = { { 0 } };
    float q[LMP_BANDS_MAX];
    for (int row = 0; row < pixels->height; row++) {
        const double top = cos(pi * row / pixels->height);
        const double bottom = cos(pi * (row + 1) / pixels->height);
        const double solid_angle = (top - bottom) * 2 * pi / pixels->width;
        const double polar = pi * (row + 0.5) / pixels->height;
        const double sine = sin(polar), y = cos(polar);
        for (int column = 0; column < pixels->width; column++) {
            const double azimuth = 2 * pi * (column + 0.5) / pixels->width - pi;
            const lmp_vec3 w = { (float)(sine * sin(azimuth)), (float)y,
                                 (float)(-sine * cos(azimuth)) };
            const lmp_azimuth a = azimuth_power(w, m);
            const float *pixel = pixel_at(pixels, row, column) + first;
            lmp_sh_column(bands, m, w.z, q);
            for (int channel = 0; channel < count; channel++) {
                const double value = (double)pixel[channel] * solid_angle;
                for (int l = m; l < bands; l++) {
                    cosines[channel][l] += value * (double)(q[l] * a.c);
                    sines[channel][l] += value * (double)(q[l] * a.s);
                }
            }
        }
    }
    for (int channel = 0; channel < count; channel++) {
        float *plane = sh + (size_t)(first + channel) * LMP_SH_COUNT(bands);
        for (int l = m; l < bands; l++) {
            plane[LMP_SH_INDEX(l, -m)] = (float)sines[channel][l];
            plane[LMP_SH_INDEX(l, m)] = (float)cosines[channel][l];
        }
    }
}

void lmp_sh_project_latlong(int bands, const float *pixels, int width, int height, int channels,
                            size_t row_stride, float *sh) {
    assert(bands >= 1 && bands <= LMP_BANDS_MAX);
    assert(width >= 1 && height >= 1 && channels >= 1);
    if (row_stride == 0)
        row_stride = (size_t)width * (size_t)channels * sizeof *pixels;
    const latlong grid = { pixels, width, height, channels, row_stride };
    for (int first = 0; first < channels; first += GROUP)
        for (int m = 0; m < bands; m++)
            project_column(bands, m, &grid, first,
                           channels - first < GROUP ? channels - first : GROUP, sh);
}
