/* SPDX-License-Identifier: MIT */
#include "src/lobe/ggx.h"
#include "src/lobe/ggx_table.h"

#include <assert.h>
#include <math.h>
#include <string.h>

/* Surfaces, where they lie in the table, and a lobe's parameters there. Every step is a loop over
 * the surfaces, for the steps of one alone wait for each other; compilers make vectors of them. */
typedef struct ggx_run {
    float normal[3][LMP_GGX_RUN], view[3][LMP_GGX_RUN], rough[LMP_GGX_RUN];
    float along[LMP_GGX_RUN], cosine[LMP_GGX_RUN], alpha[LMP_GGX_RUN];
    int node[LMP_GGX_RUN], column[LMP_GGX_RUN];   /* the node before, and its column */
    float below[LMP_GGX_RUN], right[LMP_GGX_RUN]; /* fractions of the nodes after */
    float parameters[LMP_GGX_RUN][4];
    float axis[3][LMP_GGX_RUN], exponent[LMP_GGX_RUN], f0[LMP_GGX_RUN], f90[LMP_GGX_RUN];
} ggx_run;

static float mix(float a, float b, float fraction) {
    return a + (b - a) * fraction;
}

/* NaN counts as `least`. */
static float clamped(float x, float least, float most) {
    const float raised = x > least ? x : least;
    return raised < most ? raised : most;
}

static float row_of(float rough) {
    const float least = LMP_GGX_ROUGHNESS_MIN, rows = LMP_GGX_ROUGHNESSES - 1;
    return (rough - least) / (1 - least) * rows;
}

static float column_of(float cosine) {
    return sqrtf(cosine) * (LMP_GGX_VIEWS - 1);
}

static void locate(size_t count, ggx_run *run) {
    for (size_t i = 0; i < count; i++) {
        const float along = run->normal[0][i] * run->view[0][i] +
                            run->normal[1][i] * run->view[1][i] +
                            run->normal[2][i] * run->view[2][i];
        const float cosine = clamped(along, 0, 1);
        const float rough = clamped(run->rough[i], LMP_GGX_ROUGHNESS_MIN, 1);
        const float y = row_of(rough), x = column_of(cosine);
        const int row = (int)clamped(y, 0, LMP_GGX_ROUGHNESSES - 2);
        const int column = (int)clamped(x, 0, LMP_GGX_VIEWS - 2);
        run->along[i] = along;
        run->cosine[i] = cosine;
        run->alpha[i] = rough * rough;
        run->node[i] = row * LMP_GGX_VIEWS + column;
        run->column[i] = column;
        run->below[i] = y - (float)row;
        run->right[i] = x - (float)column;
    }
}

static void interpolate(size_t count, int k, ggx_run *run) {
    const float(*const nodes)[LMP_GGX_LOBES][4] = lmp_ggx_table[0];
    for (size_t i = 0; i < count; i++) {
        const float(*const near)[LMP_GGX_LOBES][4] = nodes + run->node[i];
        const float(*const far)[LMP_GGX_LOBES][4] = near + LMP_GGX_VIEWS;
        const float right = run->right[i], below = run->below[i];
        for (int j = 0; j < 4; j++)
            run->parameters[i][j] = mix(mix(near[0][k][j], near[1][k][j], right),
                                        mix(far[0][k][j], far[1][k][j], right), below);
    }
}

static void make_lobe(size_t count, ggx_run *run) {
    for (size_t i = 0; i < count; i++) {
        const float *p = run->parameters[i], alpha = run->alpha[i];
        const float rise = run->cosine[i] + alpha * p[0] + run->along[i];
        const float x = run->normal[0][i] * rise - run->view[0][i];
        const float y = run->normal[1][i] * rise - run->view[1][i];
        const float z = run->normal[2][i] * rise - run->view[2][i];
        const float scale = 1 / sqrtf(x * x + y * y + z * z);
        run->axis[0][i] = x * scale;
        run->axis[1][i] = y * scale;
        run->axis[2][i] = z * scale;
        run->exponent[i] = 1 / (alpha * alpha * p[1]);
        run->f0[i] = p[2] - p[3];
        run->f90[i] = p[3];
    }
}

int lmp_lobe_ggx_count(float along, float roughness) {
    const float x = column_of(clamped(along, 0, 1));
    const float y = row_of(clamped(roughness, LMP_GGX_ROUGHNESS_MIN, 1));
    const int row = (int)clamped(y, 0, LMP_GGX_ROUGHNESSES - 2);
    return x >= lmp_ggx_few[row] && x >= lmp_ggx_few[row + 1] ? LMP_GGX_LOBES_FEW : LMP_GGX_LOBES;
}

void lmp_lobe_ggx_n(const float *const normal[3], const float *const view[3],
                    const float *roughness, size_t count, int lobe_count,
                    const lmp_ggx_lobe_planes *lobes, float *diffuse_f90) {
    ggx_run run;
    assert(count <= LMP_GGX_RUN);
    const size_t size = count * sizeof(float);
    for (int c = 0; c < 3; c++) {
        memcpy(run.normal[c], normal[c], size);
        memcpy(run.view[c], view[c], size);
    }
    memcpy(run.rough, roughness, size);
    locate(count, &run);
    for (int k = 0; k < lobe_count; k++) {
        interpolate(count, k, &run);
        make_lobe(count, &run);
        for (int c = 0; c < 3; c++)
            memcpy(lobes[k].axis[c], run.axis[c], size);
        memcpy(lobes[k].exponent, run.exponent, size);
        memcpy(lobes[k].f0, run.f0, size);
        memcpy(lobes[k].f90, run.f90, size);
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
    lmp_lobe_ggx_n(n, v, &roughness, 1, LMP_GGX_LOBES, planes, &lobes->diffuse_f90);
    lobes->diffuse_f0 = 1 - lobes->diffuse_f90;
}

static_assert(LMP_GGX_TEXELS * 4 * sizeof(float) ==
                  sizeof lmp_ggx_table + LMP_GGX_VIEWS * 4 * sizeof(float),
              "LMP_GGX_TEXELS is the size of the table");
static_assert(LMP_GGX_VIEWS == LMP_GGX_ROUGHNESSES, "the last texels are of a view and of a row");

void lmp_lobe_ggx_texels(float *texels) {
    memcpy(texels, lmp_ggx_table, sizeof lmp_ggx_table);
    float *diffuse = texels + sizeof lmp_ggx_table / sizeof *texels;
    for (int i = 0; i < LMP_GGX_VIEWS; i++) {
        const float texel[4] = { lmp_ggx_diffuse[i], lmp_ggx_few[i], 0, 0 };
        memcpy(diffuse + (ptrdiff_t)4 * i, texel, sizeof texel);
    }
}
