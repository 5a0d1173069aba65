/* SPDX-License-Identifier: MIT */
#include "app/render/gl/texels.h"
#include "shaders/program/shared.h"

void gpu_texels_create(gpu_texels *own, size_t size, const void *bytes) {
    gpu_texels_free(own);
    glCreateBuffers(1, &own->buffer);
    glNamedBufferStorage(own->buffer, (GLsizeiptr)size, bytes, 0);
    glCreateTextures(GL_TEXTURE_BUFFER, 1, &own->texture);
    glTextureBuffer(own->texture, GL_RGBA32F, own->buffer);
}

void gpu_texels_bind(const gpu_texels *own, GLuint number) {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, number, own->buffer);
    glBindTextureUnit(SHARED_TEXELS + number, own->texture);
}

void gpu_texels_free(gpu_texels *own) {
    glDeleteTextures(1, &own->texture);
    glDeleteBuffers(1, &own->buffer);
    *own = (gpu_texels) { 0 };
}

const char *gpu_texels_define(const gpu_context *context) {
    return context->software ? "#define TEXELS_FETCHED\n" : "";
}
