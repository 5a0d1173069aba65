/* SPDX-License-Identifier: MIT */
/* The HLSL and Metal variants of the shaders against lmp_shade, in steps of variants.sh:
 *   inputs FILE         writes lights, surfaces and the texels of GGX
 *   run SPIRV           runs what the HLSL was compiled to on the OpenGL device, and compares
 *   check FILE          compares what the Metal variant has computed */
#include "app/render/gl/gpu.h"
#include "tests/oracle/check.h"

#include <lampion/lobe.h>
#include <lampion/shade.h>

#include <epoxy/gl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { BANDS = 6, VALUES = 4 };

typedef struct inputs {
    float light[LIGHTS][2][4];     /* center and radius, radiance */
    float surface[SURFACES][3][4]; /* position and roughness, normal, view */
    float texel[LMP_GGX_TEXELS][4];
    float area[AREAS][LMP_AREA_TEXELS][4];
} inputs;

static void set(float to[4], lmp_vec3 v, double w) {
    memcpy(to, (const float[4]) { v.x, v.y, v.z, (float)w }, 4 * sizeof *to);
}

/* Makes an area of each kind, around which the surfaces are as near as they are far. */
static void make_areas(lmp_light areas[AREAS]) {
    static const lmp_light_kind kinds[AREAS] = { LMP_LIGHT_RECTANGLE, LMP_LIGHT_DISK,
                                                 LMP_LIGHT_TUBE, LMP_LIGHT_POLYGON };
    for (int i = 0; i < AREAS; i++) {
        areas[i] = (lmp_light) { .kind = kinds[i],
                                 .position = { (float)i - 1, 1.5f, -1 },
                                 .direction = { 0.6f, -0.8f, 0 },
                                 .radius = 0.3f,
                                 .two_sided = i > 0,
                                 .radiance = { 1, 2, (float)i } };
        if (kinds[i] == LMP_LIGHT_POLYGON) {
            areas[i].corner_count = 5;
            for (int k = 0; k < 5; k++)
                areas[i].corner[k] =
                    (lmp_vec3) { 0.5f * cosf(1.2f * (float)k), 0, 0.5f * sinf(1.2f * (float)k) };
        } else {
            areas[i].half[0] = (lmp_vec3) { 0.7f, 0.2f, 0 };
            areas[i].half[1] = (lmp_vec3) { 0, 0.1f, 0.4f };
        }
    }
}

static void fill(inputs *given) {
    for (int i = 0; i < LIGHTS; i++) {
        const lmp_vec3 w = check_random_direction();
        const float d = (float)check_random_between(1, 4);
        set(given->light[i][0], (lmp_vec3) { d * w.x, d * w.y, d * w.z },
            check_random_between(0.1, 1.5));
        set(given->light[i][1], (lmp_vec3) { 3, (float)i, 1 }, 0);
    }
    for (int i = 0; i < SURFACES; i++) {
        lmp_vec3 view = check_random_direction(), normal = check_random_direction();
        const float cosine = view.x * normal.x + view.y * normal.y + view.z * normal.z;
        if (cosine < 0)
            view = (lmp_vec3) { -view.x, -view.y, -view.z };
        set(given->surface[i][0], check_random_direction(), check_random_between(0.1, 1));
        set(given->surface[i][1], normal, 0);
        set(given->surface[i][2], view, 0);
    }
    lmp_lobe_copy_ggx_texels(given->texel[0]);
    lmp_light areas[AREAS];
    make_areas(areas);
    for (int i = 0; i < AREAS; i++)
        lmp_light_copy_area_texels(&areas[i], given->area[i][0]);
}

static void read_file(const char *path, void *data, size_t size) {
    FILE *file = fopen(path, "rb");
    if (!file || fread(data, 1, size, file) != size)
        fail_msg("%s: not %zu bytes", path, size);
    fclose(file);
}

static void write_file(const char *path, const void *data, size_t size) {
    FILE *file = fopen(path, "wb");
    assert_true(file && fwrite(data, 1, size, file) == size && fclose(file) == 0);
}

static lmp_vec3 vec3_of(const float v[4]) {
    return (lmp_vec3) { v[0], v[1], v[2] };
}

static float agreement(const float value[4], lmp_rgb expected) {
    const float scale = fmaxf(expected.r, fmaxf(expected.g, expected.b)) + 1e-3f;
    return fmaxf(fabsf(value[0] - expected.r),
                 fmaxf(fabsf(value[1] - expected.g), fabsf(value[2] - expected.b))) /
           scale;
}

static void check(const inputs *given, const float (*values)[4]) {
    static const lmp_material clay = { .diffuse = { 0.8f, 0.4f, 0.3f },
                                       .specular = { 0.04f, 0.05f, 0.06f },
                                       .exponent = 30 };
    const lmp_shade_settings settings = { .bands = BANDS, .window = LMP_WINDOW_HANNING };
    lmp_shade_settings coefficients = settings;
    coefficients.method = LMP_SHADE_COEFFICIENTS;
    lmp_light lights[LIGHTS + AREAS] = { { 0 } };
    make_areas(lights + LIGHTS);
    for (int i = 0; i < LIGHTS; i++) {
        const float *radiance = given->light[i][1];
        lights[i].position = vec3_of(given->light[i][0]);
        lights[i].radius = given->light[i][0][3];
        lights[i].radiance = (lmp_rgb) { radiance[0], radiance[1], radiance[2] };
    }
    for (int i = 0; i < SURFACES; i++, values += VALUES) {
        const lmp_surface surface = { .position = vec3_of(given->surface[i][0]),
                                      .normal = vec3_of(given->surface[i][1]),
                                      .view = vec3_of(given->surface[i][2]) };
        const lmp_material metal = { .kind = LMP_MATERIAL_METALLIC_ROUGHNESS,
                                     .base_color = { 0.9f, 0.6f, 0.3f },
                                     .metallic = 0.7f,
                                     .roughness = given->surface[i][0][3] };
        const lmp_rgb by_clay = lmp_shade(&settings, &clay, &surface, lights, LIGHTS + AREAS);
        const lmp_rgb by_metal = lmp_shade(&settings, &metal, &surface, lights, LIGHTS + AREAS);
        const lmp_rgb by_sums = lmp_shade(&coefficients, &metal, &surface, lights, LIGHTS + AREAS);
        float sh[LMP_SH_COUNT(BANDS)];
        lmp_sphere_project(BANDS, lights[0].position, lights[0].radius, surface.position, sh);
        CHECK_WITHIN(agreement(values[0], by_clay), 1e-4);
        CHECK_WITHIN(agreement(values[1], by_metal), 1e-4);
        CHECK_WITHIN(agreement(values[2], by_sums), 1e-4);
        CHECK_WITHIN(fabsf(values[3][0] - sh[1]), 1e-4);
        CHECK_WITHIN(fabsf(values[3][1] - sh[4]), 1e-4);
        CHECK_WITHIN(fabsf(values[3][2] - sh[20]), 1e-4);
        CHECK_WITHIN(fabsf(values[3][3] - sh[35]), 1e-4);
    }
}

/* Runs the SPIR-V; returns false if the device does not accept it. */
static bool run(const char *path, const inputs *given, float (*values)[4], size_t size) {
    static unsigned char code[1 << 20];
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    const GLsizei length = (GLsizei)fread(code, 1, sizeof code, file);
    fclose(file);
    gpu_context context;
    base_error error = { "" };
    if (!gpu_context_create(getenv("LAMPION_TEST_GL_DEVICE"), &context, &error))
        fail_msg("%s", error.text);
    if (!epoxy_has_gl_extension("GL_ARB_gl_spirv")) {
        gpu_context_destroy(&context);
        return false;
    }
    const GLuint shader = glCreateShader(GL_COMPUTE_SHADER), program = glCreateProgram();
    GLint ok = 0;
    glShaderBinary(1, &shader, GL_SHADER_BINARY_FORMAT_SPIR_V, code, length);
    glSpecializeShader(shader, "main", 0, NULL, NULL);
    glAttachShader(program, shader);
    glLinkProgram(program);
    glGetProgramiv(program, GL_LINK_STATUS, &ok);
    assert_true(ok);
    GLuint buffers[2];
    glCreateBuffers(2, buffers);
    glNamedBufferStorage(buffers[0], sizeof *given, given, 0);
    glNamedBufferStorage(buffers[1], (GLsizeiptr)size, NULL, GL_MAP_READ_BIT);
    glBindBuffersBase(GL_SHADER_STORAGE_BUFFER, 0, 2, buffers);
    glUseProgram(program);
    glDispatchCompute(1, 1, 1);
    glMemoryBarrier(GL_ALL_BARRIER_BITS);
    const void *mapped = glMapNamedBuffer(buffers[1], GL_READ_ONLY);
    assert_non_null(mapped);
    memcpy(values, mapped, size);
    gpu_context_destroy(&context);
    return true;
}

int main(int count, char **argument) {
    static inputs given;
    static float values[SURFACES * VALUES][4];
    fill(&given);
    if (count == 3 && strcmp(argument[1], "inputs") == 0)
        write_file(argument[2], &given, sizeof given);
    else if (count == 3 && strcmp(argument[1], "check") == 0) {
        read_file(argument[2], values, sizeof values);
        check(&given, (const float(*)[4])values);
    } else if (count == 3 && strcmp(argument[1], "run") == 0) {
        if (run(argument[2], &given, values, sizeof values))
            check(&given, (const float(*)[4])values);
        else
            puts("skipped: the OpenGL device takes no SPIR-V");
    } else
        return 2;
    return 0;
}
