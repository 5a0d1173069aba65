/* SPDX-License-Identifier: MIT */
/* The statements of docs/migrating-engines.md, row by row, with the numbers that the engines
 * publish. */
#include "tests/unit/peers.h"

static const lmp_probe_convention positive = { .sign = LMP_PROBE_SIGN_POSITIVE };

/* --- three.js --------------------------------------------------------------------------------- */

/* Rows getBasisAt and getAt. */
static void three_js_has_the_positive_sign(void **state) {
    (void)state;
    for (int i = 0; i < 100; i++) {
        const lmp_vec3 d = check_random_direction();
        float sh[COUNT], theirs[COUNT];
        double expected[COUNT];
        lmp_sh_eval(3, d, sh);
        lmp_probe_convert(3, &ours, &positive, sh, theirs);
        published_basis(d, 1, expected);
        CHECK_WITHIN(check_error(COUNT, expected, theirs), 1e-6);
        randomize(sh, COUNT);
        lmp_probe_convert(3, &ours, &positive, sh, theirs);
        CHECK_WITHIN(fabs((double)lmp_sh_reconstruct(3, sh, d) - published_sum(d, 1, theirs)),
                     1e-5);
    }
}

/* Returns irradiance as three.js and Godot write it, from coefficients of positive sign: 0.886227,
 * 2 * 0.511664, 2 * 0.429043, 0.743125, 0.247708. */
static double published_irradiance(lmp_vec3 n, const float *sh) {
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
        sum += factors[k] * (double)sh[k];
    return sum;
}

/* Row getIrradianceAt; and Godot's shaders, whose probes are divided by pi. */
static void three_js_and_godot_find_the_same_irradiance(void **state) {
    (void)state;
    for (int i = 0; i < 100; i++) {
        const lmp_vec3 n = check_random_direction();
        float sh[3 * COUNT] = { 0 }, theirs[COUNT];
        randomize(sh, COUNT);
        lmp_probe_convert(3, &ours, &positive, sh, theirs);
        const double irradiance = (double)lmp_probe_irradiance(3, sh, n).r;
        CHECK_WITHIN(fabs(irradiance - published_irradiance(n, theirs)), 1e-5);
        lmp_sh_combine(3, (float)(1 / ORACLE_PI), theirs, 0, theirs, theirs);
        CHECK_WITHIN(fabs(irradiance / ORACLE_PI - published_irradiance(n, theirs)), 1e-5);
    }
}

/* Rows lerp and addScaledSH. */
static void three_js_interpolates(void **state) {
    (void)state;
    float a[COUNT], b[COUNT], sh[COUNT];
    randomize(a, COUNT);
    randomize(b, COUNT);
    lmp_sh_combine(3, 1 - 0.25f, a, 0.25f, b, sh);
    for (int i = 0; i < COUNT; i++)
        CHECK_WITHIN(fabsf(sh[i] - (a[i] + 0.25f * (b[i] - a[i]))), 1e-6);
    lmp_sh_combine(3, 1, a, 3, b, a);
    for (int i = 0; i < COUNT; i++)
        CHECK_WITHIN(fabsf(a[i] - 3 * b[i] - (sh[i] - 0.25f * b[i]) / 0.75f), 1e-5);
}

/* Rows AmbientLightProbe, 2 sqrt(pi) times the color, and HemisphereLightProbe, sqrt(pi) (sky +
 * ground) and sqrt(3 pi / 4) (sky - ground) for y. */
static void three_js_probes_have_these_irradiances(void **state) {
    (void)state;
    const float sky = 3, ground = 0.5f, c0 = (float)sqrt(ORACLE_PI), c1 = c0 * sqrtf(0.75f);
    const float zonal[3] = { c0 * (sky + ground), c1 * (sky - ground), 0 };
    float sh[3 * COUNT] = { 0 }, theirs[COUNT];
    lmp_sh_expand_zonal(3, zonal, up, sh);
    lmp_probe_convert(3, &ours, &positive, sh, theirs);
    CHECK_WITHIN(fabs((double)theirs[0] - (double)zonal[0]), 1e-6);
    CHECK_WITHIN(fabs((double)theirs[1] - (double)zonal[1]), 1e-6);
    CHECK_WITHIN(fabs((double)lmp_probe_irradiance(3, sh, up).r - ORACLE_PI * (double)sky), 1e-5);
    CHECK_WITHIN(fabs((double)lmp_probe_irradiance(3, sh, down).r - ORACLE_PI * (double)ground),
                 1e-5);
    memset(sh, 0, sizeof sh);
    sh[0] = 2 * c0 * sky;
    CHECK_WITHIN(fabs((double)lmp_sh_reconstruct(3, sh, up) - (double)sky), 1e-6);
}

/* Row LightProbeGenerator.fromCubeTexture. */
static lmp_vec3 three_js_cube(int face, float column, float v) {
    const float row = -v;
    const lmp_vec3 directions[6] = { { -1, row, -column }, { 1, row, column },
                                     { -column, 1, -row }, { -column, -1, row },
                                     { -column, row, 1 },  { column, row, -1 } };
    return directions[face];
}
static void three_js_mirrors_cube_textures(void **state) {
    (void)state;
    static cube_texels texels;
    const lmp_probe_convention mirrored = { .sign = LMP_PROBE_SIGN_POSITIVE, .axes = { -1, 2, 3 } };
    float sh[COUNT], projected[COUNT], theirs[COUNT];
    randomize(sh, COUNT);
    const lmp_cubemap map = cube_of(three_js_cube, 1, sh, texels);
    lmp_sh_project_cubemap(3, &map, projected);
    lmp_probe_convert(3, &ours, &mirrored, projected, theirs);
    CHECK_WITHIN(difference(sh, theirs), 1e-3);
}

/* --- panoramas -------------------------------------------------------------------------------- */

/* Finds the texel that direction d is looked up in, and the coefficients of that texel alone. */
enum { WIDTH = 64, HEIGHT = 32 };
static double panorama_error(double u, double v, lmp_vec3 d, lmp_latlong map) {
    static float texels[HEIGHT][WIDTH];
    float sh[COUNT];
    double expected[COUNT];
    memset(texels, 0, sizeof texels);
    texels[(int)(v * HEIGHT)][(int)((u - floor(u)) * WIDTH)] = 1;
    map.pixels = texels;
    map.width = WIDTH;
    map.height = HEIGHT;
    map.channels = 1;
    lmp_sh_project_latlong(3, &map, sh);
    published_basis(d, -1, expected);
    for (int i = 0; i < COUNT; i++)
        expected[i] *= (double)sh[0] / 0.282094791773878;
    return check_error(COUNT, expected, sh);
}

/* The images are an equirectangular texture of three.js, and a panorama of Godot. */
static void panoramas_show_what_engines_see(void **state) {
    (void)state;
    for (int i = 0; i < 50; i++) {
        const lmp_vec3 d = check_random_direction();
        const double x = (double)d.x, y = (double)d.y, z = (double)d.z;
        const double v = acos(y) / ORACLE_PI, turn = 2 * ORACLE_PI;
        CHECK_WITHIN(panorama_error(0.5 + atan2(z, x) / turn, v, d, (lmp_latlong) { 0 }), 0.2);
        CHECK_WITHIN(panorama_error(atan2(x, -z) / turn, v, d,
                                    (lmp_latlong) { .azimuth = (float)ORACLE_PI / 2 }),
                     0.2);
    }
}

/* --- Unity and Filament ----------------------------------------------------------------------- */

/* The factors of IndirectLight.h's table, and of Unity's SphericalHarmonicMath. */
static const double published_factors[COUNT] = { 0.282095,  -0.325735, 0.325735,
                                                 -0.325735, 0.273137,  -0.273137,
                                                 0.078848,  -0.273137, 0.136569 };

/* Finds the nine values of a channel (docs/migrating-engines.md). */
static void nine_values(const lmp_probe_constants *k, int c, float nine[COUNT]) {
    const float *a = k->linear[c], *b = k->quadratic[c];
    const float values[COUNT] = { a[3] + b[2] / 3, a[1], a[2],      a[0], b[0], b[1],
                                  b[2] / 3,        b[3], k->last[c] };
    memcpy(nine, values, sizeof values);
}

/* Rows Builder::irradiance and SphericalHarmonicsL2; unity_SHAr … are a[3], a[1], a[2], a[0] - a[6]
 * … */
static void unity_and_filament_keep_the_polynomial(void **state) {
    (void)state;
    float sh[3 * COUNT], nine[COUNT];
    lmp_probe_constants k;
    randomize(sh, 3 * COUNT);
    lmp_probe_make_constants(3, (float)(1 / ORACLE_PI), sh, &k);
    for (int c = 0; c < 3; c++) {
        double expected[COUNT];
        for (int i = 0; i < COUNT; i++)
            expected[i] = published_factors[i] * (double)sh[c * COUNT + i];
        nine_values(&k, c, nine);
        CHECK_WITHIN(check_error(COUNT, expected, nine), 1e-5);
        CHECK_WITHIN(fabsf(k.linear[c][3] - (nine[0] - nine[6])), 1e-6);
        CHECK_WITHIN(fabsf(k.quadratic[c][2] - 3 * nine[6]), 1e-6);
    }
    const lmp_vec3 n = check_random_direction();
    const double x = (double)n.x, y = (double)n.y, z = (double)n.z;
    const double terms[COUNT] = { 1, y, z, x, x * y, y * z, 3 * z * z - 1, x * z, x * x - y * y };
    double sum = 0;
    for (int i = 0; i < COUNT; i++)
        sum += terms[i] * (double)nine[i];
    CHECK_WITHIN(fabs((double)lmp_probe_irradiance(3, sh, n).b / ORACLE_PI - sum), 1e-5);
}

/* Rows getDirectionEstimate, of one light; AddAmbientLight; and AddDirectionalLight, of 3 bands
 * times 16 pi / 17: what a facing white wall reflects is the sum of both colors. */
static void unity_and_filament_lights_are_known(void **state) {
    (void)state;
    const lmp_vec3 d = check_random_direction();
    float sh[3 * COUNT] = { 0 };
    lmp_sh_eval(3, d, sh);
    const float estimate[3] = { -sh[3], -sh[1], sh[2] };
    const double length = sqrt((double)(estimate[0] * estimate[0] + estimate[1] * estimate[1] +
                                        estimate[2] * estimate[2]));
    CHECK_WITHIN(fabs((double)estimate[0] / length - (double)d.x), 1e-6);
    CHECK_WITHIN(fabs((double)estimate[1] / length - (double)d.y), 1e-6);
    CHECK_WITHIN(fabs((double)estimate[2] / length - (double)d.z), 1e-6);
    lmp_sh_combine(3, 0.75f * 2.95679308573f, sh, 0, sh, sh);
    sh[0] += 2 * sqrtf((float)ORACLE_PI) * 0.25f;
    CHECK_WITHIN(fabs((double)lmp_probe_irradiance(3, sh, d).r / ORACLE_PI - 1), 1e-5);
}

/* Rows CubemapSH::computeSH with irradiance, and cmgen's window. */
static void filament_bakes_irradiance_that_is_not_negative(void **state) {
    (void)state;
    const lmp_vec3 d = check_random_direction();
    float sh[3 * COUNT] = { 0 }, lambda[3], baked[COUNT], weights[3];
    lmp_sh_eval(3, d, sh);
    lmp_lobe_make_diffuse(3, lambda);
    lmp_sh_apply_window(3, lambda, sh, baked);
    const lmp_vec3 n = check_random_direction();
    CHECK_WITHIN(
        fabs((double)lmp_probe_irradiance(3, sh, n).r - (double)lmp_sh_reconstruct(3, baked, n)),
        1e-5);
    assert_true(lmp_probe_minimum(3, sh) < -0.05f);
    lmp_probe_make_positive_window(3, sh, 1, weights);
    lmp_sh_apply_window(3, weights, sh, sh);
    CHECK_WITHIN(fabsf(lmp_probe_minimum(3, sh)), 1e-5);
}

/* Unity's z is forward where ours is backward. */
static void unity_worlds_are_left_handed(void **state) {
    (void)state;
    const lmp_probe_convention unity = { .axes = { 1, 2, -3 } };
    float sh[COUNT], theirs[COUNT], expected[COUNT];
    lmp_sh_eval(3, (lmp_vec3) { 0, 0.6f, -0.8f }, sh);
    lmp_probe_convert(3, &ours, &unity, sh, theirs);
    lmp_sh_eval(3, (lmp_vec3) { 0, 0.6f, 0.8f }, expected);
    CHECK_WITHIN(difference(expected, theirs), 1e-6);
}

/* --- Unreal ----------------------------------------------------------------------------------- */

/* Rows SHBasisFunction, DotSH3 and CalcDiffuseTransferSH3 of exponent 1, whose factors are pi, 2 pi
 * / 3 and pi / 4, and ConstantBasisIntegral. x is forward, y right, z up. */
static void unreal_has_other_axes_and_the_same_basis(void **state) {
    (void)state;
    const lmp_probe_convention unreal = { .axes = { -3, 1, 2 } };
    const lmp_vec3 d = check_random_direction(), n = check_random_direction();
    const double factors[3] = { ORACLE_PI, 2 * ORACLE_PI / 3, ORACLE_PI / 4 };
    float sh[3 * COUNT] = { 0 }, theirs[COUNT], lambda[3], transfer[COUNT];
    double expected[COUNT], basis[COUNT], irradiance = 0;
    lmp_sh_eval(3, d, sh);
    lmp_probe_convert(3, &ours, &unreal, sh, theirs);
    published_basis((lmp_vec3) { -d.z, d.x, d.y }, -1, expected);
    CHECK_WITHIN(check_error(COUNT, expected, theirs), 1e-6);
    published_basis((lmp_vec3) { -n.z, n.x, n.y }, -1, basis);
    for (int l = 0; l < 3; l++)
        for (int i = l * l; i < (l + 1) * (l + 1); i++) {
            basis[i] *= factors[l];
            irradiance += basis[i] * expected[i];
        }
    lmp_lobe_make_diffuse(3, lambda);
    lmp_lobe_project(3, lambda, (lmp_vec3) { -n.z, n.x, n.y }, transfer);
    CHECK_WITHIN(check_error(COUNT, basis, transfer), 1e-6);
    CHECK_WITHIN(fabs((double)lmp_sh_dot(3, theirs, transfer) - irradiance), 1e-5);
    CHECK_WITHIN(fabs((double)lmp_probe_irradiance(3, sh, n).r - irradiance), 1e-5);
    const float one[COUNT] = { 2 * sqrtf((float)ORACLE_PI) };
    CHECK_WITHIN(fabsf(lmp_sh_reconstruct(3, one, d) - 1), 1e-6);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(three_js_has_the_positive_sign),
        cmocka_unit_test(three_js_and_godot_find_the_same_irradiance),
        cmocka_unit_test(three_js_interpolates),
        cmocka_unit_test(three_js_probes_have_these_irradiances),
        cmocka_unit_test(three_js_mirrors_cube_textures),
        cmocka_unit_test(panoramas_show_what_engines_see),
        cmocka_unit_test(unity_and_filament_keep_the_polynomial),
        cmocka_unit_test(unity_and_filament_lights_are_known),
        cmocka_unit_test(filament_bakes_irradiance_that_is_not_negative),
        cmocka_unit_test(unity_worlds_are_left_handed),
        cmocka_unit_test(unreal_has_other_axes_and_the_same_basis),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
