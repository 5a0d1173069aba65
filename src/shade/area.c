/* SPDX-License-Identifier: MIT */
/* area.c - areas, which no kernel takes: their light is added to what a chunk of surfaces has
 * accumulated, surface by surface. */
#include "src/lobe/response.h"
#include "src/shade/method.h"

static const float pi = 3.14159265f;

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
                                lobe_weights *lobes, const lmp_light *light) {
    const int phong_count = chunk->is_matte ? 0 : chunk->phong_count;
    lmpi_area area;
    lmpi_area_prepare(light, &area);
    for (size_t i = 0; i < chunk->count; i++) {
        for (int k = 0; k < phong_count; k++) {
            const float exponent = chunk->surfaces.lobe[k].exponent[i];
            if (!lobes[k].known || exponent != lobes[k].exponent)
                weigh(prepared, exponent, &lobes[k]);
        }
        add_area(prepared, chunk, lobes, phong_count, &area, i);
    }
}

LMPI_NOINLINE void lmpi_shade_add_areas(const shade_prepared *prepared, const shade_chunk *chunk,
                                        const lmp_light *lights, size_t count) {
    lobe_weights lobes[LMPI_KERNEL_LOBES_MAX];
    for (int k = 0; k < LMPI_KERNEL_LOBES_MAX; k++)
        lobes[k].known = false;
    for (size_t light = 0; light < count; light++)
        if (lmpi_light_is_area(&lights[light]))
            add_area_everywhere(prepared, chunk, lobes, &lights[light]);
}
