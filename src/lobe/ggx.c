/* SPDX-License-Identifier: MIT */
#include "src/lobe/ggx.h"
#include "src/lobe/ggx_table.h"

#include <assert.h>
#include <math.h>
#include <string.h>

/* Surfaces, where they lie in the table, and their lobes' parameters there. Every step is a loop
 * over the surfaces, for the steps of one alone wait for each other; compilers make vectors of
 * them. */
typedef struct ggx_run {
    float normal[3][LMP_GGX_RUN], view[3][LMP_GGX_RUN], rough[LMP_GGX_RUN];
    float along[LMP_GGX_RUN], cosine[LMP_GGX_RUN];
    int row[LMP_GGX_RUN], column[LMP_GGX_RUN];    /* of the node before */
    float below[LMP_GGX_RUN], right[LMP_GGX_RUN]; /* fractions of the nodes after */
    float parameters[LMP_GGX_LOBES][4][LMP_GGX_RUN];
} ggx_run;

static float mix(float a, float b, float fraction) {
    return a + (b - a) * fraction;
}

/* NaN counts as `least`. */
static float clamped(float x, float least, float most) {
    const float raised = x > least ? x : least;
    return raised < most ? raised : most;
}

static void place_surfaces(size_t count, ggx_run *run) {
    const float least = LMP_GGX_ROUGHNESS_MIN;
    const float rows = LMP_GGX_ROUGHNESSES - 1, columns = LMP_GGX_VIEWS - 1;
    for (size_t i = 0; i < count; i++) {
        const float along = run->normal[0][i] * run->view[0][i] +
                            run->normal[1][i] * run->view[1][i] +
                            run->normal[2][i] * run->view[2][i];
        const float cosine = clamped(along, 0, 1), rough = clamped(run->rough[i], least, 1);
        const float y = (rough - least) / (1 - least) * rows;
        const float x = sqrtf(cosine) * columns;
        run->rough[i] = rough;
        run->along[i] = along;
        run->cosine[i] = cosine;
        run->row[i] = (int)clamped(y, 0, rows - 1);
        run->column[i] = (int)clamped(x, 0, columns - 1);
        run->below[i] = y - (float)run->row[i];
        run->right[i] = x - (float)run->column[i];
    }
}

static void interpolate(size_t count, ggx_run *run) {
    for (size_t i = 0; i < count; i++) {
        const float *near = &lmp_ggx_table[run->row[i]][run->column[i]][0][0];
        const float *near_right = &lmp_ggx_table[run->row[i]][run->column[i] + 1][0][0];
        const float *far = &lmp_ggx_table[run->row[i] + 1][run->column[i]][0][0];
        const float *far_right = &lmp_ggx_table[run->row[i] + 1][run->column[i] + 1][0][0];
        float parameters[4 * LMP_GGX_LOBES];
        for (int k = 0; k < 4 * LMP_GGX_LOBES; k++)
            parameters[k] = mix(mix(near[k], near_right[k], run->right[i]),
                                mix(far[k], far_right[k], run->right[i]), run->below[i]);
        for (int k = 0; k < 4 * LMP_GGX_LOBES; k++)
            run->parameters[k / 4][k % 4][i] = parameters[k];
    }
}

/* In place of the parameters: exponent, weights of F0 and F90; and in `axis`, the axis. */
static void make_lobe(size_t count, ggx_run *run, int k, float axis[3][LMP_GGX_RUN]) {
    float(*const p)[LMP_GGX_RUN] = run->parameters[k];
    for (size_t i = 0; i < count; i++) {
        const float alpha = run->rough[i] * run->rough[i];
        const float rise = run->cosine[i] + alpha * p[0][i] + run->along[i];
        const float x = run->normal[0][i] * rise - run->view[0][i];
        const float y = run->normal[1][i] * rise - run->view[1][i];
        const float z = run->normal[2][i] * rise - run->view[2][i];
        const float scale = 1 / sqrtf(x * x + y * y + z * z);
        axis[0][i] = x * scale;
        axis[1][i] = y * scale;
        axis[2][i] = z * scale;
        p[1][i] = 1 / (alpha * alpha * p[1][i]);
        p[2][i] -= p[3][i];
    }
}

void lmp_lobe_ggx_n(const float *const normal[3], const float *const view[3],
                    const float *roughness, size_t count,
                    const lmp_ggx_lobe_planes lobes[LMP_GGX_LOBES], float *diffuse_f90) {
    ggx_run run;
    assert(count <= LMP_GGX_RUN);
    const size_t size = count * sizeof(float);
    for (int c = 0; c < 3; c++) {
        memcpy(run.normal[c], normal[c], size);
        memcpy(run.view[c], view[c], size);
    }
    memcpy(run.rough, roughness, size);
    place_surfaces(count, &run);
    interpolate(count, &run);
    for (int k = 0; k < LMP_GGX_LOBES; k++) {
        float axis[3][LMP_GGX_RUN];
        make_lobe(count, &run, k, axis);
        for (int c = 0; c < 3; c++)
            memcpy(lobes[k].axis[c], axis[c], size);
        memcpy(lobes[k].exponent, run.parameters[k][1], size);
        memcpy(lobes[k].f0, run.parameters[k][2], size);
        memcpy(lobes[k].f90, run.parameters[k][3], size);
    }
    for (size_t i = 0; i < count; i++)
        diffuse_f90[i] =
            mix(lmp_ggx_diffuse[run.column[i]], lmp_ggx_diffuse[run.column[i] + 1], run.right[i]);
}

void lmp_lobe_ggx(lmp_vec3 normal, lmp_vec3 view, float roughness, lmp_ggx_lobes *lobes) {
    const float *const n[3] = { &normal.x, &normal.y, &normal.z };
    const float *const v[3] = { &view.x, &view.y, &view.z };
    lmp_ggx_lobe_planes planes[LMP_GGX_LOBES];
    for (int k = 0; k < LMP_GGX_LOBES; k++) {
        lmp_ggx_lobe *lobe = &lobes->lobe[k];
        planes[k] = (lmp_ggx_lobe_planes) {
            { &lobe->axis.x, &lobe->axis.y, &lobe->axis.z }, &lobe->exponent, &lobe->f0, &lobe->f90
        };
    }
    lmp_lobe_ggx_n(n, v, &roughness, 1, planes, &lobes->diffuse_f90);
    lobes->diffuse_f0 = 1 - lobes->diffuse_f90;
}

static_assert(LMP_GGX_TEXELS * 4 * sizeof(float) ==
                  sizeof lmp_ggx_table + LMP_GGX_VIEWS * 4 * sizeof(float),
              "LMP_GGX_TEXELS is the size of the table");

void lmp_lobe_ggx_texels(float *texels) {
    memcpy(texels, lmp_ggx_table, sizeof lmp_ggx_table);
    float *diffuse = texels + sizeof lmp_ggx_table / sizeof *texels;
    memset(diffuse, 0, LMP_GGX_VIEWS * 4 * sizeof *texels);
    for (int i = 0; i < LMP_GGX_VIEWS; i++)
        diffuse[4 * i] = lmp_ggx_diffuse[i];
}
