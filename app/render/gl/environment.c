/* SPDX-License-Identifier: MIT */
/* environment.c - ambient light from far away, for shaders/program/environment.glsl. */
#include "app/render/gl/environment.h"

#include "shaders/program/shared.h"

#include <stdlib.h>
#include <string.h>

static void forget(gpu_environment *own) {
    glDeleteTextures(1, &own->backdrop);
    gpu_texels_free(&own->coefficients);
    own->backdrop = 0;
    own->bands = 0;
}

void gpu_environment_set(gpu_environment *own, const environment *source) {
    forget(own);
    own->source = source;
}

static void upload_backdrop(gpu_environment *own) {
    const image *seen = &own->source->backdrop;
    glCreateTextures(GL_TEXTURE_2D, 1, &own->backdrop);
    glTextureStorage2D(own->backdrop, 1, GL_RGB32F, seen->width, seen->height);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTextureSubImage2D(own->backdrop, 0, 0, 0, seen->width, seen->height, GL_RGB, GL_FLOAT,
                        seen->rgb);
}

/* Size of the rotation matrices of a quarter turn around x. */
enum { TILTS = LMP_SH_ROTATION_COUNT(LMP_ENVIRONMENT_TABLE_BANDS) };

static void fill_tilts(vec4 *block) {
    static const float quarter[9] = { 1, 0, 0, 0, 0, -1, 0, 1, 0 };
    float matrices[TILTS];
    lmp_sh_make_rotation_from_matrix(LMP_ENVIRONMENT_TABLE_BANDS, quarter, matrices);
    for (size_t i = 0; i < TILTS; i++)
        block[i][0] = matrices[i];
}

/* Uploads the coefficients, windowed, as the lobes need them, and unwindowed, for tables that are
 * windowed themselves; then the matrices, also without an environment. */
static bool upload_coefficients(gpu_environment *own, int bands, lmp_window window,
                                base_error *error) {
    const environment *e = own->source;
    const int most = environment_shines(e) ? e->bands : 0;
    const size_t count = LMP_SH_COUNT(most), size = 2 * count + TILTS;
    float weights[LMP_BANDS_MAX];
    vec4 *block = calloc(size, sizeof *block);
    if (!block)
        return base_fail(error, NULL, "out of memory");
    lmp_sh_make_window(bands, window, 0, weights);
    for (int l = 0; l < bands && l < most; l++)
        for (int m = -l; m <= l; m++)
            for (size_t c = 0; c < 3; c++) {
                const size_t i = LMP_SH_INDEX(l, m);
                block[i][c] = weights[l] * e->sh[c * count + i];
                block[count + i][c] = e->sh[c * count + i];
            }
    fill_tilts(block + 2 * count);
    gpu_texels_create(&own->coefficients, size * sizeof *block, block);
    free(block);
    return true;
}

/* Whether tables reflect the coefficients of a field, which requires the matrices. */
static bool rotates_fields(const render_materials *materials, const render_frame *frame) {
    return method_table[frame->method].reads & METHOD_READS_FIELD &&
           (materials->table_count > 0 || materials->sheen_tables[0]);
}

bool gpu_environment_bind(gpu_environment *own, const render_materials *materials,
                          const render_frame *frame, base_error *error) {
    const bool shines = environment_shines(own->source);
    if (!shines && !rotates_fields(materials, frame))
        return true;
    if (shines && !own->backdrop && own->source->backdrop.rgb)
        upload_backdrop(own);
    if ((own->bands != frame->bands || own->window != frame->window) &&
        !upload_coefficients(own, frame->bands, frame->window, error))
        return false;
    own->bands = frame->bands;
    own->window = frame->window;
    glBindTextureUnit(SHARED_BACKDROP, own->backdrop);
    gpu_texels_bind(&own->coefficients, SHARED_ENVIRONMENT);
    return true;
}

int gpu_environment_reflected(const gpu_environment *own, int bands) {
    if (!environment_shines(own->source))
        return 0;
    return bands < LMP_ENVIRONMENT_TABLE_BANDS ? bands : LMP_ENVIRONMENT_TABLE_BANDS;
}

void gpu_environment_describe(const gpu_environment *own, const render_frame *frame,
                              float surroundings[4]) {
    const environment *e = own->source;
    if (!environment_shines(e))
        return;
    surroundings[0] = (float)(e->bands < frame->bands ? e->bands : frame->bands);
    surroundings[1] = e->azimuth;
    surroundings[2] = e->backdrop.rgb && !frame->hide_backdrop;
    surroundings[3] = (float)LMP_SH_COUNT(e->bands);
}
