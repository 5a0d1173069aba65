/* SPDX-License-Identifier: MIT */
/* method.h - the shading methods, a row each: what else depends on the method reads its row. */
#ifndef LAMPION_SHADE_METHOD_H
#define LAMPION_SHADE_METHOD_H

#include "src/preintegrated/lobe_eval.h"
#include "src/shade/chunk.h"

/* What is the same for all surfaces of a call. The bands and the window are those by which lobes
 * are summed; under preintegrated lobes only areas are. */
typedef struct shade_prepared {
    const struct shade_method *method;
    const lmp_shade_settings *settings;
    int bands;
    float window[LMP_BANDS_MAX];
    lmp_preintegrated_lobe_info info;
} shade_prepared;

typedef struct shade_method {
    /* Whether the method reads the settings' preintegrated lobe and, of a tabulated material that
     * has one, the preintegrated BRDF. */
    bool preintegrated;
    /* Whether the diffuse lobe is truncated and windowed as the others, as in the paper; otherwise
     * it is exact. */
    bool diffuse_by_bands;
    /* Returns what the lobes of one surface reflect, not clamped; NULL if they are shaded as a
     * chunk of one. */
    lmp_rgb (*lobes_of_one)(const shade_lobes *lobes, lmp_vec3 point, const lmp_light *lights,
                            size_t count);
    /* Adds what the lobes of a chunk accumulate; NULL if they are shaded surface by surface. */
    void (*lobes_of_chunk)(const shade_prepared *prepared, const shade_chunk *chunk,
                           const lmpi_packed_light *lights, size_t count);
    void (*prepare)(const lmp_shade_settings *settings, shade_prepared *prepared); /* may be NULL */
} shade_method;

const shade_method *lmpi_shade_method_of(lmp_shade_method name);

/* Adds the light of those lights that are areas to what a chunk with lobes has accumulated. */
void lmpi_shade_add_areas(const shade_prepared *prepared, const shade_chunk *chunk,
                          const lmp_light *lights, size_t count);

#endif
