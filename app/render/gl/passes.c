/* SPDX-License-Identifier: MIT */
/* The passes of a sample: the G-buffer, shading, the mean of the samples so far. */
#include "app/render/gl/passes.h"
#include "app/render/gl/frame.h"

#include <string.h>

/* Copies the G-buffer to the kept one, or back. */
static void copy_geometry(const gpu_renderer *r, bool back) {
    for (int i = 0; i <= GPU_ATTACHMENTS; i++) {
        const GLuint own = i < GPU_ATTACHMENTS ? r->targets.attachments[i] : r->targets.depth;
        if (!own)
            continue;
        glCopyImageSubData(back ? r->targets.kept[i] : own, GL_TEXTURE_2D, 0, 0, 0, 0,
                           back ? own : r->targets.kept[i], GL_TEXTURE_2D, 0, 0, 0, 0,
                           r->targets.width, r->targets.height, 1);
    }
}

static void draw_geometry(gpu_renderer *r, const render_frame *frame, const shared_frame *block) {
    static const GLfloat zero[4] = { 0 };
    /* surfaces beyond the far plane fail the test against its depth */
    const GLfloat far_depth[4] = { gpu_depth_of(block, block->background[3]) };
    if (frame->keep_geometry && r->targets.kept[0] &&
        memcmp(r->targets.kept_view, block->clip_from_world, sizeof r->targets.kept_view) == 0) {
        copy_geometry(r, true);
        return;
    }
    for (int i = 0; i < GPU_ATTACHMENTS_PLAIN; i++)
        glClearNamedFramebufferfv(r->targets.framebuffer, GL_COLOR, i, zero);
    glClearNamedFramebufferfv(r->targets.framebuffer, GL_DEPTH, 0, far_depth);
    gpu_mesh_draw(&r->mesh, block->clip_from_world, &r->surface);
    if (!frame->keep_geometry)
        return;
    for (int i = GPU_ATTACHMENTS; i >= 0 && !r->targets.kept[0]; i--)
        if (i == GPU_ATTACHMENTS || r->targets.attachments[i])
            r->targets.kept[i] =
                gpu_target_create(gpu_target_formats[i], r->targets.width, r->targets.height);
    memcpy(r->targets.kept_view, block->clip_from_world, sizeof r->targets.kept_view);
    copy_geometry(r, false);
}

void gpu_draw_gbuffer(gpu_renderer *r, const render_frame *frame, const shared_frame *block) {
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, r->targets.framebuffer);
    glViewport(0, 0, r->targets.width, r->targets.height);
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glFrontFace(GL_CW); /* y runs downward, which swaps the winding */
    glCullFace(GL_BACK);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glDepthMask(GL_TRUE);
    glBindBufferBase(GL_UNIFORM_BUFFER, SHARED_FRAME, r->frame_block);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, SHARED_LIGHTS, r->lights.block);
    draw_geometry(r, frame, block);
    glBindVertexArray(r->empty_array);
    glEnable(GL_CULL_FACE);
    glCullFace(GL_FRONT);
    if (frame->light_count) {
        glUseProgram(r->light);
        glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 14, (GLsizei)frame->light_count);
    }
    if (r->lights.area_count) {
        gpu_texels_bind(&r->lights.areas, SHARED_AREAS);
        glUseProgram(r->areas);
        glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 14, (GLsizei)r->lights.area_count);
    }
    glDisable(GL_CULL_FACE);
    glDisable(GL_DEPTH_TEST);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
}

void gpu_bind_gbuffer(const gpu_renderer *r) {
    static const GLuint units[GPU_ATTACHMENTS] = {
        SHARED_BASE_COLOR, SHARED_NORMAL,  SHARED_METALLIC_ROUGHNESS,
        SHARED_EMISSION,   SHARED_WEIGHTS, SHARED_COAT,
        SHARED_TINT,       SHARED_SHEEN
    };
    for (int i = 0; i < r->targets.count; i++)
        glBindTextureUnit(units[i], r->targets.attachments[i]);
    glBindTextureUnit(SHARED_DEPTH, r->targets.depth);
    gpu_texels_bind(&r->ggx, SHARED_GGX);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, SHARED_MATERIAL_CONSTANTS,
                     r->mesh.material_constants);
    glBindBufferBase(GL_UNIFORM_BUFFER, SHARED_FRAME, r->frame_block);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, SHARED_LIGHTS, r->lights.block);
    if (r->lights.area_count)
        gpu_texels_bind(&r->lights.areas, SHARED_AREAS);
}

static GLuint groups(int pixels) {
    return (GLuint)(pixels + SHARED_GROUP - 1) / SHARED_GROUP;
}

/* Runs one thread per pixel. */
static void dispatch(const gpu_renderer *r) {
    glDispatchCompute(groups(r->targets.width), groups(r->targets.height), 1);
    glMemoryBarrier(GL_ALL_BARRIER_BITS);
}

/* Draws sheen, whose tables are bound in place of the materials' meanwhile. */
static void draw_sheen(const gpu_renderer *r) {
    gpu_texels_bind(&r->sheen.tables, SHARED_TABLES);
    glBindImageTexture(0, r->targets.hdr, 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA32F);
    glUseProgram(r->sheen.program);
    dispatch(r);
    gpu_texels_bind(&r->tables.values, SHARED_TABLES);
}

void gpu_shade(gpu_renderer *r, const render_frame *frame, GLuint program) {
    gpu_bind_gbuffer(r);
    const bool sheen = gpu_sheen_shade(&r->materials, frame);
    if (sheen)
        draw_sheen(r);
    glUseProgram(program);
    if (method_table[frame->method].fragment) {
        glNamedFramebufferTexture(r->targets.ldr_framebuffer, GL_COLOR_ATTACHMENT0, r->targets.hdr,
                                  0);
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, r->targets.ldr_framebuffer);
        glViewport(0, 0, r->targets.width, r->targets.height);
        glBindVertexArray(r->empty_array);
        glDrawArrays(GL_TRIANGLES, 0, 3);
        glNamedFramebufferTexture(r->targets.ldr_framebuffer, GL_COLOR_ATTACHMENT0, r->targets.ldr,
                                  0);
        return;
    }
    glBindImageTexture(0, r->targets.hdr, 0, GL_FALSE, 0, sheen ? GL_READ_WRITE : GL_WRITE_ONLY,
                       GL_RGBA32F);
    dispatch(r);
}

void gpu_resolve(gpu_renderer *r, const render_frame *frame, int index, bool show) {
    if (!r->targets.sums)
        r->targets.sums = gpu_target_create(GL_RGBA32F, r->targets.width, r->targets.height);
    glBindImageTexture(0, r->targets.hdr, 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA32F);
    glBindImageTexture(1, r->targets.sums, 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA32F);
    glUseProgram(r->resolve);
    glUniform1f(0, frame->samples_exposure);
    glUniform1i(1, index == 0);
    const bool last = index == frame->samples - 1;
    glUniform1i(2, !last);
    glUniform1i(3, last || show);
    dispatch(r);
}
