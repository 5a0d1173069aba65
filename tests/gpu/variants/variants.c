/* SPDX-License-Identifier: MIT */
/* The variants of the shaders in other languages against the library, in steps of the scripts:
 *   inputs FOLDER OF      writes what the shaders read, FOLDER/given and FOLDER/tables
 *   run SPIRV OF          runs the SPIR-V on the OpenGL device, and compares
 *   check FILE OF         compares what another has computed
 *   probes SPIRV          runs a file of tests/gpu/engines, and compares
 *   check_probes FILE     compares what another has computed by one
 * where OF is LOBES BANDS WINDOW AREAS: phong or ggx, a number of lmp_window, and the number of
 * areas. */
#include "app/render/gl/gpu.h"
#include "tests/gpu/variants/values.h"

#include <epoxy/gl.h>
#include <stdio.h>

static void write_file(const char *folder, const char *name, const void *data, size_t size) {
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "wb");
    assert_true(file && fwrite(data, 1, size, file) == size && fclose(file) == 0);
}

static void read_file(const char *path, void *data, size_t size) {
    FILE *file = fopen(path, "rb");
    if (!file || fread(data, 1, size, file) != size)
        fail_msg("%s: not %zu bytes", path, size);
    fclose(file);
}

/* Returns 0 if all values are right. */
static int check(const configuration *of, const given *data, const world *from, const tables *read,
                 const float *values) {
    comparison worst = { .what = "nothing" };
    for (int i = 0; i < SURFACES; i++) {
        const comparison found =
            compare_surface(of, data, from, read, i, values + (ptrdiff_t)i * count_values(of));
        if (!(found.worst <= worst.worst))
            worst = found;
    }
    printf("%d bands, window %d, %s, %d areas: %.1e (%s)\n", of->bands, (int)of->window,
           of->ggx ? "GGX" : "Phong", of->areas, worst.worst, worst.what);
    return worst.worst <= 1e-5 ? 0 : 1;
}

static int check_probes(const given *data, const world *from, const float *values) {
    double worst = 0;
    for (int i = 0; i < SURFACES; i++) {
        const comparison found = compare_probes(data, from, i, values + 6 * (ptrdiff_t)i);
        if (!(found.worst <= worst))
            worst = found.worst;
    }
    printf("probes: %.1e\n", worst);
    return worst <= 1e-6 ? 0 : 1;
}

/* Runs the SPIR-V; returns false if the device does not accept it. */
static bool run(const char *path, const given *data, const tables *read, float *values,
                size_t size) {
    static unsigned char code[1 << 22];
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
    GLuint buffers[3];
    glCreateBuffers(3, buffers);
    glNamedBufferStorage(buffers[0], sizeof *data, data, 0);
    glNamedBufferStorage(buffers[1], (GLsizeiptr)size, NULL, GL_MAP_READ_BIT);
    glNamedBufferStorage(buffers[2], (GLsizeiptr)(read->count * sizeof *read->word), read->word, 0);
    glBindBuffersBase(GL_SHADER_STORAGE_BUFFER, 0, 3, buffers);
    glUseProgram(program);
    glDispatchCompute(1, 1, 1);
    glMemoryBarrier(GL_ALL_BARRIER_BITS);
    const void *mapped = glMapNamedBuffer(buffers[1], GL_READ_ONLY);
    assert_non_null(mapped);
    memcpy(values, mapped, size);
    gpu_context_destroy(&context);
    return true;
}

/* Takes the values from a file, or from what a device computes by SPIR-V; returns false if it takes
 * none. */
static bool take(bool runs, const char *path, const given *data, const tables *read, float *values,
                 size_t size) {
    if (!runs) {
        read_file(path, values, size);
        return true;
    }
    if (run(path, data, read, values, size))
        return true;
    puts("skipped: the OpenGL device takes no SPIR-V");
    return false;
}

int main(int count, char **argument) {
    static given data;
    static world from;
    if (count != 3 && count != 7)
        return 2;
    const char *step = argument[1], *path = argument[2];
    configuration of = { .bands = 3 };
    if (count == 7)
        of = (configuration) { .ggx = strcmp(argument[3], "ggx") == 0,
                               .bands = atoi(argument[4]),
                               .window = (lmp_window)atoi(argument[5]),
                               .areas = atoi(argument[6]) };
    const size_t size =
        (size_t)SURFACES * (size_t)(count == 7 ? count_values(&of) : 6) * sizeof(float);
    float *values = malloc(size);
    assert_non_null(values);
    fill_given(&data, &from);
    tables read = make_tables(&of);
    const bool runs = strcmp(step, "run") == 0 || strcmp(step, "probes") == 0;
    int status = 0;
    if (strcmp(step, "inputs") == 0) {
        write_file(path, "given", &data, sizeof data);
        write_file(path, "tables", read.word, read.count * sizeof *read.word);
    } else if (take(runs, path, &data, &read, values, size))
        status = count == 7 ? check(&of, &data, &from, &read, values)
                            : check_probes(&data, &from, values);
    free_tables(&read);
    free(values);
    return status;
}
