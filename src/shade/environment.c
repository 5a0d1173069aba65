/* SPDX-License-Identifier: MIT */
/* environment.c - what surfaces reflect of ambient light from far away: a lobe of factors lambda_l
 * around an axis q accumulates Σ_l lambda_l Σ_m L_lm Y_lm(q).
 *
 * Surfaces go through in runs, which the loops over them make vectors of; each is summed in the
 * same order by itself, so that no run changes a bit. */
#include "src/base/element.h"
#include "src/sh/column.h"
#include "src/shade/material.h"

#include <string.h>

enum { RUN = 8 };

/* A lobe of each surface of a run. */
typedef struct lobe_run {
    float x[RUN], y[RUN], z[RUN];
    float weight[3][RUN];
    float lambda[LMP_BANDS_MAX][RUN];
} lobe_run;

/* What was found along one column ±m: Σ_l of the coefficients' products, before C_m and S_m. */
typedef struct column_sums {
    float cosine[3][RUN], sine[3][RUN];
} column_sums;

/* Adds band l of a column, value[i] = lambda_l q_l^m. */
static void add_band(const lmp_environment *e, int l, int m, const float value[RUN],
                     column_sums *sums) {
    for (int c = 0; c < 3; c++) {
        const float *plane = e->sh + (size_t)c * LMP_SH_COUNT(e->bands);
        const float plus = plane[LMP_SH_INDEX(l, m)], minus = plane[LMP_SH_INDEX(l, -m)];
        for (int i = 0; i < RUN; i++)
            sums->cosine[c][i] += plus * value[i];
        for (int i = 0; m > 0 && i < RUN; i++)
            sums->sine[c][i] += minus * value[i];
    }
}

static void sum_column(const lmp_environment *e, int bands, int m, const lobe_run *run,
                       column_sums *sums) {
    const float *a = lmp_table_a + lmp_table_index(m, m);
    const float *b = lmp_table_b + lmp_table_index(m, m);
    float q[RUN], before[RUN] = { 0 }, value[RUN];
    memset(sums, 0, sizeof *sums);
    for (int i = 0; i < RUN; i++)
        q[i] = lmp_table_diagonal[m];
    for (int l = m; l < bands; l++) {
        for (int i = 0; l > m && i < RUN; i++) {
            const float next = a[l - m] * run->z[i] * q[i] + b[l - m] * before[i];
            before[i] = q[i];
            q[i] = next;
        }
        for (int i = 0; i < RUN; i++)
            value[i] = q[i] * run->lambda[l][i];
        add_band(e, l, m, value, sums);
    }
}

/* Adds the responses of the lobes, times their weights, to rgb. */
static void add_lobes(const lmp_environment *e, int bands, const lobe_run *run, float rgb[3][RUN]) {
    float c[RUN], s[RUN] = { 0 }, response[3][RUN] = { { 0 } };
    for (int i = 0; i < RUN; i++)
        c[i] = 1;
    for (int m = 0; m < bands; m++) {
        column_sums sums;
        sum_column(e, bands, m, run, &sums);
        for (int k = 0; k < 3; k++)
            for (int i = 0; i < RUN; i++)
                response[k][i] += sums.cosine[k][i] * c[i] + sums.sine[k][i] * s[i];
        for (int i = 0; i < RUN; i++) {
            const float rotated = run->x[i] * c[i] - run->y[i] * s[i];
            s[i] = run->x[i] * s[i] + run->y[i] * c[i];
            c[i] = rotated;
        }
    }
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < RUN; i++)
            rgb[k][i] += run->weight[k][i] * response[k][i];
}

/* --- surfaces --------------------------------------------------------------------------------- */

static lmp_surface surface_at(const lmp_surfaces *surfaces, size_t i) {
    lmp_surface surface = { .normal = lmp_vec3_element(&surfaces->normal, i),
                            .view = lmp_vec3_element(&surfaces->view, i) };
    if (surfaces->tangent.x)
        surface.tangent = lmp_vec3_element(&surfaces->tangent, i);
    return surface;
}

/* Lobe k of surface i in the run; of weight 0 where the material has fewer. */
static void take_lobe(const shade_lobes *lobes, int k, int bands, size_t i, lobe_run *run) {
    const shade_lobe *lobe = &lobes->lobe[k];
    const bool there = k < lobes->count;
    run->x[i] = there ? lobe->axis.x : 0;
    run->y[i] = there ? lobe->axis.y : 0;
    run->z[i] = there ? lobe->axis.z : 0;
    run->weight[0][i] = there ? lobe->weight.r : 0;
    run->weight[1][i] = there ? lobe->weight.g : 0;
    run->weight[2][i] = there ? lobe->weight.b : 0;
    for (int l = 0; l < bands; l++)
        run->lambda[l][i] = there ? lobe->lambda[l] : 0;
}

static lmp_shade_settings settings_of(const lmp_shade_settings *settings) {
    lmp_shade_settings resolved = lmp_shade_resolve(settings);
    if (resolved.method == LMP_SHADE_PREINTEGRATED && resolved.lobe) {
        const lmp_preintegrated_lobe_info info = lmp_preintegrated_lobe_describe(resolved.lobe);
        resolved.bands = info.bands;
        resolved.window = info.window;
        resolved.window_size = info.window_size;
    }
    return resolved;
}

/* Surfaces `first` on, at most RUN of them. */
static void shade_run(const lmp_shade_settings *settings, const lmp_surfaces *surfaces,
                      size_t first, size_t count, const lmp_environment *e, float rgb[3][RUN]) {
    const int bands = settings->bands < e->bands ? settings->bands : e->bands;
    lobe_run run[SHADE_LOBES_MAX];
    int lobe_count = 0;
    memset(run, 0, sizeof run);
    for (size_t i = 0; i < count; i++) {
        const lmp_material *material = lmp_material_at(surfaces, first + i);
        const lmp_surface surface = surface_at(surfaces, first + i);
        rgb[0][i] = rgb[1][i] = rgb[2][i] = 0;
        if (material->kind == LMP_MATERIAL_TABLE) {
            const lmp_rgb color = lmp_shade_table_environment(material->table, &surface, e);
            rgb[0][i] = color.r, rgb[1][i] = color.g, rgb[2][i] = color.b;
        } else if (material->kind != LMP_MATERIAL_PREINTEGRATED) {
            shade_lobes lobes;
            lmp_shade_lobes(settings, material, &surface, &lobes);
            for (int k = 0; k < SHADE_LOBES_MAX; k++)
                take_lobe(&lobes, k, bands, i, &run[k]);
            lobe_count = lobes.count > lobe_count ? lobes.count : lobe_count;
        }
    }
    for (int k = 0; k < lobe_count; k++)
        add_lobes(e, bands, &run[k], rgb);
}

void lmp_shade_environment_n(const lmp_shade_settings *settings, const lmp_surfaces *surfaces,
                             size_t count, const lmp_environment *environment, size_t rgb_stride,
                             float *rgb) {
    const lmp_shade_settings resolved = settings_of(settings);
    const size_t stride = rgb_stride ? rgb_stride : sizeof(lmp_rgb);
    assert(lmp_are_unit(surfaces->normal, count) && lmp_are_unit(surfaces->view, count));
    assert(lmp_is_bands(environment->bands));
    for (size_t first = 0; first < count; first += RUN) {
        const size_t some = count - first < RUN ? count - first : RUN;
        float color[3][RUN] = { { 0 } };
        shade_run(&resolved, surfaces, first, some, environment, color);
        for (size_t i = 0; i < some; i++) {
            const lmp_rgb clamped = { lmp_shade_clamped(color[0][i]),
                                      lmp_shade_clamped(color[1][i]),
                                      lmp_shade_clamped(color[2][i]) };
            memcpy((char *)rgb + (first + i) * stride, &clamped, sizeof clamped);
        }
    }
}

lmp_rgb lmp_shade_environment(const lmp_shade_settings *settings, const lmp_material *material,
                              const lmp_surface *surface, const lmp_environment *environment) {
    const lmp_surfaces one = lmp_surfaces_of(material, surface);
    lmp_rgb color;
    lmp_shade_environment_n(settings, &one, 1, environment, 0, &color.r);
    return color;
}
