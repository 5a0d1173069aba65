/* SPDX-License-Identifier: MIT */
/* lampion/field.h - fields: the light of thousands of lights on a grid of nodes, read at any point
 * at a cost that the lights far from it do not change.
 *
 * A node holds the coefficients of all lights, red, green, blue, and their derivatives by the
 * node's position. Between nodes they are interpolated (Adini: exact for cubics, error h⁴). A light
 * near a point changes too fast for that: it fades out of the field toward its surface,
 *
 *     f = u² (6 - 8 u + 3 u²),  u = t²,  t = (distance - radius) / reach held to 0 … 1,
 *
 * at nodes and points alike, and what it lacks there, the fraction 1 - f, is summed exactly at the
 * point. Nothing jumps: not where a point leaves a cell, nor where a light does.
 *
 * Spheres and points are interpolated. A light of another kind, or one too large for its grid, is
 * near everywhere: summed at every point. So is every light at a point outside the grid; a field
 * that is too small is slow there, not wrong.
 *
 * docs/fields.md has errors, times and how to choose a grid. A field may be read by many threads at
 * once, while none changes it. A release build, which asserts nothing (base.h), stays in its arrays
 * at any point; the index of a light that is not there leads outside them. */
#ifndef LAMPION_FIELD_H
#define LAMPION_FIELD_H

#include <lampion/shade.h>

#ifdef __cplusplus
extern "C" {
#endif

#define LMP_FIELD_BANDS_MAX  10
#define LMP_FIELD_NODES_MAX  1024
#define LMP_FIELD_LIGHTS_MAX 65536

typedef struct lmp_field lmp_field;

/* The grid; zero-initialize it, zero means the default. */
typedef struct lmp_field_desc {
    int bands;       /* 1 … LMP_FIELD_BANDS_MAX; 5 */
    int nodes[3];    /* along x, y, z: 2 … LMP_FIELD_NODES_MAX; 16. At most 2^24 in all */
    lmp_vec3 origin; /* position of the first node, within 1e15 of 0 */
    lmp_vec3 cell;   /* from a node to the next, along x, y, z: 1e-12 … 1e12; 1 each */
    int light_max;   /* how many lights it has room for, 1 … LMP_FIELD_LIGHTS_MAX; 1024 */
    /* Largest error of a light's interpolated coefficients, relative to that light's own there:
     * root of the sum of squares, wherever the light is. That of a sum of many lights is far
     * smaller, for they err in all directions. 1e-5 … 1; LMP_FIELD_ERROR_DEFAULT */
    float error;
    /* From a light's surface, in longest edges of a cell, 1 … 64. Given, `error` does not count. */
    float reach;
} lmp_field_desc;
#define LMP_FIELD_ERROR_DEFAULT 0.05f

/* A field's desc with every default filled in, either of error and reach found from the other. */
typedef struct lmp_field_info {
    lmp_field_desc desc;
    float reach; /* in the unit of positions */
    size_t light_count;
    size_t node_bytes; /* of a node's coefficients and derivatives */
    size_t bytes;      /* of all */
} lmp_field_info;

/* host and desc may be NULL; *field is NULL on failure (LMP_ERROR_ARGUMENT: a member outside its
 * range). It has no lights yet. Nothing below allocates, whatever becomes of its lights. */
LMP_API lmp_result lmp_field_create(const lmp_host *host, const lmp_field_desc *desc,
                                    lmp_field **field);
LMP_API void lmp_field_destroy(lmp_field *field);
LMP_API lmp_field_info lmp_field_describe(const lmp_field *field);

/* Its lights, light_count of them, in their order. */
LMP_API const lmp_light *lmp_field_lights(const lmp_field *field);

/* --- lights ----------------------------------------------------------------------------------- */

/* Replaces all lights, and computes every node anew, on the threads of the host, which may be NULL.
 *
 * LMP_ERROR_ARGUMENT, and nothing has changed: more than light_max lights. LMP_ERROR_CANCELLED:
 * the nodes are those of neither; update again */
LMP_API lmp_result lmp_field_update(const lmp_host *host, lmp_field *field, const lmp_light *lights,
                                    size_t count);

/* The same in pieces, for those who read a field near few of its nodes, such as what a camera sees:
 * reset replaces the lights and computes nothing; want, from many threads at once, notes the nodes
 * around points; compute does those which are noted and have not been computed since. What is then
 * changed by move, add and remove holds for nodes that come later, too.
 *
 * Points whose nodes are not computed must not be read, nor bytes written before all are.
 * LMP_ERROR_ARGUMENT: as for update */
LMP_API lmp_result lmp_field_reset(lmp_field *field, const lmp_light *lights, size_t count);
LMP_API void lmp_field_want(lmp_field *field, lmp_vec3_array points, size_t count);
LMP_API lmp_result lmp_field_compute(const lmp_host *host, lmp_field *field);

/* Light at[i] becomes lights[i]. Each node loses what the old lights gave it and gains what the new
 * ones give, which costs as much as updating a field of twice `count` lights.
 *
 * Rounding adds up: a node is within 2^-24 of exact sums, times twice the lights changed since it
 * was computed anew, of the largest sum meanwhile. Every LMP_FIELD_REFRESH changed lights 16 nodes
 * are, in turn, which bounds that for ever: nodes * LMP_FIELD_REFRESH / 16 changes later it is a
 * node's turn again.
 *
 * at[i] < light_count, all different */
#define LMP_FIELD_REFRESH 16
LMP_API void lmp_field_move(const lmp_host *host, lmp_field *field, const size_t *at,
                            const lmp_light *lights, size_t count);

/* One more light, whose index is the old light_count. LMP_ERROR_ARGUMENT: light_max of them. */
LMP_API lmp_result lmp_field_add(const lmp_host *host, lmp_field *field, const lmp_light *light);

/* The light's index becomes that of the last light. at < light_count */
LMP_API void lmp_field_remove(const lmp_host *host, lmp_field *field, size_t at);

/* --- at points -----------------------------------------------------------------------------------
 * Sums of all lights, near ones included. Many at once, in one place, are many times faster. */

/* Coefficients: 3 * LMP_SH_COUNT(bands) values a point, red, green, blue, laid out as sh.h says. */
LMP_API void lmp_field_eval_n(const lmp_field *field, lmp_vec3_array points, size_t count,
                              lmp_sh_layout layout, size_t stride, float *sh);

/* lmp_lobe_response_n of the field's lights, with the field's bands: each point's own axis; red,
 * green, blue in rgb. */
LMP_API void lmp_field_lobe_n(const lmp_field *field, const float *lambda, lmp_vec3_array axes,
                              lmp_vec3_array points, size_t count, lmp_rgb *rgb);

/* lmp_shade_n under the field's lights. Of the settings the window counts; the bands are the
 * field's, and near lights are summed by LMP_SHADE_ZONAL. What the field has of a light reaches the
 * diffuse lobe by its bands, without the window. A material that has but a preintegrated BRDF is
 * lmp_shade's, under LMP_SHADE_PREINTEGRATED. */
LMP_API void lmp_field_shade_n(const lmp_shade_settings *settings, const lmp_field *field,
                               const lmp_surfaces *surfaces, size_t count, size_t rgb_stride,
                               float *rgb);

/* The lights near a point, for sums of your own, and which fraction of each the field lacks there,
 * above 0 to 1. Returns how many there are; up to `capacity` of them are written, in rising order.
 *
 * lights and fractions receive `capacity` values, and may be NULL if that is 0 */
LMP_API size_t lmp_field_near(const lmp_field *field, lmp_vec3 point, size_t capacity,
                              uint32_t *lights, float *fractions);

/* --- for shaders ------------------------------------------------------------------------------ */

/* Nodes first … first + count - 1, x running first, then y, z, all computed. Of each coefficient,
 * red, green, blue, a texel of four floats: its value and its derivatives by x, y and z. */
LMP_API void lmp_field_nodes(const lmp_field *field, size_t first, size_t count, float *texels);

/* The lists of near lights of all blocks of 2 x 2 x 2 cells, x first, nodes / 2 along an axis; then
 * those near everywhere: list i is lights[begin[i]] … lights[begin[i + 1] - 1]. Returns how many
 * they are and writes up to `capacity`, which if not 0 has begin receive blocks + 2 values. */
LMP_API size_t lmp_field_lists(const lmp_field *field, size_t capacity, uint32_t *begin,
                               uint32_t *lights);

/* The coarser field that 2048 nodes and more are made from, or NULL: of the same lights and origin,
 * twice the cells. Node x, y, z is what it has at half of that, interpolated, plus f - F, F being
 * its fade, of its lists of block x/4, y/4, z/4 and of everywhere. Only to be described and read */
LMP_API const lmp_field *lmp_field_coarser(const lmp_field *field);

/* --- as bytes ------------------------------------------------------------------------------------
 * Little-endian, versioned, checksummed; with its lights, so that what is read can be updated.
 *
 * bytes receives lmp_field_size(field) bytes */
LMP_API size_t lmp_field_size(const lmp_field *field);
LMP_API void lmp_field_write(const lmp_field *field, void *bytes);
LMP_API lmp_result lmp_field_read(const lmp_host *host, const void *data, size_t size,
                                  lmp_field **field);

#ifdef __cplusplus
}
#endif
#endif
