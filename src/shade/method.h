/* SPDX-License-Identifier: MIT */
/* method.h - the shading methods, a row each: what else depends on the method reads its row. */
#ifndef LAMPION_SHADE_METHOD_H
#define LAMPION_SHADE_METHOD_H

#include "src/preintegrated/lobe_eval.h"
#include "src/shade/chunk.h"

/* What is the same for all surfaces of a call. */
typedef struct shade_prepared {
    const struct shade_method *method;
    const lmp_shade_settings *settings;
    float window[LMP_BANDS_MAX];
    lmp_preintegrated_lobe_info info;
} shade_prepared;

typedef struct shade_method {
    /* It reads the settings' preintegrated lobe, and of a tabulated material, where there is one,
     * the preintegrated BRDF. */
    bool preintegrated;
    /* The diffuse lobe is truncated and windowed as the others are, as in the paper: else exact. */
    bool diffuse_by_bands;
    /* What the lobes of one surface reflect, not clamped; NULL: they are a chunk of one. */
    lmp_rgb (*lobes_of_one)(const shade_lobes *lobes, lmp_vec3 point, const lmp_light *lights,
                            size_t count);
    /* Adds what the lobes of a chunk accumulate; NULL: surface by surface. */
    void (*lobes_of_chunk)(const shade_prepared *prepared, const shade_chunk *chunk,
                           const lmp_packed_light *lights, size_t count);
    void (*prepare)(const lmp_shade_settings *settings, shade_prepared *prepared); /* or NULL */
} shade_method;

const shade_method *lmp_shade_method_of(lmp_shade_method name);

#endif
