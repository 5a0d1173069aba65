/* SPDX-License-Identifier: MIT */
/* bench_inputs.h - synthetic points, lights and materials for the kernels, and the tables that the
 * kernels read. */
#ifndef LAMPION_STUDY_BENCH_INPUTS_H
#define LAMPION_STUDY_BENCH_INPUTS_H

#include "app/study/bench_kernels.h"

#include <stdbool.h>

typedef struct bench_inputs {
    float center[3][BENCH_ELEMENTS_MAX], point[3][BENCH_ELEMENTS_MAX], axis[3][BENCH_ELEMENTS_MAX];
    float radiance[3][BENCH_ELEMENTS_MAX], radius[BENCH_ELEMENTS_MAX], distance[BENCH_ELEMENTS_MAX];
    float normal[3][BENCH_ELEMENTS_MAX];
    lmp_material phong[BENCH_ELEMENTS_MAX], ggx[BENCH_ELEMENTS_MAX], tabulated;
    float lambda[LMP_BANDS_MAX];
    float *out, *vectors, *matrices;
    void *scratch;
    lmp_light lights[BENCH_LIGHTS], kinds[BENCH_LIGHTS]; /* spheres; all kinds, as in a level */
    bench_areas areas;
    /* The tables that the current kernel reads. */
    lmp_preintegrated_lobe *lobes;
    lmp_brdf_table *table;
    lmp_preintegrated_brdf *preintegrated;
    lmp_field *field;
} bench_inputs;

/* Makes the inputs; returns false if memory ran out. Free *inputs in any case. */
bool bench_inputs_create(bench_inputs *inputs);
void bench_inputs_free(bench_inputs *inputs);

/* Makes the tables that kernels of this kind read, with so many bands. */
bool bench_tables_create(bench_table table, int bands, bench_inputs *inputs);
void bench_tables_free(bench_inputs *inputs);

/* Returns what a kernel works on in one call. */
bench_batch bench_batch_of(bench_inputs *inputs, const bench_kernel *kernel, int bands,
                           lmp_sh_layout layout);

/* A batch of the same elements repeated until they fill `bytes` of output; bench_large_create
 * returns false if memory ran out. Free *large in any case. */
typedef struct bench_large {
    bench_batch batch;
    float *inputs, *out;
} bench_large;
bool bench_large_create(bench_inputs *inputs, const bench_kernel *kernel, int bands,
                        lmp_sh_layout layout, size_t bytes, bench_large *large);
void bench_large_free(bench_large *large);

#endif
