/* SPDX-License-Identifier: MIT */
/* coefficients.c - sums of n² coefficients, the light's times the material's, a range of bands at a
 * time: all at once would take more stack than a function may (base.h). */
#include "src/brdf/table.h"
#include "src/kernels/euler.h"
#include "src/light/packed.h"
#include "src/light/seen.h"
#include "src/sh/column.h"
#include "src/shade/material.h"

#include <assert.h>
#include <math.h>
#include <string.h>

/* Coefficients of a channel that are computed together: those of any single band, and more. */
enum { WAITING = 1024 };

/* Bands low … high-1 of the light and of what they are multiplied with, in planes of `count`. */
typedef struct band_range {
    int low, high;
    size_t count;
} band_range;

static band_range bands_after(int bands, band_range range) {
    band_range next = { range.high, range.high + 1, 0 };
    while (next.high < bands &&
           LMP_SH_COUNT(next.high + 1) - LMP_SH_COUNT(next.low) <= (size_t)WAITING)
        next.high++;
    next.count = LMP_SH_COUNT(next.high) - LMP_SH_COUNT(next.low);
    return next;
}

/* --- lobes ------------------------------------------------------------------------------------ */

static void add_light_bands(band_range range, const lmp_light *lights, size_t count, lmp_vec3 point,
                            float *sh) {
    float *const planes[3] = { sh, sh + range.count, sh + 2 * range.count };
    memset(sh, 0, 3 * range.count * sizeof *sh);
    for (size_t i = 0; i < count; i++) {
        lmpi_seen seen;
        lmpi_light_see(&lights[i], point, &seen);
        lmpi_seen_add(range.low, range.high, &seen, planes);
    }
}

static float dot(size_t count, const float *a, const float *b) {
    float sum = 0;
    for (size_t i = 0; i < count; i++)
        sum += a[i] * b[i];
    return sum;
}

lmp_rgb lmpi_shade_lobes_coefficients(const shade_lobes *lobes, lmp_vec3 point,
                                      const lmp_light *lights, size_t count) {
    float light[3 * WAITING], lobe[WAITING];
    lmp_rgb color = { 0, 0, 0 };
    for (band_range range = bands_after(lobes->bands, (band_range) { 0 }); range.low < lobes->bands;
         range = bands_after(lobes->bands, range)) {
        add_light_bands(range, lights, count, point, light);
        for (int k = 0; k < lobes->count; k++) {
            const shade_lobe *from = &lobes->lobe[k];
            lmpi_sh_zonal_bands(range.low, range.high, from->lambda, from->axis, lobe);
            color.r += from->weight.r * dot(range.count, light, lobe);
            color.g += from->weight.g * dot(range.count, light + range.count, lobe);
            color.b += from->weight.b * dot(range.count, light + 2 * range.count, lobe);
        }
    }
    return color;
}

/* --- tables ----------------------------------------------------------------------------------- */

typedef struct frame {
    lmp_vec3 x, y, z;
} frame;

static float scalar(lmp_vec3 a, lmp_vec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static lmp_vec3 cross(lmp_vec3 a, lmp_vec3 b) {
    return (lmp_vec3) { a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

/* Takes v without its part along the unit vector n and makes it unit; returns false if nothing is
 * left. */
static bool flatten(lmp_vec3 v, lmp_vec3 n, lmp_vec3 *flat) {
    const float along = scalar(v, n);
    const lmp_vec3 rest = { v.x - along * n.x, v.y - along * n.y, v.z - along * n.z };
    const float length2 = scalar(rest, rest);
    if (!(length2 > 1e-12f * scalar(v, v)))
        return false;
    const float scale = 1 / sqrtf(length2);
    *flat = (lmp_vec3) { rest.x * scale, rest.y * scale, rest.z * scale };
    return true;
}

/* Returns the material's x axis: the tangent, or the horizontal direction across the normal. */
static lmp_vec3 across(lmp_vec3 tangent, lmp_vec3 n) {
    lmp_vec3 x = { 1, 0, 0 };
    if (flatten(tangent, n, &x))
        return x;
    const lmp_vec3 up = { 0, 1, 0 }, side = x;
    if (!flatten(cross(up, n), n, &x))
        flatten(side, n, &x);
    return x;
}

static lmp_vec3 into(const frame *f, lmp_vec3 v) {
    return (lmp_vec3) { scalar(v, f->x), scalar(v, f->y), scalar(v, f->z) };
}

/* Finds what is seen of a light, in the frame: lights are transformed before they become caps, but
 * areas only then, because a rounded corner would matter close to them. */
static void see_in_frame(const frame *view, lmp_vec3 point, const lmp_light *from,
                         lmpi_seen *seen) {
    if (lmpi_light_is_area(from)) {
        lmpi_light_see(from, point, seen);
        lmpi_seen_rotate((lmp_vec3[]) { view->x, view->y, view->z }, seen);
        return;
    }
    lmp_light light = *from;
    const lmp_vec3 offset = { light.position.x - point.x, light.position.y - point.y,
                              light.position.z - point.z };
    light.position = into(view, offset);
    light.direction = into(view, light.direction);
    lmpi_light_see(&light, (lmp_vec3) { 0, 0, 0 }, seen);
}

/* Adds the products of the light's coefficients with the table's, which has m >= 0 alone if
 * mirrored. */
static void add_products(band_range range, bool mirrored, const float *light, const float *table,
                         float *sum) {
    for (int l = range.low; l < range.high; l++)
        for (int m = mirrored ? 0 : -l; m <= l; m++)
            *sum += light[LMP_SH_INDEX(l, m) - LMP_SH_COUNT(range.low)] * *table++;
}

/* Makes the frame of a table: z is the normal, x points toward the viewer; phi is the view's
 * azimuth from the material's x axis. */
static frame frame_of(const lmp_surface *surface, float *phi) {
    const lmp_vec3 n = surface->normal, material_x = across(surface->tangent, n);
    frame view = { .x = material_x, .z = n };
    flatten(surface->view, n, &view.x);
    view.y = cross(n, view.x);
    *phi = atan2f(scalar(view.x, cross(n, material_x)), scalar(view.x, material_x));
    return view;
}

lmp_rgb lmpi_shade_table(const lmp_brdf_table *table, const lmp_surface *surface,
                         const lmp_light *lights, size_t count) {
    if (count == 0)
        return (lmp_rgb) { 0, 0, 0 };
    const lmp_brdf_table_info info = lmp_brdf_table_describe(table);
    const float cosine = scalar(surface->view, surface->normal);
    float light[3 * WAITING], row[3 * WAITING], rgb[3] = { 0, 0, 0 }, phi;
    const frame view = frame_of(surface, &phi);
    for (band_range range = bands_after(info.bands, (band_range) { 0 }); range.low < info.bands;
         range = bands_after(info.bands, range)) {
        memset(light, 0, 3 * range.count * sizeof *light);
        float *const planes[3] = { light, light + range.count, light + 2 * range.count };
        for (size_t i = 0; i < count; i++) {
            lmpi_seen seen;
            see_in_frame(&view, surface->position, &lights[i], &seen);
            lmpi_seen_add(range.low, range.high, &seen, planes);
        }
        const size_t each = lmpi_brdf_table_bands(table, cosine, phi, range.low, range.high, row);
        for (size_t c = 0; c < 3; c++)
            add_products(range, info.mirrored, light + c * range.count, row + c * each, &rgb[c]);
    }
    return (lmp_rgb) { rgb[0], rgb[1], rgb[2] };
}

/* --- tables under an environment -------------------------------------------------------------- */

/* Red, green, blue and one unused value of a coefficient, multiplied at once. */
typedef float colors __attribute__((vector_size(16)));

enum { MOST = LMP_ENVIRONMENT_TABLE_BANDS };
static_assert(MOST <= LMPI_EULER_BANDS, "an environment is rotated at once");

static void interleave(size_t count, const float *planes, size_t plane, colors *to) {
    for (size_t i = 0; i < count; i++)
        to[i] = (colors) { planes[i], planes[plane + i], planes[2 * plane + i], 0 };
}

/* Interleaves a row of the table, with m < 0 too, which a mirrored one leaves out. */
static void interleave_row(int bands, bool mirrored, const float *row, size_t each, colors *to) {
    if (!mirrored) {
        interleave(LMP_SH_COUNT(bands), row, each, to);
        return;
    }
    for (int l = 0; l < bands; l++)
        for (int m = 0; m <= l; m++, row++) {
            to[LMP_SH_INDEX(l, -m)] = (colors) { 0 };
            to[LMP_SH_INDEX(l, m)] = (colors) { row[0], row[each], row[2 * each], 0 };
        }
}

/* Multiplies a row with the environment in its frame, Z X^T Z X Z e by the five factors of a
 * rotation (euler.h): the row takes the outer two, transposed, the environment the others, and no
 * matrix is made. */
static colors rotated_product(int bands, const lmpi_euler_angles *angles, colors *row,
                              colors *light) {
    colors first[LMP_SH_COUNT(MOST)], sum = { 0 };
    lmpi_euler_angle back = angles->last;
    for (int m = 0; m < bands; m++)
        back.s[m] = -back.s[m];
    LMPI_EULER_Z(colors, bands, &back, row, row)
    LMPI_EULER_QUARTER(colors, bands, row, first)
    LMPI_EULER_Z(colors, bands, &angles->first, light, light)
    LMPI_EULER_QUARTER(colors, bands, light, row)
    LMPI_EULER_Z(colors, bands, &angles->middle, row, row)
    for (size_t i = 0; i < LMP_SH_COUNT(bands); i++)
        sum += first[i] * row[i];
    return sum;
}

lmp_rgb lmpi_shade_table_environment(const lmp_brdf_table *table, const lmp_surface *surface,
                                     const lmp_environment *environment) {
    const lmp_brdf_table_info info = lmp_brdf_table_describe(table);
    const int known = environment->bands < info.bands ? environment->bands : info.bands;
    const int bands = known < MOST ? known : MOST;
    float values[3 * LMP_SH_COUNT(MOST)], phi;
    colors row[LMP_SH_COUNT(MOST)], light[LMP_SH_COUNT(MOST)];
    const frame f = frame_of(surface, &phi);
    const float into_frame[9] = { f.x.x, f.x.y, f.x.z, f.y.x, f.y.y, f.y.z, f.z.x, f.z.y, f.z.z };
    lmpi_euler euler;
    lmpi_euler_of(into_frame, &euler);
    lmpi_euler_angles angles;
    lmpi_euler_angles_of(bands, &euler, &angles);
    const size_t each =
        lmpi_brdf_table_bands(table, scalar(surface->view, surface->normal), phi, 0, bands, values);
    interleave_row(bands, info.mirrored, values, each, row);
    interleave(LMP_SH_COUNT(bands), environment->sh, LMP_SH_COUNT(environment->bands), light);
    const colors rgb = rotated_product(bands, &angles, row, light);
    return (lmp_rgb) { rgb[0], rgb[1], rgb[2] };
}
