/* SPDX-License-Identifier: MIT */
/* The paper's tabulation of Z_l against cos a (§4.2), as a benchmark case. */
#include "app/render/zonal.h"
#include "app/render/gl/gpu.h"
#include "app/render/gl/zonal.h"

#include "shaders/program/shared.h"

#include <math.h>
#include <stdlib.h>

/* Computes sin²a R_l of all entries, with 4 bands per row of texels. */
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

bool gpu_zonal_bind(gpu_zonal *own, int bands, base_error *error) {
    if (own->bands != bands) {
        const size_t rows = (size_t)(bands + 3) / 4;
        vec4 *texels = malloc(gpu_zonal_bytes(bands));
        if (!texels || !fill_table(bands, rows, texels)) {
            free(texels);
            return base_fail(error, NULL, "out of memory");
        }
        glDeleteTextures(1, &own->texture);
        glCreateTextures(GL_TEXTURE_2D, 1, &own->texture);
        glTextureStorage2D(own->texture, 1, GL_RGBA32F, SHARED_ZONAL_ENTRIES, (GLsizei)rows);
        glTextureParameteri(own->texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
        glTextureParameteri(own->texture, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
        glTextureParameteri(own->texture, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        glTextureSubImage2D(own->texture, 0, 0, 0, SHARED_ZONAL_ENTRIES, (GLsizei)rows, GL_RGBA,
                            GL_FLOAT, texels);
        free(texels);
        own->bands = bands;
    }
    glBindTextureUnit(SHARED_ZONAL, own->texture);
    return true;
}

void gpu_zonal_free(gpu_zonal *own) {
    glDeleteTextures(1, &own->texture);
}
