/* SPDX-License-Identifier: MIT */
#include "app/render/gl/passes.h"

#include <stdlib.h>

/* Pixels of one strip, whose buffer stays far below the 128 MiB that every device offers. */
enum { STRIP_PIXELS = 1 << 18 };

static lmp_vec3 as_vec3(const vec4 v) {
    return (lmp_vec3) { v[0], v[1], v[2] };
}

static lmp_rgb as_rgb(const vec4 v) {
    return (lmp_rgb) { v[0], v[1], v[2] };
}

static void unpack(const gpu_renderer *r, const shared_pixel *from, size_t count,
                   render_pixel *to) {
    for (size_t i = 0; i < count; i++) {
        const int kind = (int)from[i].position_kind[3];
        to[i] = (render_pixel) {
            .kind = kind < SHARED_KIND_SURFACE ? (render_kind)kind : RENDER_SURFACE,
            .surface = { .position = as_vec3(from[i].position_kind),
                         .normal = as_vec3(from[i].normal_metallic),
                         .view = as_vec3(from[i].view_roughness),
                         .coat_normal = as_vec3(from[i].coat) },
            .emission = as_rgb(from[i].emission),
            .ambient = from[i].weights[0],
        };
        if (kind < SHARED_KIND_SURFACE)
            continue;
        const size_t number = (size_t)(kind - SHARED_KIND_SURFACE);
        render_material_fill(&r->materials, number, from[i].weights[1], as_rgb(from[i].tint),
                             &to[i].material);
        if (render_material_is_layered(&r->materials, number))
            render_material_cover(&r->materials, (lmp_coat) { from[i].coat[3], from[i].tint[3] },
                                  as_rgb(from[i].sheen), from[i].sheen[3], &to[i].material);
        to[i].material.base_color = as_rgb(from[i].base_color);
        to[i].material.metallic = from[i].normal_metallic[3];
        to[i].material.roughness = from[i].view_roughness[3];
    }
}

static bool read_strips(gpu_renderer *r, GLuint buffer, int rows, render_pixel *pixels) {
    const size_t width = (size_t)r->targets.width;
    glUseProgram(r->surfaces);
    for (int first = 0; first < r->targets.height; first += rows) {
        const int count = first + rows <= r->targets.height ? rows : r->targets.height - first;
        const size_t strip = (size_t)count * width;
        gpu_bind_gbuffer(r);
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffer);
        glUniform1i(0, first);
        glDispatchCompute((GLuint)(r->targets.width + SHARED_GROUP - 1) / SHARED_GROUP,
                          (GLuint)(count + SHARED_GROUP - 1) / SHARED_GROUP, 1);
        glMemoryBarrier(GL_ALL_BARRIER_BITS);
        const GLsizeiptr size = (GLsizeiptr)(strip * sizeof(shared_pixel));
        const shared_pixel *mapped = glMapNamedBufferRange(buffer, 0, size, GL_MAP_READ_BIT);
        if (!mapped)
            return false;
        unpack(r, mapped, strip, pixels + (size_t)first * width);
        glUnmapNamedBuffer(buffer);
    }
    return true;
}

bool gpu_read_pixels(gpu_renderer *r, render_pixel **pixels, base_error *error) {
    /* a multiple of the group's rows: a strip's last group must not write past the buffer */
    int rows = STRIP_PIXELS / r->targets.width / SHARED_GROUP * SHARED_GROUP;
    rows = rows < SHARED_GROUP ? SHARED_GROUP : rows;
    *pixels = malloc((size_t)r->targets.width * (size_t)r->targets.height * sizeof **pixels);
    if (!*pixels)
        return base_fail(error, NULL, "out of memory for an image of %d x %d", r->targets.width,
                         r->targets.height);
    GLuint buffer = 0;
    glCreateBuffers(1, &buffer);
    glNamedBufferStorage(
        buffer, (GLsizeiptr)((size_t)rows * (size_t)r->targets.width * sizeof(shared_pixel)), NULL,
        GL_MAP_READ_BIT);
    const bool ok = read_strips(r, buffer, rows, *pixels);
    glDeleteBuffers(1, &buffer);
    if (!ok) {
        free(*pixels);
        *pixels = NULL;
        return base_fail(error, NULL, "%s does not give its pixels back", r->context.device);
    }
    return true;
}
