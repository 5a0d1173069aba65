/* SPDX-License-Identifier: MIT */
/* area.c - adds the light of areas to what a chunk of surfaces has accumulated: of those with
 * corners by a kernel, of disks and tubes surface by surface. */
#include "src/kernels/dispatch.h"
#include "src/lobe/response.h"
#include "src/shade/method.h"

static const float pi = 3.14159265f;

/* The most polygons that a kernel is given at once. */
enum { SHADE_POLYGONS_MAX = 4 };

/* The weights of a lobe of this exponent, once they are known. */
typedef struct lobe_weights {
    bool known;
    float exponent, lambda_0, weights[LMP_BANDS_MAX];
} lobe_weights;

static void weigh(const shade_prepared *prepared, float exponent, lobe_weights *to) {
    float lambda[LMP_BANDS_MAX];
    lmp_lobe_make_phong(prepared->bands, exponent, lambda);
    for (int l = 0; l < prepared->bands; l++)
        lambda[l] *= prepared->window[l];
    lmpi_lobe_weights(prepared->bands, lambda, to->weights);
    to->lambda_0 = lambda[0];
    to->exponent = exponent;
    to->known = true;
}

static void add_color(lmp_rgb color, float scale, size_t i, float *const planes[3]) {
    planes[0][i] += color.r * scale;
    planes[1][i] += color.g * scale;
    planes[2][i] += color.b * scale;
}

/* Adds the light of an area on surface i to its diffuse lobe and to `phong_count` others. */
static void add_area(const shade_prepared *prepared, const shade_chunk *chunk,
                     const lobe_weights *lobes, int phong_count, const lmpi_area *area, size_t i) {
    float r[LMP_BANDS_MAX];
    lmpi_seen seen;
    lmp_rgb diffuse = { 0, 0, 0 };
    lmpi_area_see(area, lmpi_batch_get(&chunk->surfaces.point, i), &seen);
    if (phong_count > 0)
        lmpi_seen_close(&seen);
    lmpi_seen_add_irradiance(&seen, lmpi_batch_get(&chunk->surfaces.normal, i), &diffuse);
    add_color(diffuse, 1 / pi, i, chunk->sums.diffuse);
    if (phong_count > 0 && !seen.is_loop)
        lmpi_cap_polynomials(prepared->bands, seen.cap.one_minus_cos, r);
    for (int k = 0; k < phong_count; k++) {
        lmp_rgb specular = { 0, 0, 0 };
        lmpi_lobe_add_seen(prepared->bands, lobes[k].weights, lobes[k].lambda_0, r,
                           lmpi_batch_get(&chunk->surfaces.lobe[k].axis, i), &seen, &specular);
        add_color(specular, 1, i, chunk->sums.specular[k]);
    }
}

/* Adds the light of an area on all surfaces; neighbors often have the same material. */
static void add_area_everywhere(const shade_prepared *prepared, const shade_chunk *chunk,
                                lobe_weights *lobes, const lmpi_area *area) {
    const int phong_count = chunk->is_matte ? 0 : chunk->phong_count;
    for (size_t i = 0; i < chunk->count; i++) {
        for (int k = 0; k < phong_count; k++) {
            const float exponent = chunk->surfaces.lobe[k].exponent[i];
            if (!lobes[k].known || exponent != lobes[k].exponent)
                weigh(prepared, exponent, &lobes[k]);
        }
        add_area(prepared, chunk, lobes, phong_count, area, i);
    }
}

/* Polygons that wait for a kernel. */
typedef struct polygons {
    size_t count;
    lmpi_kernel_polygon polygon[SHADE_POLYGONS_MAX];
} polygons;

static void add_polygons(const shade_prepared *prepared, const shade_chunk *chunk,
                         polygons *waiting) {
    lmpi_kernel_surfaces surfaces = chunk->surfaces;
    if (chunk->is_matte)
        surfaces.lobe_count = 0;
    lmpi_kernels_get()->shade.polygons(prepared->bands, prepared->window, &surfaces,
                                       waiting->polygon, waiting->count, chunk->count,
                                       &chunk->sums);
    waiting->count = 0;
}

LMPI_NOINLINE void lmpi_shade_add_areas(const shade_prepared *prepared, const shade_chunk *chunk,
                                        const lmp_light *lights, size_t count) {
    lobe_weights lobes[LMPI_KERNEL_LOBES_MAX];
    polygons waiting;
    waiting.count = 0;
    for (int k = 0; k < LMPI_KERNEL_LOBES_MAX; k++)
        lobes[k].known = false;
    for (size_t i = 0; i < count; i++) {
        lmpi_area area;
        if (!lmpi_light_is_area(&lights[i]))
            continue;
        lmpi_area_prepare(&lights[i], &area);
        if (!lmpi_area_has_corners(&area)) {
            add_area_everywhere(prepared, chunk, lobes, &area);
            continue;
        }
        lmpi_area_pack(&area, &waiting.polygon[waiting.count++]);
        if (waiting.count == SHADE_POLYGONS_MAX)
            add_polygons(prepared, chunk, &waiting);
    }
    if (waiting.count > 0)
        add_polygons(prepared, chunk, &waiting);
}
