/* SPDX-License-Identifier: MIT */
#include <lampion/lampion.h>

#include <stdio.h>

int main(void) {
    const lmp_light lanterns[] = {
        { .position = { 0, 3, 0 }, .radius = 0.5f, .radiance = { 10, 8, 5 } },
        { .position = { 2, 1, 1 }, .radius = 0.1f, .radiance = { 60, 80, 120 } },
    };
    const lmp_material clay = { .diffuse = { 0.8f, 0.4f, 0.3f },
                                .specular = { 0.04f, 0.04f, 0.04f },
                                .exponent = 30 };
    const lmp_vec3 points[] = { { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 } };
    const lmp_vec3 up = { 0, 1, 0 }, view = { 0, 0.6f, 0.8f };
    const lmp_surfaces ground = { .position = lmp_vec3_array_of(points),
                                  .normal = lmp_vec3_array_same(&up), /* the same for all */
                                  .view = lmp_vec3_array_same(&view),
                                  .material = &clay };
    lmp_rgb color[3];
    lmp_shade_n(NULL, &ground, 3, lanterns, 2, lmp_rgb_array_of(color));
    for (int i = 0; i < 3; i++)
        printf("point %d reflects %.3f %.3f %.3f\n", i, (double)color[i].r, (double)color[i].g,
               (double)color[i].b);
    return 0;
}
