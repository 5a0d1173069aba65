/* SPDX-License-Identifier: MIT */
/* The textures that a frame is drawn to. */
#include "app/render/gl/targets.h"

#include <string.h>

GLuint gpu_target_create(GLenum format, int width, int height) {
    GLuint texture = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    glTextureStorage2D(texture, 1, format, width, height);
    glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return texture;
}

const GLenum gpu_target_formats[GPU_ATTACHMENTS + 1] = {
    GL_RGBA16, GL_RG16,  GL_RG16,  GL_RGBA32F,           GL_RG8,
    GL_RGBA16, GL_RGBA8, GL_RGBA8, GL_DEPTH_COMPONENT32F
};

/* Frees the copy of the G-buffer that keep_geometry has left. */
static void forget_geometry(gpu_targets *t) {
    glDeleteTextures(GPU_ATTACHMENTS + 1, t->kept);
    memset(t->kept, 0, sizeof t->kept);
}

void gpu_targets_delete(gpu_targets *t) {
    glDeleteTextures(GPU_ATTACHMENTS, t->attachments);
    glDeleteTextures(1, &t->depth);
    forget_geometry(t);
    glDeleteTextures(1, &t->hdr);
    glDeleteTextures(1, &t->sums);
    t->sums = 0;
    glDeleteTextures(1, &t->ldr);
    glDeleteFramebuffers(1, &t->framebuffer);
    glDeleteFramebuffers(1, &t->ldr_framebuffer);
    t->width = t->height = 0;
}

bool gpu_targets_create(gpu_targets *t, const gpu_context *context, bool layered, int width,
                        int height, base_error *error) {
    const int attachments = layered ? GPU_ATTACHMENTS : GPU_ATTACHMENTS_PLAIN;
    GLenum buffers[GPU_ATTACHMENTS];
    if (t->width == width && t->height == height)
        return true;
    if (width < 1 || height < 1 || width > context->size_max || height > context->size_max)
        return base_fail(error, NULL, "an image of %d x %d is beyond %s, which takes %d a side",
                         width, height, context->device, context->size_max);
    gpu_targets_delete(t);
    glCreateFramebuffers(1, &t->framebuffer);
    for (int i = 0; i < attachments; i++) {
        buffers[i] = GL_COLOR_ATTACHMENT0 + (GLenum)i;
        t->attachments[i] = gpu_target_create(gpu_target_formats[i], width, height);
        glNamedFramebufferTexture(t->framebuffer, buffers[i], t->attachments[i], 0);
    }
    glNamedFramebufferDrawBuffers(t->framebuffer, attachments, buffers);
    t->depth = gpu_target_create(gpu_target_formats[GPU_ATTACHMENTS], width, height);
    glNamedFramebufferTexture(t->framebuffer, GL_DEPTH_ATTACHMENT, t->depth, 0);
    t->hdr = gpu_target_create(GL_RGBA32F, width, height);
    t->ldr = gpu_target_create(GL_RGBA8, width, height);
    glCreateFramebuffers(1, &t->ldr_framebuffer);
    glNamedFramebufferTexture(t->ldr_framebuffer, GL_COLOR_ATTACHMENT0, t->ldr, 0);
    const GLenum status = glCheckNamedFramebufferStatus(t->framebuffer, GL_DRAW_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE || glGetError() == GL_OUT_OF_MEMORY) {
        gpu_targets_delete(t);
        return base_fail(error, NULL, "%s cannot hold an image of %d x %d", context->device, width,
                         height);
    }
    t->count = attachments;
    t->width = width;
    t->height = height;
    return true;
}
