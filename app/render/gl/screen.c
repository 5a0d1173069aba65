/* SPDX-License-Identifier: MIT */
/* What a window shows: images of renderers. */
#include "app/render/gl/program.h"
#include "app/render/gl/state.h"

#include <stdint.h>
#include <stdlib.h>

typedef struct screen_side {
    GLuint texture, framebuffer;
    int width, height;
} screen_side;

struct gpu_screen {
    GLuint compose, empty_array;
    screen_side sides[2], copy; /* copy: for reading back */
};

gpu_screen *gpu_screen_create(base_error *error) {
    const gpu_stage compose[] = { { GL_VERTEX_SHADER, "screen.vert" },
                                  { GL_FRAGMENT_SHADER, "compose.frag" } };
    gpu_screen *s = calloc(1, sizeof *s);
    if (!s) {
        base_fail(error, NULL, "out of memory");
        return NULL;
    }
    glCreateVertexArrays(1, &s->empty_array);
    if (!(s->compose = gpu_program(compose, 2, "", error))) {
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
    if (s->compose)
        glDeleteProgram(s->compose);
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

/* Darkens the columns that are not seen; what is drawn next leaves them alone. Cleared, they cost
 * less than a rectangle that is drawn over the image. */
static void cut_off(const gpu_layout *layout) {
    static const float dark[4] = { 0.06f, 0.06f, 0.06f, 1 };
    enum { FAR = 1 << 20 };
    if (layout->seen == 0)
        return;
    glEnable(GL_SCISSOR_TEST);
    glScissor(layout->seen, 0, FAR, FAR);
    glClearNamedFramebufferfv(0, GL_COLOR, 0, dark);
    glScissor(0, 0, layout->seen, FAR);
}

void gpu_screen_show(gpu_screen *s, const gpu_layout *layout) {
    const screen_side *side = &s->sides[0];
    cut_off(layout);
    if (layout->split == GPU_SPLIT_NONE && side->texture) { /* a blit is cheaper than a shader */
        glBlitNamedFramebuffer(side->framebuffer, 0, 0, 0, side->width, side->height, 0,
                               layout->height, layout->width, 0, GL_COLOR_BUFFER_BIT, GL_LINEAR);
    } else {
        compose(s, layout, 0, true);
    }
    glDisable(GL_SCISSOR_TEST);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    /* the program in use may be deleted: to use it again, as what saves and restores the state
     * does, is an error */
    glUseProgram(0);
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
