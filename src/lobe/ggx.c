/* SPDX-License-Identifier: MIT */
#include "src/lobe/ggx.h"

#include <assert.h>
#include <string.h>

void lmp_lobe_ggx_n(const lmp_kernel_vec3 *normal, const lmp_kernel_vec3 *view,
                    const float *roughness, size_t count, int lobe_count,
                    const lmp_kernel_ggx_lobe *lobes, float *diffuse_f90) {
    const lmp_kernel_ggx table = { lmp_ggx_table[0][0][0], lmp_ggx_diffuse, LMP_GGX_VIEWS,
                                   LMP_GGX_ROUGHNESSES, LMP_GGX_ROUGHNESS_MIN };
    lmp_kernels_get()->ggx(&table, normal, view, roughness, count, lobe_count, lobes, diffuse_f90);
}

/* --- one surface: the same operations, in which the parameters of a lobe are side by side --------
 */

static float mix(float a, float b, float fraction) {
    return a + (b - a) * fraction;
}

static lmp_ggx_lobe make_lobe(lmp_vec3 n, lmp_vec3 v, float along, float alpha, const float p[4]) {
    const float rise = lmp_ggx_clamped(along, 0, 1) + alpha * p[0] + along;
    const float x = n.x * rise - v.x, y = n.y * rise - v.y, z = n.z * rise - v.z;
    const float scale = 1 / sqrtf(x * x + y * y + z * z);
    return (lmp_ggx_lobe) {
        { x * scale, y * scale, z * scale }, 1 / (alpha * alpha * p[1]), p[2] - p[3], p[3]
    };
}

void lmp_lobe_ggx(lmp_vec3 normal, lmp_vec3 view, float roughness, lmp_ggx_lobes *lobes) {
    const float along = normal.x * view.x + normal.y * view.y + normal.z * view.z;
    const float rough = lmp_ggx_clamped(roughness, LMP_GGX_ROUGHNESS_MIN, 1);
    const float y = lmp_ggx_row(rough), x = lmp_ggx_column(lmp_ggx_clamped(along, 0, 1));
    const int row = (int)lmp_ggx_clamped(y, 0, LMP_GGX_ROUGHNESSES - 2);
    const int column = (int)lmp_ggx_clamped(x, 0, LMP_GGX_VIEWS - 2);
    const float below = y - (float)row, right = x - (float)column;
    const float(*near)[LMP_GGX_LOBES][4] = &lmp_ggx_table[row][column];
    const float(*far)[LMP_GGX_LOBES][4] = &lmp_ggx_table[row + 1][column];
    for (int k = 0; k < LMP_GGX_LOBES; k++) {
        float p[4];
        for (int j = 0; j < 4; j++)
            p[j] = mix(mix(near[0][k][j], near[1][k][j], right),
                       mix(far[0][k][j], far[1][k][j], right), below);
        lobes->lobe[k] = make_lobe(normal, view, along, rough * rough, p);
    }
    lobes->diffuse_f90 = mix(lmp_ggx_diffuse[column], lmp_ggx_diffuse[column + 1], right);
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
