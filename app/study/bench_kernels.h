/* SPDX-License-Identifier: MIT */
/* bench_kernels.h - what `lampion bench cpu` times: batch kernels, of which a new one is a row of
 * bench_kernels.c, which says how it is run and measured, and one more of BENCH_KERNELS; and calls
 * of one element, which are rows of bench_calls.c. */
#ifndef LAMPION_STUDY_BENCH_KERNELS_H
#define LAMPION_STUDY_BENCH_KERNELS_H

#include <lampion/lampion.h>

/* Sizes: the output of a call fits the first cache (48 KiB), as for a caller that uses it at once.
 * Each point has BENCH_LIGHTS lights, or BENCH_LIGHTS_FEW. */
enum {
    BENCH_LIGHTS = 32,
    BENCH_LIGHTS_FEW = 8,
    BENCH_CUBE = 20, /* side of a face */
    BENCH_PANORAMA_WIDTH = 80,
    BENCH_PANORAMA_HEIGHT = 30,
    BENCH_FIELD = 16,      /* nodes of a field along x and z */
    BENCH_FIELD_ROWS = 15, /* nodes along y */
    BENCH_FIELD_NODES = BENCH_FIELD * BENCH_FIELD_ROWS * BENCH_FIELD,
    BENCH_ELEMENTS_MAX = 480,
    BENCH_OUTPUT_FLOATS = 6144
};

/* Rectangles that are 23 degrees wide, that look small, and that the horizon cuts; disks and tubes
 * that are as wide; and tubes that look small. */
typedef struct bench_areas {
    lmp_light large[BENCH_LIGHTS], small[BENCH_LIGHTS], cut[BENCH_LIGHTS], disk[BENCH_LIGHTS];
    lmp_light tube[BENCH_LIGHTS], tube_small[BENCH_LIGHTS];
} bench_areas;

/* The inputs and outputs of a kernel. */
typedef struct bench_batch {
    int bands;
    lmp_sh_layout layout;
    size_t count, stride;
    lmp_vec3_array axes, points;
    lmp_spheres spheres;
    const float *distances, *lambda, *matrices, *vectors;
    lmp_surfaces surfaces;
    const lmp_light *lights, *kinds;
    const bench_areas *areas;
    const lmp_preintegrated_lobe *lobe; /* for kernels that read a lobe */
    lmp_field *field;                   /* for kernels that read a field */
    lmp_scratch scratch;                /* of the thread */
    float *out;
} bench_batch;

/* The table that a kernel reads. The bands of lobes and BRDFs do not affect the cost: 10, unless
 * requested otherwise. */
typedef enum bench_table {
    BENCH_TABLE_NONE,
    BENCH_TABLE_LOBES,
    BENCH_TABLE_BRDF,
    BENCH_TABLE_FIELD
} bench_table;
enum { BENCH_TABLE_BANDS = 10 };

/* A kernel: per element it has one light, or `lights`; for images, as many texels. */
typedef struct bench_kernel {
    const char *name;
    size_t (*values)(int bands); /* per element */
    double (*slots)(int bands);  /* mul, add, div and sqrt per light-point pair */
    void (*run)(const bench_batch *b);
    void (*paper)(const bench_batch *b, size_t element); /* NULL: the paper has no formula */
    int lights;                                          /* pairs per element */
    bool one_layout;                                     /* its output is interleaved alone */
    bench_table table;
    bool ggx;      /* shades glTF's metallic-roughness */
    int bands_max; /* the most that it has; 0: any number */
    bool large;    /* does little but store: measured on large outputs, too */
    bool call;     /* takes one element, in one lane: measured on the best instruction set alone */
} bench_kernel;

enum { BENCH_KERNELS = 33, BENCH_CALLS = 16, BENCH_ROWS = BENCH_KERNELS + BENCH_CALLS };
extern const bench_kernel bench_kernels[BENCH_KERNELS], bench_calls[BENCH_CALLS];

/* Returns the kernel or the call of a row, kernels first. */
static inline const bench_kernel *bench_row(int row) {
    return row < BENCH_KERNELS ? &bench_kernels[row] : &bench_calls[row - BENCH_KERNELS];
}

/* --- bench_paper.c: elements of the same work by the paper's formulas, one at a time ---------- */

void bench_paper_basis(const bench_batch *b, size_t element);
void bench_paper_basis_gradient(const bench_batch *b, size_t element);
void bench_paper_field_update(const bench_batch *b, size_t element);
void bench_paper_irradiance(const bench_batch *b, size_t element);
void bench_paper_cubemap(const bench_batch *b, size_t element);
void bench_paper_panorama(const bench_batch *b, size_t element);
void bench_paper_product(const bench_batch *b, size_t element);
void bench_paper_dot(const bench_batch *b, size_t element);
void bench_paper_rotate(const bench_batch *b, size_t element);
void bench_paper_zonal(const bench_batch *b, size_t element);
void bench_paper_project(const bench_batch *b, size_t element);
void bench_paper_accumulate(const bench_batch *b, size_t element);
void bench_paper_accumulate_few(const bench_batch *b, size_t element);
void bench_paper_pack_half(const bench_batch *b, size_t element);
void bench_paper_gradient(const bench_batch *b, size_t element);
void bench_paper_lobe(const bench_batch *b, size_t element);
void bench_paper_shade(const bench_batch *b, size_t element);
void bench_paper_shade_environment(const bench_batch *b, size_t element);

#endif
