/* SPDX-License-Identifier: MIT */
/* probe_grid.c - a grid of light probes that follows moving lights: every frame the coefficients of
 * all lights at all probes, then diffuse light at any point by interpolating between probes.
 *
 *     cc probe_grid.c $(pkg-config --cflags --libs lampion) -lm -o probe_grid */
#include <lampion/lampion.h>

#include <math.h>
#include <stdio.h>

enum { BANDS = 4, COEFFICIENTS = BANDS * BANDS, NX = 9, NZ = 7, PROBES = NX * NZ, LIGHTS = 3 };

/* Probes lie at height 1, a unit apart, x from 0 to 8 and z from 0 to 6. */
static lmp_vec3 positions[PROBES];
static float probes[PROBES][3][COEFFICIENTS];

static void move(lmp_light *lights, float seconds) {
    for (int i = 0; i < LIGHTS; i++) {
        const float angle = seconds + 2.0944f * (float)i;
        lights[i].position = (lmp_vec3) { 4 + 2 * cosf(angle), 3, 3 + 2 * sinf(angle) };
    }
}

/* Sums all lights at all probes, in one call. */
static void update(const lmp_light *lights) {
    const lmp_spheres spheres = lmp_spheres_of(lights);
    lmp_sphere_sum_n(NULL, BANDS, &spheres, LIGHTS, NULL, lmp_vec3_array_of(positions), PROBES,
                     lmp_sh_interleaved(&probes[0][0][0], 0));
}

/* Returns the irradiance on a surface: bilinear between the four probes around the point, each a
 * dot product (paper Eq. 4) with the cosine lobe around the surface's normal. */
static float irradiance(lmp_vec3 point, lmp_vec3 normal) {
    float lambda[BANDS], lobe[COEFFICIENTS], sum = 0;
    lmp_lobe_make_diffuse(BANDS, lambda);
    lmp_lobe_project(BANDS, lambda, normal, lobe);
    const int x = (int)point.x, z = (int)point.z;
    const float s = point.x - (float)x, t = point.z - (float)z;
    for (int i = 0; i < 4; i++) {
        const float weight = (i % 2 ? s : 1 - s) * (i / 2 ? t : 1 - t);
        sum += weight * lmp_sh_dot(BANDS, probes[(z + i / 2) * NX + x + i % 2][1], lobe);
    }
    return sum;
}

int main(void) {
    lmp_light lights[LIGHTS] = {
        { .radius = 0.3f, .radiance = { 20, 20, 20 } },
        { .radius = 0.5f, .radiance = { 10, 10, 10 } },
        { .radius = 0.2f, .radiance = { 30, 30, 30 } },
    };
    for (int i = 0; i < PROBES; i++)
        positions[i] = (lmp_vec3) { (float)(i % NX), 1, (float)(i / NX) };
    const lmp_vec3 point = { 3.3f, 1, 2.6f }, up = { 0, 1, 0 };
    float lambda[BANDS];
    lmp_lobe_make_diffuse(BANDS, lambda);

    puts("seconds  from probes  exact");
    for (int frame = 0; frame <= 6; frame++) {
        move(lights, 0.5f * (float)frame);
        update(lights);
        const lmp_rgb exact = lmp_lobe_response(BANDS, lambda, up, lights, LIGHTS, point);
        printf("%7.1f  %11.3f  %5.3f\n", 0.5 * frame, (double)irradiance(point, up),
               (double)exact.g);
    }
    return 0;
}
