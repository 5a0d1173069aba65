/* SPDX-License-Identifier: MIT */
#include "app/truth/reference_environment.h"

#include <stdlib.h>

static double solid_angle_of(const image *map, size_t row) {
    const double top = cos(REFERENCE_PI * (double)row / map->height);
    const double bottom = cos(REFERENCE_PI * (double)(row + 1) / map->height);
    return (top - bottom) * 2 * REFERENCE_PI / map->width;
}

static double brightness_of(const image *map, size_t pixel) {
    const float *rgb = map->rgb + 3 * pixel;
    return ((double)rgb[0] + (double)rgb[1] + (double)rgb[2]) / 3;
}

static size_t count_of(const image *map) {
    return (size_t)map->width * (size_t)map->height;
}

bool reference_environment_create(const environment *source, reference_environment *e) {
    *e = (reference_environment) { .source = source };
    if (!environment_shines(source))
        return true;
    const image *map = &source->light;
    double sum = 0;
    e->cumulative = malloc(count_of(map) * sizeof *e->cumulative);
    if (!e->cumulative)
        return false;
    for (size_t row = 0, i = 0; row < (size_t)map->height; row++) {
        const double solid_angle = solid_angle_of(map, row);
        for (const size_t end = i + (size_t)map->width; i < end; i++) {
            sum += brightness_of(map, i) * solid_angle;
            e->cumulative[i] = sum;
            for (size_t c = 0; c < 3; c++)
                e->mean[c] += solid_angle / (4 * REFERENCE_PI) * (double)map->rgb[3 * i + c];
        }
    }
    return true;
}

void reference_environment_free(reference_environment *e) {
    free(e->cumulative);
    *e = (reference_environment) { .cumulative = NULL };
}

bool reference_environment_shines(const reference_environment *e) {
    return e->cumulative && e->cumulative[count_of(&e->source->light) - 1] > 0;
}

reference_vec reference_environment_draw(const reference_environment *e, double u, double v) {
    const image *map = &e->source->light;
    size_t low = 0, high = count_of(map) - 1;
    const double wanted = u * e->cumulative[high];
    while (low < high) {
        const size_t middle = (low + high) / 2;
        if (wanted < e->cumulative[middle])
            high = middle;
        else
            low = middle + 1;
    }
    /* the remainder of u is uniform within the pixel */
    const double before = low > 0 ? e->cumulative[low - 1] : 0;
    const double along = (wanted - before) / (e->cumulative[low] - before);
    const size_t width = (size_t)map->width, row = low / width;
    const double top = cos(REFERENCE_PI * (double)row / map->height);
    const double bottom = cos(REFERENCE_PI * (double)(row + 1) / map->height);
    const double cosine = top + (bottom - top) * along;
    const double sine = sqrt(fmax((1 - cosine) * (1 + cosine), 0));
    const double across = ((double)(low % width) + v) / map->width - 0.5;
    const double azimuth = 2 * REFERENCE_PI * across + (double)e->source->azimuth;
    return (reference_vec) { sine * cos(azimuth), cosine, sine * sin(azimuth) };
}

double reference_environment_at(const reference_environment *e, reference_vec w,
                                double radiance[3]) {
    const image *map = &e->source->light;
    const double turns = (atan2(w.z, w.x) - (double)e->source->azimuth) / (2 * REFERENCE_PI) + 0.5;
    const double polar = acos(fmin(fmax(w.y, -1), 1)) / REFERENCE_PI;
    const size_t column = (size_t)((turns - floor(turns)) * map->width) % (size_t)map->width;
    const size_t row = (size_t)fmin(polar * map->height, map->height - 1);
    const size_t pixel = row * (size_t)map->width + column;
    for (size_t c = 0; c < 3; c++)
        radiance[c] += (double)map->rgb[3 * pixel + c];
    return brightness_of(map, pixel) / e->cumulative[count_of(map) - 1];
}
