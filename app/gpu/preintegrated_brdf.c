/* SPDX-License-Identifier: MIT */
/* Responses of measured materials for shaders/preintegrated_brdf.glsl: all slices in one texture,
 * all numbers in one buffer. */
#include "app/gpu/internal.h"

#include <stdlib.h>
#include <string.h>

enum { ATLAS_WIDTH = 4096, HEADER = 10, SLICE = 8 }; /* numbers of preintegrated_brdf.glsl */

bool gpu_has_preintegrated_brdf(const gpu_renderer *r) {
    for (int t = 0; t < r->table_count; t++)
        if (r->responses[t])
            return true;
    return false;
}

void gpu_set_responses(gpu_renderer *r, const lmp_preintegrated_brdf *const *responses) {
    for (int t = 0; t < GPU_TABLES_MAX; t++)
        r->responses[t] = responses && t < r->table_count ? responses[t] : NULL;
    glDeleteBuffers(1, &r->brdf_block);
    glDeleteTextures(1, &r->brdf_texels);
    glDeleteBuffers(1, &r->tables_buffer);
    r->brdf_block = r->brdf_texels = r->tables_buffer = 0;
}

/* --- places -------------------------------------------------------------------------------------
 */

/* A slice and where its first texel lies. */
typedef struct place {
    const lmp_preintegrated_brdf_slice *slice;
    const int16_t *texels;
    GLint x, y;
    size_t number; /* of its numbers in the buffer */
} place;

static int taller_first(const void *a, const void *b) {
    const place *p = a, *q = b;
    if (p->slice->rows != q->slice->rows)
        return p->slice->rows < q->slice->rows ? 1 : -1;
    return p->number > q->number ? 1 : -1;
}

/* From left to right, on shelves from the top, so that a shelf's slices are about as tall; returns
 * the height. */
static GLsizei lay_out(place *places, size_t count) {
    GLint x = 0, top = 0, bottom = 0;
    qsort(places, count, sizeof *places, taller_first);
    for (size_t i = 0; i < count; i++) {
        const GLint columns = (GLint)places[i].slice->columns, rows = (GLint)places[i].slice->rows;
        if (x + columns > ATLAS_WIDTH) {
            x = 0;
            top = bottom;
        }
        places[i].x = x;
        places[i].y = top;
        x += columns;
        bottom = top + rows > bottom ? top + rows : bottom;
    }
    return bottom;
}

/* --- numbers ------------------------------------------------------------------------------------
 */

static size_t slice_count(const lmp_preintegrated_brdf_info *info) {
    return (size_t)info->view_count * info->cap_count;
}

static size_t number_count(const lmp_preintegrated_brdf_info *info) {
    return HEADER + info->view_steps + 1 + info->cap_steps + 1 + 3 * (size_t)info->view_count +
           SLICE * slice_count(info);
}

static float *append(float *to, const float *values, size_t count) {
    memcpy(to, values, count * sizeof *to);
    return to + count;
}

/* All numbers but the slices'; returns the place of those. */
static float *write_header(const lmp_preintegrated_brdf_info *info, float *to) {
    const float header[HEADER] = { (float)info->view_count,
                                   (float)info->cap_count,
                                   (float)info->view_steps,
                                   (float)info->cap_steps,
                                   info->width,
                                   info->radius,
                                   info->reach,
                                   info->slope,
                                   info->lobe_angle,
                                   info->mirrored };
    to = append(to, header, HEADER);
    to = append(to, info->view_remap, info->view_steps + 1);
    to = append(to, info->cap_remap, info->cap_steps + 1);
    return append(to, &info->ambient->r, 3 * (size_t)info->view_count);
}

static void write_slices(const place *places, size_t count, float *numbers) {
    for (size_t i = 0; i < count; i++) {
        const lmp_preintegrated_brdf_slice *s = places[i].slice;
        /* the texture's values are -1 … 1 */
        const float values[SLICE] = { (float)places[i].x, (float)places[i].y, (float)s->rows,
                                      (float)s->columns,  s->row_density,     s->row_origin,
                                      s->column_density,  s->unit * 32767 };
        append(numbers + places[i].number, values, SLICE);
    }
}

/* --- upload -------------------------------------------------------------------------------------
 */

static bool upload_texels(gpu_renderer *r, const place *places, size_t count, GLsizei height,
                          cli_error *error) {
    GLint largest = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    if (height > largest)
        return cli_fail(error, NULL,
                        "the responses of the materials are too large for the GPU "
                        "(fewer --bands, or --method coefficients)");
    glCreateTextures(GL_TEXTURE_2D, 1, &r->brdf_texels);
    glTextureStorage2D(r->brdf_texels, 1, GL_RGBA16_SNORM, ATLAS_WIDTH, height);
    glTextureParameteri(r->brdf_texels, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(r->brdf_texels, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    for (size_t i = 0; i < count; i++)
        glTextureSubImage2D(r->brdf_texels, 0, places[i].x, places[i].y,
                            (GLsizei)places[i].slice->columns, (GLsizei)places[i].slice->rows,
                            GL_RGB, GL_SHORT, places[i].texels);
    return true;
}

/* Gathers every response's numbers and places. */
static void gather(const gpu_renderer *r, place *places, float *numbers) {
    float *to = numbers + GPU_TABLES_MAX;
    for (int t = 0; t < r->table_count; t++) {
        if (!r->responses[t])
            continue;
        const lmp_preintegrated_brdf_info info = lmp_preintegrated_brdf_describe(r->responses[t]);
        numbers[t] = (float)(to - numbers);
        to = write_header(&info, to);
        for (size_t i = 0; i < slice_count(&info); i++, to += SLICE)
            *places++ = (place) { .slice = &info.slices[i],
                                  .texels = info.texels + 3 * (size_t)info.slices[i].first,
                                  .number = (size_t)(to - numbers) };
    }
}

static bool upload(gpu_renderer *r, cli_error *error) {
    size_t slices = 0, count = GPU_TABLES_MAX;
    for (int t = 0; t < r->table_count; t++)
        if (r->responses[t]) {
            const lmp_preintegrated_brdf_info info =
                lmp_preintegrated_brdf_describe(r->responses[t]);
            slices += slice_count(&info);
            count += number_count(&info);
        }
    place *places = malloc(slices * sizeof *places);
    float *numbers = calloc(count, sizeof *numbers);
    bool ok = places && numbers;
    if (ok) {
        gather(r, places, numbers);
        const GLsizei height = lay_out(places, slices);
        write_slices(places, slices, numbers);
        ok = upload_texels(r, places, slices, height, error);
    } else
        cli_fail(error, NULL, "out of memory");
    if (ok) {
        glCreateBuffers(1, &r->brdf_block);
        glNamedBufferStorage(r->brdf_block, (GLsizeiptr)(count * sizeof *numbers), numbers, 0);
    }
    free(places);
    free(numbers);
    return ok;
}

bool gpu_bind_preintegrated_brdf(gpu_renderer *r, cli_error *error) {
    if (!gpu_has_preintegrated_brdf(r))
        return true;
    if (!r->brdf_block && !upload(r, error))
        return false;
    glBindTextureUnit(SHARED_PREINTEGRATED_BRDF_TEXELS, r->brdf_texels);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, SHARED_PREINTEGRATED_BRDF, r->brdf_block);
    return true;
}
