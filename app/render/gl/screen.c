/* SPDX-License-Identifier: MIT */
/* What a window shows: images of renderers, and drawings over them. */
#include "app/render/gl/program.h"
#include "app/render/gl/state.h"

#include <stdint.h>
#include <stdlib.h>

typedef struct screen_side {
    GLuint texture, framebuffer;
    int width, height;
} screen_side;

typedef struct screen_drawing {
    GLuint texture;
    int width, height;
} screen_drawing;

struct gpu_screen {
    GLuint compose, draw, empty_array;
    screen_side sides[2], copy; /* copy: for reading back */
    screen_drawing drawings[GPU_DRAWINGS_MAX];
};

gpu_screen *gpu_screen_create(base_error *error) {
    const gpu_stage compose[] = { { GL_VERTEX_SHADER, "screen.vert" },
                                  { GL_FRAGMENT_SHADER, "compose.frag" } };
    const gpu_stage draw[] = { { GL_VERTEX_SHADER, "screen.vert" },
                               { GL_FRAGMENT_SHADER, "drawing.frag" } };
    gpu_screen *s = calloc(1, sizeof *s);
    if (!s) {
        base_fail(error, NULL, "out of memory");
        return NULL;
    }
    glCreateVertexArrays(1, &s->empty_array);
    if (!(s->compose = gpu_program(compose, 2, "", error)) ||
        !(s->draw = gpu_program(draw, 2, "", error))) {
        gpu_screen_destroy(s);
        return NULL;
    }
    return s;
}

static void delete_side(screen_side *side) {
    glDeleteTextures(1, &side->texture);
    glDeleteFramebuffers(1, &side->framebuffer);
    *side = (screen_side) { .width = 0 };
}

void gpu_screen_destroy(gpu_screen *s) {
    if (!s)
        return;
    delete_side(&s->sides[0]);
    delete_side(&s->sides[1]);
    delete_side(&s->copy);
    for (int i = 0; i < GPU_DRAWINGS_MAX; i++)
        glDeleteTextures(1, &s->drawings[i].texture);
    if (s->compose)
        glDeleteProgram(s->compose);
    if (s->draw)
        glDeleteProgram(s->draw);
    glDeleteVertexArrays(1, &s->empty_array);
    free(s);
}

static void size_side(screen_side *side, int width, int height) {
    if (side->width == width && side->height == height)
        return;
    delete_side(side);
    glCreateTextures(GL_TEXTURE_2D, 1, &side->texture);
    glTextureStorage2D(side->texture, 1, GL_RGBA8, width, height);
    glTextureParameteri(side->texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(side->texture, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(side->texture, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glCreateFramebuffers(1, &side->framebuffer);
    glNamedFramebufferTexture(side->framebuffer, GL_COLOR_ATTACHMENT0, side->texture, 0);
    side->width = width;
    side->height = height;
}

void gpu_screen_take(gpu_screen *s, gpu_renderer *renderer, int side,
                     const image_display *display) {
    size_side(&s->sides[side], renderer->targets.width, renderer->targets.height);
    gpu_present(renderer, s->sides[side].framebuffer, display, true);
}

void gpu_screen_put(gpu_screen *s, int side, int width, int height, const unsigned char *rgb8) {
    size_side(&s->sides[side], width, height);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage2D(s->sides[side].texture, 0, 0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE,
                        rgb8);
}

static void compose(gpu_screen *s, const gpu_layout *layout, GLuint framebuffer, bool flip) {
    const bool two = layout->split != GPU_SPLIT_NONE && s->sides[1].texture;
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, layout->width, layout->height);
    glBindVertexArray(s->empty_array);
    for (GLuint i = 0; i < 2; i++)
        glBindTextureUnit(i, s->sides[two ? i : 0].texture);
    glUseProgram(s->compose);
    glUniform2f(0, (float)layout->width, (float)layout->height);
    glUniform1i(1, flip);
    glUniform1i(2, two ? (GLint)layout->split : GPU_SPLIT_NONE);
    glUniform2f(3, layout->divider * (float)layout->width, layout->line);
    glUniform1f(4, GPU_DIFFERENCE_GAIN);
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

void gpu_screen_show(gpu_screen *s, const gpu_layout *layout) {
    const screen_side *side = &s->sides[0];
    if (layout->split == GPU_SPLIT_NONE && side->texture) { /* a blit is cheaper than a shader */
        glBlitNamedFramebuffer(side->framebuffer, 0, 0, 0, side->width, side->height, 0,
                               layout->height, layout->width, 0, GL_COLOR_BUFFER_BIT, GL_LINEAR);
        return;
    }
    compose(s, layout, 0, true);
}

bool gpu_screen_read(gpu_screen *s, const gpu_layout *layout, unsigned char *rgb8,
                     base_error *error) {
    const size_t size = 3 * (size_t)layout->width * (size_t)layout->height;
    if (size > INT32_MAX)
        return base_fail(error, NULL, "an image of %d x %d is too large to read back",
                         layout->width, layout->height);
    size_side(&s->copy, layout->width, layout->height);
    compose(s, layout, s->copy.framebuffer, false);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(s->copy.texture, 0, GL_RGB, GL_UNSIGNED_BYTE, (GLsizei)size, rgb8);
    return true;
}

void gpu_screen_upload(gpu_screen *s, int index, int width, int height, const void *pixels) {
    screen_drawing *drawing = &s->drawings[index];
    if (drawing->width != width || drawing->height != height) {
        glDeleteTextures(1, &drawing->texture);
        glCreateTextures(GL_TEXTURE_2D, 1, &drawing->texture);
        glTextureStorage2D(drawing->texture, 1, GL_RGBA8, width, height);
        drawing->width = width;
        drawing->height = height;
    }
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTextureSubImage2D(drawing->texture, 0, 0, 0, width, height, GL_BGRA,
                        GL_UNSIGNED_INT_8_8_8_8_REV, pixels);
}

void gpu_screen_draw(gpu_screen *s, const gpu_layout *layout, int index, int x, int y) {
    const screen_drawing *drawing = &s->drawings[index];
    if (!drawing->texture)
        return;
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    glViewport(0, 0, layout->width, layout->height);
    glEnable(GL_SCISSOR_TEST);
    glScissor(x, layout->height - y - drawing->height, drawing->width, drawing->height);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glBindVertexArray(s->empty_array);
    glBindTextureUnit(0, drawing->texture);
    glUseProgram(s->draw);
    glUniform3i(0, x, y, layout->height);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisable(GL_BLEND);
    glDisable(GL_SCISSOR_TEST);
}
