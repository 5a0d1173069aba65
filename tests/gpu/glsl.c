/* SPDX-License-Identifier: MIT */
/* lampion.glsl, probe.glsl and ggx.glsl alone, as an engine includes them, against the library. */
#include "tests/gpu/compute.h"
#include "tests/oracle/check.h"
#include "tests/oracle/oracle.h"

#include <lampion/lobe.h>
#include <lampion/probe.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { POINTS = 64 };

/* The shader runs one thread per point: in[i] is (point, radius) of a light at the origin; out
 * receives the coefficients of the light, then those of the direction to it. */
static const char main_function[] =
    "layout(local_size_x = 64) in;\n"
    "layout(std430, binding = 0) buffer in_block { vec4 points[]; };\n"
    "layout(std430, binding = 1) buffer out_block { float values[]; };\n"
    "void main() {\n"
    "    float sh[LMP_SH_COUNT], basis[LMP_SH_COUNT];\n"
    "    vec4 p = points[gl_GlobalInvocationID.x];\n"
    "    lmp_sphere_project(vec4(0.0, 0.0, 0.0, p.w), p.xyz, sh);\n"
    "    lmp_sh_eval(-normalize(p.xyz), basis);\n"
    "    for (int i = 0; i < LMP_SH_COUNT; i++) {\n"
    "        int at = (int(gl_GlobalInvocationID.x) * LMP_SH_COUNT + i) * 2;\n"
    "        values[at] = sh[i];\n"
    "        values[at + 1] = basis[i];\n"
    "    }\n"
    "}\n";

static const char *const lampion_files[] = { "lampion.glsl", "coefficients.glsl", NULL };

/* Points range from touching the sphere to a million radii away, and inside. */
static void fill_points(float points[POINTS][4]) {
    for (int i = 0; i < POINTS; i++) {
        const float azimuth = 2.39996f * (float)i, z = 1 - 2 * ((float)i + 0.5f) / (float)POINTS;
        const float around = sqrtf(1 - z * z);
        const float distance = 0.3f * powf(10, 7 * (float)(i * 37 % POINTS) / (float)POINTS);
        points[i][0] = distance * around * cosf(azimuth);
        points[i][1] = distance * around * sinf(azimuth);
        points[i][2] = distance * z;
        points[i][3] = 1;
    }
}

static double largest(const float *values, size_t count) {
    double result = 0;
    for (size_t i = 0; i < count; i++)
        result = fmax(result, fabs((double)values[i]));
    return result;
}

static void coefficients_agree_with_the_library(void **state) {
    (void)state;
    static const int band_counts[] = { 1, 2, 3, 6, 10, 20 };
    float points[POINTS][4];
    fill_points(points);
    for (size_t b = 0; b < sizeof band_counts / sizeof band_counts[0]; b++) {
        const int bands = band_counts[b];
        const size_t count = LMP_SH_COUNT(bands), size = POINTS * count * 2 * sizeof(float);
        char head[64];
        snprintf(head, sizeof head, "#version 450 core\n#define LMP_BANDS %d\n", bands);
        const GLuint program = build_compute(head, lampion_files, main_function);
        float *values = run_compute(program, points, sizeof points, size, 1);
        double worst = 0;
        for (size_t i = 0; i < POINTS; i++) {
            float light[400], basis[400];
            const lmp_vec3 p = { points[i][0], points[i][1], points[i][2] };
            const float d = sqrtf(p.x * p.x + p.y * p.y + p.z * p.z);
            lmp_sphere_project(bands, (lmp_vec3) { 0, 0, 0 }, points[i][3], p, light);
            lmp_sh_eval(bands, (lmp_vec3) { -p.x / d, -p.y / d, -p.z / d }, basis);
            const double scale[2] = { largest(light, count), largest(basis, count) };
            for (size_t k = 0; k < 2 * count; k++) {
                const double expected = (double)(k % 2 ? basis[k / 2] : light[k / 2]);
                const double error =
                    fabs((double)values[2 * count * i + k] - expected) / scale[k % 2];
                assert_true(isfinite(error));
                worst = fmax(worst, error);
            }
        }
        print_message("%2d bands: %.1e of the largest coefficient\n", bands, worst);
        free(values);
        glDeleteProgram(program);
        if (!(worst <= 2e-5))
            fail_msg("%d bands: %g above 2e-5", bands, worst);
    }
}

/* --- spheres ---------------------------------------------------------------------------------- */

enum { SPHERES = 64 * 64 };

/* The shader runs one thread per sphere: in[i] is its position and radius; out receives the
 * irradiance of a surface at the origin whose normal is z. */
static const char sphere_main[] =
    "layout(local_size_x = 64) in;\n"
    "layout(std430, binding = 0) buffer in_block { vec4 spheres[]; };\n"
    "layout(std430, binding = 1) buffer out_block { float values[]; };\n"
    "void main() {\n"
    "    uint i = gl_GlobalInvocationID.x;\n"
    "    lmp_cap cap = lmp_cap_of_sphere(spheres[i], vec3(0.0));\n"
    "    values[i] = lmp_cap_irradiance(cap, vec3(0.0, 0.0, 1.0));\n"
    "}\n";

/* Makes a sphere at any angle, or where the horizon begins or ends to cut it, from ten thousand
 * radii away to its middle, but for its surface, where cos a changes faster than float32 tells
 * positions apart. */
static void fill_sphere(float sphere[4]) {
    const double ratio = pow(10, check_random_between(-4, 4)),
                 r = fabs(ratio - 1) < 1e-2 ? 1.01 : ratio;
    const double half = r > 1 ? asin(1 / r) : check_random_between(0, 3);
    const double side = check_random() < 0.5 ? half : -half;
    const double angle = check_random() < 0.5
                             ? check_random_between(0, ORACLE_PI)
                             : ORACLE_PI / 2 + side * check_random_between(0.9, 1.1);
    const double around = check_random_between(0, 2 * ORACLE_PI);
    sphere[0] = (float)(r * sin(angle) * cos(around));
    sphere[1] = (float)(r * sin(angle) * sin(around));
    sphere[2] = (float)(r * cos(angle));
    sphere[3] = 1;
}

/* Returns how far the irradiance is off, in parts of that of a surface that faces the sphere. */
static double irradiance_error(const float sphere[4], double irradiance) {
    const double x = (double)sphere[0], y = (double)sphere[1], z = (double)sphere[2];
    const double d = sqrt(x * x + y * y + z * z), sine = d < 1 ? d : 1 / d;
    const double held = sine * sine / (1 + sqrt(1 - sine * sine)), open = d < 1 ? 2 - held : held;
    return fabs(irradiance - oracle_irradiance(z / d, open)) / oracle_irradiance(1, open);
}

static void irradiance_under_spheres_is_that_of_what_is_seen(void **state) {
    (void)state;
    static float spheres[SPHERES][4];
    double worst = 0;
    for (int i = 0; i < SPHERES; i++)
        fill_sphere(spheres[i]);
    const GLuint program =
        build_compute("#version 450 core\n#define LMP_BANDS 3\n", lampion_files, sphere_main);
    float *values =
        run_compute(program, spheres, sizeof spheres, SPHERES * sizeof(float), SPHERES / POINTS);
    for (int i = 0; i < SPHERES; i++)
        worst = fmax(worst, irradiance_error(spheres[i], (double)values[i]));
    print_message("of the irradiance of a surface that faces the sphere: at most %.1e\n", worst);
    CHECK_WITHIN(worst, 1e-5);
    free(values);
    glDeleteProgram(program);
}

/* --- lists ------------------------------------------------------------------------------------ */

static const char lists_main[] =
    "layout(local_size_x = 1) in;\n"
    "layout(std430, binding = 1) buffer out_block { uint values[]; };\n"
    "#define LIST_BAND(l) values[0] = values[0] + (1u << l);\n"
    "#define LIST_CELL(l, m) values[1 + m] = values[1 + m] + (1u << l);\n"
    "#define LIST_COLUMN(m) values[3] = values[3] + (1u << m);\n"
    "void main() {\n"
    "    LMP_FOR_BANDS(LIST_BAND)\n"
    "    LMP_FOR_COLUMN(LIST_CELL, 0)\n"
    "    LMP_FOR_COLUMN(LIST_CELL, 1)\n"
    "    LMP_FOR_COLUMNS(LIST_COLUMN)\n"
    "}\n";

/* Every band must be listed once: in a sum of powers of two, a missing or repeated number shows.
 * Drivers compile this at once, unlike code for the most bands. */
static void lists_name_every_band_once(void **state) {
    (void)state;
    static const int band_counts[] = { 1, 4, 5, 8, 9, 16, 17, 32 };
    static const uint32_t zeros[4];
    for (size_t b = 0; b < sizeof band_counts / sizeof *band_counts; b++) {
        const int bands = band_counts[b];
        char head[64];
        GLuint buffer;
        uint32_t values[4];
        snprintf(head, sizeof head, "#version 450 core\n#define LMP_BANDS %d\n", bands);
        const GLuint program = build_compute(head, lampion_files, lists_main);
        glCreateBuffers(1, &buffer);
        glNamedBufferStorage(buffer, sizeof zeros, zeros, 0);
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, buffer);
        glUseProgram(program);
        glDispatchCompute(1, 1, 1);
        glMemoryBarrier(GL_ALL_BARRIER_BITS);
        glGetNamedBufferSubData(buffer, 0, sizeof values, values);
        const int columns = bands <= 4 ? 4 : bands <= 8 ? 8 : bands <= 16 ? 16 : 32;
        assert_int_equal(values[0], 0xfffffffcu);
        assert_int_equal(values[1], 0xffffffffu);
        assert_int_equal(values[2], 0xffffffffu);
        assert_int_equal(values[3], 0xffffffffu >> (32 - columns));
        glDeleteBuffers(1, &buffer);
        glDeleteProgram(program);
    }
}

/* --- probes ----------------------------------------------------------------------------------- */

static const char probe_main[] =
    "layout(local_size_x = 64) in;\n"
    "layout(std140, binding = 0) uniform probe_block { vec4 linear[3], quadratic[3], last; };\n"
    "layout(std430, binding = 0) buffer in_block { vec4 normals[]; };\n"
    "layout(std430, binding = 1) buffer out_block { vec4 values[]; };\n"
    "void main() {\n"
    "    uint i = gl_GlobalInvocationID.x;\n"
    "    values[i] = vec4(lmp_probe_irradiance(linear, quadratic, last, normals[i].xyz), 0.0);\n"
    "}\n";

static void irradiance_agrees_with_the_library(void **state) {
    (void)state;
    float sh[3 * 9], normals[POINTS][4];
    lmp_probe_constants constants;
    for (int k = 0; k < 27; k++)
        sh[k] = (float)check_random_between(-1, 1);
    for (int i = 0; i < POINTS; i++) {
        const lmp_vec3 n = check_random_direction();
        memcpy(normals[i], (const float[4]) { n.x, n.y, n.z }, sizeof normals[i]);
    }
    lmp_probe_make_constants(3, 1, sh, &constants);
    static const char *const files[] = { "probe.glsl", NULL };
    const GLuint program = build_compute("#version 450 core\n", files, probe_main);
    GLuint buffers[3];
    glCreateBuffers(3, buffers);
    glNamedBufferStorage(buffers[0], sizeof normals, normals, 0);
    glNamedBufferStorage(buffers[1], sizeof normals, NULL, GL_MAP_READ_BIT);
    glNamedBufferStorage(buffers[2], sizeof constants, &constants, 0);
    glBindBuffersBase(GL_SHADER_STORAGE_BUFFER, 0, 2, buffers);
    glBindBufferBase(GL_UNIFORM_BUFFER, 0, buffers[2]);
    glUseProgram(program);
    glDispatchCompute(1, 1, 1);
    glMemoryBarrier(GL_ALL_BARRIER_BITS);
    const float(*values)[4] = glMapNamedBuffer(buffers[1], GL_READ_ONLY);
    assert_non_null(values);
    for (int i = 0; i < POINTS; i++) {
        const lmp_rgb e =
            lmp_probe_irradiance(3, sh, (lmp_vec3) { normals[i][0], normals[i][1], normals[i][2] });
        CHECK_WITHIN(fabsf(values[i][0] - e.r), 1e-5);
        CHECK_WITHIN(fabsf(values[i][1] - e.g), 1e-5);
        CHECK_WITHIN(fabsf(values[i][2] - e.b), 1e-5);
    }
    glDeleteBuffers(3, buffers);
    glDeleteProgram(program);
}

/* --- GGX -------------------------------------------------------------------------------------- */

static const char ggx_head[] =
    "#version 450 core\n"
    "layout(std430, binding = 2) buffer texel_block { vec4 texels[]; };\n"
    "#define LMP_GGX_TEXEL(i) texels[i]\n";

/* The shader runs one thread per view: (direction, roughness) around the normal z; out receives two
 * vec4 per lobe. */
static const char ggx_main[] =
    "layout(local_size_x = 64) in;\n"
    "layout(std430, binding = 0) buffer in_block { vec4 views[]; };\n"
    "layout(std430, binding = 1) buffer out_block { vec4 values[]; };\n"
    "void main() {\n"
    "    uint i = gl_GlobalInvocationID.x;\n"
    "    vec3 normal = vec3(0.0, 0.0, 1.0), view = views[i].xyz;\n"
    "    lmp_ggx_node node = lmp_ggx_lookup(normal, view, views[i].w);\n"
    "    for (int k = 0; k < LMP_GGX_LOBES; k++) {\n"
    "        lmp_ggx_lobe lobe = lmp_ggx_lobe_at(node, normal, view, k);\n"
    "        uint at = (i * LMP_GGX_LOBES + k) * 2;\n"
    "        values[at] = vec4(lobe.axis, lobe.exponent);\n"
    "        values[at + 1] = vec4(lobe.f0, lobe.f90, lmp_ggx_diffuse_f90(node), "
    "float(lmp_ggx_count(node)));\n"
    "    }\n"
    "}\n";

static void check_ggx_lobes(const float view[4], const float (*values)[4]) {
    lmp_ggx_lobes lobes;
    lmp_lobe_find_ggx((lmp_vec3) { 0, 0, 1 }, (lmp_vec3) { view[0], view[1], view[2] }, view[3],
                      &lobes);
    for (int k = 0; k < LMP_GGX_LOBES; k++) {
        const lmp_ggx_lobe *lobe = &lobes.lobe[k];
        const float *first = values[2 * k], *second = values[2 * k + 1];
        CHECK_WITHIN(fabsf(first[0] - lobe->axis.x), 1e-5);
        CHECK_WITHIN(fabsf(first[1] - lobe->axis.y), 1e-5);
        CHECK_WITHIN(fabsf(first[2] - lobe->axis.z), 1e-5);
        CHECK_WITHIN(fabsf(first[3] / lobe->exponent - 1), 1e-4);
        CHECK_WITHIN(fabsf(second[0] - lobe->f0), 1e-5);
        CHECK_WITHIN(fabsf(second[1] - lobe->f90), 1e-5);
        CHECK_WITHIN(fabsf(second[2] - lobes.diffuse_f90), 1e-5);
        if (k >= (int)second[3]) /* a lobe that does not count */
            CHECK_WITHIN(fabsf(lobe->f0) + fabsf(lobe->f90), 1e-5);
    }
}

static void ggx_lobes_agree_with_the_library(void **state) {
    (void)state;
    static float views[POINTS][4], texels[LMP_GGX_TEXELS][4];
    const size_t size = POINTS * LMP_GGX_LOBES * 2 * 4 * sizeof(float);
    for (int i = 0; i < POINTS; i++) {
        const lmp_vec3 v = check_random_direction();
        memcpy(views[i], (const float[4]) { v.x, v.y, fabsf(v.z) }, sizeof views[i]);
        views[i][3] = (float)check_random_between(-0.1, 1.1);
    }
    lmp_lobe_copy_ggx_texels(texels[0]);
    static const char *const files[] = { "ggx.glsl", NULL };
    const GLuint program = build_compute(ggx_head, files, ggx_main);
    GLuint buffers[3];
    glCreateBuffers(3, buffers);
    glNamedBufferStorage(buffers[0], sizeof views, views, 0);
    glNamedBufferStorage(buffers[1], (GLsizeiptr)size, NULL, GL_MAP_READ_BIT);
    glNamedBufferStorage(buffers[2], sizeof texels, texels, 0);
    glBindBuffersBase(GL_SHADER_STORAGE_BUFFER, 0, 3, buffers);
    glUseProgram(program);
    glDispatchCompute(1, 1, 1);
    glMemoryBarrier(GL_ALL_BARRIER_BITS);
    const float(*values)[4] = glMapNamedBuffer(buffers[1], GL_READ_ONLY);
    assert_non_null(values);
    for (int i = 0; i < POINTS; i++)
        check_ggx_lobes(views[i], values + (ptrdiff_t)2 * LMP_GGX_LOBES * i);
    glDeleteBuffers(3, buffers);
    glDeleteProgram(program);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(coefficients_agree_with_the_library),
        cmocka_unit_test(irradiance_under_spheres_is_that_of_what_is_seen),
        cmocka_unit_test(lists_name_every_band_once),
        cmocka_unit_test(irradiance_agrees_with_the_library),
        cmocka_unit_test(ggx_lobes_agree_with_the_library),
    };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
