/* SPDX-License-Identifier: MIT */
/* points.c - evaluates a field at points: interpolated coefficients, and what near lights add. */
#include "src/field/points.h"
#include "src/kernels/dispatch.h"
#include "src/light/cap.h"
#include "src/sh/layout.h"

#include <string.h>

/* --- interpolation ---------------------------------------------------------------------------- */

void lmpi_field_set_place(const lmp_field *field, const field_place *place, size_t at,
                          field_cells *cells) {
    const uint32_t *cell = place->cell;
    for (uint32_t k = 0; k < 8; k++)
        cells->corners[8 * at + k] =
            lmpi_field_node(field, cell[0] + k % 2, cell[1] + k / 2 % 2, cell[2] + k / 4);
    for (int a = 0; a < 3; a++)
        cells->fraction[a][at] = place->fraction[a];
}

lmpi_kernel_cells lmpi_field_cells(const lmp_field *field, const float *nodes,
                                   const field_cells *cells) {
    return (lmpi_kernel_cells) { nodes,
                                 field->stride,
                                 field->info.desc.cell,
                                 cells->corners,
                                 { cells->fraction[0], cells->fraction[1], cells->fraction[2] } };
}

static void note_block(uint32_t block, field_blocks *blocks) {
    if (blocks->count == 0 || blocks->at[blocks->count - 1] != block)
        blocks->at[blocks->count++] = block;
}

/* Interpolates at points; neighbors are often in one cell. Points outside the grid read any cell.
 */
void lmpi_field_interpolate(const lmp_field *field, const lmp_vec3 *points, size_t count,
                            field_blocks *blocks, const lmpi_kernel_out *out) {
    field_cells found;
    field_place place, last = { .cell = { UINT32_MAX } };
    memset(found.fraction, 0, sizeof found.fraction);
    for (size_t i = 0; i < count; i++, last = place) {
        const bool inside = lmpi_field_find(field, points[i], &place);
        if (!inside)
            place = (field_place) { 0 };
        if (!lmpi_field_same_cell(place.cell, last.cell)) {
            lmpi_field_set_place(field, &place, i, &found);
            if (inside && blocks)
                note_block(lmpi_field_block(field, place.cell), blocks);
            continue;
        }
        memcpy(&found.corners[8 * i], &found.corners[8 * (i - 1)], 8 * sizeof *found.corners);
        for (int a = 0; a < 3; a++)
            found.fraction[a][i] = place.fraction[a];
    }
    const lmpi_kernel_cells cells = lmpi_field_cells(field, field->nodes, &found);
    lmpi_kernels_get()->field.interpolate(field->values, &cells, count, out);
}

/* --- near lights ------------------------------------------------------------------------------ */

bool lmpi_field_set_find(const lmp_field *field, lmp_vec3 point, field_set *set) {
    field_place place;
    const bool inside = lmpi_field_find(field, point, &place);
    if (inside)
        lmpi_field_set_add(field, lmpi_field_block(field, place.cell), set);
    else
        lmpi_field_set_add_all(field, set);
    return inside;
}

size_t lmp_field_find_near(const lmp_field *field, lmp_vec3 point, size_t capacity,
                           uint32_t *lights, float *fractions) {
    field_set set;
    size_t count = 0;
    lmpi_field_set_clear(field, &set);
    const bool inside = lmpi_field_set_find(field, point, &set);
    for (uint32_t i = 0; (i = lmpi_field_set_next(&set, i)) != FIELD_NONE; i++) {
        const float fraction = inside ? lmpi_field_residual(field, i, point) : 1;
        if (!(fraction > 0))
            continue;
        if (count < capacity) {
            lights[count] = i;
            fractions[count] = fraction;
        }
        count++;
    }
    return count;
}

static lmp_rgb scaled(lmp_rgb color, float factor) {
    return (lmp_rgb) { color.r * factor, color.g * factor, color.b * factor };
}

/* Adds to a row what the field does not hold at a point: all lights, outside the grid. */
static void add_near(const lmp_field *field, lmp_vec3 point, float *row) {
    const size_t n = field->values / 3;
    float *const planes[3] = { row, row + n, row + 2 * n };
    field_set set;
    lmpi_field_set_clear(field, &set);
    const bool inside = lmpi_field_set_find(field, point, &set);
    if (!inside)
        memset(row, 0, field->values * sizeof *row);
    for (uint32_t i = 0; (i = lmpi_field_set_next(&set, i)) != FIELD_NONE; i++) {
        const float fraction = inside ? lmpi_field_residual(field, i, point) : 1;
        lmp_cap cap;
        if (!(fraction > 0))
            continue;
        lmp_light_find_cap(&field->lights[i], point, &cap);
        cap.strength = scaled(cap.strength, fraction);
        cap.ambient = scaled(cap.ambient, fraction);
        lmpi_cap_add(0, field->info.desc.bands, &cap, planes);
    }
}

/* --- at points -------------------------------------------------------------------------------- */

static size_t load_points(lmp_vec3_array array, size_t first, size_t count, lmp_vec3 *points) {
    const size_t some = count - first < FIELD_BRICK ? count - first : FIELD_BRICK;
    for (size_t i = 0; i < some; i++)
        points[i] = lmpi_vec3_element(&array, first + i);
    return some;
}

void lmpi_field_rows(const lmp_field *field, const lmp_vec3 *points, size_t count, float *rows) {
    const lmpi_kernel_out out = { rows, field->values, 0 };
    lmpi_field_interpolate(field, points, count, NULL, &out);
    for (size_t i = 0; i < count; i++)
        add_near(field, points[i], rows + i * field->values);
}

void lmp_field_eval_n(const lmp_field *field, lmp_vec3_array points, size_t count,
                      lmp_sh_array sh) {
    assert(lmpi_are_finite(points, count) && lmpi_is_sh_array(sh, field->values, count));
    const bool planar = sh.layout == LMP_SH_PLANAR;
    const size_t step = lmpi_batch_stride(sh.stride, planar ? count : field->values);
    float rows[FIELD_ROWS];
    lmp_vec3 some[FIELD_BRICK];
    for (size_t first = 0; first < count; first += FIELD_BRICK) {
        const size_t n = load_points(points, first, count, some);
        lmpi_field_rows(field, some, n, rows);
        for (size_t i = 0; i < n; i++)
            for (size_t v = 0; v < field->values; v++)
                sh.at[planar ? v * step + first + i : (first + i) * step + v] =
                    rows[i * field->values + v];
    }
}

void lmp_field_eval_lobe_n(const lmp_field *field, const float *lambda, lmp_vec3_array axes,
                           lmp_vec3_array points, size_t count, lmp_rgb_array rgb) {
    assert(lmpi_are_finite(points, count) && lmpi_are_unit(axes, count));
    assert(lmpi_is_rgb_array(rgb));
    const size_t step = lmpi_batch_stride(rgb.stride, 3);
    float rows[FIELD_ROWS], planes[FIELD_ROWS], ones[LMP_FIELD_BANDS_MAX];
    lmp_vec3 some[FIELD_BRICK];
    for (int l = 0; l < LMP_FIELD_BANDS_MAX; l++)
        ones[l] = 1;
    for (size_t first = 0; first < count; first += FIELD_BRICK) {
        float axis[3][FIELD_BRICK] __attribute__((aligned(64))) = { 0 };
        float sums[3][FIELD_BRICK] __attribute__((aligned(64))) = { 0 };
        const size_t n = load_points(points, first, count, some);
        for (size_t i = 0; i < n; i++) {
            const lmp_vec3 q = lmpi_vec3_element(&axes, first + i);
            axis[0][i] = q.x;
            axis[1][i] = q.y;
            axis[2][i] = q.z;
        }
        const lmpi_kernel_surfaces surfaces = { .normal = { axis[0], axis[1], axis[2] } };
        const lmpi_kernel_in in = { planes, FIELD_BRICK, 1 };
        const lmpi_kernel_accumulated to = { .diffuse = { sums[0], sums[1], sums[2] } };
        lmpi_field_rows(field, some, n, rows);
        for (size_t v = 0; v < field->values; v++)
            for (size_t i = 0; i < FIELD_BRICK; i++)
                planes[v * FIELD_BRICK + i] = i < n ? rows[i * field->values + v] : 0;
        lmpi_kernels_get()->shade.field(field->info.desc.bands, ones, lambda, &surfaces, &in, n,
                                        &to);
        for (size_t i = 0; i < n; i++)
            for (size_t c = 0; c < 3; c++)
                rgb.at[(first + i) * step + c] = sums[c][i];
    }
}
