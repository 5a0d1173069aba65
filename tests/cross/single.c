/* SPDX-License-Identifier: MIT */
/* single.c - prints the bits of what the calls for one direction, light or lobe give: two platforms
 * print the same. */
#include <lampion/lampion.h>

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

enum { BANDS = 12, COUNT = LMP_SH_COUNT(BANDS) };

static void print(const char *call, const float *values, size_t count) {
    printf("%s", call);
    for (size_t i = 0; i < count; i++) {
        uint32_t bits;
        memcpy(&bits, values + i, sizeof bits);
        printf(" %08" PRIx32, bits);
    }
    printf("\n");
}

static const lmp_vec3 direction = { 0x1.555556p-1f, -0x1.555556p-2f, 0x1.555556p-1f };
static const lmp_vec3 point = { .1f, -.7f, .3f };

static const lmp_light lights[] = {
    { .kind = LMP_LIGHT_SPHERE, .position = { 1, 2, .5f }, .radius = .3f, .radiance = { 3, 2, 1 } },
    { .kind = LMP_LIGHT_SPHERE, .position = { 0, -1, 0 }, .radius = .9f, .radiance = { 1, 2, 7 } },
    { .kind = LMP_LIGHT_POINT, .position = { -3, 1, .2f }, .intensity = { 5, 6, 7 } },
    { .kind = LMP_LIGHT_SPOT,
      .position = { 0, 4, 1 },
      .direction = { 0, -1, 0 },
      .inner = .2f,
      .outer = .9f,
      .intensity = { 9, 8, 7 } },
    { .kind = LMP_LIGHT_DIRECTIONAL, .direction = { 0, .6f, .8f }, .irradiance = { 1, 2, 3 } },
    { .kind = LMP_LIGHT_CAP, .direction = { .6f, 0, .8f }, .angle = .4f, .radiance = { 4, 5, 6 } },
    { .kind = LMP_LIGHT_HEMISPHERE,
      .direction = { 0, 1, 0 },
      .radiance = { .3f, .4f, .9f },
      .ground = { .2f, .1f, .05f } },
    { .kind = LMP_LIGHT_RECTANGLE,
      .position = { .5f, 1, -.3f },
      .half = { { .6f, .1f, 0 }, { 0, 0, .3f } },
      .radiance = { 2, 3, 4 } },
    { .kind = LMP_LIGHT_DISK,
      .position = { -.4f, .9f, .8f },
      .direction = { 0, -.6f, -.8f },
      .radius = .7f,
      .radiance = { 5, 4, 3 } },
    { .kind = LMP_LIGHT_TUBE,
      .position = { .2f, .5f, 1 },
      .half = { { 2, .3f, .1f } },
      .radius = .04f,
      .radiance = { 7, 8, 9 } },
    { .kind = LMP_LIGHT_POLYGON,
      .position = { 0, 2, 0 },
      .corner_count = 3,
      .corner = { { 1, 0, 0 }, { -.5f, 0, .9f }, { -.5f, 0, -.9f } },
      .two_sided = true,
      .radiance = { 1, 1, 6 } },
};
enum { LIGHTS = sizeof lights / sizeof *lights };

static void print_basis(void) {
    float sh[COUNT], gradient[3 * COUNT], weights[BANDS], product[COUNT];
    lmp_sh_eval(BANDS, direction, sh);
    print("lmp_sh_eval", sh, COUNT);
    lmp_sh_eval_gradient(BANDS, direction, sh, gradient);
    print("lmp_sh_eval_gradient", gradient, 3 * COUNT);
    print("lmp_sh_reconstruct", (float[]) { lmp_sh_reconstruct(BANDS, sh, point) }, 1);
    print("lmp_sh_dot", (float[]) { lmp_sh_dot(BANDS, sh, gradient) }, 1);
    for (int bands = 2; bands <= LMP_SH_FEW_BANDS; bands++) {
        lmp_sh_multiply_few(bands, sh, gradient, product);
        print("lmp_sh_multiply_few", product, LMP_SH_COUNT(bands));
    }
    lmp_sh_make_window(BANDS, LMP_WINDOW_LANCZOS, 0, weights);
    print("lmp_sh_make_window", weights, BANDS);
}

static void print_rotation(void) {
    float sh[COUNT], rotated[COUNT], matrices[LMP_SH_ROTATION_COUNT(BANDS)];
    lmp_sh_eval(BANDS, direction, sh);
    lmp_sh_make_rotation(BANDS, (lmp_quat) { .1f, .7f, -.5f, .5f }, matrices);
    lmp_sh_rotate(BANDS, matrices, sh, rotated);
    print("lmp_sh_rotate", rotated, COUNT);
    lmp_sh_rotate_z(BANDS, .7f, sh, rotated);
    print("lmp_sh_rotate_z", rotated, COUNT);
}

static void print_lights(void) {
    float sh[3 * COUNT], gradient[3 * COUNT], zonal[BANDS];
    lmp_sphere_project_zonal(BANDS, .3f, 1.7f, zonal);
    print("lmp_sphere_project_zonal", zonal, BANDS);
    lmp_sphere_project(BANDS, lights[0].position, .3f, point, sh);
    print("lmp_sphere_project", sh, COUNT);
    lmp_sphere_project_gradient(BANDS, lights[0].position, .3f, point, sh, gradient);
    print("lmp_sphere_project_gradient", gradient, 3 * COUNT);
    for (int i = 0; i < LIGHTS; i++) {
        lmp_light_project(BANDS, &lights[i], 1, point, sh);
        print("lmp_light_project", sh, 3 * COUNT);
    }
    print("lmp_light_range", (float[]) { lmp_light_range(&lights[2], .01f) }, 1);
}

static void print_lobes(void) {
    float lambda[BANDS], sh[COUNT];
    lmp_lobe_make_phong(BANDS, 37.5f, lambda);
    print("lmp_lobe_make_phong", lambda, BANDS);
    lmp_lobe_project(BANDS, lambda, direction, sh);
    print("lmp_lobe_project", sh, COUNT);
    lmp_lobe_make_vmf(BANDS, 11.3f, lambda);
    print("lmp_lobe_make_vmf", lambda, BANDS);
}

static void print_shading(void) {
    const lmp_material material = { .diffuse = { .5f, .4f, .3f },
                                    .specular = { .3f, .2f, .1f },
                                    .exponent = 40 };
    const lmp_surface surface = { .position = point,
                                  .normal = { 0, 1, 0 },
                                  .view = { 0, .6f, .8f } };
    for (int i = 0; i < LIGHTS; i++) {
        const lmp_rgb rgb = lmp_shade(NULL, &material, &surface, &lights[i], 1);
        print("lmp_shade", (float[]) { rgb.r, rgb.g, rgb.b }, 3);
    }
}

int main(void) {
    print_basis();
    print_rotation();
    print_lights();
    print_lobes();
    print_shading();
    return 0;
}
