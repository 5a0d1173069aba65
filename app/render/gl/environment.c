/* SPDX-License-Identifier: MIT */
/* environment.c - ambient light from far away, for shaders/environment.glsl. */
#include "app/render/gl/internal.h"

#include <stdlib.h>
#include <string.h>

static void forget(gpu_renderer *r) {
    glDeleteTextures(1, &r->backdrop);
    glDeleteBuffers(1, &r->environment_block);
    r->backdrop = r->environment_block = 0;
    r->environment_bands = 0;
}

void gpu_set_environment(gpu_renderer *r, const environment *e) {
    forget(r);
    gpu_forget_tables(r); /* which of them are summed depends on it */
    r->environment = e;
}

static void upload_backdrop(gpu_renderer *r) {
    const image *seen = &r->environment->backdrop;
    glCreateTextures(GL_TEXTURE_2D, 1, &r->backdrop);
    glTextureStorage2D(r->backdrop, 1, GL_RGB32F, seen->width, seen->height);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTextureSubImage2D(r->backdrop, 0, 0, 0, seen->width, seen->height, GL_RGB, GL_FLOAT,
                        seen->rgb);
}

/* Matrices of a quarter turn about x. */
enum { TILTS = LMP_SH_ROTATION_COUNT(LMP_ENVIRONMENT_TABLE_BANDS) };

static void fill_tilts(vec4 *block) {
    static const float quarter[9] = { 1, 0, 0, 0, 0, -1, 0, 1, 0 };
    float matrices[TILTS];
    lmp_sh_rotation_from_matrix(LMP_ENVIRONMENT_TABLE_BANDS, quarter, matrices);
    for (size_t i = 0; i < TILTS; i++)
        block[i][0] = matrices[i];
}

/* Windowed, as the lobes are, and as they are, for tables that are windowed themselves. Of no
 * environment there are the matrices alone. */
static bool upload_coefficients(gpu_renderer *r, int bands, lmp_window window, cli_error *error) {
    const environment *e = r->environment;
    const int most = environment_shines(e) ? e->bands : 0;
    const size_t count = LMP_SH_COUNT(most), size = 2 * count + TILTS;
    float weights[LMP_BANDS_MAX];
    vec4 *block = calloc(size, sizeof *block);
    if (!block)
        return cli_fail(error, NULL, "out of memory");
    lmp_sh_window(bands, window, 0, weights);
    for (int l = 0; l < bands && l < most; l++)
        for (int m = -l; m <= l; m++)
            for (size_t c = 0; c < 3; c++) {
                const size_t i = LMP_SH_INDEX(l, m);
                block[i][c] = weights[l] * e->sh[c * count + i];
                block[count + i][c] = e->sh[c * count + i];
            }
    fill_tilts(block + 2 * count);
    glDeleteBuffers(1, &r->environment_block);
    glCreateBuffers(1, &r->environment_block);
    glNamedBufferStorage(r->environment_block, (GLsizeiptr)(size * sizeof *block), block, 0);
    free(block);
    return true;
}

/* Whether tables reflect coefficients of a field, and need the matrices. */
static bool rotates_fields(const gpu_renderer *r, const render_frame *frame) {
    return method_table[frame->method].reads & METHOD_READS_FIELD &&
           (r->materials.table_count > 0 || r->materials.fibers);
}

bool gpu_bind_environment(gpu_renderer *r, const render_frame *frame, cli_error *error) {
    const bool shines = environment_shines(r->environment);
    if (!shines && !rotates_fields(r, frame))
        return true;
    if (shines && !r->backdrop && r->environment->backdrop.rgb)
        upload_backdrop(r);
    if ((r->environment_bands != frame->bands || r->environment_window != frame->window) &&
        !upload_coefficients(r, frame->bands, frame->window, error))
        return false;
    r->environment_bands = frame->bands;
    r->environment_window = frame->window;
    glBindTextureUnit(SHARED_BACKDROP, r->backdrop);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, SHARED_ENVIRONMENT, r->environment_block);
    return true;
}

int gpu_reflected_bands(const gpu_renderer *r, int bands) {
    if (!environment_shines(r->environment))
        return 0;
    return bands < LMP_ENVIRONMENT_TABLE_BANDS ? bands : LMP_ENVIRONMENT_TABLE_BANDS;
}

void gpu_describe_environment(const gpu_renderer *r, const render_frame *frame, vec4 surroundings) {
    const environment *e = r->environment;
    if (!environment_shines(e))
        return;
    surroundings[0] = (float)(e->bands < frame->bands ? e->bands : frame->bands);
    surroundings[1] = e->azimuth;
    surroundings[2] = e->backdrop.rgb && !frame->hide_backdrop;
    surroundings[3] = (float)LMP_SH_COUNT(e->bands);
}
