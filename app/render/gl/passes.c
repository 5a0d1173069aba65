/* SPDX-License-Identifier: MIT */
/* The passes of a sample: the G-buffer, shading, the mean of the samples so far. */
#include "app/render/gl/internal.h"

#include <string.h>

/* Copies the G-buffer to what is kept, or back. */
static void copy_geometry(const gpu_renderer *r, bool back) {
    for (int i = 0; i <= GPU_ATTACHMENTS; i++) {
        const GLuint own = i < GPU_ATTACHMENTS ? r->attachments[i] : r->depth;
        if (!own)
            continue;
        glCopyImageSubData(back ? r->kept[i] : own, GL_TEXTURE_2D, 0, 0, 0, 0,
                           back ? own : r->kept[i], GL_TEXTURE_2D, 0, 0, 0, 0, r->width, r->height,
                           1);
    }
}

static void draw_geometry(gpu_renderer *r, const render_frame *frame, const shared_frame *block) {
    static const GLfloat zero[4] = { 0 };
    /* what is farther than the far plane fails against its depth */
    const GLfloat far_depth[4] = { gpu_depth_of(block, block->background[3]) };
    if (frame->keep_geometry && r->kept[0] &&
        memcmp(r->kept_view, block->clip_from_world, sizeof r->kept_view) == 0) {
        copy_geometry(r, true);
        return;
    }
    for (int i = 0; i < GPU_ATTACHMENTS_PLAIN; i++)
        glClearNamedFramebufferfv(r->framebuffer, GL_COLOR, i, zero);
    glClearNamedFramebufferfv(r->framebuffer, GL_DEPTH, 0, far_depth);
    gpu_mesh_draw(&r->mesh, block->clip_from_world, &r->surface);
    if (!frame->keep_geometry)
        return;
    for (int i = GPU_ATTACHMENTS; i >= 0 && !r->kept[0]; i--)
        if (i == GPU_ATTACHMENTS || r->attachments[i])
            r->kept[i] = gpu_target_create(gpu_target_formats[i], r->width, r->height);
    memcpy(r->kept_view, block->clip_from_world, sizeof r->kept_view);
    copy_geometry(r, false);
}

void gpu_draw_gbuffer(gpu_renderer *r, const render_frame *frame, const shared_frame *block) {
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, r->framebuffer);
    glViewport(0, 0, r->width, r->height);
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glFrontFace(GL_CW); /* y runs down */
    glCullFace(GL_BACK);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glDepthMask(GL_TRUE);
    glBindBufferBase(GL_UNIFORM_BUFFER, SHARED_FRAME, r->frame_block);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, SHARED_LIGHTS, r->lights_block);
    draw_geometry(r, frame, block);
    if (frame->light_count) {
        glBindVertexArray(r->empty_array);
        glUseProgram(r->light);
        glEnable(GL_CULL_FACE);
        glCullFace(GL_FRONT);
        glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 14, (GLsizei)frame->light_count);
    }
    glDisable(GL_CULL_FACE);
    glDisable(GL_DEPTH_TEST);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
}

void gpu_bind_gbuffer(const gpu_renderer *r) {
    static const GLuint units[GPU_ATTACHMENTS] = {
        SHARED_BASE_COLOR, SHARED_NORMAL, SHARED_METALLIC_ROUGHNESS,
        SHARED_EMISSION,   SHARED_LAYERS, SHARED_COAT,
        SHARED_TINT,       SHARED_SHEEN
    };
    for (int i = 0; i < gpu_attachment_count(r); i++)
        glBindTextureUnit(units[i], r->attachments[i]);
    glBindTextureUnit(SHARED_DEPTH, r->depth);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, SHARED_GGX, r->ggx_block);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, SHARED_REFLECTORS, r->mesh.reflectors);
    glBindBufferBase(GL_UNIFORM_BUFFER, SHARED_FRAME, r->frame_block);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, SHARED_LIGHTS, r->lights_block);
}

static GLuint groups(int pixels) {
    return (GLuint)(pixels + SHARED_GROUP - 1) / SHARED_GROUP;
}

/* One thread a pixel. */
static void dispatch(const gpu_renderer *r) {
    glDispatchCompute(groups(r->width), groups(r->height), 1);
    glMemoryBarrier(GL_ALL_BARRIER_BITS);
}

/* Their tables take the place of those of materials for so long. */
static void draw_fibers(const gpu_renderer *r) {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, SHARED_TABLES, r->fibers_buffer);
    glBindImageTexture(0, r->hdr, 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA32F);
    glUseProgram(r->fibers_program);
    dispatch(r);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, SHARED_TABLES, r->tables_buffer);
}

void gpu_shade(gpu_renderer *r, const render_frame *frame, GLuint program) {
    gpu_bind_gbuffer(r);
    const bool fibers = gpu_shades_fibers(r, frame);
    if (fibers)
        draw_fibers(r);
    glUseProgram(program);
    if (method_table[frame->method].fragment) {
        glNamedFramebufferTexture(r->ldr_framebuffer, GL_COLOR_ATTACHMENT0, r->hdr, 0);
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, r->ldr_framebuffer);
        glViewport(0, 0, r->width, r->height);
        glBindVertexArray(r->empty_array);
        glDrawArrays(GL_TRIANGLES, 0, 3);
        glNamedFramebufferTexture(r->ldr_framebuffer, GL_COLOR_ATTACHMENT0, r->ldr, 0);
        return;
    }
    glBindImageTexture(0, r->hdr, 0, GL_FALSE, 0, fibers ? GL_READ_WRITE : GL_WRITE_ONLY,
                       GL_RGBA32F);
    dispatch(r);
}

/* Adds the HDR target to the sums; the last sample leaves the mean there, with `show` every one. */
void gpu_resolve(gpu_renderer *r, const render_frame *frame, int index, bool show) {
    if (!r->sums)
        r->sums = gpu_target_create(GL_RGBA32F, r->width, r->height);
    glBindImageTexture(0, r->hdr, 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA32F);
    glBindImageTexture(1, r->sums, 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA32F);
    glUseProgram(r->resolve);
    glUniform1f(0, frame->samples_exposure);
    glUniform1i(1, index == 0);
    const bool last = index == frame->samples - 1;
    glUniform1i(2, !last);
    glUniform1i(3, last || show);
    dispatch(r);
}
