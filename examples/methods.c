/* SPDX-License-Identifier: MIT */
/* methods.c - three lights, a probe under them, and a surface shaded by each method, with memory of
 * the program's own.
 *
 *     cc methods.c $(pkg-config --cflags --libs lampion) -lm -o methods */
#include <lampion/lampion.h>

#include <stdio.h>
#include <stdlib.h>

static void *allocate(size_t size, void *user) {
    *(size_t *)user += size;
    return malloc(size);
}

static void release(void *memory, void *user) {
    (void)user;
    free(memory);
}

int main(void) {
    const lmp_light lights[] = {
        { LMP_LIGHT_SPHERE, .position = { 1, 2, 0 }, .radius = 0.4f, .radiance = { 12, 9, 5 } },
        { LMP_LIGHT_SPOT, .position = { -1, 3, 0 }, .direction = { 0, -1, 0 }, .outer = 0.7f,
          .intensity = { 4, 4, 9 } },
        { LMP_LIGHT_HEMISPHERE, .direction = { 0, 1, 0 }, .radiance = { 0.2f, 0.3f, 0.5f } },
    };
    const lmp_material clay = { .diffuse = { 0.8f, 0.4f, 0.3f },
                                .specular = { 0.04f, 0.04f, 0.04f },
                                .exponent = 30 };
    const lmp_surface ground = { .normal = { 0, 1, 0 }, .view = { -0.6f, 0.8f, 0 } };

    float probe[3 * LMP_SH_COUNT(3)];
    lmp_light_project(3, lights, 3, ground.position, probe);
    const lmp_rgb up = lmp_probe_irradiance(3, probe, ground.normal);
    printf("irradiance    %.3f %.3f %.3f\n", (double)up.r, (double)up.g, (double)up.b);

    size_t bytes = 0;
    const lmp_host host = { .allocate = allocate, .release = release, .user = &bytes };
    lmp_preintegrated_lobe *lobe;
    const lmp_result result = lmp_preintegrated_lobe_create(&host, NULL, &lobe);
    if (result != LMP_OK) {
        fprintf(stderr, "methods: %s\n", lmp_result_text(result));
        return 1;
    }

    static const char *const names[] = { "zonal", "coefficients", "preintegrated" };
    for (lmp_shade_method method = LMP_SHADE_ZONAL; method <= LMP_SHADE_PREINTEGRATED; method++) {
        const lmp_shade_settings settings = { .method = method, .lobe = lobe };
        const lmp_rgb color = lmp_shade(&settings, &clay, &ground, lights, 3);
        printf("%-13s %.3f %.3f %.3f\n", names[method], (double)color.r, (double)color.g,
               (double)color.b);
    }
    lmp_preintegrated_lobe_destroy(lobe);
    return bytes > 0 ? 0 : 1;
}
