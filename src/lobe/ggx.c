/* SPDX-License-Identifier: MIT */
#include "src/lobe/ggx_table.h"

#include <assert.h>
#include <math.h>
#include <string.h>

/* A place between two nodes of one axis of the table. */
typedef struct between {
    int node;
    float fraction;
} between;

/* x in 0 … 1, both ends included; NaN counts as 0. */
static between between_nodes(float x, int nodes) {
    const float at = (x > 0 ? x < 1 ? x : 1 : 0) * (float)(nodes - 1);
    const int node = at < (float)(nodes - 1) ? (int)at : nodes - 2;
    return (between) { node, at - (float)node };
}

static float mix(float a, float b, float fraction) {
    return a + (b - a) * fraction;
}

/* The parameters of all lobes, as in the table. */
static void interpolate(between row, between column, float parameters[LMP_GGX_LOBES][4]) {
    const float *node[2][2];
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 2; k++)
            node[i][k] = &lmp_ggx_table[row.node + i][column.node + k][0][0];
    for (int i = 0; i < 4 * LMP_GGX_LOBES; i++)
        (&parameters[0][0])[i] =
            mix(mix(node[0][0][i], node[0][1][i], column.fraction),
                mix(node[1][0][i], node[1][1][i], column.fraction), row.fraction);
}

void lmp_lobe_ggx(lmp_vec3 normal, lmp_vec3 view, float roughness, lmp_ggx_lobes *lobes) {
    const float least = LMP_GGX_ROUGHNESS_MIN;
    const float rough = roughness > least ? roughness < 1 ? roughness : 1 : least;
    const float alpha = rough * rough;
    const float along = normal.x * view.x + normal.y * view.y + normal.z * view.z;
    const float cosine = along > 0 ? along : 0;
    const between row = between_nodes((rough - least) / (1 - least), LMP_GGX_ROUGHNESSES);
    const between column = between_nodes(sqrtf(cosine), LMP_GGX_VIEWS);

    float parameters[LMP_GGX_LOBES][4];
    interpolate(row, column, parameters);
    for (int k = 0; k < LMP_GGX_LOBES; k++) {
        const float *p = parameters[k];
        const float rise = cosine + alpha * p[0] + along;
        const lmp_vec3 axis = { normal.x * rise - view.x, normal.y * rise - view.y,
                                normal.z * rise - view.z };
        const float length2 = axis.x * axis.x + axis.y * axis.y + axis.z * axis.z;
        const float scale = 1 / sqrtf(length2);
        lobes->lobe[k] = (lmp_ggx_lobe) {
            .axis = { axis.x * scale, axis.y * scale, axis.z * scale },
            .exponent = 1 / (alpha * alpha * p[1]),
            .f0 = p[2] - p[3],
            .f90 = p[3],
        };
    }
    lobes->diffuse_f90 =
        mix(lmp_ggx_diffuse[column.node], lmp_ggx_diffuse[column.node + 1], column.fraction);
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
