/* SPDX-License-Identifier: MIT */
#include "app/render/gl/program.h"
#include "app/render/gl/gpu.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { INCLUDES_MAX = 32 };

/* A source with its #include lines resolved, every file once. */
typedef struct unit {
    char *text;
    size_t length, capacity;
    const char *included[INCLUDES_MAX];
    int included_count;
} unit;

static bool append(unit *u, const char *text, size_t length) {
    if (u->length + length + 1 > u->capacity) {
        const size_t capacity = 2 * (u->length + length + 1);
        char *grown = realloc(u->text, capacity);
        if (!grown)
            return false;
        u->text = grown;
        u->capacity = capacity;
    }
    memcpy(u->text + u->length, text, length);
    u->length += length;
    u->text[u->length] = '\0';
    return true;
}

static const char *find_source(const char *name, size_t length) {
    for (const embedded_file *file = gpu_sources; file->name; file++)
        if (strlen(file->name) == length && memcmp(file->name, name, length) == 0)
            return file->text;
    return NULL;
}

static bool append_file(unit *u, const char *name, size_t name_length) {
    const char *text = find_source(name, name_length);
    for (int i = 0; i < u->included_count; i++)
        if (u->included[i] == text)
            return true;
    if (!text || u->included_count == INCLUDES_MAX)
        return false;
    u->included[u->included_count++] = text;

    static const char directive[] = "#include \"";
    while (*text) {
        const size_t length = strcspn(text, "\n") + (strchr(text, '\n') ? 1 : 0);
        if (strncmp(text, directive, sizeof directive - 1) == 0) {
            const char *file = text + sizeof directive - 1;
            if (!append_file(u, file, strcspn(file, "\"")))
                return false;
        } else if (!append(u, text, length)) {
            return false;
        }
        text += length;
    }
    return true;
}

static GLuint compile(const gpu_stage *stage, const char *defines, base_error *error) {
    static const char preamble[] = "#version 450 core\n#define LAMPION_SHADER\n";
    unit u = { 0 };
    GLuint shader = 0;
    if (append(&u, preamble, sizeof preamble - 1) && append(&u, defines, strlen(defines)) &&
        append_file(&u, stage->file, strlen(stage->file))) {
        const char *text = u.text;
        GLint ok = 0;
        shader = glCreateShader(stage->type);
        glShaderSource(shader, 1, &text, NULL);
        glCompileShader(shader);
        glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
        if (!ok) {
            char log[512];
            glGetShaderInfoLog(shader, sizeof log, NULL, log);
            base_fail(error, stage->file, "the OpenGL driver refuses this shader: %s", log);
            glDeleteShader(shader);
            shader = 0;
        }
    } else {
        base_fail(error, stage->file, "out of memory");
    }
    free(u.text);
    return shader;
}

GLuint gpu_program(const gpu_stage *stages, int count, const char *defines, base_error *error) {
    GLuint program = glCreateProgram();
    bool complete = true;
    for (int i = 0; i < count && complete; i++) {
        const GLuint shader = compile(&stages[i], defines, error);
        complete = shader != 0;
        if (complete) {
            glAttachShader(program, shader);
            glDeleteShader(shader);
        }
    }
    GLint ok = 0;
    if (complete) {
        glLinkProgram(program);
        glGetProgramiv(program, GL_LINK_STATUS, &ok);
        if (!ok) {
            char log[512];
            glGetProgramInfoLog(program, sizeof log, NULL, log);
            base_fail(error, stages[0].file, "the OpenGL driver does not link it: %s", log);
        }
    }
    if (!ok) {
        glDeleteProgram(program);
        return 0;
    }
    return program;
}
