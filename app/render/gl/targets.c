/* SPDX-License-Identifier: MIT */
/* The textures that a frame is drawn to. */
#include "app/render/gl/internal.h"

#include <string.h>

GLuint gpu_target_create(GLenum format, int width, int height) {
    GLuint texture = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    glTextureStorage2D(texture, 1, format, width, height);
    glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return texture;
}

/* Of the G-buffer's attachments, and of its depth. */
const GLenum gpu_target_formats[GPU_ATTACHMENTS + 1] = {
    GL_RGBA16, GL_RG16,  GL_RG16,  GL_RGBA32F,           GL_RG8,
    GL_RGBA16, GL_RGBA8, GL_RGBA8, GL_DEPTH_COMPONENT32F
};

int gpu_attachment_count(const gpu_renderer *r) {
    return r->mesh.layered ? GPU_ATTACHMENTS : GPU_ATTACHMENTS_PLAIN;
}

void gpu_forget_geometry(gpu_renderer *r) {
    glDeleteTextures(GPU_ATTACHMENTS + 1, r->kept);
    memset(r->kept, 0, sizeof r->kept);
}

void gpu_targets_delete(gpu_renderer *r) {
    glDeleteTextures(GPU_ATTACHMENTS, r->attachments);
    glDeleteTextures(1, &r->depth);
    gpu_forget_geometry(r);
    glDeleteTextures(1, &r->hdr);
    glDeleteTextures(1, &r->sums);
    r->sums = 0;
    glDeleteTextures(1, &r->ldr);
    glDeleteFramebuffers(1, &r->framebuffer);
    glDeleteFramebuffers(1, &r->ldr_framebuffer);
    gpu_gbuffer_free(&r->gbuffer);
    r->width = r->height = 0;
}

bool gpu_targets_create(gpu_renderer *r, int width, int height, cli_error *error) {
    const int attachments = gpu_attachment_count(r);
    GLenum buffers[GPU_ATTACHMENTS];
    if (r->width == width && r->height == height)
        return true;
    if (width < 1 || height < 1 || width > r->context.size_max || height > r->context.size_max)
        return cli_fail(error, NULL, "an image of %d x %d is beyond %s, which takes %d a side",
                        width, height, r->context.device, r->context.size_max);
    gpu_targets_delete(r);
    glCreateFramebuffers(1, &r->framebuffer);
    for (int i = 0; i < attachments; i++) {
        buffers[i] = GL_COLOR_ATTACHMENT0 + (GLenum)i;
        r->attachments[i] = gpu_target_create(gpu_target_formats[i], width, height);
        glNamedFramebufferTexture(r->framebuffer, buffers[i], r->attachments[i], 0);
    }
    glNamedFramebufferDrawBuffers(r->framebuffer, attachments, buffers);
    r->depth = gpu_target_create(gpu_target_formats[GPU_ATTACHMENTS], width, height);
    glNamedFramebufferTexture(r->framebuffer, GL_DEPTH_ATTACHMENT, r->depth, 0);
    r->hdr = gpu_target_create(GL_RGBA32F, width, height);
    r->ldr = gpu_target_create(GL_RGBA8, width, height);
    glCreateFramebuffers(1, &r->ldr_framebuffer);
    glNamedFramebufferTexture(r->ldr_framebuffer, GL_COLOR_ATTACHMENT0, r->ldr, 0);
    const GLenum status = glCheckNamedFramebufferStatus(r->framebuffer, GL_DRAW_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE || glGetError() == GL_OUT_OF_MEMORY) {
        gpu_targets_delete(r);
        return cli_fail(error, NULL, "%s cannot hold an image of %d x %d", r->context.device, width,
                        height);
    }
    r->width = width;
    r->height = height;
    return true;
}
