/* SPDX-License-Identifier: MIT */
#include "src/lobe/ggx.h"

#include "src/kernels/dispatch.h"

#include <assert.h>
#include <string.h>

void lmpi_lobe_ggx_n(const lmpi_kernel_vec3 *normal, const lmpi_kernel_vec3 *view,
                     const float *roughness, size_t count, int lobe_count,
                     const lmpi_kernel_ggx_lobe *lobes, float *diffuse_f90) {
    const lmpi_kernel_ggx table = { lmpi_ggx_table[0][0][0], lmpi_ggx_diffuse, LMPI_GGX_VIEWS,
                                    LMPI_GGX_ROUGHNESSES, LMPI_GGX_ROUGHNESS_MIN };
    lmpi_kernels_get()->lobe.ggx(&table, normal, view, roughness, count, lobe_count, lobes,
                                 diffuse_f90);
}

/* --- one surface: the same operations, in which the parameters of a lobe are side by side --------
 */

static float mix(float a, float b, float fraction) {
    return a + (b - a) * fraction;
}

static lmp_ggx_lobe make_lobe(lmp_vec3 n, lmp_vec3 v, float along, float alpha, const float p[4]) {
    const float rise = lmpi_ggx_clamped(along, 0, 1) + alpha * p[0] + along;
    const float x = n.x * rise - v.x, y = n.y * rise - v.y, z = n.z * rise - v.z;
    const float scale = 1 / sqrtf(x * x + y * y + z * z);
    return (lmp_ggx_lobe) {
        { x * scale, y * scale, z * scale }, 1 / (alpha * alpha * p[1]), p[2] - p[3], p[3]
    };
}

void lmp_lobe_find_ggx(lmp_vec3 normal, lmp_vec3 view, float roughness, lmp_ggx_lobes *lobes) {
    const float along = normal.x * view.x + normal.y * view.y + normal.z * view.z;
    const float rough = lmpi_ggx_clamped(roughness, LMPI_GGX_ROUGHNESS_MIN, 1);
    const float y = lmpi_ggx_row(rough), x = lmpi_ggx_column(lmpi_ggx_clamped(along, 0, 1));
    const int row = (int)lmpi_ggx_clamped(y, 0, LMPI_GGX_ROUGHNESSES - 2);
    const int column = (int)lmpi_ggx_clamped(x, 0, LMPI_GGX_VIEWS - 2);
    const float below = y - (float)row, right = x - (float)column;
    const float(*near)[LMP_GGX_LOBES][4] = &lmpi_ggx_table[row][column];
    const float(*far)[LMP_GGX_LOBES][4] = &lmpi_ggx_table[row + 1][column];
    for (int k = 0; k < LMP_GGX_LOBES; k++) {
        float p[4];
        for (int j = 0; j < 4; j++)
            p[j] = mix(mix(near[0][k][j], near[1][k][j], right),
                       mix(far[0][k][j], far[1][k][j], right), below);
        lobes->lobe[k] = make_lobe(normal, view, along, rough * rough, p);
    }
    lobes->diffuse_f90 = mix(lmpi_ggx_diffuse[column], lmpi_ggx_diffuse[column + 1], right);
    lobes->diffuse_f0 = 1 - lobes->diffuse_f90;
}

static_assert(LMP_GGX_TEXELS * 4 * sizeof(float) ==
                  sizeof lmpi_ggx_table + LMPI_GGX_VIEWS * 4 * sizeof(float),
              "LMP_GGX_TEXELS is the size of the table");
static_assert(LMPI_GGX_VIEWS == LMPI_GGX_ROUGHNESSES, "the last texels are of a view and of a row");

void lmp_lobe_copy_ggx_texels(float *texels) {
    memcpy(texels, lmpi_ggx_table, sizeof lmpi_ggx_table);
    float *diffuse = texels + sizeof lmpi_ggx_table / sizeof *texels;
    for (int i = 0; i < LMPI_GGX_VIEWS; i++) {
        const float texel[4] = { lmpi_ggx_diffuse[i], lmpi_ggx_few[i], 0, 0 };
        memcpy(diffuse + (ptrdiff_t)4 * i, texel, sizeof texel);
    }
}
