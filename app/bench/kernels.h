/* SPDX-License-Identifier: MIT */
/* kernels.h - the batch kernels that `lampion bench cpu` times: what they work on, and what they
 * ask of a CPU. */
#ifndef LAMPION_BENCH_KERNELS_H
#define LAMPION_BENCH_KERNELS_H

#include <lampion/lampion.h>

/* Sizes: outputs of a call fit the first cache (48 KiB), as a caller that uses them at once sees;
 * BENCH_LIGHTS lights go into each point, or BENCH_LIGHTS_FEW. */
enum {
    BENCH_LIGHTS = 32,
    BENCH_LIGHTS_FEW = 8,
    BENCH_CUBE = 20, /* a face's side */
    BENCH_PANORAMA_WIDTH = 80,
    BENCH_PANORAMA_HEIGHT = 30,
    BENCH_FIELD = 16,      /* nodes of a field along x and z */
    BENCH_FIELD_ROWS = 15, /* along y */
    BENCH_FIELD_NODES = BENCH_FIELD * BENCH_FIELD_ROWS * BENCH_FIELD,
    BENCH_ELEMENTS_MAX = 480,
    BENCH_OUTPUT_FLOATS = 6144
};

/* What a kernel works on. */
typedef struct bench_batch {
    int bands;
    lmp_sh_layout layout;
    size_t count, stride;
    lmp_vec3_array axes, points;
    lmp_spheres spheres;
    const float *distances, *lambda, *matrices, *vectors;
    lmp_surfaces surfaces;
    const lmp_light *lights, *kinds;
    const lmp_preintegrated_lobe *lobe; /* of the kernels that read one */
    lmp_field *field;                   /* the same */
    float *out;
} bench_batch;

/* What a kernel reads. The bands of lobes and BRDFs do not concern the cost: 10, unless others are
 * asked for. */
typedef enum bench_table {
    BENCH_TABLE_NONE,
    BENCH_TABLE_LOBES,
    BENCH_TABLE_BRDF,
    BENCH_TABLE_FIELD
} bench_table;
enum { BENCH_TABLE_BANDS = 10 };

/* One light an element, or as many as `lights`; of images as many texels. */
typedef struct bench_kernel {
    const char *name;
    size_t (*values)(int bands); /* of an element */
    double (*slots)(int bands);  /* mul, add, div and sqrt a light-point pair */
    void (*run)(const bench_batch *b);
    void (*paper)(const bench_batch *b, size_t element);
    int lights;  /* pairs an element */
    bool shades; /* its output has one layout */
    bench_table table;
    bool ggx; /* it shades glTF's metallic-roughness */
} bench_kernel;

enum { BENCH_KERNELS = 27 };
extern const bench_kernel bench_kernels[BENCH_KERNELS];

/* --- paper.c: elements of the same work by the paper's formulas, one by one ------------------- */

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
