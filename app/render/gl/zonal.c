/* SPDX-License-Identifier: MIT */
/* The paper's tabulation of Z_l against cos a (§4.2), to be timed. */
#include "app/zonal/zonal.h"
#include "app/render/gl/internal.h"

#include <math.h>
#include <stdlib.h>

/* sin²a R_l of all entries, 4 bands a row of texels. */
static bool fill_table(int bands, size_t rows, vec4 *texels) {
    zonal_table *table = zonal_table_create(bands, 2 * SHARED_ZONAL_ENTRIES - 1);
    if (!table)
        return false;
    for (size_t i = 0; i < SHARED_ZONAL_ENTRIES; i++) {
        float zonal[LMP_BANDS_MAX];
        zonal_table_eval(table, (float)i / (SHARED_ZONAL_ENTRIES - 1), zonal);
        for (size_t l = 0; l < 4 * rows; l++) {
            /* Z_l = pi sin²a R_l sqrt((2l + 1)/(4 pi)) */
            const double norm = sqrt(3.14159265358979324 * (2.0 * (double)l + 1) / 4);
            texels[l / 4 * SHARED_ZONAL_ENTRIES + i][l % 4] =
                l < (size_t)bands ? (float)((double)zonal[l] / norm) : 0;
        }
    }
    zonal_table_destroy(table);
    return true;
}

size_t gpu_zonal_bytes(int bands) {
    return (size_t)((bands + 3) / 4) * SHARED_ZONAL_ENTRIES * sizeof(vec4);
}

bool gpu_bind_zonal(gpu_renderer *r, int bands, cli_error *error) {
    if (r->zonal_bands != bands) {
        const size_t rows = (size_t)(bands + 3) / 4;
        vec4 *texels = malloc(gpu_zonal_bytes(bands));
        if (!texels || !fill_table(bands, rows, texels)) {
            free(texels);
            return cli_fail(error, NULL, "out of memory");
        }
        glDeleteTextures(1, &r->zonal);
        glCreateTextures(GL_TEXTURE_2D, 1, &r->zonal);
        glTextureStorage2D(r->zonal, 1, GL_RGBA32F, SHARED_ZONAL_ENTRIES, (GLsizei)rows);
        glTextureParameteri(r->zonal, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
        glTextureParameteri(r->zonal, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
        glTextureParameteri(r->zonal, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        glTextureSubImage2D(r->zonal, 0, 0, 0, SHARED_ZONAL_ENTRIES, (GLsizei)rows, GL_RGBA,
                            GL_FLOAT, texels);
        free(texels);
        r->zonal_bands = bands;
    }
    glBindTextureUnit(SHARED_ZONAL, r->zonal);
    return true;
}
