/* SPDX-License-Identifier: MIT */
#include <lampion/lampion.h>

#include <stdio.h>

int main(void) {
    const lmp_light lantern = { .position = { 0, 3, 0 }, .radius = 0.5f, .radiance = { 10, 8, 5 } };
    const lmp_material clay = { .diffuse = { 0.8f, 0.4f, 0.3f },
                                .specular = { 0.04f, 0.04f, 0.04f },
                                .exponent = 30 };
    const lmp_surface ground = { .normal = { 0, 1, 0 }, .view = { 0, 0.6f, 0.8f } };
    const lmp_rgb color = lmp_shade(NULL, &clay, &ground, &lantern, 1);
    printf("reflected radiance: %.3f %.3f %.3f\n", (double)color.r, (double)color.g,
           (double)color.b);
    return 0;
}
