/* SPDX-License-Identifier: MIT */
#include "app/render/shadow/around.h"

#include "app/scene/vector.h"

#include <stdlib.h>

static double brightness_of(const float *rgb) {
    return ((double)rgb[0] + (double)rgb[1] + (double)rgb[2]) / 3;
}

/* Accumulates the brightness of a row's pixels, weighted by solid angle, and the mean; returns the
 * row's sum. */
static double add_row(const image *map, int row, double height, double *columns, double mean[3]) {
    const double solid_angle = height * 2 * (double)PI / map->width;
    double sum = 0;
    for (int x = 0; x < map->width; x++) {
        const float *rgb = map->rgb + 3 * ((size_t)row * (size_t)map->width + (size_t)x);
        sum += brightness_of(rgb) * solid_angle;
        columns[x] = sum;
        for (int c = 0; c < 3; c++)
            mean[c] += (double)rgb[c] * solid_angle / (4 * (double)PI);
    }
    return sum;
}

bool shadow_around_create(const environment *source, shadow_around *around) {
    *around = (shadow_around) { .source = source };
    if (!environment_shines(source))
        return true;
    const image *map = &source->light;
    const size_t width = (size_t)map->width, height = (size_t)map->height;
    double sum = 0, mean[3] = { 0 };
    around->columns = malloc(width * height * sizeof *around->columns);
    around->rows = malloc(height * sizeof *around->rows);
    around->cosines = malloc((height + 1) * sizeof *around->cosines);
    if (!around->columns || !around->rows || !around->cosines) {
        shadow_around_free(around);
        return false;
    }
    for (size_t y = 0; y <= height; y++)
        around->cosines[y] = cos((double)PI * (double)y / (double)height);
    for (size_t y = 0; y < height; y++)
        around->rows[y] = sum += add_row(map, (int)y, around->cosines[y] - around->cosines[y + 1],
                                         around->columns + y * width, mean);
    around->mean = (lmp_rgb) { (float)mean[0], (float)mean[1], (float)mean[2] };
    return true;
}

void shadow_around_free(shadow_around *around) {
    free(around->columns);
    free(around->rows);
    free(around->cosines);
    *around = (shadow_around) { .columns = NULL };
}

bool shadow_around_shines(const shadow_around *around) {
    return around->rows && around->rows[around->source->light.height - 1] > 0;
}

/* Finds the entry of cumulative sums at the fraction u of the total; *u becomes uniform within
 * it. */
static int find(const double *sums, int count, double *u) {
    const double wanted = *u * sums[count - 1];
    int low = 0, high = count - 1;
    while (low < high) {
        const int middle = (low + high) / 2;
        if (wanted < sums[middle])
            high = middle;
        else
            low = middle + 1;
    }
    const double before = low > 0 ? sums[low - 1] : 0;
    *u = (wanted - before) / (sums[low] - before);
    return low;
}

static shadow_arrival arrival_of(const shadow_around *around, int row, int column) {
    const image *map = &around->source->light;
    const float *rgb = map->rgb + 3 * ((size_t)row * (size_t)map->width + (size_t)column);
    return (shadow_arrival) { rgb_load(rgb),
                              (float)(brightness_of(rgb) / around->rows[map->height - 1]) };
}

lmp_vec3 shadow_around_draw(const shadow_around *around, float u, float v,
                            shadow_arrival *arrival) {
    const image *map = &around->source->light;
    const size_t width = (size_t)map->width;
    double down = (double)u, across = (double)v;
    const int row = find(around->rows, map->height, &down);
    const int column = find(around->columns + (size_t)row * width, map->width, &across);
    const double top = around->cosines[row], bottom = around->cosines[row + 1];
    const double cosine = top + (bottom - top) * down;
    const double sine = sqrt(fmax((1 - cosine) * (1 + cosine), 0));
    const double turns = (column + across) / map->width - 0.5;
    const double azimuth = 2 * (double)PI * turns + (double)around->source->azimuth;
    *arrival = arrival_of(around, row, column);
    return vec((float)(sine * cos(azimuth)), (float)cosine, (float)(sine * sin(azimuth)));
}

shadow_arrival shadow_around_look(const shadow_around *around, lmp_vec3 direction) {
    const image *map = &around->source->light;
    float across, down;
    environment_place(around->source, (float[3]) { direction.x, direction.y, direction.z }, &across,
                      &down);
    const int column = (int)(across * (float)map->width), row = (int)(down * (float)map->height);
    return arrival_of(around, row < map->height ? row : map->height - 1,
                      column < map->width ? column : map->width - 1);
}
