/* SPDX-License-Identifier: MIT */
#include "web/probes.h"

#include "lampion/probe.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Three bands hold irradiance to within a few percent (probe.h). 2048 probes take some 10 ms under
 * 1000 spheres. */
enum { BANDS = 3, PROBES_MAX = 2048, SLABS = 7 };
static_assert(sizeof(lmp_probe_constants) == SLABS * 4 * sizeof(float), "a texel for each vector");

static size_t count_probes(const probes_grid *grid) {
    return (size_t)grid->size[0] * grid->size[1] * grid->size[2];
}

/* Chooses the narrowest cells, about as wide as high and deep, whose corners are few enough. */
static void choose_size(probes_grid *grid) {
    const float longest = fmaxf(grid->extent[0], fmaxf(grid->extent[1], grid->extent[2]));
    float cell = longest / 64.0f;
    do {
        for (int axis = 0; axis < 3; axis++)
            grid->size[axis] = 2 + (uint32_t)(grid->extent[axis] / cell);
        cell *= 1.02f;
    } while (count_probes(grid) > PROBES_MAX);
}

static void place(probes_grid *grid) {
    lmp_vec3 *point = grid->points;
    for (uint32_t z = 0; z < grid->size[2]; z++)
        for (uint32_t y = 0; y < grid->size[1]; y++)
            for (uint32_t x = 0; x < grid->size[0]; x++) {
                const uint32_t at[3] = { x, y, z };
                float position[3];
                for (int axis = 0; axis < 3; axis++)
                    position[axis] = grid->minimum[axis] + grid->extent[axis] * (float)at[axis] /
                                                               (float)(grid->size[axis] - 1);
                *point++ = (lmp_vec3) { position[0], position[1], position[2] };
            }
}

bool probes_spread(probes_grid *grid, const float minimum[3], const float maximum[3]) {
    for (int axis = 0; axis < 3; axis++) {
        grid->minimum[axis] = minimum[axis];
        grid->extent[axis] = fmaxf(maximum[axis] - minimum[axis], 1e-3f);
    }
    choose_size(grid);
    const size_t count = count_probes(grid);
    free(grid->points);
    free(grid->sh);
    free(grid->texels);
    grid->points = malloc(count * sizeof *grid->points);
    grid->sh = malloc(count * 3 * LMP_SH_COUNT(BANDS) * sizeof *grid->sh);
    grid->texels = malloc(count * sizeof(lmp_probe_constants));
    if (!grid->points || !grid->sh || !grid->texels)
        return false;
    place(grid);
    return true;
}

void probes_light(probes_grid *grid, const lmp_light *lights, size_t light_count) {
    const size_t count = count_probes(grid), values = 3 * LMP_SH_COUNT(BANDS);
    const lmp_vec3_array points = { &grid->points->x, &grid->points->y, &grid->points->z,
                                    sizeof *grid->points };
    lmp_light_project_n(NULL, BANDS, lights, light_count, NULL, points, count,
                        lmp_sh_interleaved(grid->sh, 0));
    for (size_t i = 0; i < count; i++) {
        float vectors[SLABS][4];
        lmp_probe_constants constants;
        lmp_probe_make_constants(BANDS, 1, grid->sh + values * i, &constants);
        memcpy(vectors, &constants, sizeof vectors);
        for (size_t slab = 0; slab < SLABS; slab++)
            memcpy(grid->texels + 4 * (slab * count + i), vectors[slab], sizeof *vectors);
    }
}
