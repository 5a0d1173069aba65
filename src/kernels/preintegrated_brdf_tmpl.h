/* SPDX-License-Identifier: MIT */
/* preintegrated_brdf_tmpl.h - what surfaces of one BRDF reflect of many lights, read from its table
 * (lampion/preintegrated.h).
 *
 * The positions of readings are computed with surfaces as lanes; then, surface by surface, lanes
 * are texels: a row of a reading has four of them, twelve numbers side by side. */
#ifndef LAMPION_KERNELS_PREINTEGRATED_BRDF_TMPL_H
#define LAMPION_KERNELS_PREINTEGRATED_BRDF_TMPL_H

#include "src/kernels/preintegrated_lobe_tmpl.h"

/* --- where ------------------------------------------------------------------------------------ */

/* What surfaces see: the axes of the mirror direction's frame, z that direction and x in the plane
 * of incidence on the side of the normal; and the first slice of the view before theirs. */
typedef struct brdf_block {
    vf point[3], x[3], y[3], z[3];
    vi slice;
    vf fraction; /* weight of the next view */
    vf ambient[3];
    int plain; /* whether no light fades */
} brdf_block;

/* A light's cap (u and v are not set), the angle from the mirror direction to its axis, and its
 * azimuth around that direction. */
typedef struct brdf_direction {
    shade_direction cap;
    vf angle, azimuth;
} brdf_direction;

/* One of the four slices that a light reads: two views with two caps each. Element e's four column
 * weights are at columns[e % 4][e / 4 * 4]; they include the light's and the slice's weight. */
typedef struct brdf_slice {
    LMPI_ALIGNED float columns[4][LMPI_LANES];
    LMPI_ALIGNED uint32_t rows[2][LMPI_LANES]; /* weights of two rows each, in 16 bits */
    LMPI_ALIGNED uint32_t from[LMPI_LANES], row[LMPI_LANES]; /* in numbers: three a texel */
} brdf_slice;

/* Loads table[i] and table[i + step]. */
LMPI_INLINE void brdf_neighbors(const float *table, vi i, int step, vf *low, vf *high) {
    int32_t at[LMPI_LANES];
    float from[2][LMPI_LANES];
    memcpy(at, &i, sizeof at);
    for (int e = 0; e < LMPI_LANES; e++) {
        from[0][e] = table[at[e]];
        from[1][e] = table[at[e] + step];
    }
    *low = vf_load(from[0]);
    *high = vf_load(from[1]);
}

/* Looks up the slice coordinate at `at` = 0 … 1 of a remap: the first of two slices and the
 * fraction of the second. */
LMPI_INLINE vi brdf_lookup(const float *remap, uint32_t steps, uint32_t count, vf at, vf *second) {
    const vf step = vf_min(vf_max(at, vf_set(0)), vf_set(1)) * (float)steps;
    const vi i = lmp_lookup_first(step, (float)(steps - 1));
    vf low, high;
    brdf_neighbors(remap, i, 1, &low, &high);
    const vf slice = lmp_lookup_between(low, high, step - vf_from(i));
    const vi first = lmp_lookup_first(slice, (float)(count - 2));
    *second = slice - vf_from(first);
    return first;
}

/* Returns the horizontal direction across the normal, for views along it. */
LMPI_INLINE void brdf_horizontal(const vf n[3], vf x[3]) {
    const vf none = vf_set(0), one = vf_set(1), level2 = n[0] * n[0] + n[2] * n[2];
    const vf least = vf_set(1e-12f);
    x[0] = vf_select_less(least, level2, n[2], one);
    x[1] = none;
    x[2] = vf_select_less(least, level2, -n[0], none);
}

LMPI_INLINE void brdf_block_load(const lmpi_kernel_preintegrated_brdf *material,
                                 const lmpi_kernel_surfaces *surfaces, size_t e,
                                 brdf_block *block) {
    vf n[3], v[3], flat[3], across[3];
    shade_planes(&surfaces->point, e, block->point);
    shade_planes(&surfaces->normal, e, n);
    shade_planes(&surfaces->view, e, v);
    const vf along = n[0] * v[0] + n[1] * v[1] + n[2] * v[2];
    for (int i = 0; i < 3; i++)
        flat[i] = v[i] - along * n[i];
    const vf least = 1e-12f * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    const vf length2 = flat[0] * flat[0] + flat[1] * flat[1] + flat[2] * flat[2];
    brdf_horizontal(n, across);
    for (int i = 0; i < 3; i++)
        flat[i] = vf_select_less(least, length2, flat[i], across[i]);
    const vf per_length = 1 / vf_sqrt(flat[0] * flat[0] + flat[1] * flat[1] + flat[2] * flat[2]);
    const vf cosine = vf_min(vf_max(along, vf_set(0)), vf_set(1));
    const vf sine = vf_sqrt(1 - cosine * cosine);
    for (int i = 0; i < 3; i++) {
        flat[i] = flat[i] * per_length;
        block->x[i] = cosine * flat[i] + sine * n[i];
        block->z[i] = cosine * n[i] - sine * flat[i];
    }
    block->y[0] = n[1] * flat[2] - n[2] * flat[1];
    block->y[1] = n[2] * flat[0] - n[0] * flat[2];
    block->y[2] = n[0] * flat[1] - n[1] * flat[0];

    const vi view = brdf_lookup(material->view_remap, material->view_steps, material->view_count,
                                lmp_lookup_arc(1 - cosine) * (2 / LMP_LOOKUP_PI), &block->fraction);
    block->slice = view * (int32_t)material->cap_count;
    for (int c = 0; c < 3; c++) {
        vf low, high;
        brdf_neighbors(&material->ambient->r + c, 3 * view, 3, &low, &high);
        block->ambient[c] = lmp_lookup_between(low, high, block->fraction);
    }
}

/* Finds a light's axis as seen from the mirror direction. */
LMPI_INLINE void brdf_direction_of(const lmpi_kernel_preintegrated_brdf *material,
                                   const lmpi_packed_light *light, const brdf_block *block,
                                   brdf_direction *direction) {
    const cap_lanes cap = shade_cap(light, block->plain, block->point, &direction->cap);
    const vf x = shade_dot(block->x, &cap) * cap.per_d, y = shade_dot(block->y, &cap) * cap.per_d;
    const vf z = shade_dot(block->z, &cap) * cap.per_d;
    const vf across2 = x * x + y * y;
    direction->angle = lmp_lookup_polar(z, across2);
    direction->azimuth = lmp_lookup_azimuth(x, y, across2, material->mirrored != 0);
}

/* --- slices ----------------------------------------------------------------------------------- */

/* What the four slices of a light have in common. */
typedef struct brdf_position {
    vf row, azimuth;    /* the row's coordinate before density and origin, and the azimuth */
    vi slice;           /* index for the first view and the smaller cap */
    vf smaller, larger; /* weights of both caps, times the light's */
} brdf_position;

LMPI_INLINE void brdf_position_of(const lmpi_kernel_preintegrated_brdf *material,
                                  const brdf_block *block, const brdf_direction *direction,
                                  brdf_position *position) {
    const vf t = direction->cap.t, a = lmp_lookup_arc(t);
    position->row = lmp_lookup_row(direction->angle, a, material->radius, material->width,
                                   material->reach, material->slope);
    position->azimuth = direction->azimuth;
    vf second;
    const vi cap = brdf_lookup(material->cap_remap, material->cap_steps, material->cap_count,
                               lmp_lookup_cap(a), &second);
    position->slice = block->slice + cap;
    /* mean over the cap = reading / (cap's + lobe's angle) */
    const vf covered = 2 * LMP_LOOKUP_PI * t + material->lobe_angle;
    const vf weight = 2 * LMP_LOOKUP_PI * direction->cap.weight / covered;
    position->larger = weight * second;
    position->smaller = weight - position->larger;
}

/* A slice per lane, with members in the order of lmpi_kernel_slice. */
typedef struct slice_lanes {
    vi first, rows, columns;
    vf row_density, row_origin, column_density, unit;
} slice_lanes;

/* Loads slices at `at` bytes from `slices`: words 0 … 3 of each, then 3 … 6. */
LMPI_INLINE void slice_lanes_load(const char *slices, const int32_t at[LMPI_LANES],
                                  slice_lanes *lanes) {
    const float *from[LMPI_LANES];
    vf low[4], high[4];
    LMPI_UNROLL for (int e = 0; e < LMPI_LANES; e++) from[e] =
        (const float *)(const void *)(slices + at[e]);
    layout_load4(from, 0, low);
    layout_load4(from, 3, high);
    *lanes = (slice_lanes) { vi_bits(low[0]), vi_bits(low[1]), vi_bits(low[2]), high[0],
                             high[1],         high[2],         high[3] };
}

/* Returns the integer part of a row or column among `count`, and the spline's weights of the
 * fraction. */
LMPI_INLINE vi slice_spline(vf at, vi count, vf weights[4]) {
    const vi base = lmp_lookup_base(at, vf_from(count - 3));
    spline_weights(lmp_lookup_past(at, base), weights);
    return base;
}

LMPI_INLINE void slice_locate(const char *slices, const int32_t at[LMPI_LANES],
                              const brdf_position *position, vf weight, brdf_slice *to) {
    slice_lanes lanes;
    vf down[4], across[4];
    slice_lanes_load(slices, at, &lanes);
    const vi row =
        slice_spline(position->row * lanes.row_density - lanes.row_origin, lanes.rows, down);
    const vi column =
        slice_spline(position->azimuth * lanes.column_density + 1, lanes.columns, across);
    const vi texel = lanes.first + (row - 1) * lanes.columns + (column - 1);
    const vi from = 3 * texel, step = 3 * lanes.columns;
    const vf scale = weight * lanes.unit * (1 / (6 * SPLINE_ONE));
    vi whole[4];
    for (int k = 0; k < 4; k++) {
        whole[k] = vi_from(down[k] * (SPLINE_ONE / 6) + 0.5f);
        across[k] = across[k] * scale;
    }
    const vi upper = whole[0] | whole[1] << 16, lower = whole[2] | whole[3] << 16;
    layout_transpose4(across);
    memcpy(to->columns, across, sizeof to->columns);
    memcpy(to->rows[0], &upper, sizeof upper);
    memcpy(to->rows[1], &lower, sizeof lower);
    memcpy(to->from, &from, sizeof from);
    memcpy(to->row, &step, sizeof step);
}

LMPI_INLINE void brdf_slices(const lmpi_kernel_preintegrated_brdf *material,
                             const brdf_block *block, const brdf_position *position,
                             brdf_slice to[4]) {
    const vf beyond = block->fraction, before = 1 - beyond;
    const vf weights[4] = { before * position->smaller, before * position->larger,
                            beyond * position->smaller, beyond * position->larger };
    const size_t caps = material->cap_count, size = sizeof(lmpi_kernel_slice);
    const vi offset = position->slice * (int32_t)size;
    int32_t at[LMPI_LANES];
    memcpy(at, &offset, sizeof at);
    const char *slices = material->slices;
    LMPI_ROLLED for (size_t s = 0; s < 4; s++)
        slice_locate(slices + (s / 2 * caps + s % 2) * size, at, position, weights[s], &to[s]);
}

/* --- readings --------------------------------------------------------------------------------- */

/* Sums over the lights, per surface, of the twelve numbers of a reading. */
typedef struct brdf_sums {
    LMPI_ALIGNED float at[LMPI_LANES][TEXEL_NUMBERS];
} brdf_sums;

/* Adds one light's part to the sums of surface e. radiance holds its red, green, blue in the order
 * of the numbers. */
LMPI_INLINE void brdf_read(const int16_t *texels, const brdf_slice slices[4], int e,
                           const texel_lanes radiance[TEXEL_PARTS], float *sums) {
    texel_lanes total[TEXEL_PARTS];
    LMPI_UNROLL for (int s = 0; s < 4; s++) {
        const brdf_slice *slice = &slices[s];
        const uint32_t rows[2] = { slice->rows[0][e], slice->rows[1][e] };
        texel_lanes values[TEXEL_PARTS], columns[TEXEL_PARTS];
        texel_rows(texels + slice->from[e], slice->row[e], rows, values);
        texel_columns(&slice->columns[e % 4][e / 4 * 4], columns);
        LMPI_UNROLL for (int i = 0; i < TEXEL_PARTS; i++) {
            const texel_lanes value = columns[i] * values[i];
            /* Hidden as a variable, because gcc would keep a member of an array in memory. */
            texel_lanes sum = s == 0 ? value : total[i] + value;
            LMPI_OPAQUE_LANES(sum);
            total[i] = sum;
        }
    }
    /* Added part by part, because a load of both would wait for the stores of each before. */
    LMPI_UNROLL for (int i = 0; i < TEXEL_PARTS; i++) {
        texel_lanes sum;
        memcpy(&sum, sums + TEXEL_LANES * i, sizeof sum);
        sum = sum + radiance[i] * total[i];
        memcpy(sums + TEXEL_LANES * i, &sum, sizeof sum);
    }
}

/* --- surfaces --------------------------------------------------------------------------------- */

LMPI_INLINE void brdf_radiance(lmp_rgb rgb, texel_lanes radiance[TEXEL_PARTS]) {
    const float channels[3] = { rgb.r, rgb.g, rgb.b };
    float numbers[TEXEL_NUMBERS];
    for (int i = 0; i < TEXEL_NUMBERS; i++)
        numbers[i] = channels[TEXEL_NUMBER(i) % 3];
    memcpy(radiance, numbers, sizeof numbers);
}

/* Sums each channel over the columns. */
LMPI_INLINE void brdf_channels(const brdf_sums *sums, vf rgb[3]) {
    LMPI_ALIGNED float numbers[12][LMPI_LANES];
    for (int i = 0; i < 12; i += 4)
        layout_planes4(&sums->at[0][i], TEXEL_NUMBERS, numbers[TEXEL_NUMBER(i)]);
    for (int c = 0; c < 3; c++)
        rgb[c] = (vf_load(numbers[c]) + vf_load(numbers[3 + c])) +
                 (vf_load(numbers[6 + c]) + vf_load(numbers[9 + c]));
}

/* Adds ambient light. */
LMPI_INLINE void brdf_ambient(const brdf_block *block, lmp_rgb radiance, vf weight, vf rgb[3]) {
    rgb[0] = rgb[0] + radiance.r * weight * block->ambient[0];
    rgb[1] = rgb[1] + radiance.g * weight * block->ambient[1];
    rgb[2] = rgb[2] + radiance.b * weight * block->ambient[2];
}

/* Lights whose readings are located before any is summed; a surface's sums are added to its color
 * after each such group. */
#define BRDF_LIGHTS 16

/* Adds what a block reflects of `count` lights, and of `ambient` light. */
static LMPI_NOINLINE void brdf_lights(const lmpi_kernel_preintegrated_brdf *material,
                                      const brdf_block *block, const lmpi_packed_light *lights,
                                      texel_lanes (*radiance)[TEXEL_PARTS], size_t count,
                                      lmp_rgb ambient, size_t e, int live, float *const rgb[3]) {
    brdf_direction directions[BRDF_LIGHTS];
    brdf_position positions[BRDF_LIGHTS];
    brdf_sums sums;
    vf from_all[3] = { vf_set(0), vf_set(0), vf_set(0) }, from_caps[3];
    memset(&sums, 0, sizeof sums);
    brdf_ambient(block, ambient, vf_set(1), from_all);
    for (size_t i = 0; i < count; i++)
        brdf_direction_of(material, &lights[i], block, &directions[i]);
    for (size_t i = 0; i < count; i++)
        brdf_position_of(material, block, &directions[i], &positions[i]);
    for (size_t i = 0; i < count; i++) {
        brdf_slice slices[4];
        brdf_slices(material, block, &positions[i], slices);
        for (int k = 0; k < live; k++)
            brdf_read(material->texels, slices, k, radiance[i], sums.at[k]);
        if (__builtin_expect(directions[i].cap.is_ambient, 0))
            brdf_ambient(block, lights[i].color, directions[i].cap.ambient, from_all);
    }
    brdf_channels(&sums, from_caps);
    for (int c = 0; c < 3; c++)
        vf_store(rgb[c] + e, vf_load(rgb[c] + e) + (from_all[c] + from_caps[c]));
}

static void kernel_shade_preintegrated_brdf(const lmpi_kernel_preintegrated_brdf *material,
                                            const lmpi_kernel_surfaces *surfaces,
                                            const lmpi_packed_light *lights, size_t light_count,
                                            lmp_rgb ambient, size_t count, float *const rgb[3]) {
    texel_lanes radiance[LMPI_KERNEL_LIGHTS_MAX][TEXEL_PARTS];
    const lmp_rgb none = { 0, 0, 0 };
    const int plain = shade_are_plain(lights, light_count);
    for (size_t i = 0; i < light_count; i++)
        brdf_radiance(lights[i].color, radiance[i]);
    for (size_t e = 0; e < count; e += LMPI_LANES) {
        const int live = count - e < LMPI_LANES ? (int)(count - e) : LMPI_LANES;
        brdf_block block;
        block.plain = plain;
        brdf_block_load(material, surfaces, e, &block);
        size_t first = 0;
        do {
            const size_t left = light_count - first;
            brdf_lights(material, &block, lights + first, radiance + first,
                        left < BRDF_LIGHTS ? left : BRDF_LIGHTS, first == 0 ? ambient : none, e,
                        live, rgb);
            first += BRDF_LIGHTS;
        } while (first < light_count);
    }
}

#endif
