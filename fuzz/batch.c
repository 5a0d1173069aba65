/* SPDX-License-Identifier: MIT */
/* The batch functions: they give the same bits on every available instruction set, whatever the
 * numbers, and finite results for numbers within their preconditions. */
#include "fuzz/numbers.h"

#include <lampion/cpu.h>
#include <lampion/lampion.h>

enum { BANDS = 6, VALUES = LMP_SH_COUNT(BANDS), COUNT = 35, LIGHTS = 3 };

typedef struct batch_input {
    int bands;
    size_t count, stride;
    lmp_sh_layout layout;
    lmp_shade_settings settings;
    lmp_light lights[LIGHTS];
    lmp_vec3 points[COUNT], normals[COUNT], views[COUNT];
    lmp_material materials[COUNT];
    float sh[COUNT * VALUES], lambda[BANDS];
} batch_input;

/* The results of all functions. */
typedef struct batch_output {
    float eval[COUNT * VALUES], dots[COUNT], rotated[COUNT * VALUES];
    float projected[COUNT * VALUES], sum[3 * COUNT * VALUES], response[3 * COUNT];
    lmp_rgb shaded[COUNT];
} batch_output;

static void take(fuzz_input *in, batch_input *b) {
    b->bands = fuzz_int(in, 1, BANDS);
    b->count = (size_t)fuzz_int(in, 1, COUNT);
    b->layout = (lmp_sh_layout)fuzz_int(in, 0, 1);
    b->settings = (lmp_shade_settings) { .bands = b->bands };
    for (int i = 0; i < LIGHTS; i++)
        b->lights[i] = (lmp_light) { .position = fuzz_vector(in, 1e-6f, 1e6f),
                                     .radius = fabsf(fuzz_float(in, 1e-6f, 1e6f)),
                                     .radiance = { fabsf(fuzz_float(in, 1e-6f, 1e6f)), 1, 0.5f } };
    for (int i = 0; i < BANDS; i++)
        b->lambda[i] = fuzz_float(in, 1e-6f, 1e6f);
    /* values that the input lacks repeat the first ones */
    for (size_t i = 0; i < COUNT; i++) {
        const bool first = i == 0 || in->left > 0;
        b->points[i] = first ? fuzz_vector(in, 1e-6f, 1e6f) : b->points[0];
        b->normals[i] = first ? fuzz_direction(in) : b->normals[0];
        b->views[i] = first ? fuzz_direction(in) : b->views[0];
        b->materials[i] = (lmp_material) { .diffuse = { 0.5f, 0.25f, 0 },
                                           .specular = { 0.5f, 0.5f, 1 },
                                           .exponent = fabsf(fuzz_float(in, 0, 1e6f)) };
    }
    for (size_t i = 0; i < COUNT * VALUES; i++)
        b->sh[i] = fuzz_float(in, 1e-6f, 1e6f);
}

static void run(const batch_input *b, batch_output *out) {
    static float matrices[LMP_SH_ROTATION_COUNT(BANDS)];
    const lmp_spheres spheres = lmp_spheres_of(b->lights);
    const lmp_vec3_array points = lmp_vec3_array_of(b->points);
    const lmp_vec3_array normals = lmp_vec3_array_of(b->normals);
    const lmp_surfaces surfaces = { .position = points,
                                    .normal = normals,
                                    .view = lmp_vec3_array_of(b->views),
                                    .material = b->materials,
                                    .material_stride = sizeof *b->materials };
    memset(out, 0, sizeof *out);
    lmp_sh_eval_n(b->bands, normals, b->count, (lmp_sh_array) { out->eval, 0, b->layout });
    lmp_sh_dot_n(b->bands, b->layout, 0, b->sh, out->eval, b->count, out->dots);
    lmp_sh_make_rotation(b->bands, (lmp_quat) { 0.5f, -0.5f, 0.1f, 0.7f }, matrices);
    lmp_sh_rotate_n(b->bands, matrices, b->sh, b->count,
                    (lmp_sh_array) { out->rotated, 0, b->layout });
    lmp_sphere_project_all_n(b->bands, &spheres, 1, points, b->count,
                             (lmp_sh_array) { out->projected, 0, b->layout });
    lmp_sphere_sum_n(NULL, b->bands, &spheres, LIGHTS, NULL, points, b->count,
                     (lmp_sh_array) { out->sum, 0, b->layout });
    lmp_lobe_response_n(b->bands, b->lambda, normals, &spheres, LIGHTS, points, b->count,
                        (lmp_rgb_array) { out->response, 0 });
    lmp_shade_n(&b->settings, &surfaces, b->count, b->lights, LIGHTS,
                (lmp_rgb_array) { &out->shaded[0].r, 0 });
}

static void check_finite(const batch_output *out) {
    const float *const numbers = (const float *)(const void *)out;
    for (size_t i = 0; i < sizeof *out / sizeof *numbers; i++)
        fuzz_expect(isfinite(numbers[i]));
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static batch_input b;
    static batch_output scalar, other;
    fuzz_input in = { data, size };
    take(&in, &b);
    lmp_cpu_limit(LMP_CPU_SCALAR);
    run(&b, &scalar);
    check_finite(&scalar);
    for (unsigned flag = LMP_CPU_VECTOR; flag <= LMP_CPU_AVX512; flag <<= 1)
        if (lmp_cpu_flags() & flag) {
            lmp_cpu_limit(flag);
            run(&b, &other);
            fuzz_expect(memcmp(&scalar, &other, sizeof scalar) == 0);
        }
    return 0;
}
