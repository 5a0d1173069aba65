/* SPDX-License-Identifier: MIT */
#include "src/shade/method.h"

/* --- by bands --------------------------------------------------------------------------------- */

static void prepare_zonal(const lmp_shade_settings *settings, shade_prepared *prepared) {
    lmp_sh_window(settings->bands, settings->window, settings->window_size, prepared->window);
}

static void add_zonal(const shade_prepared *prepared, const shade_chunk *chunk,
                      const lmp_packed_light *lights, size_t count) {
    lmp_kernels_get()->shade_zonal(prepared->settings->bands, prepared->window, &chunk->surfaces,
                                   lights, count, chunk->count, &chunk->sums);
}

/* --- from preintegrated lobes ----------------------------------------------------------------- */

static void prepare_preintegrated(const lmp_shade_settings *settings, shade_prepared *prepared) {
    if (settings->lobe)
        prepared->info = lmp_preintegrated_lobe_describe(settings->lobe);
}

/* Of all lobes of a chunk: one plane after the other. */
enum { POSITIONS = SHADE_FLOATS / SHADE_LOBE_PLANES };

/* Where each surface's lobe lies. */
typedef struct chunk_positions {
    uint32_t first[POSITIONS], columns[POSITIONS];
    float fraction[POSITIONS], density[POSITIONS], lobe_angle[POSITIONS];
} chunk_positions;

static lmp_kernel_lobe_positions find_positions(const lmp_preintegrated_lobe_info *info,
                                                const float *exponents, size_t count, size_t begin,
                                                chunk_positions *positions) {
    lmp_preintegrated_lobe_position position = { 0 };
    float exponent = -1;
    for (size_t i = 0; i < count || i % LMP_KERNEL_LANES_MAX; i++) {
        /* Past the last surface, its position again: a kernel reads whole vectors. */
        const float e = exponents[i < count ? i : count - 1];
        if (e < exponent || e > exponent)
            lmp_preintegrated_lobe_lookup(info, e, &position);
        exponent = e;
        positions->first[begin + i] = position.first;
        positions->columns[begin + i] = position.columns;
        positions->fraction[begin + i] = position.fraction;
        positions->density[begin + i] = position.density;
        positions->lobe_angle[begin + i] = position.lobe_angle;
    }
    return (lmp_kernel_lobe_positions) { positions->first + begin, positions->columns + begin,
                                         positions->fraction + begin, positions->density + begin,
                                         positions->lobe_angle + begin };
}

static void add_preintegrated(const shade_prepared *prepared, const shade_chunk *chunk,
                              const lmp_packed_light *lights, size_t count) {
    chunk_positions positions;
    lmp_kernel_lobe_positions specular[LMP_KERNEL_LOBES_MAX];
    const lmp_kernel_preintegrated_lobe lobe = { prepared->info.coefficients };
    for (int k = 0; k < chunk->phong_count; k++)
        specular[k] = find_positions(&prepared->info, chunk->planes.lobe[k].exponent, chunk->count,
                                     (size_t)k * chunk->planes.stride, &positions);
    lmp_kernels_get()->shade_preintegrated_lobe(&lobe, specular, &chunk->surfaces, lights, count,
                                                chunk->count, &chunk->sums);
}

/* --- the table -------------------------------------------------------------------------------- */

static const shade_method methods[LMP_SHADE_METHODS] = {
    [LMP_SHADE_ZONAL] = { .lobes_of_one = lmp_shade_lobes_zonal,
                          .prepare = prepare_zonal,
                          .lobes_of_chunk = add_zonal },
    [LMP_SHADE_COEFFICIENTS] = { .diffuse_by_bands = true,
                                 .lobes_of_one = lmp_shade_lobes_coefficients },
    [LMP_SHADE_PREINTEGRATED] = { .preintegrated = true,
                                  .prepare = prepare_preintegrated,
                                  .lobes_of_chunk = add_preintegrated },
};

const shade_method *lmp_shade_method_of(lmp_shade_method name) {
    return &methods[name];
}
