/* SPDX-License-Identifier: MIT */
/* A preintegrated lobe for shaders/lampion/preintegrated_lobe.glsl: its cells side by side in one
 * texture. */
#include "app/render/gl/preintegrated_lobe.h"
#include "app/render/gl/shelves.h"

#include "shaders/lampion/preintegrated_lookup.h"
#include "shaders/program/shared.h"

#include <string.h>

enum { ATLAS_WIDTH = 2048 };

static_assert(SHARED_PREINTEGRATED_LOBE_REMAP == LMP_LOOKUP_REMAP_COUNT,
              "the block holds the remap");

/* Finds the position of each cell's first pair; returns the height. */
static GLsizei lay_out(const lmp_preintegrated_lobe_info *info, gpu_corner *corners) {
    gpu_shelves shelves = { .width = ATLAS_WIDTH };
    for (uint32_t i = 0; i < info->cell_count; i++)
        corners[i] =
            gpu_shelves_put(&shelves, (int)info->cells[i].columns, (int)info->cells[i].rows);
    return shelves.bottom;
}

static void upload_cells(const lmp_preintegrated_lobe_info *info, const gpu_corner *corners,
                         GLsizei height, GLuint *texture) {
    glDeleteTextures(1, texture);
    glCreateTextures(GL_TEXTURE_2D, 1, texture);
    glTextureStorage2D(*texture, 1, GL_RG16_SNORM, ATLAS_WIDTH, height);
    glTextureParameteri(*texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(*texture, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    for (uint32_t i = 0; i < info->cell_count; i++)
        glTextureSubImage2D(*texture, 0, corners[i].x, corners[i].y,
                            (GLsizei)info->cells[i].columns, (GLsizei)info->cells[i].rows, GL_RG,
                            GL_SHORT, info->coefficients + 2 * (size_t)info->cells[i].first);
}

static void upload_block(const lmp_preintegrated_lobe_info *info, const gpu_corner *corners,
                         GLsizei height, GLuint *buffer) {
    shared_preintegrated_lobe block = { .shape = { info->width2, (float)info->cell_count,
                                                   1.0f / ATLAS_WIDTH, 1 / (float)height } };
    for (uint32_t i = 0; i < info->cell_count; i++) {
        block.cells[i][0] = info->cells[i].scale;
        block.cells[i][1] = info->cells[i].offset;
        block.cells[i][2] = (float)corners[i].x;
        block.cells[i][3] = (float)corners[i].y;
    }
    memcpy(block.remap, info->remap, LMP_PREINTEGRATED_LOBE_REMAP_COUNT * sizeof(float));
    glDeleteBuffers(1, buffer);
    glCreateBuffers(1, buffer);
    glNamedBufferStorage(*buffer, sizeof block, &block, 0);
}

bool gpu_preintegrated_lobe_bind(gpu_preintegrated_lobe *own, const lmp_preintegrated_lobe *lobe,
                                 base_error *error) {
    const lmp_preintegrated_lobe_info info = lmp_preintegrated_lobe_describe(lobe);
    if (own->lobe != lobe || own->bands != info.bands || own->window != info.window) {
        gpu_corner corners[SHARED_PREINTEGRATED_LOBE_CELLS];
        if (info.cell_count > SHARED_PREINTEGRATED_LOBE_CELLS)
            return base_fail(error, NULL, "a preintegrated lobe of %u cells: the shaders take %d",
                             info.cell_count, SHARED_PREINTEGRATED_LOBE_CELLS);
        const GLsizei height = lay_out(&info, corners);
        upload_cells(&info, corners, height, &own->pairs);
        upload_block(&info, corners, height, &own->block);
        own->lobe = lobe;
        own->bands = info.bands;
        own->window = info.window;
    }
    glBindTextureUnit(SHARED_PREINTEGRATED_LOBE_PAIRS, own->pairs);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, SHARED_PREINTEGRATED_LOBE, own->block);
    return true;
}

void gpu_preintegrated_lobe_free(gpu_preintegrated_lobe *own) {
    glDeleteBuffers(1, &own->block);
    glDeleteTextures(1, &own->pairs);
}
