/* SPDX-License-Identifier: MIT */
/* Preintegrated BRDFs for shaders/lampion/preintegrated_brdf.glsl: all slices in one texture, all
 * parameters in one buffer. */
#include "app/render/gl/preintegrated_brdf.h"
#include "app/render/gl/shelves.h"

#include "shaders/lampion/preintegrated_lookup.h"
#include "shaders/program/shared.h"

#include <stdlib.h>
#include <string.h>

enum { ATLAS_WIDTH = 4096 };

bool gpu_preintegrated_brdfs_exist(const render_materials *materials) {
    for (int t = 0; t < materials->table_count; t++)
        if (materials->brdfs[t])
            return true;
    return false;
}

void gpu_preintegrated_brdfs_free(gpu_preintegrated_brdfs *own) {
    glDeleteBuffers(1, &own->block);
    glDeleteTextures(1, &own->texels);
    own->block = own->texels = 0;
}

/* --- the texture ------------------------------------------------------------------------------ */

/* A slice, and the position of its first texel. */
typedef struct placement {
    const lmp_preintegrated_brdf_slice *slice;
    const int16_t *texels;
    gpu_corner corner;
    size_t number; /* index of its parameters in the buffer */
} placement;

static int taller_first(const void *a, const void *b) {
    const placement *p = a, *q = b;
    if (p->slice->rows != q->slice->rows)
        return p->slice->rows < q->slice->rows ? 1 : -1;
    return p->number > q->number ? 1 : -1;
}

/* Places slices of similar height on shelves; returns the total height. */
static GLsizei lay_out(placement *placements, size_t count) {
    gpu_shelves shelves = { .width = ATLAS_WIDTH };
    qsort(placements, count, sizeof *placements, taller_first);
    for (size_t i = 0; i < count; i++)
        placements[i].corner = gpu_shelves_put(&shelves, (int)placements[i].slice->columns,
                                               (int)placements[i].slice->rows);
    return shelves.bottom;
}

/* --- numbers ---------------------------------------------------------------------------------- */

static size_t slice_count(const lmp_preintegrated_brdf_info *info) {
    return (size_t)info->view_count * info->cap_count;
}

static size_t number_count(const lmp_preintegrated_brdf_info *info) {
    return LMP_LOOKUP_HEADER + info->view_steps + 1 + info->cap_steps + 1 +
           3 * (size_t)info->view_count + LMP_LOOKUP_SLICE * slice_count(info);
}

static float *append(float *to, const float *values, size_t count) {
    memcpy(to, values, count * sizeof *to);
    return to + count;
}

/* Writes all parameters but the slices'; returns where those begin. */
static float *write_header(const lmp_preintegrated_brdf_info *info, float *to) {
    const float header[] = { [LMP_LOOKUP_VIEW_COUNT] = (float)info->view_count,
                             [LMP_LOOKUP_CAP_COUNT] = (float)info->cap_count,
                             [LMP_LOOKUP_VIEW_STEPS] = (float)info->view_steps,
                             [LMP_LOOKUP_CAP_STEPS] = (float)info->cap_steps,
                             [LMP_LOOKUP_WIDTH] = info->width,
                             [LMP_LOOKUP_RADIUS] = info->radius,
                             [LMP_LOOKUP_REACH] = info->reach,
                             [LMP_LOOKUP_SLOPE] = info->slope,
                             [LMP_LOOKUP_LOBE_ANGLE] = info->lobe_angle,
                             [LMP_LOOKUP_MIRRORED] = info->mirrored };
    static_assert(sizeof header == LMP_LOOKUP_HEADER * sizeof(float), "the header is complete");
    to = append(to, header, LMP_LOOKUP_HEADER);
    to = append(to, info->view_remap, info->view_steps + 1);
    to = append(to, info->cap_remap, info->cap_steps + 1);
    return append(to, &info->ambient->r, 3 * (size_t)info->view_count);
}

static void write_slices(const placement *placements, size_t count, float *numbers) {
    for (size_t i = 0; i < count; i++) {
        const lmp_preintegrated_brdf_slice *s = placements[i].slice;
        const float values[] = { [LMP_LOOKUP_CORNER_X] = (float)placements[i].corner.x,
                                 [LMP_LOOKUP_CORNER_Y] = (float)placements[i].corner.y,
                                 [LMP_LOOKUP_ROWS] = (float)s->rows,
                                 [LMP_LOOKUP_COLUMNS] = (float)s->columns,
                                 [LMP_LOOKUP_ROW_DENSITY] = s->row_density,
                                 [LMP_LOOKUP_ROW_ORIGIN] = s->row_origin,
                                 [LMP_LOOKUP_COLUMN_DENSITY] = s->column_density,
                                 [LMP_LOOKUP_VALUE_MAX] = s->unit * 32767 };
        static_assert(sizeof values == LMP_LOOKUP_SLICE * sizeof(float), "a slice is complete");
        append(numbers + placements[i].number, values, LMP_LOOKUP_SLICE);
    }
}

/* --- upload ----------------------------------------------------------------------------------- */

static bool upload_texels(GLuint *texture, const placement *placements, size_t count,
                          GLsizei height, base_error *error) {
    GLint largest = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    if (height > largest)
        return base_fail(error, NULL,
                         "the preintegrated materials are too large for the GPU "
                         "(fewer --bands, or --method coefficients)");
    glCreateTextures(GL_TEXTURE_2D, 1, texture);
    glTextureStorage2D(*texture, 1, GL_RGBA16_SNORM, ATLAS_WIDTH, height);
    glTextureParameteri(*texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(*texture, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    for (size_t i = 0; i < count; i++)
        glTextureSubImage2D(*texture, 0, placements[i].corner.x, placements[i].corner.y,
                            (GLsizei)placements[i].slice->columns,
                            (GLsizei)placements[i].slice->rows, GL_RGB, GL_SHORT,
                            placements[i].texels);
    return true;
}

/* Writes every BRDF's parameters, and lists the slices to be placed. */
static void list_slices(const render_materials *materials, placement *placements, float *numbers) {
    float *to = numbers + RENDER_TABLES_MAX;
    for (int t = 0; t < materials->table_count; t++) {
        if (!materials->brdfs[t])
            continue;
        const lmp_preintegrated_brdf_info info =
            lmp_preintegrated_brdf_describe(materials->brdfs[t]);
        numbers[t] = (float)(to - numbers);
        to = write_header(&info, to);
        for (size_t i = 0; i < slice_count(&info); i++, to += LMP_LOOKUP_SLICE)
            *placements++ = (placement) { .slice = &info.slices[i],
                                          .texels = info.texels + 3 * (size_t)info.slices[i].first,
                                          .number = (size_t)(to - numbers) };
    }
}

static bool upload(gpu_preintegrated_brdfs *own, const render_materials *materials,
                   base_error *error) {
    size_t slices = 0, count = RENDER_TABLES_MAX;
    for (int t = 0; t < materials->table_count; t++)
        if (materials->brdfs[t]) {
            const lmp_preintegrated_brdf_info info =
                lmp_preintegrated_brdf_describe(materials->brdfs[t]);
            slices += slice_count(&info);
            count += number_count(&info);
        }
    placement *placements = malloc(slices * sizeof *placements);
    float *numbers = calloc(count, sizeof *numbers);
    bool ok = placements && numbers;
    if (ok) {
        list_slices(materials, placements, numbers);
        const GLsizei height = lay_out(placements, slices);
        write_slices(placements, slices, numbers);
        ok = upload_texels(&own->texels, placements, slices, height, error);
    } else
        base_fail(error, NULL, "out of memory");
    if (ok) {
        glCreateBuffers(1, &own->block);
        glNamedBufferStorage(own->block, (GLsizeiptr)(count * sizeof *numbers), numbers, 0);
    }
    free(placements);
    free(numbers);
    return ok;
}

bool gpu_preintegrated_brdfs_bind(gpu_preintegrated_brdfs *own, const render_materials *materials,
                                  base_error *error) {
    if (!gpu_preintegrated_brdfs_exist(materials))
        return true;
    if (!own->block && !upload(own, materials, error))
        return false;
    glBindTextureUnit(SHARED_PREINTEGRATED_BRDF_TEXELS, own->texels);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, SHARED_PREINTEGRATED_BRDF, own->block);
    return true;
}
