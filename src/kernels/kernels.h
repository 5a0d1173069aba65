/* SPDX-License-Identifier: MIT */
/* kernels.h - the batch kernels: one source, compiled once for each instruction set, and a table of
 * function pointers that picks one at run time.
 *
 * Every build does the same operations in the same order, contracts none of them to an FMA and
 * takes its quotients and roots from the IEEE instructions, so all give the same bits.
 *
 * Element arrays (`const float *`) are planar and readable up to the next multiple of
 * LMP_KERNEL_LANES_MAX elements; what is read past `count` must be finite, and is not used. */
#ifndef LAMPION_KERNELS_KERNELS_H
#define LAMPION_KERNELS_KERNELS_H

#include <lampion/base.h>

#include <math.h>
#include <stdatomic.h>

#define LMP_KERNEL_LANES_MAX 16

/* Value v of element e lies at at[e * stride + v], or at at[v * stride + e] if planar; here alone
 * strides are in floats. */
typedef struct lmp_kernel_out {
    float *at;
    size_t stride;
    int planar;
} lmp_kernel_out;

typedef struct lmp_kernel_in {
    const float *at;
    size_t stride;
    int planar;
} lmp_kernel_in;

typedef struct lmp_kernel_vec3 {
    const float *x, *y, *z;
} lmp_kernel_vec3;

/* Floats of a cache line. */
#define LMP_KERNEL_LINE 16

/* Values of an element, at most, that a kernel streams: of 10 bands. */
#define LMP_KERNEL_STREAM_VALUES_MAX 100

/* Rows anywhere: that of element e begins at[e] * stride bytes after the first. at is readable like
 * planes, and what is read past `count` names rows, too. */
typedef struct lmp_kernel_rows {
    const size_t *at;
    size_t stride;
} lmp_kernel_rows;

/* One sphere of radiance 1 an element. */
typedef struct lmp_kernel_pairs {
    lmp_kernel_vec3 center, point;
    const float *radius;
} lmp_kernel_pairs;

/* The size of a light without one, a Dirac, in place of a radius or an angle. Its square is above
 * that of any distance: as far as kernels that know spheres alone can tell, every point is inside,
 * which is their slow path. And the distance from which on a Dirac at a position falls. */
#define LMP_DIRAC              (-INFINITY)
#define LMP_DIRAC_DISTANCE_MIN 1e-6f

/* Spheres wherever the caller keeps them; radiance.x … z are red, green, blue. One of a radius of
 * LMP_DIRAC is a Dirac at its center, of intensity where radiance is. */
typedef struct lmp_kernel_lights {
    lmp_vec3_array center;
    lmp_float_array radius;
    lmp_vec3_array radiance;
    size_t count;
    /* Of what accumulates: how much of light i comes to point p is at [i * stride + p]; NULL: all.
     */
    const float *visibility;
    size_t visibility_stride;
    int adds; /* accumulate_more's own */
} lmp_kernel_lights;

/* What a light is once its kind has been looked at (src/light/packed.h): kernels, shading, fields,
 * shadows and shaders know these forms alone. A loop of directions, as lights of other shapes are,
 * is one more of them. */
typedef enum lmp_light_form {
    LMP_FORM_SPHERE, /* around a position */
    LMP_FORM_DIRAC,  /* a single direction, to a position or fixed */
    LMP_FORM_CONE,   /* a Dirac at a position that falls off around an axis */
    LMP_FORM_CAP     /* fixed, of at most a hemisphere, and ambient light besides */
} lmp_light_form;

typedef struct lmp_packed_light {
    lmp_light_form form;
    int fixed; /* seen alike from every point: `at` is its unit direction, else its position */
    lmp_vec3 at;
    float size;      /* a radius; 1 - cos a of a cap, 0 … 1; LMP_DIRAC of Diracs and cones */
    lmp_rgb color;   /* radiance; of Diracs and cones intensity or, of fixed ones, irradiance */
    lmp_rgb ambient; /* radiance from every direction; only a cap has any */
    float per_reach; /* above 0: what a field (field.h of the API) lacks of it is left, 1/reach */
    /* Of a cone alone: its axis, from the light, the cosine of the outer angle, and what that of
     * the inner one is more. */
    lmp_vec3 axis;
    float outer, width;
} lmp_packed_light;

/* A preintegrated lobe (lampion/preintegrated.h), and where lobes lie in it
 * (src/preintegrated/lobe_eval.h): an array a member, readable like planes. */
typedef struct lmp_kernel_preintegrated_lobe {
    const int16_t *pairs;
} lmp_kernel_preintegrated_lobe;

typedef struct lmp_kernel_lobe_positions {
    const uint32_t *first, *columns; /* of the cell, in pairs */
    const float *fraction, *density, *lobe_angle;
} lmp_kernel_lobe_positions;

/* A slice of a preintegrated BRDF, and the rest of it: members as in
 * lampion/preintegrated.h, but that LMP_KERNEL_TEXELS_SPARE texels past the last one can be read,
 * too. */
typedef struct lmp_kernel_slice {
    uint32_t first, rows, columns;
    float row_density, row_origin, column_density, unit;
} lmp_kernel_slice;
#define LMP_KERNEL_TEXELS_SPARE 2

typedef struct lmp_kernel_preintegrated_brdf {
    int mirrored;
    float width, radius, reach, slope, lobe_angle;
    uint32_t view_count, cap_count, view_steps, cap_steps;
    const float *view_remap, *cap_remap;
    const lmp_rgb *ambient;
    const void *slices; /* lmp_kernel_slice */
    const int16_t *texels;
} lmp_kernel_preintegrated_brdf;

#define LMP_KERNEL_LOBES_MAX 5

/* A Phong lobe of every surface. */
typedef struct lmp_kernel_lobe {
    lmp_kernel_vec3 axis;
    const float *exponent;
} lmp_kernel_lobe;

/* Surfaces to shade. Those that have lobes have a diffuse one around the normal, and of Phong's 1,
 * 3 or 5; a BRDF is seen from `view` instead. */
typedef struct lmp_kernel_surfaces {
    lmp_kernel_vec3 point, normal, view;
    int lobe_count;
    lmp_kernel_lobe lobe[LMP_KERNEL_LOBES_MAX];
} lmp_kernel_surfaces;

/* Lights fade toward their surfaces over a distance of 1/per_reach (src/kernels/fade.h); and, with
 * per_outer above 0, lack what is left of them when they fade over 1/per_outer. */
typedef struct lmp_kernel_fade {
    float per_reach, per_outer;
} lmp_kernel_fade;

/* Points in the cells of a grid: of each node a row of values, then of their derivatives by x, by y
 * and by z. Each row is `stride` floats, a multiple of LMP_KERNEL_LANES_MAX: all of them are read,
 * so that a vector of 64 bytes lies in one cache line. */
typedef struct lmp_kernel_cells {
    const float *nodes;
    size_t stride;
    lmp_vec3 cell;            /* its edges */
    const uint32_t *corners;  /* of each point 8 nodes; x changes first, then y, then z */
    lmp_kernel_vec3 fraction; /* of each point, 0 … 1 along the edges */
} lmp_kernel_cells;

/* Nodes of half the cells, as those: 4 along x by 2 by 2, x first, and the nodes of the two cells
 * that they lie in, 3 along x by 2 by 2. */
typedef struct lmp_kernel_brick {
    const float *from[12];
    size_t stride;
    lmp_vec3 cell; /* the edges of the large cells */
    /* Nodes that the next call writes, or these: they are fetched while these are computed, for
     * they are far more than caches hold, and are not written in the order of memory. */
    const float *next;
} lmp_kernel_brick;

/* Bands of a field at most. */
#define LMP_KERNEL_FIELD_BANDS_MAX 10

/* Lights that one call of a shading kernel takes at most. */
#define LMP_KERNEL_LIGHTS_MAX 32

/* What the lobes receive, in planes of red, green, blue; added to. */
typedef struct lmp_kernel_accumulated {
    float *diffuse[3], *specular[LMP_KERNEL_LOBES_MAX][3];
} lmp_kernel_accumulated;

/* Texels of up to LMP_KERNEL_CHANNELS channels: where each is seen, and its values times its solid
 * angle, 0 for those past the last. */
#define LMP_KERNEL_TEXELS   256
#define LMP_KERNEL_CHANNELS 4
typedef struct lmp_kernel_texels {
    lmp_kernel_vec3 direction;
    const float *value[LMP_KERNEL_CHANNELS];
    int channels;
} lmp_kernel_texels;

/* What they add up to: the coefficients (l, m) and (l, -m) of a few orders m. */
#define LMP_KERNEL_ORDERS 3
typedef struct lmp_kernel_texel_sums {
    double cosine[LMP_KERNEL_ORDERS][LMP_KERNEL_CHANNELS][LMP_BANDS_MAX];
    double sine[LMP_KERNEL_ORDERS][LMP_KERNEL_CHANNELS][LMP_BANDS_MAX];
} lmp_kernel_texel_sums;

/* The table of GGX's lobes (lmp_ggx_table): rows over roughness_min … 1 of nodes over the root of
 * the view's cosine, each of LMP_KERNEL_LOBES_MAX lobes of four parameters; what the base loses, by
 * view. And planes of a lobe. */
typedef struct lmp_kernel_ggx {
    const float *nodes, *diffuse;
    int views, roughnesses;
    float roughness_min;
} lmp_kernel_ggx;

typedef struct lmp_kernel_ggx_lobe {
    float *axis[3], *exponent, *f0, *f90;
} lmp_kernel_ggx_lobe;

typedef struct lmp_kernels {
    const char *name;
    int lanes;

    /* `values` planes, 4 and up, of as many floats a row; rows of three planes, clamped at 0. */
    void (*load_rows)(size_t values, const float *first, const lmp_kernel_rows *rows, size_t count,
                      float *const *planes);
    void (*store_colors)(const float *const planes[3], size_t count, const lmp_kernel_rows *rows,
                         float *first);
    /* The first `lobes` lobes of each surface, whole registers of them. */
    void (*ggx)(const lmp_kernel_ggx *table, const lmp_kernel_vec3 *normal,
                const lmp_kernel_vec3 *view, const float *roughness, size_t count, int lobes,
                const lmp_kernel_ggx_lobe *to, float *diffuse_f90);
    /* Floats as binary16 and back (src/base/half.h). */
    void (*pack_half)(const float *values, size_t count, uint16_t *halves);
    void (*unpack_half)(const uint16_t *halves, size_t count, float *values);
    /* bands^2 values: Y_lm. */
    void (*eval)(int bands, const lmp_kernel_vec3 *directions, size_t count,
                 const lmp_kernel_out *out);
    /* The same of up to LMP_KERNEL_STREAM_VALUES_MAX, stored past the caches where the instruction
     * set can: seen by other threads after lmp_batch_fence. */
    void (*eval_streamed)(int bands, const lmp_kernel_vec3 *directions, size_t count,
                          const lmp_kernel_out *out);
    /* As eval, and 3 bands^2 values: their derivatives along the sphere by x, then y, then z. */
    void (*eval_gradient)(int bands, const lmp_kernel_vec3 *directions, size_t count,
                          const lmp_kernel_out *out, const lmp_kernel_out *gradient);
    /* One value: the dot product of two elements of `values` values. */
    void (*dot)(size_t values, const lmp_kernel_in *a, const lmp_kernel_in *b, size_t count,
                float *dots);
    /* bands^2 values, by the matrices of lmp_sh_rotation. */
    void (*rotate)(int bands, const float *matrices, const lmp_kernel_in *in, size_t count,
                   const lmp_kernel_out *out);
    /* 3 values: the functions of three planes of coefficients in these directions, band l times
     * factors[l] and, with exponents, times that of a Phong lobe of integral 1. */
    void (*reconstruct)(int bands, const float *factors, const float *exponents,
                        const float *const planes[3], const lmp_kernel_vec3 *directions,
                        size_t count, const lmp_kernel_out *out);
    /* Adds up to LMP_KERNEL_TEXELS texels to the sums of orders m … m+orders-1. */
    void (*image)(int bands, int m, int orders, const lmp_kernel_texels *texels, size_t count,
                  lmp_kernel_texel_sums *sums);
    /* `bands` values: Z_l (paper Eq. 12). */
    void (*zonal)(int bands, const float *radius, const float *distance, size_t count,
                  const lmp_kernel_out *out);
    /* bands^2 values: L_lm (paper Eq. 12 and 13). */
    void (*project)(int bands, const lmp_kernel_pairs *pairs, size_t count,
                    const lmp_kernel_out *out);
    /* As eval_streamed. */
    void (*project_streamed)(int bands, const lmp_kernel_pairs *pairs, size_t count,
                             const lmp_kernel_out *out);
    /* 3 bands^2 values: the red, green and blue coefficients of the sum of the lights. */
    void (*accumulate)(const lmp_scratch *scratch, int bands, const lmp_kernel_lights *lights,
                       const lmp_kernel_vec3 *points, size_t count, const lmp_kernel_out *out);
    /* The same, added to what the output holds. */
    void (*accumulate_more)(const lmp_scratch *scratch, int bands, const lmp_kernel_lights *lights,
                            const lmp_kernel_vec3 *points, size_t count, const lmp_kernel_out *out);
    /* Adds values to the output's from `first` on, times each element's factor. */
    void (*add)(const float *sh, size_t first, size_t values, const float *factors, size_t count,
                const lmp_kernel_out *out);
    /* Multiplies whole registers of factors by what of a cone's light comes to the points. */
    void (*cone)(const lmp_packed_light *cone, const lmp_kernel_vec3 *points, size_t count,
                 float *factors);
    /* As accumulate, and 9 bands^2 values: derivatives by x, then y, then z; |cos a| is held at
     * cos_min and up, for they are infinite on the sphere's surface. */
    void (*gradient)(const lmp_scratch *scratch, int bands, const lmp_kernel_lights *lights,
                     const lmp_kernel_vec3 *points, float cos_min, size_t count,
                     const lmp_kernel_out *out, const lmp_kernel_out *gradient);
    /* The same of lights that fade. */
    void (*fading_gradient)(const lmp_scratch *scratch, int bands, const lmp_kernel_lights *lights,
                            const lmp_kernel_vec3 *points, float cos_min, lmp_kernel_fade fade,
                            size_t count, const lmp_kernel_out *out,
                            const lmp_kernel_out *gradient);
    /* `values` values: Adini's interpolation. */
    void (*interpolate)(size_t values, const lmp_kernel_cells *cells, size_t count,
                        const lmp_kernel_out *out);
    /* Adini's interpolation of a brick's 16 nodes, with their derivatives. */
    void (*refine)(const lmp_kernel_brick *brick, float *nodes);
    /* The same, added to what the nodes hold. */
    void (*refine_add)(const lmp_kernel_brick *brick, float *nodes);
    /* 3 values: the response of a lobe around each point's axis to the lights. */
    void (*lobe)(int bands, const float *lambda, const lmp_kernel_vec3 *axes,
                 const lmp_kernel_lights *lights, const lmp_kernel_vec3 *points, size_t count,
                 const lmp_kernel_out *out);
    /* Adds what the diffuse lobe of integral 1, exact, and Phong's, truncated to `bands` bands with
     * window[l], reflect of the lights but their ambient light. */
    void (*shade_zonal)(int bands, const float *window, const lmp_kernel_surfaces *surfaces,
                        const lmp_packed_light *lights, size_t light_count, size_t count,
                        const lmp_kernel_accumulated *accumulated);
    /* The same of light given by its coefficients at each surface, 3 bands^2 values, planar and
     * readable like planes; diffuse[l] are the factors of the diffuse lobe. */
    void (*shade_field)(int bands, const float *window, const float *diffuse,
                        const lmp_kernel_surfaces *surfaces, const lmp_kernel_in *sh, size_t count,
                        const lmp_kernel_accumulated *accumulated);
    /* As shade_zonal, Phong lobes from a preintegrated lobe; `specular` are the positions of each.
     */
    void (*shade_preintegrated_lobe)(const lmp_kernel_preintegrated_lobe *lobe,
                                     const lmp_kernel_lobe_positions *specular,
                                     const lmp_kernel_surfaces *surfaces,
                                     const lmp_packed_light *lights, size_t light_count,
                                     size_t count, const lmp_kernel_accumulated *accumulated);
    /* Adds what a BRDF reflects, in planes of red, green, blue, of the lights and of
     * ambient radiance. Lobes are not read. */
    void (*shade_preintegrated_brdf)(const lmp_kernel_preintegrated_brdf *material,
                                     const lmp_kernel_surfaces *surfaces,
                                     const lmp_packed_light *lights, size_t light_count,
                                     lmp_rgb ambient, size_t count, float *const rgb[3]);
    const struct lmp_single *single; /* single.h */
} lmp_kernels;

/* The build for AVX2, to which that for AVX-512 hands what it would not do faster. */
extern const lmp_kernels lmp_kernels_avx2;

/* Fills the table with the best build among `cpu_flags` (lmp_cpu_flag, cpu.h) that this library
 * and machine have; scalar when there is none. Returns the flag of the build taken. */
unsigned lmp_kernels_init(lmp_kernels *kernels, unsigned cpu_flags);

/* The table in use: what lmp_cpu_mask chose, else the best, which the first call finds. Inline, for
 * a call of its own would take as long as evaluating a few bands. */
extern _Atomic(const lmp_kernels *) lmp_kernel_table;
const lmp_kernels *lmp_kernels_find(void);
static inline const lmp_kernels *lmp_kernels_get(void) {
    const lmp_kernels *kernels = atomic_load_explicit(&lmp_kernel_table, memory_order_acquire);
    return kernels ? kernels : lmp_kernels_find();
}

#endif
