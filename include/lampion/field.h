/* SPDX-License-Identifier: MIT */
/* lampion/field.h - fields: the light of thousands of lights, stored at the nodes of a grid and
 * read at any point, at a cost that does not depend on the lights far from that point.
 *
 * A node holds the coefficients of all lights, red, green, blue, and their derivatives with respect
 * to its position. Between nodes they are interpolated (Adini: exact for cubics, error O(h⁴)).
 * Close to a light they vary too fast for that, so it fades out of the field toward its surface,
 *
 *     f = u² (6 - 8 u + 3 u²),  u = t²,  t = (distance - radius) / reach clamped to 0 … 1,
 *
 * at nodes and points alike. The residual, the fraction 1 - f, is summed exactly at the point.
 * Results are continuous where a point passes from one cell to the next, and where a light does.
 *
 * Sphere and point lights are interpolated. Areas are refused. A light of another kind, or one too
 * large for the grid, counts as near everywhere: it is summed at every point. At a point outside
 * the grid every light is summed, so a field that is too small is slow there, but not wrong.
 *
 * docs/fields.md gives errors and times, and says how to choose a grid. Many threads may read a
 * field at once, as long as none changes it. In a release build, which asserts nothing (base.h), no
 * point leads outside the field's arrays, but the index of a light that does not exist does. */
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

/* The grid of a field; zero-initialize it. Zero means the default, which comments name last. */
typedef struct lmp_field_desc {
    int bands;        /* 1 … LMP_FIELD_BANDS_MAX; 5 */
    int nodes[3];     /* along x, y, z: 2 … LMP_FIELD_NODES_MAX each, at most 2^24 in all; 16 */
    lmp_vec3 origin;  /* position of the first node, within 1e15 of 0 */
    lmp_vec3 cell;    /* distance between nodes along x, y, z: 1e-12 … 1e12; 1 each */
    size_t light_max; /* the number of lights it has room for, 1 … LMP_FIELD_LIGHTS_MAX; 1024 */
    /* The largest error in a light's interpolated coefficients, wherever the light is: the root of
     * the sum of squares, relative to its own. A sum of many lights has a far smaller error,
     * because their errors differ in direction. 1e-5 … 1; LMP_FIELD_ERROR_DEFAULT */
    float error;
    /* The distance from a light's surface within which it fades out of the field, in longest cell
     * edges, 1 … 64. If it is given, `error` is ignored. */
    float reach;
} lmp_field_desc;
#define LMP_FIELD_ERROR_DEFAULT 0.05f

/* A field's desc with its defaults filled in, and with error or reach derived from the other. */
typedef struct lmp_field_info {
    lmp_field_desc desc;
    float reach; /* in the unit of positions */
    size_t light_count;
    size_t node_bytes; /* of a node's coefficients and derivatives */
    size_t bytes;      /* of all memory the field holds */
} lmp_field_info;

/* Creates a field without lights. Below, only lmp_field_read allocates memory. host and desc may be
 * NULL; on failure *field is NULL (LMP_ERROR_ARGUMENT: a member of desc is outside its range). */
LMP_API lmp_result lmp_field_create(const lmp_host *host, const lmp_field_desc *desc,
                                    lmp_field **field);
LMP_API void lmp_field_destroy(lmp_field *field);
LMP_API lmp_field_info lmp_field_describe(const lmp_field *field);

/* Returns the field's lights, light_count of them in order; the field owns them. */
LMP_API const lmp_light *lmp_field_lights(const lmp_field *field);

/* --- lights ----------------------------------------------------------------------------------- */

/* Replaces all lights and recomputes every node, on the threads of the host, which may be NULL.
 * LMP_ERROR_ARGUMENT: there are more than light_max lights, or one is an area; nothing has changed.
 * After LMP_ERROR_CANCELLED the nodes match neither the old nor the new lights: update again. */
LMP_API lmp_result lmp_field_update(const lmp_host *host, lmp_field *field, const lmp_light *lights,
                                    size_t count);

/* Update a field in pieces, for programs that read it near only a few nodes, such as those around
 * what a camera sees. `reset` replaces the lights and computes nothing. `want_n` marks the nodes
 * around points; many threads may call it at once. `compute` computes the marked nodes that are not
 * computed yet. Nodes computed later include the changes made by `move_n`, `add` and `remove`.
 *
 * Do not read the field at points whose nodes are not computed, nor write it before all are.
 * LMP_ERROR_ARGUMENT as for lmp_field_update */
LMP_API lmp_result lmp_field_reset(lmp_field *field, const lmp_light *lights, size_t count);
LMP_API void lmp_field_want_n(lmp_field *field, lmp_vec3_array points, size_t count);
LMP_API lmp_result lmp_field_compute(const lmp_host *host, lmp_field *field);

/* Replaces light at[i] with lights[i]. Each node loses the contribution of the old lights and gains
 * that of the new ones, which costs as much as updating a field of twice `count` lights.
 *
 * Rounding errors accumulate: a node is within 2^-24 of the exact sums, times twice the number of
 * lights changed since it was recomputed, times the largest sum since. Every LMP_FIELD_REFRESH
 * changes, 16 nodes are recomputed in turn, each once in nodes * LMP_FIELD_REFRESH / 16 changes.
 *
 * at[i] < light_count, all different; no light may be an area */
#define LMP_FIELD_REFRESH 16
LMP_API void lmp_field_move_n(const lmp_host *host, lmp_field *field, const size_t *at,
                              const lmp_light *lights, size_t count);

/* Adds a light at index light_count. LMP_ERROR_ARGUMENT: light_max are there, or it is an area. */
LMP_API lmp_result lmp_field_add(const lmp_host *host, lmp_field *field, const lmp_light *light);

/* Removes light `at` < light_count; the last light takes over its index. */
LMP_API void lmp_field_remove(const lmp_host *host, lmp_field *field, size_t at);

/* --- at points -----------------------------------------------------------------------------------
 * Results include all lights, near ones too. Many nearby points at once are many times faster. */

/* Evaluates 3 * LMP_SH_COUNT(bands) coefficients per point, red, green, blue, in sh.h's layout. */
LMP_API void lmp_field_eval_n(const lmp_field *field, lmp_vec3_array points, size_t count,
                              lmp_sh_array sh);

/* Computes the response of a lobe to the field's lights at many points, each with an axis of its
 * own, as lmp_lobe_response_n does with the field's bands. rgb receives one color per point. */
LMP_API void lmp_field_eval_lobe_n(const lmp_field *field, const float *lambda, lmp_vec3_array axes,
                                   lmp_vec3_array points, size_t count, lmp_rgb_array rgb);

/* Shades many surfaces under the field's lights, as lmp_shade_n does. Of the settings only the
 * window applies: the bands are the field's, and near lights are summed by LMP_SHADE_ZONAL. The
 * diffuse lobe receives the interpolated part of a light with the field's bands, not windowed.
 * LMP_MATERIAL_PREINTEGRATED is shaded as by lmp_shade under LMP_SHADE_PREINTEGRATED. */
LMP_API void lmp_field_shade_n(const lmp_shade_settings *settings, const lmp_field *field,
                               const lmp_surfaces *surfaces, size_t count, lmp_rgb_array rgb);

/* Finds the lights near a point and the fraction of each, in (0, 1], that the field does not hold
 * there. Returns how many there are, and writes up to `capacity` of them, in ascending order. If
 * capacity is 0, lights and fractions may be NULL. */
LMP_API size_t lmp_field_find_near(const lmp_field *field, lmp_vec3 point, size_t capacity,
                                   uint32_t *lights, float *fractions);

/* --- for shaders ------------------------------------------------------------------------------ */

/* Copies computed nodes first … first + count - 1, x varying fastest, then y, z. A texel of four
 * floats holds a coefficient of red, green or blue and its derivatives with respect to x, y, z. */
LMP_EXPERIMENTAL LMP_API void lmp_field_copy_nodes(const lmp_field *field, size_t first,
                                                   size_t count, float *texels);

/* Copies the lists of near lights: one for each block of 2 x 2 x 2 cells, nodes / 2 blocks along an
 * axis, with x varying fastest; then one of the lights that are near everywhere. List i is
 * lights[begin[i]] … lights[begin[i + 1] - 1]. Returns how many entries there are, and writes up to
 * `capacity` of them; if capacity is not 0, begin receives blocks + 2 values. */
LMP_EXPERIMENTAL LMP_API size_t lmp_field_copy_lists(const lmp_field *field, size_t capacity,
                                                     uint32_t *begin, uint32_t *lights);

/* Returns the coarser field from which a field of 2048 nodes or more is made, or NULL. Only
 * describe and read it: it has the same lights and origin, and twice the cell size. Node x, y, z is
 * the coarser field interpolated at half of these, plus the fraction f - F, with F its own fade, of
 * the lights in its lists for block x/4, y/4, z/4 and everywhere. */
LMP_EXPERIMENTAL LMP_API const lmp_field *lmp_field_coarser_level(const lmp_field *field);

/* --- as bytes ------------------------------------------------------------------------------------
 * Write a field and its lights as bytes and read them back: little-endian, versioned, checksummed.
 *
 * size must be at least lmp_field_size(field): else LMP_ERROR_ARGUMENT, and nothing is written */
LMP_API size_t lmp_field_size(const lmp_field *field);
LMP_API lmp_result lmp_field_write(const lmp_field *field, size_t size, void *bytes);
LMP_API lmp_result lmp_field_read(const lmp_host *host, const void *data, size_t size,
                                  lmp_parse_error *error, lmp_field **field);

#ifdef __cplusplus
}
#endif
#endif
