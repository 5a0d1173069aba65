/* SPDX-License-Identifier: MIT */
/* The statements of docs/migrating.md about google/spherical-harmonics, sphericart, Ambisonics and
 * splats, row by row. Those about DirectXMath are in peers_directx.c. */
#include "tests/unit/peers.h"

/* --- google/spherical-harmonics --------------------------------------------------------------- */

static lmp_vec3 direction_of(double phi, double theta) {
    return (lmp_vec3) { (float)(sin(theta) * cos(phi)), (float)(sin(theta) * sin(phi)),
                        (float)cos(theta) };
}

/* Rows EvalSH(l, m, phi, theta), whose angles are around and from z, and EvalSHSum. */
static void angles_are_a_direction(void **state) {
    (void)state;
    for (int i = 0; i < 100; i++) {
        const double phi = check_random_between(0, 2 * ORACLE_PI),
                     theta = check_random_between(0, 3);
        const lmp_vec3 d = direction_of(phi, theta);
        float sh[COUNT], f[COUNT];
        lmp_sh_eval(3, d, sh);
        CHECK_WITHIN(fabs((double)sh[LMP_SH_INDEX(1, 1)] + 0.488602512 * sin(theta) * cos(phi)),
                     1e-6);
        CHECK_WITHIN(
            fabs((double)sh[LMP_SH_INDEX(2, 2)] - 0.546274215 * pow(sin(theta), 2) * cos(2 * phi)),
            1e-6);
        randomize(f, COUNT);
        CHECK_WITHIN(fabs((double)lmp_sh_reconstruct(3, f, d) - published_sum(d, -1, f)), 1e-5);
    }
}

static float clamped_cosine(lmp_vec3 d, void *user) {
    (void)user;
    return d.z > 0 ? d.z : 0;
}

/* Rows ProjectFunction, of the lobe whose coefficients are known, and RenderDiffuseIrradiance. */
static void projects_functions(void **state) {
    (void)state;
    const double expected[3] = { sqrt(ORACLE_PI) / 2, sqrt(ORACLE_PI / 3),
                                 sqrt(5 * ORACLE_PI) / 8 };
    float sh[3 * COUNT] = { 0 };
    lmp_sh_project_function(3, 200, clamped_cosine, NULL, sh);
    for (int l = 0; l < 3; l++)
        CHECK_WITHIN(fabs((double)sh[l * l + l] - expected[l]), 1e-4);
    memset(sh, 0, sizeof sh);
    sh[0] = 2 * sqrtf((float)ORACLE_PI); /* radiance 1 from everywhere */
    CHECK_WITHIN(fabs((double)lmp_probe_irradiance(3, sh, up).r - ORACLE_PI), 1e-5);
}

/* Row ProjectEnvironment: column and row are phi and theta, and z is up. */
static void projects_environments(void **state) {
    (void)state;
    enum { WIDTH = 96, HEIGHT = 48 };
    static float texels[HEIGHT][WIDTH];
    float sh[COUNT], projected[COUNT];
    randomize(sh, COUNT);
    for (int row = 0; row < HEIGHT; row++)
        for (int column = 0; column < WIDTH; column++)
            texels[row][column] =
                (float)published_sum(direction_of(2 * ORACLE_PI * (column + 0.5) / WIDTH,
                                                  ORACLE_PI * (row + 0.5) / HEIGHT),
                                     -1, sh);
    const lmp_latlong map = { .pixels = texels,
                              .width = WIDTH,
                              .height = HEIGHT,
                              .channels = 1,
                              .azimuth = (float)ORACLE_PI,
                              .mirrored = true,
                              .z_up = true };
    lmp_sh_project_latlong(3, &map, projected);
    CHECK_WITHIN(difference(sh, projected), 2e-3);
}

/* Row ProjectSparseSamples. */
static void fits_sparse_samples(void **state) {
    (void)state;
    enum { SAMPLES = 40 };
    lmp_vec3 directions[SAMPLES];
    float values[SAMPLES], sh[COUNT], fitted[COUNT];
    randomize(sh, COUNT);
    for (int i = 0; i < SAMPLES; i++) {
        directions[i] = check_random_direction();
        values[i] = (float)published_sum(directions[i], -1, sh);
    }
    lmp_probe_samples samples = { .directions = lmp_vec3_array_of(directions),
                                  .values = { values, sizeof(float) },
                                  .count = SAMPLES };
    assert_int_equal(lmp_probe_fit(NULL, 3, 0, &samples, fitted), LMP_OK);
    CHECK_WITHIN(difference(sh, fitted), 1e-4);
    samples.count = COUNT - 1; /* invalid arguments give a result, not an assertion */
    assert_int_equal(lmp_probe_fit(NULL, 3, 0, &samples, fitted), LMP_ERROR_ARGUMENT);
}

/* Rows Rotation::Create and Apply. */
static void rotates_functions(void **state) {
    (void)state;
    const lmp_quat q = check_random_rotation();
    const lmp_vec3 d = check_random_direction();
    double matrix[9];
    oracle_quaternion_matrix((double[]) { (double)q.x, (double)q.y, (double)q.z, (double)q.w },
                             matrix);
    float matrices[LMP_SH_ROTATION_COUNT(3)], sh[COUNT], rotated[COUNT];
    double expected[COUNT], w[3];
    for (int i = 0; i < 3; i++)
        w[i] = matrix[3 * i] * (double)d.x + matrix[3 * i + 1] * (double)d.y +
               matrix[3 * i + 2] * (double)d.z;
    lmp_sh_eval(3, d, sh);
    lmp_sh_make_rotation(3, q, matrices);
    lmp_sh_rotate(3, matrices, sh, rotated);
    published_basis((lmp_vec3) { (float)w[0], (float)w[1], (float)w[2] }, -1, expected);
    CHECK_WITHIN(check_error(COUNT, expected, rotated), 1e-6);
}

/* --- sphericart ------------------------------------------------------------------------------- */

enum { BANDS = 8, VALUES = BANDS * BANDS };

/* Evaluates Y(v / |v|) for spherical harmonics, times |v|^l for solid ones. */
static void harmonics_at(const double v[3], bool solid, double *sh) {
    const double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    lmp_sh_eval_double(BANDS, (double[]) { v[0] / length, v[1] / length, v[2] / length }, sh);
    for (int l = 0; solid && l < BANDS; l++)
        for (int i = l * l; i < (l + 1) * (l + 1); i++)
            sh[i] *= pow(length, l);
}

/* Compares differences of both, at v of any length, with the document's formulas: for spherical
 * harmonics the derivatives over |v| and |v|²; for solid ones l Y w |v|^(l-1) more. */
static void derivatives_are_divided_by_the_length(void **state) {
    (void)state;
    static double sh[VALUES], gradient[3 * VALUES], hessian[6 * VALUES], at[2][2][VALUES];
    const int second[3] = { 0, 3, 5 }; /* d²/dx², dy², dz² */
    for (int i = 0; i < 20; i++) {
        const lmp_vec3 d = check_random_direction();
        const double length = check_random_between(0.5, 2), h = 1e-4;
        double w[3] = { (double)d.x, (double)d.y, (double)d.z }, unit = 0;
        for (int k = 0; k < 3; k++)
            unit += w[k] * w[k];
        for (int k = 0; k < 3; k++)
            w[k] /= sqrt(unit);
        lmp_sh_eval_gradient_double(BANDS, w, sh, gradient);
        lmp_sh_eval_hessian_double(BANDS, w, hessian);
        for (int k = 0; k < 3; k++) {
            for (int side = 0; side < 2; side++)
                for (int solid = 0; solid < 2; solid++) {
                    double v[3] = { w[0] * length, w[1] * length, w[2] * length };
                    v[k] += side ? h : -h;
                    harmonics_at(v, solid, at[side][solid]);
                }
            for (int l = 0; l < BANDS; l++)
                for (int n = l * l; n < (l + 1) * (l + 1); n++) {
                    const double slope = gradient[k * VALUES + n];
                    const double bent = at[1][0][n] + at[0][0][n] - 2 * sh[n];
                    CHECK_WITHIN(fabs((at[1][0][n] - at[0][0][n]) / (2 * h) - slope / length),
                                 1e-4);
                    CHECK_WITHIN(
                        fabs(bent / (h * h) - hessian[second[k] * VALUES + n] / (length * length)),
                        1e-3);
                    CHECK_WITHIN(fabs((at[1][1][n] - at[0][1][n]) / (2 * h) -
                                      pow(length, l - 1) * (l * sh[n] * w[k] + slope)),
                                 1e-3);
                }
        }
    }
}

/* The Laplacian of Y on the sphere is -l (l+1) Y. */
static void second_derivatives_add_up_to_the_laplacian(void **state) {
    (void)state;
    static double sh[VALUES], hessian[6 * VALUES];
    const double w[3] = { 0.48, 0.6, 0.64 };
    lmp_sh_eval_double(BANDS, w, sh);
    lmp_sh_eval_hessian_double(BANDS, w, hessian);
    for (int l = 0; l < BANDS; l++)
        for (int k = l * l; k < (l + 1) * (l + 1); k++)
            CHECK_WITHIN(fabs(hessian[k] + hessian[3 * VALUES + k] + hessian[5 * VALUES + k] +
                              l * (l + 1) * sh[k]),
                         1e-11);
}

/* --- conventions ------------------------------------------------------------------------------ */

/* In Ambisonics N3D's first channels are 1 and sqrt(3) of each axis, SN3D's 1 and each axis; x is
 * forward, y left, z up. */
static void ambisonics_are_scaled_to_one(void **state) {
    (void)state;
    lmp_probe_convention theirs = { LMP_PROBE_SIGN_POSITIVE, LMP_PROBE_N3D, { -3, -1, 2 } };
    const lmp_vec3 d = check_random_direction();
    const double x = -(double)d.z, y = -(double)d.x, z = (double)d.y, root = sqrt(3);
    const double n3d[4] = { 1, root * y, root * z, root * x }, sn3d[4] = { 1, y, z, x };
    float sh[4], converted[4];
    lmp_sh_eval(2, d, sh);
    lmp_probe_convert(2, &ours, &theirs, sh, converted);
    CHECK_WITHIN(check_error(4, n3d, converted), 1e-6);
    theirs.normalization = LMP_PROBE_SN3D;
    lmp_probe_convert(2, &ours, &theirs, sh, converted);
    CHECK_WITHIN(check_error(4, sn3d, converted), 1e-6);
}

/* Each normalization is converted to each, with each sign, and back. */
static void every_convention_converts_to_every_other(void **state) {
    (void)state;
    for (int pair = 0; pair < 36; pair++) {
        const lmp_probe_convention from = { (lmp_probe_sign)(pair % 2),
                                            (lmp_probe_normalization)(pair / 4 % 3),
                                            { 0, 0, 0 } };
        const lmp_probe_convention to = { (lmp_probe_sign)(pair / 2 % 2),
                                          (lmp_probe_normalization)(pair / 12),
                                          { 2, 3, 1 } };
        float sh[COUNT], there[COUNT], back[COUNT];
        randomize(sh, COUNT);
        lmp_probe_convert(3, &from, &to, sh, there);
        lmp_probe_convert(3, &to, &from, there, back);
        CHECK_WITHIN(difference(sh, back), 1e-6);
    }
}

/* A splat's color in direction (x, y, z) is 1/2 + 0.28209479 f_dc - 0.48860251 y f_1 + … */
static void splats_are_in_this_convention(void **state) {
    (void)state;
    const lmp_vec3 d = check_random_direction();
    float sh[COUNT];
    randomize(sh, COUNT);
    CHECK_WITHIN(fabs((double)lmp_sh_reconstruct(3, sh, d) - published_sum(d, -1, sh)), 1e-5);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(angles_are_a_direction),
        cmocka_unit_test(projects_functions),
        cmocka_unit_test(projects_environments),
        cmocka_unit_test(fits_sparse_samples),
        cmocka_unit_test(rotates_functions),
        cmocka_unit_test(derivatives_are_divided_by_the_length),
        cmocka_unit_test(second_derivatives_add_up_to_the_laplacian),
        cmocka_unit_test(ambisonics_are_scaled_to_one),
        cmocka_unit_test(every_convention_converts_to_every_other),
        cmocka_unit_test(splats_are_in_this_convention),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
