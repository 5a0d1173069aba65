/* SPDX-License-Identifier: MIT */
/* environment.c - what surfaces reflect of ambient light from far away: a lobe of factors lambda_l
 * around an axis q accumulates Σ_l lambda_l Σ_m L_lm Y_lm(q). */
#include "src/kernels/dispatch.h"
#include "src/shade/method.h"

static const float pi = 3.14159265f;

/* What is the same for all surfaces: the bands, the factors of the diffuse lobe of integral 1, and
 * the window of Phong lobes. */
typedef struct environment_method {
    const lmp_shade_settings *settings;
    int bands;
    float diffuse[LMP_BANDS_MAX], window[LMP_BANDS_MAX];
    const float *planes[3];
} environment_method;

static lmp_shade_settings settings_of(const lmp_shade_settings *settings) {
    lmp_shade_settings resolved = lmpi_shade_resolve(settings);
    if (lmpi_shade_method_of(resolved.method)->preintegrated && resolved.lobe) {
        const lmp_preintegrated_lobe_info info = lmp_preintegrated_lobe_describe(resolved.lobe);
        resolved.bands = info.bands;
        resolved.window = info.window;
        resolved.window_size = info.window_size;
    }
    return resolved;
}

static environment_method method_of(const lmp_shade_settings *resolved, const lmp_environment *e) {
    environment_method method = { .settings = resolved,
                                  .bands =
                                      resolved->bands < e->bands ? resolved->bands : e->bands };
    lmp_sh_make_window(resolved->bands, resolved->window, resolved->window_size, method.window);
    const bool windowed = lmpi_shade_method_of(resolved->method)->diffuse_by_bands;
    lmp_lobe_make_diffuse(resolved->bands, method.diffuse);
    for (int l = 0; l < resolved->bands; l++)
        method.diffuse[l] *= (windowed ? method.window[l] : 1) / pi;
    for (size_t c = 0; c < 3; c++)
        method.planes[c] = e->sh + c * LMP_SH_COUNT(e->bands);
    return method;
}

/* --- surfaces that have lobes ----------------------------------------------------------------- */

/* Some of a chunk's surfaces, all with the same number of Phong lobes. */
typedef struct environment_chunk {
    size_t count, at[SHADE_SURFACES_MIN]; /* indices among the caller's */
    shade_planes lobes;
} environment_chunk;

static void accumulate(const environment_method *method, const float *factors,
                       const float *exponents, const lmpi_kernel_vec3 *axes, size_t count,
                       size_t stride, float *accumulated) {
    const lmpi_kernel_out out = { accumulated, stride, 1 };
    lmpi_kernels_get()->sh.reconstruct(method->bands, factors, exponents, method->planes, axes,
                                       count, &out);
}

static void shade_lobes_of_chunk(const environment_method *method, const lmp_surfaces *surfaces,
                                 int lobe_count, environment_chunk *chunk, size_t stride,
                                 float *rgb) {
    static const float no_light[3] = { 0, 0, 0 };
    shade_planes *lobes = &chunk->lobes;
    const size_t count = chunk->count;
    lmpi_shade_divide(lobe_count, lobes);
    const bool in_a_row = chunk->at[count - 1] - chunk->at[0] == count - 1; /* they rise */
    const lmpi_kernel_vec3 normal =
        lmpi_shade_vectors(&surfaces->normal, chunk->at, count, in_a_row, lobes->normal);
    const lmpi_kernel_vec3 view =
        lmpi_shade_vectors(&surfaces->view, chunk->at, count, in_a_row, lobes->view);
    lmpi_shade_load(surfaces, chunk->at, count, lobe_count, &normal, &view, lobes);
    accumulate(method, method->diffuse, NULL, &normal, count, lobes->stride, lobes->accumulated[0]);
    for (int k = 0; k < lobe_count; k++) {
        shade_lobe_planes *lobe = &lobes->lobe[k];
        const lmpi_kernel_vec3 axis = lmpi_batch_planes(lobe->axis);
        accumulate(method, method->window, lobe->exponent, &axis, count, lobes->stride,
                   lobe->accumulated[0]);
    }
    lmpi_shade_sum_planes(count, lobe_count, no_light, lobes);
    lmpi_shade_store(lobes, chunk->at, count, stride, rgb);
}

/* --- surfaces --------------------------------------------------------------------------------- */

/* Shades a surface that has a table, or that reflects nothing of an environment. */
static void shade_one(const lmp_surfaces *surfaces, size_t i, const lmp_environment *e,
                      const lmp_brdf_table *table, size_t stride, float *rgb) {
    lmp_rgb color = { 0, 0, 0 };
    if (table) {
        lmp_surface surface = { .normal = lmpi_vec3_element(&surfaces->normal, i),
                                .view = lmpi_vec3_element(&surfaces->view, i) };
        if (surfaces->tangent.x)
            surface.tangent = lmpi_vec3_element(&surfaces->tangent, i);
        color = lmpi_shade_table_environment(table, &surface, e);
        color = (lmp_rgb) { lmpi_shade_clamped(color.r), lmpi_shade_clamped(color.g),
                            lmpi_shade_clamped(color.b) };
    }
    memcpy((char *)rgb + i * stride, &color, sizeof color);
}

/* Counts the Phong lobes of surfaces first … end-1; returns which layers lie over any of them. */
static unsigned count_lobes(const lmp_surfaces *surfaces, size_t first, size_t end,
                            unsigned char lobes[SHADE_SURFACES_MIN]) {
    unsigned layer_mask = 0;
    for (size_t i = first; i < end; i++) {
        const lmp_material *material = lmpi_material_at(surfaces, i);
        lobes[i - first] =
            (unsigned char)lmpi_shade_phong_count(material, lmpi_vec3_element(&surfaces->normal, i),
                                                  lmpi_vec3_element(&surfaces->view, i));
        layer_mask |= lmpi_shade_layer_mask(material);
    }
    return layer_mask;
}

unsigned lmpi_shade_environment_bare_n(const lmp_shade_settings *settings,
                                       const lmp_surfaces *surfaces, size_t count,
                                       const lmp_environment *environment, size_t stride,
                                       float *rgb) {
    const lmp_shade_settings resolved = settings_of(settings);
    const environment_method method = method_of(&resolved, environment);
    environment_chunk chunk;
    unsigned layer_mask = 0;
    assert(lmpi_are_unit(surfaces->normal, count) && lmpi_are_unit(surfaces->view, count));
    assert(lmpi_is_bands(environment->bands));
    for (size_t first = 0; first < count; first += SHADE_SURFACES_MIN) {
        const size_t rest = count - first;
        const size_t end = first + (rest < SHADE_SURFACES_MIN ? rest : SHADE_SURFACES_MIN);
        unsigned char counts[SHADE_SURFACES_MIN];
        layer_mask |= count_lobes(surfaces, first, end, counts);
        for (int lobes = 0; lobes <= LMP_GGX_LOBES; lobes++) {
            chunk.count = 0;
            for (size_t i = first; i < end; i++) {
                if (counts[i - first] != lobes)
                    continue;
                if (lobes > 0)
                    chunk.at[chunk.count++] = i;
                else
                    shade_one(surfaces, i, environment,
                              lmpi_shade_source(lmpi_material_at(surfaces, i), false).table, stride,
                              rgb);
            }
            if (chunk.count == 0)
                continue;
            lmpi_shade_fill(chunk.at, chunk.count);
            shade_lobes_of_chunk(&method, surfaces, lobes, &chunk, stride, rgb);
        }
    }
    return layer_mask;
}
