/* SPDX-License-Identifier: MIT */
/* environment_map.c - the coefficients of a latitude-longitude image, and its color in a direction.
 */
#include "app/scene/environment.h"

#include <math.h>
#include <stdlib.h>

static const double pi = 3.14159265358979323846;

/* Columns for each band, so that its shortest wave is sampled without loss. */
enum { COLUMNS_A_BAND = 8, COLUMNS_MIN = 256 };

/* Returns how many pixels along each side are averaged into one, so that enough remain. */
static int step_of(const image *light, int bands) {
    const int enough = COLUMNS_A_BAND * bands > COLUMNS_MIN ? COLUMNS_A_BAND * bands : COLUMNS_MIN;
    int step = 1;
    while (light->width / (2 * step) >= enough && light->width % (2 * step) == 0 &&
           light->height % (2 * step) == 0)
        step *= 2;
    return step;
}

/* Averages a square of pixels, weighted by solid angle. */
static void average(const image *light, int step, int column, int row, float rgb[3]) {
    double sum[3] = { 0 }, total = 0;
    for (int y = row * step; y < (row + 1) * step; y++) {
        const double solid_angle = cos(pi * y / light->height) - cos(pi * (y + 1) / light->height);
        for (int x = column * step; x < (column + 1) * step; x++) {
            const float *pixel = light->rgb + 3 * ((size_t)y * (size_t)light->width + (size_t)x);
            for (int c = 0; c < 3; c++)
                sum[c] += solid_angle * (double)pixel[c];
            total += solid_angle;
        }
    }
    for (int c = 0; c < 3; c++)
        rgb[c] = (float)(sum[c] / total);
}

bool environment_project(environment *e, int bands, base_error *error) {
    image small;
    if (!e->light.rgb || e->bands >= bands)
        return true;
    const int step = step_of(&e->light, bands);
    if (!image_create(&small, e->light.width / step, e->light.height / step, error))
        return false;
    free(e->sh);
    e->sh = calloc(3 * LMP_SH_COUNT(bands), sizeof *e->sh);
    e->bands = e->sh ? bands : 0;
    for (int y = 0; y < small.height; y++)
        for (int x = 0; x < small.width; x++)
            average(&e->light, step, x, y,
                    small.rgb + 3 * ((size_t)y * (size_t)small.width + (size_t)x));
    const lmp_latlong map = { .pixels = small.rgb,
                              .width = small.width,
                              .height = small.height,
                              .channels = 3,
                              .azimuth = e->azimuth };
    if (e->sh)
        lmp_sh_project_latlong(bands, &map, e->sh);
    image_free(&small);
    return e->sh || base_fail(error, NULL, "out of memory");
}

/* Computes atan2, within 1e-7, by arithmetic whose bits are the same everywhere (Abramowitz and
 * Stegun, 4.4.49). */
static float angle_of(float y, float x) {
    const float a = fabsf(x), b = fabsf(y), most = fmaxf(a, b);
    const float z = most > 0 ? fminf(a, b) / most : 0, s = z * z;
    float angle =
        z +
        z * s *
            (-0.3333314528f +
             s * (0.1999355085f +
                  s * (-0.1420889944f +
                       s * (0.1065626393f + s * (-0.0752896400f +
                                                 s * (0.0429096138f + s * (-0.0161657367f +
                                                                           s * 0.0028662257f)))))));
    angle = b > a ? (float)pi / 2 - angle : angle;
    angle = x < 0 ? (float)pi - angle : angle;
    return copysignf(angle, y);
}

void environment_place(const environment *e, const float d[3], float *across, float *down) {
    const float turns = (angle_of(d[2], d[0]) - e->azimuth) / (2 * (float)pi) + 0.5f;
    *across = turns - floorf(turns);
    *down = angle_of(sqrtf(d[0] * d[0] + d[2] * d[2]), d[1]) / (float)pi;
}

lmp_rgb environment_seen(const environment *e, const float d[3]) {
    const image *map = &e->backdrop;
    float turns, polar;
    environment_place(e, d, &turns, &polar);
    const float u = turns * (float)map->width - 0.5f;
    const float v = fminf(fmaxf(polar * (float)map->height - 0.5f, 0), (float)map->height - 1);
    const int x = (int)floorf(u), y = (int)v;
    const float across = u - floorf(u), down = v - (float)y;
    const int left = x < 0 ? map->width - 1 : x, right = left + 1 == map->width ? 0 : left + 1;
    const int below = y + 1 < map->height ? y + 1 : y;
    const size_t corners[4] = { (size_t)(y * map->width + left), (size_t)(y * map->width + right),
                                (size_t)(below * map->width + left),
                                (size_t)(below * map->width + right) };
    const float weights[4] = { (1 - across) * (1 - down), across * (1 - down), (1 - across) * down,
                               across * down };
    lmp_rgb seen = { 0, 0, 0 };
    for (int i = 0; i < 4; i++) {
        const float *pixel = map->rgb + 3 * corners[i];
        seen.r += weights[i] * pixel[0];
        seen.g += weights[i] * pixel[1];
        seen.b += weights[i] * pixel[2];
    }
    return seen;
}
