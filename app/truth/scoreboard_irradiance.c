/* SPDX-License-Identifier: MIT */
/* Ramamoorthi and Hanrahan, An Efficient Representation for Irradiance Environment Maps (SIGGRAPH
 * 2001): a light is projected to 9 coefficients, as in an irradiance volume, and looked up by the
 * normal. */
#include "app/truth/scoreboard_gltf.h"

enum { COUNT = 9 };

static void basis(lmp_vec3 w, float y[COUNT]) {
    y[0] = 0.282095f;
    y[1] = 0.488603f * w.y;
    y[2] = 0.488603f * w.z;
    y[3] = 0.488603f * w.x;
    y[4] = 1.092548f * w.x * w.y;
    y[5] = 1.092548f * w.y * w.z;
    y[6] = 0.315392f * (3 * w.z * w.z - 1);
    y[7] = 1.092548f * w.x * w.z;
    y[8] = 0.546274f * (w.x * w.x - w.y * w.y);
}

float formula_irradiance(const formula_query *q, const formula_reads *reads) {
    (void)reads;
    const float sin2 = q->sine * q->sine, cosine = sqrtf(1 - sin2);
    /* 2 pi times the integral of each Legendre polynomial over the disk, times pi, 2 pi/3 and pi/4
     * of the clamped cosine */
    const float band[3] = { 2 * PI * sin2 / (1 + cosine) * PI, PI * sin2 * (2 * PI / 3),
                            PI * cosine * sin2 * (PI / 4) };
    float light[COUNT], normal[COUNT], sum = 0;
    basis(q->light, light);
    basis(q->normal, normal);
    for (int i = 0; i < COUNT; i++)
        light[i] *= band[i == 0 ? 0 : i < 4 ? 1 : 2];
    for (int i = 0; i < COUNT; i++)
        sum += light[i] * normal[i];
    return q->color / PI * fmaxf(sum, 0);
}
