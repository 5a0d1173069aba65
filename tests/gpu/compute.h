/* SPDX-License-Identifier: MIT */
/* compute.h - a compute shader made of embedded files, as an engine makes it, and its buffers. */
#ifndef LAMPION_TESTS_GPU_COMPUTE_H
#define LAMPION_TESTS_GPU_COMPUTE_H

#include "tests/gpu/device.h"

#include <epoxy/gl.h>
#include <string.h>

static inline const char *embedded_source(const char *name) {
    for (const embedded_file *file = gpu_sources; file->name; file++)
        if (strcmp(file->name, name) == 0)
            return file->text;
    fail_msg("%s is not embedded", name);
    return NULL;
}

/* Compiles `head`, the files, whose list ends with NULL, and `main`. */
static inline GLuint build_compute(const char *head, const char *const files[], const char *main) {
    enum { TEXTS = 8 };
    const char *text[TEXTS] = { head };
    int count = 1;
    for (; *files; files++) {
        assert_true(count < TEXTS - 1);
        text[count++] = embedded_source(*files);
    }
    text[count++] = main;
    const GLuint program = glCreateProgram(), shader = glCreateShader(GL_COMPUTE_SHADER);
    GLint ok = 0;
    char log[512] = "";
    glShaderSource(shader, count, text, NULL);
    glCompileShader(shader);
    glAttachShader(program, shader);
    glDeleteShader(shader);
    glLinkProgram(program);
    glGetProgramiv(program, GL_LINK_STATUS, &ok);
    glGetProgramInfoLog(program, sizeof log, NULL, log);
    if (!ok)
        fail_msg("%s", log);
    return program;
}

/* Runs `groups` groups on an input in storage block 0 and returns the values of block 1, to be
 * freed by the caller. */
static inline float *run_compute(GLuint program, const void *input, size_t input_size,
                                 size_t output_size, int groups) {
    GLuint buffers[2];
    float *values = malloc(output_size);
    assert_non_null(values);
    glCreateBuffers(2, buffers);
    glNamedBufferStorage(buffers[0], (GLsizeiptr)input_size, input, 0);
    glNamedBufferStorage(buffers[1], (GLsizeiptr)output_size, NULL, GL_MAP_READ_BIT);
    glBindBuffersBase(GL_SHADER_STORAGE_BUFFER, 0, 2, buffers);
    glUseProgram(program);
    glDispatchCompute((GLuint)groups, 1, 1);
    glMemoryBarrier(GL_ALL_BARRIER_BITS);
    glGetNamedBufferSubData(buffers[1], 0, (GLsizeiptr)output_size, values);
    glDeleteBuffers(2, buffers);
    return values;
}

#endif
