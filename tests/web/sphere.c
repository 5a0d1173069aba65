/* SPDX-License-Identifier: MIT */
/* Prints the image that the page of docs/webgpu.md draws, by the library: 256 rows of as many
 * pixels, three bytes each. */
#include <lampion/shade.h>

#include <math.h>
#include <stdio.h>

enum { SIDE = 256 };

static int level(float radiance) {
    return (int)(255 * powf(fminf(radiance, 1), 1 / 2.2f) + 0.5f);
}

int main(void) {
    static const lmp_light lights[] = {
        { .position = { 2, 1.5f, 2 }, .radius = 0.5f, .radiance = { 12, 10, 8 } },
        { .position = { -2.5f, 0, 1 }, .radius = 0.3f, .radiance = { 5, 15, 40 } },
        { .position = { 0, -1.5f, 0.5f }, .radius = 0.2f, .radiance = { 9, 3, 3 } },
    };
    static const lmp_material clay = { .diffuse = { 0.8f, 0.4f, 0.3f },
                                       .specular = { 0.04f, 0.04f, 0.04f },
                                       .exponent = 30 };
    const lmp_shade_settings settings = { .bands = 8, .window = LMP_WINDOW_HANNING };
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++) {
            const float u = ((float)x + 0.5f - 128) / 120, v = (128 - (float)y - 0.5f) / 120;
            const float z2 = 1 - u * u - v * v;
            lmp_rgb c = { 0, 0, 0 };
            if (z2 >= 0) {
                const lmp_vec3 normal = { u, v, sqrtf(z2) };
                const lmp_surface surface = { .position = normal,
                                              .normal = normal,
                                              .view = { 0, 0, 1 } };
                c = lmp_shade(&settings, &clay, &surface, lights, 3);
            }
            printf("%c%c%c", level(c.r), level(c.g), level(c.b));
        }
    return 0;
}
