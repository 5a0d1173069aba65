/* SPDX-License-Identifier: MIT */
#include "src/shade/method.h"

#include "src/kernels/dispatch.h"

/* --- by bands --------------------------------------------------------------------------------- */

static void prepare_zonal(const lmp_shade_settings *settings, shade_prepared *prepared) {
    prepared->bands = settings->bands;
    lmp_sh_make_window(settings->bands, settings->window, settings->window_size, prepared->window);
}

static void add_zonal(const shade_prepared *prepared, const shade_chunk *chunk,
                      const lmpi_packed_light *lights, size_t count) {
    lmpi_kernel_surfaces surfaces = chunk->surfaces;
    if (chunk->is_matte)
        surfaces.lobe_count = 0;
    lmpi_kernels_get()->shade.zonal(prepared->settings->bands, prepared->window, &surfaces, lights,
                                    count, chunk->count, &chunk->sums);
}

/* --- from preintegrated lobes ----------------------------------------------------------------- */

static void prepare_preintegrated(const lmp_shade_settings *settings, shade_prepared *prepared) {
    if (!settings->lobe)
        return;
    prepared->info = lmp_preintegrated_lobe_describe(settings->lobe);
    prepared->bands = prepared->info.bands;
    lmp_sh_make_window(prepared->info.bands, prepared->info.window, prepared->info.window_size,
                       prepared->window);
}

/* Positions of all lobes of a chunk: one plane after another. */
enum { POSITIONS = SHADE_FLOATS / SHADE_LOBE_PLANES };

/* Where each surface's lobe lies in the preintegrated lobe. */
typedef struct chunk_positions {
    uint32_t first[POSITIONS], columns[POSITIONS];
    float fraction[POSITIONS], density[POSITIONS], lobe_angle[POSITIONS];
} chunk_positions;

static lmpi_kernel_lobe_positions find_positions(const lmp_preintegrated_lobe_info *info,
                                                 const float *exponents, size_t count, size_t begin,
                                                 chunk_positions *positions) {
    lmpi_preintegrated_lobe_position position = { 0 };
    float exponent = -1;
    for (size_t i = 0; i < count || i % LMPI_KERNEL_LANES_MAX; i++) {
        /* Past the last surface its position is repeated, because a kernel reads whole vectors. */
        const float e = exponents[i < count ? i : count - 1];
        if (e < exponent || e > exponent)
            lmpi_preintegrated_lobe_lookup(info, e, &position);
        exponent = e;
        positions->first[begin + i] = position.first;
        positions->columns[begin + i] = position.columns;
        positions->fraction[begin + i] = position.fraction;
        positions->density[begin + i] = position.density;
        positions->lobe_angle[begin + i] = position.lobe_angle;
    }
    return (lmpi_kernel_lobe_positions) { positions->first + begin, positions->columns + begin,
                                          positions->fraction + begin, positions->density + begin,
                                          positions->lobe_angle + begin };
}

static void add_preintegrated(const shade_prepared *prepared, const shade_chunk *chunk,
                              const lmpi_packed_light *lights, size_t count) {
    chunk_positions positions;
    lmpi_kernel_lobe_positions specular[LMPI_KERNEL_LOBES_MAX];
    const lmpi_kernel_preintegrated_lobe lobe = { prepared->info.coefficients };
    for (int k = 0; k < chunk->phong_count; k++)
        specular[k] = find_positions(&prepared->info, chunk->planes.lobe[k].exponent, chunk->count,
                                     (size_t)k * chunk->planes.stride, &positions);
    lmpi_kernels_get()->shade.preintegrated_lobe(&lobe, specular, &chunk->surfaces, lights, count,
                                                 chunk->count, &chunk->sums);
}

/* --- the table -------------------------------------------------------------------------------- */

static const shade_method methods[LMP_SHADE_METHOD_COUNT] = {
    [LMP_SHADE_ZONAL] = { .lobes_of_one = lmpi_shade_lobes_zonal,
                          .prepare = prepare_zonal,
                          .lobes_of_chunk = add_zonal },
    [LMP_SHADE_COEFFICIENTS] = { .diffuse_by_bands = true,
                                 .lobes_of_one = lmpi_shade_lobes_coefficients },
    [LMP_SHADE_PREINTEGRATED] = { .preintegrated = true,
                                  .prepare = prepare_preintegrated,
                                  .lobes_of_chunk = add_preintegrated },
};

const shade_method *lmpi_shade_method_of(lmp_shade_method name) {
    return &methods[name];
}
