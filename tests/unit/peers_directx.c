/* SPDX-License-Identifier: MIT */
/* The statements of docs/migrating.md about DirectXMath, row by row, with the numbers that
 * Microsoft and Sloan publish. */
#include "tests/unit/peers.h"

/* Row XMSHEvalDirection. */
static void evaluates_the_same_basis(void **state) {
    (void)state;
    for (int i = 0; i < 100; i++) {
        const lmp_vec3 d = check_random_direction();
        double expected[COUNT];
        float sh[COUNT];
        published_basis(d, -1, expected);
        lmp_sh_eval(3, d, sh);
        CHECK_WITHIN(check_error(COUNT, expected, sh), 1e-6);
    }
}

/* Rows XMSHAdd and XMSHScale. */
static void adds_and_scales(void **state) {
    (void)state;
    float a[COUNT], b[COUNT], sum[COUNT];
    randomize(a, COUNT);
    randomize(b, COUNT);
    lmp_sh_combine(3, 1, a, 1, b, sum);
    for (int i = 0; i < COUNT; i++)
        assert_true(sum[i] == a[i] + b[i]);
    lmp_sh_combine(3, 2.5f, a, 0, a, sum);
    for (int i = 0; i < COUNT; i++)
        assert_true(sum[i] == 2.5f * a[i]);
}

/* Row XMSHDot, of x + 2 and x + y: the integral of x² is 4 pi / 3, and the others vanish. */
static void dots_are_integrals_of_products(void **state) {
    (void)state;
    const float y0 = 2 * sqrtf((float)ORACLE_PI), y1 = sqrtf(4 * (float)ORACLE_PI / 3);
    const float a[COUNT] = { 2 * y0, 0, 0, -y1 }, b[COUNT] = { 0, -y1, 0, -y1 };
    CHECK_WITHIN(fabs((double)lmp_sh_dot(3, a, b) - 4 * ORACLE_PI / 3), 1e-6);
}

/* Rows XMSHMultiply2 … 6: z² is 1/3 + 2/3 P_2, and as many bands as fit a product give its values.
 */
static void multiplies_functions(void **state) {
    (void)state;
    const float z[4] = { 0, 0, sqrtf(4 * (float)ORACLE_PI / 3), 0 };
    float c[36], a[36] = { 0 }, b[36] = { 0 };
    lmp_sh_multiply_few(2, z, z, c);
    CHECK_WITHIN(fabs((double)c[0] - 2 * sqrt(ORACLE_PI) / 3), 1e-6);
    memcpy(a, z, sizeof z);
    lmp_sh_multiply_few(3, a, a, c);
    CHECK_WITHIN(fabs((double)c[6] - 2 / 3.0 * sqrt(4 * ORACLE_PI / 5)), 1e-6);
    for (int bands = 3; bands <= 6; bands++) { /* factors of (bands + 1) / 2 bands each */
        memset(a, 0, sizeof a);
        memset(b, 0, sizeof b);
        randomize(a, (bands + 1) / 2 * ((bands + 1) / 2));
        randomize(b, (bands + 1) / 2 * ((bands + 1) / 2));
        lmp_sh_multiply_few(bands, a, b, c);
        for (int i = 0; i < 20; i++) {
            const lmp_vec3 d = check_random_direction();
            CHECK_WITHIN(fabs((double)lmp_sh_reconstruct(bands, c, d) -
                              (double)lmp_sh_reconstruct(bands, a, d) *
                                  (double)lmp_sh_reconstruct(bands, b, d)),
                         1e-5);
        }
    }
}

/* Rows XMSHRotate, by a matrix of row vectors, here of 90° around x as XMMatrixRotationX documents
 * it, which takes up to z; and XMSHRotateZ. */
static void rotates_by_transposed_matrices(void **state) {
    (void)state;
    const float rows[9] = { 1, 0, 0, 0, 0, 1, 0, -1, 0 };
    float transposed[9], matrices[LMP_SH_ROTATION_COUNT(3)], sh[COUNT], rotated[COUNT];
    float expected[COUNT];
    for (int i = 0; i < 9; i++)
        transposed[i] = rows[i % 3 * 3 + i / 3];
    lmp_sh_make_rotation_from_matrix(3, transposed, matrices);
    lmp_sh_eval(3, up, sh);
    lmp_sh_rotate(3, matrices, sh, rotated);
    lmp_sh_eval(3, (lmp_vec3) { 0, 0, 1 }, expected);
    CHECK_WITHIN(difference(expected, rotated), 1e-6);
    lmp_sh_eval(3, (lmp_vec3) { 1, 0, 0 }, sh);
    lmp_sh_rotate_z(3, (float)ORACLE_PI / 2, sh, rotated);
    lmp_sh_eval(3, up, expected);
    CHECK_WITHIN(difference(expected, rotated), 1e-6);
}

/* Row SHProjectCubeMap, with these directions: as they are in Direct3D's world, or with z negated
 * for a right-handed one. */
static lmp_vec3 direct3d(int face, float u, float v) {
    const lmp_vec3 directions[6] = { { 1, -v, -u }, { -1, -v, u }, { u, 1, v },
                                     { u, -1, -v }, { u, -v, 1 },  { -u, -v, -1 } };
    return directions[face];
}
static void projects_cube_maps(void **state) {
    (void)state;
    static cube_texels texels;
    const lmp_probe_convention mirrored = { .axes = { 1, 2, -3 } };
    float sh[COUNT], projected[COUNT], converted[COUNT];
    randomize(sh, COUNT);
    lmp_cubemap map = cube_of(direct3d, -1, sh, texels);
    lmp_sh_project_cubemap(3, &map, projected);
    CHECK_WITHIN(difference(sh, projected), 1e-3);
    map.left_handed = true;
    lmp_sh_project_cubemap(3, &map, projected);
    lmp_probe_convert(3, &mirrored, &ours, sh, converted);
    CHECK_WITHIN(difference(converted, projected), 1e-3);
}

/* Row XMSHEvalDirectionalLight: a facing white wall reflects the color. The factors are 4 pi, 4 pi
 * / 3, 16 pi / 17 (Sloan) and 32 pi / 31; odd bands past the second add nothing. */
static void normalizes_directional_lights(void **state) {
    (void)state;
    const double published[] = { 4.0, 4 / 3.0, 16 / 17.0, 16 / 17.0, 32 / 31.0, 32 / 31.0 };
    for (int bands = 1; bands <= 6; bands++) {
        const lmp_vec3 d = check_random_direction();
        float sh[3 * 36] = { 0 };
        lmp_sh_eval(bands, d, sh);
        lmp_sh_combine(bands, (float)(ORACLE_PI * published[bands - 1]), sh, 0, sh, sh);
        CHECK_WITHIN(fabs((double)lmp_probe_irradiance(bands, sh, d).r / ORACLE_PI - 1), 1e-5);
    }
}

/* Row XMSHEvalSphericalLight: Sloan's closed forms of the zonal coefficients. */
static void spherical_lights_have_sloans_coefficients(void **state) {
    (void)state;
    for (double sine = 0.1; sine < 1; sine += 0.2) {
        const double c = sqrt(1 - sine * sine), root = sqrt(ORACLE_PI);
        const double zonal[3] = { root * (1 - c), 0.5 * sqrt(3) * root * sine * sine,
                                  0.5 * sqrt(5) * root * c * sine * sine };
        const lmp_light light = { .position = { 0, 0, 2 },
                                  .radius = (float)(2 * sine),
                                  .radiance = { 3, 2, 1 } };
        float sh[3 * COUNT];
        lmp_light_project(3, &light, 1, (lmp_vec3) { 0, 0, 0 }, sh);
        for (int l = 0; l < 3; l++)
            CHECK_WITHIN(fabs((double)sh[l * l + l] - 3 * zonal[l]), 1e-5);
    }
}

/* A sphere that contains the point counts as a hemisphere there; here it grows, to 2 sqrt(pi) at
 * its center. */
static void spheres_around_a_point_are_hemispheres_there(void **state) {
    (void)state;
    const double root = sqrt(ORACLE_PI), zonal[3] = { root, 0.5 * sqrt(3) * root, 0 };
    const lmp_light hemisphere = { .kind = LMP_LIGHT_CAP,
                                   .direction = { 0, 0, 1 },
                                   .angle = (float)ORACLE_PI / 2,
                                   .radiance = { 1, 1, 1 } };
    const lmp_light sphere = { .radius = 1, .radiance = { 1, 1, 1 } };
    float sh[3 * COUNT];
    lmp_light_project(3, &hemisphere, 1, (lmp_vec3) { 0, 0, 0 }, sh);
    for (int l = 0; l < 3; l++)
        CHECK_WITHIN(fabs((double)sh[l * l + l] - zonal[l]), 1e-6);
    lmp_light_project(3, &sphere, 1, (lmp_vec3) { 0, 0, 0 }, sh);
    CHECK_WITHIN(fabs((double)sh[0] - 2 * root), 1e-6);
}

/* Row XMSHEvalConeLight: its irradiance is its color times pi, with the radiance color / sin². */
static void cones_bring_pi(void **state) {
    (void)state;
    enum { BANDS = 64 };
    static float sh[3 * BANDS * BANDS];
    for (float angle = 0.2f; angle < 1.5f; angle += 0.2f) {
        const float radiance = lmp_light_cap_radiance_from_irradiance((float)ORACLE_PI, angle);
        CHECK_WITHIN(fabs((double)radiance * pow(sin((double)angle), 2) - 1), 1e-5);
        const lmp_light cone = { .kind = LMP_LIGHT_CAP,
                                 .direction = up,
                                 .angle = angle,
                                 .radiance = { radiance, radiance, radiance } };
        lmp_light_project(BANDS, &cone, 1, (lmp_vec3) { 0, 0, 0 }, sh);
        CHECK_WITHIN(fabs((double)lmp_probe_irradiance(BANDS, sh, up).g / ORACLE_PI - 1), 1e-3);
    }
}

/* Row XMSHEvalHemisphereLight: 3/2 of a gradient from the bottom color to the top one. */
static void hemispheres_are_a_gradient(void **state) {
    (void)state;
    const double top = 3, bottom = 0.5, root = sqrt(ORACLE_PI);
    const float zonal[3] = { (float)(1.5 * root * (top + bottom)),
                             (float)(1.5 * root / sqrt(3) * (top - bottom)), 0 };
    float sh[COUNT];
    lmp_sh_expand_zonal(3, zonal, up, sh);
    CHECK_WITHIN(fabs((double)lmp_sh_reconstruct(3, sh, up) - 1.5 * top), 1e-5);
    CHECK_WITHIN(fabs((double)lmp_sh_reconstruct(3, sh, down) - 1.5 * bottom), 1e-5);
    CHECK_WITHIN(
        fabs((double)lmp_sh_reconstruct(3, sh, (lmp_vec3) { 1, 0, 0 }) - 0.75 * (top + bottom)),
        1e-5);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(evaluates_the_same_basis),
        cmocka_unit_test(adds_and_scales),
        cmocka_unit_test(dots_are_integrals_of_products),
        cmocka_unit_test(multiplies_functions),
        cmocka_unit_test(rotates_by_transposed_matrices),
        cmocka_unit_test(projects_cube_maps),
        cmocka_unit_test(normalizes_directional_lights),
        cmocka_unit_test(spherical_lights_have_sloans_coefficients),
        cmocka_unit_test(spheres_around_a_point_are_hemispheres_there),
        cmocka_unit_test(cones_bring_pi),
        cmocka_unit_test(hemispheres_are_a_gradient),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
