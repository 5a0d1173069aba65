/* SPDX-License-Identifier: MIT */
/* A debug build aborts on a broken precondition, but not on the same call within it. */
#include "tests/oracle/check.h"

#include <lampion/lampion.h>

#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

enum { BANDS = 4, VALUES = BANDS * BANDS };

static float a[4 * VALUES], b[3 * VALUES], c[3 * VALUES], matrices[LMP_SH_ROTATION_COUNT(BANDS)];
static const lmp_vec3 up = { 0, 0, 1 }, long_up = { 0, 0, 2 }, nowhere = { NAN, 0, 0 };
static const lmp_vec3 at = { 0, 0, 0 };
static const float identity[9] = { 1, 0, 0, 0, 1, 0, 0, 0, 1 };
static const float mirror[9] = { 1, 0, 0, 0, 1, 0, 0, 0, -1 };
static lmp_sh_product *product;

static const double up_double[3] = { 0, 0, 1 };
static double wide[32];
static lmp_probe_convention convention;
static lmp_probe_constants constants;

/* Projects a cube map whose last face may be missing. */
static void project_cube(const float *face) {
    const lmp_cubemap map = { .faces = { b, b, b, b, b, face }, .size = 2, .channels = 1 };
    lmp_sh_project_cubemap(2, &map, c);
}

static lmp_rgb shaded(lmp_vec3 normal, float exponent, float radius) {
    const lmp_surface surface = { .normal = normal, .view = up };
    const lmp_material material = { .exponent = exponent };
    const lmp_light light = { .position = { 0, 0, 3 }, .radius = radius };
    return lmp_shade(NULL, &material, &surface, &light, 1);
}

static void shaded_n(lmp_vec3 position, size_t stride) {
    const lmp_material material = { .exponent = 1 };
    const lmp_surfaces surfaces = { .position = lmp_vec3_array_same(&position),
                                    .normal = lmp_vec3_array_same(&up),
                                    .view = lmp_vec3_array_same(&up),
                                    .material = &material };
    lmp_shade_n(NULL, &surfaces, 2, NULL, 0, (lmp_rgb_array) { a, stride });
}

static void summed(size_t offset) {
    static _Alignas(LMP_SCRATCH_ALIGNMENT) char memory[2 * LMP_SCRATCH_ALIGNMENT];
    const lmp_scratch scratch = { memory + offset, LMP_SCRATCH_ALIGNMENT };
    const lmp_spheres none = { .radius = { 0 } };
    lmp_sphere_sum_n(&scratch, BANDS, &none, 0, NULL, lmp_vec3_array_same(&at), 1,
                     lmp_sh_interleaved(a, 0));
}

static void cap_of(lmp_light light) {
    lmp_cap cap;
    lmp_light_find_cap(&light, at, &cap);
}

static void area_of(int corner_count) {
    const lmp_light light = { LMP_LIGHT_POLYGON, .corner_count = corner_count };
    (void)lmp_light_irradiance(&light, 1, at, up);
}

static void power_of(lmp_light light) {
    (void)lmp_light_power_from_radiance(&light, 1);
}

static void create_half_a_host(void) {
    const lmp_host host = { .allocate = NULL, .release = check_host(&(check_hooks) { 0 }).release };
    lmp_sh_product *made;
    if (lmp_sh_product_create(&host, 2, &made) == LMP_OK)
        lmp_sh_product_destroy(made);
}

/* Each pair: a call within its preconditions, and the call with one of them broken. */
/* clang-format off */
#define CALLS(X) \
    X(bands, lmp_sh_eval(BANDS, up, a), lmp_sh_eval(0, up, a)) \
    X(bands_max, lmp_sh_dot(BANDS, a, b), lmp_sh_dot(LMP_BANDS_MAX + 1, a, b)) \
    X(unit, lmp_sh_eval(BANDS, up, a), lmp_sh_eval(BANDS, long_up, a)) \
    X(finite, lmp_sh_reconstruct(BANDS, a, up), lmp_sh_reconstruct(BANDS, a, nowhere)) \
    X(unit_gradient, lmp_sh_eval_gradient(BANDS, up, a, b), lmp_sh_eval_gradient(BANDS, long_up, a, b)) \
    X(unit_zonal, lmp_sh_expand_zonal(BANDS, a, up, b), lmp_sh_expand_zonal(BANDS, a, at, b)) \
    X(zonal_apart, lmp_sh_expand_zonal(BANDS, a, up, b), lmp_sh_expand_zonal(BANDS, a, up, a)) \
    X(combine, lmp_sh_combine(BANDS, 1, a, 2, b, a), lmp_sh_combine(BANDS, 1, a, 2, b, a + 1)) \
    X(rotate_onto_itself, lmp_sh_rotate(BANDS, matrices, a, b), lmp_sh_rotate(BANDS, matrices, a, a)) \
    X(rotate_overlap, lmp_sh_rotate(BANDS, matrices, a, a + VALUES), lmp_sh_rotate(BANDS, matrices, a, a + VALUES - 1)) \
    X(rotate_by_matrix, lmp_sh_rotate_by_matrix(BANDS, identity, a, b), lmp_sh_rotate_by_matrix(BANDS, mirror, a, b)) \
    X(rotate_z, lmp_sh_rotate_z(BANDS, 1, a, a), lmp_sh_rotate_z(BANDS, NAN, a, a)) \
    X(quaternion, lmp_sh_make_rotation(BANDS, (lmp_quat) { 0, 0, 0, 2 }, matrices), lmp_sh_make_rotation(BANDS, (lmp_quat) { 0, 0, 0, 0 }, matrices)) \
    X(matrix, lmp_sh_make_rotation_from_matrix(BANDS, identity, matrices), lmp_sh_make_rotation_from_matrix(BANDS, mirror, matrices)) \
    X(window, lmp_sh_make_window(BANDS, LMP_WINDOW_HANNING, 0, a), lmp_sh_make_window(BANDS, LMP_WINDOW_HANNING, -1, a)) \
    X(windowed, lmp_sh_apply_window(BANDS, b, a, a), lmp_sh_apply_window(BANDS, b, a, a + 1)) \
    X(keep, lmp_sh_make_laplacian_window(BANDS, 1, a, b), lmp_sh_make_laplacian_window(BANDS, 0, a, b)) \
    X(cube_faces, project_cube(a), project_cube(NULL)) \
    X(channels, lmp_light_project_channels(BANDS, NULL, 0, at, a, b, NULL), lmp_light_project_channels(BANDS, NULL, 0, at, a, a + 1, NULL)) \
    X(zonal_behind, lmp_sh_expand_zonal(BANDS, a + VALUES, up, a), lmp_sh_expand_zonal(BANDS, a + VALUES - 1, up, a)) \
    X(zonal_before, lmp_sh_expand_zonal(BANDS, a, up, a + BANDS), lmp_sh_expand_zonal(BANDS, a, up, a + BANDS - 1)) \
    X(gradient_behind, lmp_sh_eval_gradient(2, up, a, a + 4), lmp_sh_eval_gradient(2, up, a, a + 3)) \
    X(gradient_before, lmp_sh_eval_gradient(2, up, a + 12, a), lmp_sh_eval_gradient(2, up, a + 11, a)) \
    X(sphere_behind, lmp_sphere_project_gradient(2, at, 1, up, a, a + 4), lmp_sphere_project_gradient(2, at, 1, up, a, a + 3)) \
    X(sphere_before, lmp_sphere_project_gradient(2, at, 1, up, a + 12, a), lmp_sphere_project_gradient(2, at, 1, up, a + 11, a)) \
    X(double_before, lmp_sh_eval_gradient_double(2, up_double, wide + 12, wide), lmp_sh_eval_gradient_double(2, up_double, wide + 11, wide)) \
    X(laplacian_behind, lmp_sh_make_laplacian_window(BANDS, 1, a, a + VALUES), lmp_sh_make_laplacian_window(BANDS, 1, a, a + VALUES - 1)) \
    X(laplacian_before, lmp_sh_make_laplacian_window(BANDS, 1, a + BANDS, a), lmp_sh_make_laplacian_window(BANDS, 1, a + BANDS - 1, a)) \
    X(positive_behind, lmp_probe_make_positive_window(BANDS, a, 2, a + 2 * VALUES), lmp_probe_make_positive_window(BANDS, a, 2, a + 2 * VALUES - 1)) \
    X(positive_before, lmp_probe_make_positive_window(BANDS, a + BANDS, 2, a), lmp_probe_make_positive_window(BANDS, a + BANDS - 1, 2, a)) \
    X(export_behind, lmp_probe_export(3, lmp_probe_engine_format(LMP_PROBE_UNITY), a, a + 27), lmp_probe_export(3, lmp_probe_engine_format(LMP_PROBE_UNITY), a, a + 26)) \
    X(rotate_matrices, lmp_sh_rotate(2, a, b, a + 10), lmp_sh_rotate(2, a, b, a + 9)) \
    X(rotate_before, lmp_sh_rotate(2, a + 4, b, a), lmp_sh_rotate(2, a + 3, b, a)) \
    X(rotate_double_behind, lmp_sh_rotate_double(2, wide, wide + 11, wide + 15), lmp_sh_rotate_double(2, wide, wide + 11, wide + 14)) \
    X(rotate_double_before, lmp_sh_rotate_double(2, wide + 4, wide + 15, wide), lmp_sh_rotate_double(2, wide + 3, wide + 15, wide)) \
    X(gradient_double, lmp_sh_eval_gradient_double(2, up_double, wide, wide + 4), lmp_sh_eval_gradient_double(2, up_double, wide, wide + 3)) \
    X(rotate_double, lmp_sh_rotate_double(2, wide, wide + 10, wide + 14), lmp_sh_rotate_double(2, wide, wide + 14, wide + 9)) \
    X(sphere_double, lmp_sphere_project_double(2, up_double, 1, up_double, wide), lmp_sphere_project_double(2, up_double, -1, up_double, wide)) \
    X(tolerance, lmp_probe_recognize(BANDS, 0, a, b, &convention), lmp_probe_recognize(BANDS, -1, a, b, &convention)) \
    X(positive, lmp_probe_make_positive_window(BANDS, a, 1, b), lmp_probe_make_positive_window(BANDS, a, 1, a)) \
    X(constants, lmp_probe_make_constants(3, 1, a, &constants), lmp_probe_make_constants(2, 1, a, &constants)) \
    X(minimum, lmp_probe_minimum(3, a), lmp_probe_minimum(4, a)) \
    X(export, lmp_probe_export(3, lmp_probe_engine_format(LMP_PROBE_UNITY), a, b), lmp_probe_export(2, lmp_probe_engine_format(LMP_PROBE_UNITY), a, b)) \
    X(multiply_few, lmp_sh_multiply_few(BANDS, a, b, c), lmp_sh_multiply_few(LMP_SH_FEW_BANDS + 1, a, b, c)) \
    X(multiply, lmp_sh_multiply(product, a, b, c), lmp_sh_multiply(product, a, b, a)) \
    X(eval_n, lmp_sh_eval_n(BANDS, lmp_vec3_array_same(&up), 2, lmp_sh_interleaved(a, 0)), lmp_sh_eval_n(BANDS, lmp_vec3_array_same(&long_up), 2, lmp_sh_interleaved(a, 0))) \
    X(eval_gradient_n, lmp_sh_eval_gradient_n(BANDS, lmp_vec3_array_same(&up), 1, lmp_sh_planar(a, 0), lmp_sh_planar(b, 0)), lmp_sh_eval_gradient_n(BANDS, lmp_vec3_array_same(&up), 1, lmp_sh_planar(a, 0), lmp_sh_planar(b, 2))) \
    X(stride_short, lmp_sh_eval_n(BANDS, lmp_vec3_array_same(&up), 2, lmp_sh_planar(a, 8)), lmp_sh_eval_n(BANDS, lmp_vec3_array_same(&up), 2, lmp_sh_planar(a, 4))) \
    X(stride_odd, lmp_sh_dot_n(BANDS, LMP_SH_INTERLEAVED, 64, a, b, 1, c), lmp_sh_dot_n(BANDS, LMP_SH_INTERLEAVED, 65, a, b, 1, c)) \
    X(rotate_n, lmp_sh_rotate_n(BANDS, matrices, a, 2, lmp_sh_interleaved(b, 0)), lmp_sh_rotate_n(BANDS, matrices, a, 2, lmp_sh_interleaved(a + VALUES, 0))) \
    X(radius, lmp_sphere_project(BANDS, up, 0, at, a), lmp_sphere_project(BANDS, up, -1, at, a)) \
    X(distance, lmp_sphere_project_zonal(BANDS, 1, 0, a), lmp_sphere_project_zonal(BANDS, 1, -1, a)) \
    X(position, lmp_sphere_project(BANDS, up, 1, at, a), lmp_sphere_project(BANDS, nowhere, 1, at, a)) \
    X(length, cap_of((lmp_light) { .position = { LMP_LENGTH_MAX, 0, 0 } }), cap_of((lmp_light) { .position = { 2 * LMP_LENGTH_MAX, 0, 0 } })) \
    X(direction, cap_of((lmp_light) { LMP_LIGHT_DIRECTIONAL, .direction = up }), cap_of((lmp_light) { LMP_LIGHT_DIRECTIONAL, .direction = at })) \
    X(angle, cap_of((lmp_light) { LMP_LIGHT_CAP, .direction = up, .angle = 3 }), cap_of((lmp_light) { LMP_LIGHT_CAP, .direction = up, .angle = 4 })) \
    X(cones, cap_of((lmp_light) { LMP_LIGHT_SPOT, .direction = up, .inner = 1, .outer = 1 }), cap_of((lmp_light) { LMP_LIGHT_SPOT, .direction = up, .inner = 1, .outer = 0.5f })) \
    X(area, cap_of((lmp_light) { LMP_LIGHT_POINT, .radius = 1 }), cap_of((lmp_light) { LMP_LIGHT_TUBE, .radius = 1 })) \
    X(corners, area_of(3), area_of(LMP_LIGHT_CORNERS_MAX + 1)) \
    X(surface, power_of((lmp_light) { LMP_LIGHT_TUBE, .radius = 1 }), power_of((lmp_light) { .radius = 1 })) \
    X(radiance, cap_of((lmp_light) { .radiance = { 1, 1, 1 } }), cap_of((lmp_light) { .radiance = { 1, INFINITY, 1 } })) \
    X(nowhere_gradient, lmp_sphere_project_gradient(BANDS, at, 1, at, a, b), lmp_sphere_project_gradient(BANDS, at, 0, at, a, b)) \
    X(scratch, summed(0), summed(sizeof(float))) \
    X(pack_half, lmp_sh_pack_half_n(a, VALUES, (uint16_t *)(void *)(a + VALUES)), lmp_sh_pack_half_n(a, VALUES, (uint16_t *)(void *)(a + VALUES - 1))) \
    X(unpack_half, lmp_sh_unpack_half_n((uint16_t *)(void *)a, VALUES, a + VALUES / 2), lmp_sh_unpack_half_n((uint16_t *)(void *)a, VALUES, a + VALUES / 2 - 1)) \
    X(lights_n, lmp_light_project_n(NULL, 2, NULL, 0, NULL, lmp_vec3_array_same(&at), 1, lmp_sh_planar(a, 4)), lmp_light_project_n(NULL, 2, NULL, 0, NULL, lmp_vec3_array_same(&at), 1, lmp_sh_planar(a, 2))) \
    X(add_n, lmp_light_add_n(NULL, 2, NULL, 0, NULL, lmp_vec3_array_same(&at), 1, lmp_sh_planar(a, 0)), lmp_light_add_n(NULL, 2, NULL, 0, NULL, lmp_vec3_array_same(&nowhere), 1, lmp_sh_planar(a, 0))) \
    X(range, (void)lmp_light_range(&(lmp_light) { 0 }, 1), (void)lmp_light_range(&(lmp_light) { 0 }, 0)) \
    X(power, lmp_sphere_power_from_radiance(1, 1), lmp_sphere_power_from_radiance(1, 0)) \
    X(phong, lmp_lobe_make_phong(BANDS, 0, a), lmp_lobe_make_phong(BANDS, -1, a)) \
    X(vmf, lmp_lobe_make_vmf(BANDS, 1, a), lmp_lobe_make_vmf(BANDS, 0, a)) \
    X(lobe, lmp_lobe_project(BANDS, b, up, a), lmp_lobe_project(BANDS, b, long_up, a)) \
    X(irradiance, lmp_probe_irradiance(BANDS, a, up), lmp_probe_irradiance(BANDS, a, long_up)) \
    X(convert, lmp_probe_convert(BANDS, &(lmp_probe_convention) { 0 }, &(lmp_probe_convention) { 0 }, a, b), lmp_probe_convert(BANDS, &(lmp_probe_convention) { 0 }, &(lmp_probe_convention) { 0 }, a, a)) \
    X(normal, shaded(up, 1, 1), shaded(long_up, 1, 1)) \
    X(exponent, shaded(up, 1, 1), shaded(up, -1, 1)) \
    X(light, shaded(up, 1, 1), shaded(up, 1, NAN)) \
    X(surfaces, shaded_n(at, 0), shaded_n(nowhere, 0)) \
    X(rgb_stride, shaded_n(at, 12), shaded_n(at, 8)) \
    X(host, lmp_result_text(LMP_OK), create_half_a_host())
/* clang-format on */

#define CALL(name, kept, broken)                                                                   \
    static void name##_kept(void) {                                                                \
        (void)(kept);                                                                              \
    }                                                                                              \
    static void name##_broken(void) {                                                              \
        (void)(broken);                                                                            \
    }
CALLS(CALL)

#define ROW(name, kept, broken) { #name, name##_kept, name##_broken },
static const struct {
    const char *name;
    void (*kept)(void), (*broken)(void);
} calls[] = { CALLS(ROW) };

static bool dies(void (*call)(void)) {
    fflush(NULL);
    const pid_t child = fork();
    if (child == 0) {
        const struct rlimit none = { 0, 0 };
        setrlimit(RLIMIT_CORE, &none);
        signal(SIGABRT, SIG_DFL);
        if (!freopen("/dev/null", "w", stderr))
            _exit(2);
        call();
        _exit(0);
    }
    int status = -1;
    assert_true(child > 0 && waitpid(child, &status, 0) == child);
    return WIFSIGNALED(status) && WTERMSIG(status) == SIGABRT;
}

static void a_broken_precondition_ends_a_debug_build(void **state) {
    (void)state;
    if (!CHECK_ASSERTS) {
        check_skip("this build asserts nothing");
        return;
    }
    assert_int_equal(lmp_sh_product_create(NULL, BANDS, &product), LMP_OK);
    for (size_t i = 0; i < sizeof calls / sizeof *calls; i++) {
        if (dies(calls[i].kept))
            fail_msg("%s: ends where nothing is wrong", calls[i].name);
        if (!dies(calls[i].broken))
            fail_msg("%s: goes on where something is wrong", calls[i].name);
    }
    lmp_sh_product_destroy(product);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_broken_precondition_ends_a_debug_build),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
