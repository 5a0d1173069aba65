/* SPDX-License-Identifier: MIT */
/* What docs/migrating.md says of other libraries, with the numbers that they publish. */
#include "tests/oracle/check.h"
#include "tests/oracle/oracle.h"

#include <lampion/probe.h>

#include <math.h>
#include <string.h>

enum { COUNT = 9 };

static const lmp_probe_convention ours = { 0 }, positive = { .sign = LMP_PROBE_SIGN_POSITIVE };

static void randomize(float *sh, int count) {
    for (int i = 0; i < count; i++)
        sh[i] = (float)check_random_between(-1, 1);
}

/* --- DirectXMath ------------------------------------------------------------------------------ */

/* XMSHEvalDirection, by the polynomials of Sloan's «Stupid Spherical Harmonics Tricks», A2. */
static void directx_evaluates_the_same_basis(void **state) {
    (void)state;
    for (int i = 0; i < 100; i++) {
        const lmp_vec3 d = check_random_direction();
        const double x = (double)d.x, y = (double)d.y, z = (double)d.z;
        const double expected[COUNT] = { 0.282094791773878,
                                         -0.488602511902920 * y,
                                         0.488602511902920 * z,
                                         -0.488602511902920 * x,
                                         1.092548430592079 * x * y,
                                         -1.092548430592079 * y * z,
                                         0.315391565252520 * (3 * z * z - 1),
                                         -1.092548430592079 * x * z,
                                         0.546274215296040 * (x * x - y * y) };
        float sh[COUNT];
        lmp_sh_eval(3, d, sh);
        CHECK_WITHIN(check_error(COUNT, expected, sh), 1e-6);
    }
}

/* A directional light that a facing white wall reflects as its color: 4 pi, 4 pi / 3, 16 pi / 17
 * (Sloan) and 32 pi / 31 times its direction's basis; odd bands past the second add nothing. */
static void directx_normalizes_directional_lights(void **state) {
    (void)state;
    const int bands[] = { 1, 2, 3, 4, 5, 6 };
    const double published[] = { 4.0, 4 / 3.0, 16 / 17.0, 16 / 17.0, 32 / 31.0, 32 / 31.0 };
    for (int i = 0; i < 6; i++) {
        float lambda[6];
        double facing = 0; /* of the light whose coefficients are Y_lm(direction) */
        lmp_lobe_diffuse(bands[i], lambda);
        for (int l = 0; l < bands[i]; l++)
            facing += (double)lambda[l] * (2 * l + 1) / (4 * ORACLE_PI);
        CHECK_WITHIN(fabs(1 / facing - published[i]), 1e-6);
    }
}

/* A cone's irradiance is its color times pi, with the radiance color / sin². */
static void directx_cones_bring_pi(void **state) {
    (void)state;
    enum { BANDS = 64 };
    static float sh[3 * BANDS * BANDS];
    const lmp_vec3 up = { 0, 1, 0 };
    for (float angle = 0.2f; angle < 1.5f; angle += 0.2f) {
        const float radiance = lmp_cap_radiance_from_irradiance((float)ORACLE_PI, angle);
        CHECK_WITHIN(fabs((double)radiance * pow(sin((double)angle), 2) - 1), 1e-5);
        const lmp_light cone = { .kind = LMP_LIGHT_CAP,
                                 .direction = up,
                                 .angle = angle,
                                 .radiance = { radiance, radiance, radiance } };
        lmp_light_project(BANDS, &cone, 1, (lmp_vec3) { 0, 0, 0 }, sh);
        CHECK_WITHIN(fabs((double)lmp_probe_irradiance(BANDS, sh, up).g / ORACLE_PI - 1), 1e-3);
    }
}

static void directx_adds_scales_and_rotates(void **state) {
    (void)state;
    float a[COUNT], b[COUNT], sum[COUNT], matrices[LMP_SH_ROTATION_COUNT(3)], by_matrix[COUNT];
    randomize(a, COUNT);
    randomize(b, COUNT);
    lmp_sh_combine(3, 1, a, 1, b, sum);
    for (int i = 0; i < COUNT; i++)
        assert_true(sum[i] == a[i] + b[i]);
    lmp_sh_combine(3, 2.5f, a, 0, a, sum);
    for (int i = 0; i < COUNT; i++)
        assert_true(sum[i] == 2.5f * a[i]);
    const float c = cosf(0.7f), s = sinf(0.7f);
    const float around_z[9] = { c, -s, 0, s, c, 0, 0, 0, 1 };
    lmp_sh_rotation_from_matrix(3, around_z, matrices);
    lmp_sh_rotate(3, matrices, a, by_matrix);
    lmp_sh_rotate_z(3, 0.7f, a, sum);
    for (int i = 0; i < COUNT; i++)
        CHECK_WITHIN(fabs((double)sum[i] - (double)by_matrix[i]), 1e-6);
}

/* --- three.js --------------------------------------------------------------------------------- */

/* SphericalHarmonics3.getIrradianceAt: 0.886227, 2 * 0.511664, 2 * 0.429043, 0.743125, 0.247708. */
static void three_js_finds_the_same_irradiance(void **state) {
    (void)state;
    for (int i = 0; i < 100; i++) {
        float sh[3 * COUNT] = { 0 }, theirs[COUNT];
        randomize(sh, COUNT);
        lmp_probe_convert(3, &ours, &positive, sh, theirs);
        const lmp_vec3 n = check_random_direction();
        const double x = (double)n.x, y = (double)n.y, z = (double)n.z;
        const double factors[COUNT] = { 0.886227,
                                        2 * 0.511664 * y,
                                        2 * 0.511664 * z,
                                        2 * 0.511664 * x,
                                        2 * 0.429043 * x * y,
                                        2 * 0.429043 * y * z,
                                        0.743125 * z * z - 0.247708,
                                        2 * 0.429043 * x * z,
                                        0.429043 * (x * x - y * y) };
        double sum = 0;
        for (int k = 0; k < COUNT; k++)
            sum += factors[k] * (double)theirs[k];
        CHECK_WITHIN(fabs((double)lmp_probe_irradiance(3, sh, n).r - sum), 1e-5);
    }
}

/* HemisphereLightProbe: sqrt(pi) (sky + ground), sqrt(3 pi / 4) (sky - ground) of y. */
static void three_js_hemisphere_probes_are_a_gradient(void **state) {
    (void)state;
    const float sky = 3, ground = 0.5f, c0 = (float)sqrt(ORACLE_PI), c1 = c0 * sqrtf(0.75f);
    const float zonal[3] = { c0 * (sky + ground), c1 * (sky - ground), 0 };
    const lmp_vec3 up = { 0, 1, 0 }, down = { 0, -1, 0 };
    float sh[3 * COUNT] = { 0 }, theirs[COUNT];
    lmp_sh_from_zonal(3, zonal, up, sh);
    lmp_probe_convert(3, &ours, &positive, sh, theirs);
    CHECK_WITHIN(fabs((double)theirs[0] - (double)zonal[0]), 1e-6);
    CHECK_WITHIN(fabs((double)theirs[1] - (double)zonal[1]), 1e-6);
    CHECK_WITHIN(fabs((double)lmp_probe_irradiance(3, sh, up).r - ORACLE_PI * (double)sky), 1e-5);
    CHECK_WITHIN(fabs((double)lmp_probe_irradiance(3, sh, down).r - ORACLE_PI * (double)ground),
                 1e-5);
}

/* --- others ----------------------------------------------------------------------------------- */

/* google/spherical-harmonics: EvalSH(l, m, phi, theta) of the angles around and from z. */
static void angles_are_a_direction(void **state) {
    (void)state;
    for (int i = 0; i < 100; i++) {
        const double phi = check_random_between(0, 2 * ORACLE_PI),
                     theta = check_random_between(0, 3);
        const lmp_vec3 d = { (float)(sin(theta) * cos(phi)), (float)(sin(theta) * sin(phi)),
                             (float)cos(theta) };
        float sh[COUNT];
        lmp_sh_eval(3, d, sh);
        CHECK_WITHIN(fabs((double)sh[3] + 0.488602512 * sin(theta) * cos(phi)), 1e-6);
        CHECK_WITHIN(fabs((double)sh[8] - 0.546274215 * pow(sin(theta), 2) * cos(2 * phi)), 1e-6);
    }
}

/* Ambisonics' N3D: 1, then sqrt(3) of each axis. */
static void n3d_is_scaled_to_one(void **state) {
    (void)state;
    const lmp_probe_convention n3d = { LMP_PROBE_SIGN_POSITIVE, LMP_PROBE_N3D, { 0, 0, 0 } };
    const lmp_vec3 d = check_random_direction();
    float sh[4], theirs[4];
    lmp_sh_eval(2, d, sh);
    lmp_probe_convert(2, &ours, &n3d, sh, theirs);
    const double root = sqrt(3);
    const double expected[4] = { 1, root * (double)d.y, root * (double)d.z, root * (double)d.x };
    CHECK_WITHIN(check_error(4, expected, theirs), 1e-6);
}

/* sphericart's derivatives by position: those of Y(v / |v|) over |v|, and Y's Laplacian on the
 * sphere, -l (l+1) Y. */
static void derivatives_are_those_of_the_sphere(void **state) {
    (void)state;
    enum { BANDS = 8, VALUES = BANDS * BANDS };
    for (int i = 0; i < 20; i++) {
        const lmp_vec3 d = check_random_direction();
        const double length =
            sqrt((double)d.x * (double)d.x + (double)d.y * (double)d.y + (double)d.z * (double)d.z);
        const double w[3] = { (double)d.x / length, (double)d.y / length, (double)d.z / length };
        double sh[VALUES], hessian[6 * VALUES];
        lmp_sh_eval_double(BANDS, w, sh);
        lmp_sh_eval_hessian_double(BANDS, w, hessian);
        for (int l = 0; l < BANDS; l++)
            for (int k = l * l; k < (l + 1) * (l + 1); k++)
                CHECK_WITHIN(fabs(hessian[k] + hessian[3 * VALUES + k] + hessian[5 * VALUES + k] +
                                  l * (l + 1) * sh[k]),
                             1e-11);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(directx_evaluates_the_same_basis),
        cmocka_unit_test(directx_normalizes_directional_lights),
        cmocka_unit_test(directx_cones_bring_pi),
        cmocka_unit_test(directx_adds_scales_and_rotates),
        cmocka_unit_test(three_js_finds_the_same_irradiance),
        cmocka_unit_test(three_js_hemisphere_probes_are_a_gradient),
        cmocka_unit_test(angles_are_a_direction),
        cmocka_unit_test(n3d_is_scaled_to_one),
        cmocka_unit_test(derivatives_are_those_of_the_sphere),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
