/* SPDX-License-Identifier: MIT */
/* area.c - adds the light of areas to what a chunk of surfaces has accumulated: by kernels, and
 * surface by surface what those of disks and tubes leave. */
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

/* Adds the light of an area on surface i to those of its diffuse lobe and of `phong_count` others
 * that `parts` names. */
static void add_area(const shade_prepared *prepared, const shade_chunk *chunk,
                     const lobe_weights *lobes, int phong_count, const lmpi_area *area, int parts,
                     size_t i) {
    float r[LMP_BANDS_MAX];
    lmpi_seen seen;
    lmpi_area_see(area, lmpi_batch_get(&chunk->surfaces.point, i), &seen);
    const int phong = parts & LMPI_LEFT_LOBES ? phong_count : 0;
    if (phong > 0)
        lmpi_seen_close(&seen);
    if (parts & LMPI_LEFT_DIFFUSE) {
        lmp_rgb diffuse = { 0, 0, 0 };
        lmpi_seen_add_irradiance(&seen, lmpi_batch_get(&chunk->surfaces.normal, i), &diffuse);
        add_color(diffuse, 1 / pi, i, chunk->sums.diffuse);
    }
    if (phong > 0 && !seen.is_loop)
        lmpi_cap_polynomials(prepared->bands, seen.cap.one_minus_cos, r);
    for (int k = 0; k < phong; k++) {
        lmp_rgb specular = { 0, 0, 0 };
        lmpi_lobe_add_seen(prepared->bands, lobes[k].weights, lobes[k].lambda_0, r,
                           lmpi_batch_get(&chunk->surfaces.lobe[k].axis, i), &seen, &specular);
        add_color(specular, 1, i, chunk->sums.specular[k]);
    }
}

static int phong_count_of(const shade_chunk *chunk) {
    return chunk->is_matte ? 0 : chunk->phong_count;
}

/* Adds those parts of the light of an area that are left on surfaces; neighbors often have the same
 * material. */
static void add_left(const shade_prepared *prepared, const shade_chunk *chunk, lobe_weights *lobes,
                     const lmpi_area *area, const float *left) {
    const int phong_count = phong_count_of(chunk);
    for (size_t i = 0; i < chunk->count; i++) {
        const int parts = (int)left[i];
        if (parts == 0)
            continue;
        for (int k = 0; k < phong_count; k++) {
            const float exponent = chunk->surfaces.lobe[k].exponent[i];
            if (!lobes[k].known || exponent != lobes[k].exponent)
                weigh(prepared, exponent, &lobes[k]);
        }
        add_area(prepared, chunk, lobes, phong_count, area, parts, i);
    }
}

static lmpi_kernel_surfaces surfaces_of(const shade_chunk *chunk) {
    lmpi_kernel_surfaces surfaces = chunk->surfaces;
    surfaces.lobe_count = phong_count_of(chunk);
    return surfaces;
}

static void add_disk(const shade_prepared *prepared, const shade_chunk *chunk,
                     const lmpi_area *area, float *left) {
    const lmpi_kernel_surfaces surfaces = surfaces_of(chunk);
    lmpi_kernel_disk disk;
    lmpi_area_pack_disk(area, &disk);
    lmpi_kernels_get()->shade.disk(prepared->bands, prepared->window, &surfaces, &disk,
                                   chunk->count, &chunk->sums, left);
}

static void add_tube(const shade_prepared *prepared, const shade_chunk *chunk,
                     const lmpi_area *area, float *left) {
    const lmpi_kernel_surfaces surfaces = surfaces_of(chunk);
    lmpi_kernel_tube tube;
    lmpi_area_pack_tube(area, &tube);
    lmpi_kernels_get()->shade.tube(prepared->bands, prepared->window, &surfaces, &tube,
                                   chunk->count, &chunk->sums, left);
}

/* Polygons that wait for a kernel. */
typedef struct polygons {
    size_t count;
    lmpi_kernel_polygon polygon[SHADE_POLYGONS_MAX];
} polygons;

static void add_polygons(const shade_prepared *prepared, const shade_chunk *chunk,
                         polygons *waiting) {
    const lmpi_kernel_surfaces surfaces = surfaces_of(chunk);
    lmpi_kernels_get()->shade.polygons(prepared->bands, prepared->window, &surfaces,
                                       waiting->polygon, waiting->count, chunk->count,
                                       &chunk->sums);
    waiting->count = 0;
}

/* Adds the light of an area that has no corners. By itself, because polygons need the stack. */
static LMPI_NOINLINE void add_round(const shade_prepared *prepared, const shade_chunk *chunk,
                                    lobe_weights *lobes, const lmpi_area *area) {
    _Alignas(64) float left[SHADE_SURFACES_MAX];
    if (lmpi_area_is_tube(area->light))
        add_tube(prepared, chunk, area, left);
    else
        add_disk(prepared, chunk, area, left);
    add_left(prepared, chunk, lobes, area, left);
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
        if (lmpi_area_is_tube(&lights[i]) || area.count == 0) {
            add_round(prepared, chunk, lobes, &area);
            continue;
        }
        lmpi_area_pack_polygon(&area, &waiting.polygon[waiting.count++]);
        if (waiting.count == SHADE_POLYGONS_MAX)
            add_polygons(prepared, chunk, &waiting);
    }
    if (waiting.count > 0)
        add_polygons(prepared, chunk, &waiting);
}
