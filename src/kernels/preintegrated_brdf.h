/* SPDX-License-Identifier: MIT */
/* measured.h - what surfaces of one measured material reflect of many lights, read from its
 * response (lampion/preintegrated.h).
 *
 * Where a light is read is found with lanes that are surfaces; then, surface by surface, lanes are
 * texels: a row of a reading is four of them, twelve numbers side by side. */
#ifndef LAMPION_KERNELS_MEASURED_H
#define LAMPION_KERNELS_MEASURED_H

#include "src/kernels/preintegrated_lobe.h"

/* --- where ------------------------------------------------------------------------------------ */

/* What surfaces see: axes of the mirror direction's frame, z that direction and x in the plane of
 * incidence, on the side of the normal; and the first slice of the view before theirs. */
typedef struct brdf_block {
    vf point[3], x[3], y[3], z[3];
    vi slice;
    vf share; /* of the view after it */
    vf ambient[3];
} brdf_block;

/* A light's cap (u and v are not set), the angle from the mirror direction to its axis, and the
 * azimuth around it. */
typedef struct measured_aim {
    shade_aim cap;
    vf angle, azimuth;
} measured_aim;

/* Four slices a light: two views, of two caps each. Element e's four column weights are at
 * columns[e % 4][e / 4 * 4]; they hold the light's and the slice's weight. */
typedef struct brdf_slice {
    LMP_ALIGNED float columns[4][LMP_LANES];
    LMP_ALIGNED uint32_t rows[2][LMP_LANES];              /* weights of two rows each, in 16 bits */
    LMP_ALIGNED uint32_t from[LMP_LANES], row[LMP_LANES]; /* in numbers: three a texel */
} brdf_slice;

/* table[i] and table[i + step] */
LMP_INLINE void measured_neighbors(const float *table, vi i, int step, vf *low, vf *high) {
    int32_t at[LMP_LANES];
    float from[2][LMP_LANES];
    memcpy(at, &i, sizeof at);
    for (int e = 0; e < LMP_LANES; e++) {
        from[0][e] = table[at[e]];
        from[1][e] = table[at[e] + step];
    }
    *low = vf_load(from[0]);
    *high = vf_load(from[1]);
}

/* The slice coordinate at `share` of a warp, as the first of two slices and the second's share. */
LMP_INLINE vi measured_seek(const float *warp, uint32_t steps, uint32_t count, vf share,
                            vf *second) {
    const vf at = vf_min(vf_max(share, vf_set(0)), vf_set(1)) * (float)steps;
    const vi i = vi_from(vf_min(at, vf_set((float)(steps - 1))));
    vf low, high;
    measured_neighbors(warp, i, 1, &low, &high);
    const vf slice = low + (at - vf_from(i)) * (high - low);
    const vi first = vi_from(vf_min(slice, vf_set((float)(count - 2))));
    *second = slice - vf_from(first);
    return first;
}

/* acos(1 - y), y in 0 … 1. */
LMP_INLINE vf measured_angle(vf y) {
    return vf_sqrt(y) * LMP_ANGLE(1 - y);
}

/* The horizontal direction across the normal, for views along it. */
LMP_INLINE void measured_across(const vf n[3], vf x[3]) {
    const vf none = vf_set(0), one = vf_set(1), level2 = n[0] * n[0] + n[2] * n[2];
    const vf least = vf_set(1e-12f);
    x[0] = vf_select_less(least, level2, n[2], one);
    x[1] = none;
    x[2] = vf_select_less(least, level2, -n[0], none);
}

LMP_INLINE void measured_block_load(const lmp_kernel_preintegrated_brdf *material,
                                    const lmp_kernel_surfaces *surfaces, size_t e,
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
    measured_across(n, across);
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

    const vi view = measured_seek(material->view_remap, material->view_steps, material->view_count,
                                  measured_angle(1 - cosine) * (2 / LMP_KERNEL_PI), &block->share);
    block->slice = view * (int32_t)material->cap_count;
    for (int c = 0; c < 3; c++) {
        vf low, high;
        measured_neighbors(&material->ambient->r + c, 3 * view, 3, &low, &high);
        block->ambient[c] = low + block->share * (high - low);
    }
}

/* The axis from the mirror direction. */
LMP_INLINE void measured_aim_at(const lmp_kernel_preintegrated_brdf *material,
                                const lmp_kernel_light *light, size_t e, const brdf_block *block,
                                measured_aim *aim) {
    const vf zero = vf_set(0), one = vf_set(1);
    const cap_lanes cap = shade_cap(light, e, block->point, &aim->cap);
    const vf x = shade_dot(block->x, &cap) * cap.per_d, y = shade_dot(block->y, &cap) * cap.per_d;
    const vf z = shade_dot(block->z, &cap) * cap.per_d;
    const vf across2 = x * x + y * y, across = vf_sqrt(across2);
    /* 1 - |z| without cancellation */
    const vf near = measured_angle(vf_min(across2 / (1 + vf_max(z, -z)), one));
    aim->angle = vf_select_less(z, zero, LMP_KERNEL_PI - near, near);
    const vf side = vf_min(vf_max(x, -x) / across, one);
    const vf cosine = vf_select_less(zero, across, side, one);
    const vf quarter = measured_angle(1 - cosine);
    const vf half = vf_select_less(x, zero, LMP_KERNEL_PI - quarter, quarter);
    aim->azimuth =
        material->mirrored ? half : vf_select_less(y, zero, 2 * LMP_KERNEL_PI - half, half);
}

/* --- slices ----------------------------------------------------------------------------------- */

/* What the four slices of a light have in common. */
typedef struct measured_place {
    vf row, azimuth;    /* the row's coordinate but for density and origin */
    vi slice;           /* of the first view and the smaller cap */
    vf smaller, larger; /* the weights of both caps, times the light's */
} measured_place;

LMP_INLINE void measured_place_at(const lmp_kernel_preintegrated_brdf *material,
                                  const brdf_block *block, const measured_aim *aim,
                                  measured_place *place) {
    const float reach2 = material->reach * material->reach;
    const float radius = material->radius, radius2 = radius * radius;
    const vf t = aim->cap.t, a = measured_angle(t);
    const vf rim = a * a / (vf_sqrt(a * a + radius2) + radius), x = aim->angle - rim;
    place->row =
        x * (material->reach / (material->width * vf_sqrt(x * x + reach2)) + material->slope);
    place->azimuth = aim->azimuth;
    vf second;
    const vi cap = measured_seek(material->cap_remap, material->cap_steps, material->cap_count,
                                 a / (a + 0.5f) * ((LMP_KERNEL_PI + 1) / LMP_KERNEL_PI), &second);
    place->slice = block->slice + cap;
    /* mean over the cap = reading / (cap's + lobe's angle) */
    const vf covered = 2 * LMP_KERNEL_PI * t + material->lobe_angle;
    const vf weight = 2 * LMP_KERNEL_PI * aim->cap.weight / covered;
    place->larger = weight * second;
    place->smaller = weight - place->larger;
}

/* A slice of every lane: members in the order of lmp_kernel_slice. */
typedef struct slice_lanes {
    vi first, rows, columns;
    vf row_density, row_origin, column_density, unit;
} slice_lanes;

#if LMP_LANES > 1
/* Four words of lanes 0, 4, …, each at its own place. */
LMP_INLINE vf slice_quarters(const char *slices, const int32_t *at) {
    vf v;
#if LMP_LANES == 8
    v = (vf)_mm256_insertf128_ps(
        _mm256_castps128_ps256(_mm_loadu_ps((const float *)(const void *)(slices + at[0]))),
        _mm_loadu_ps((const float *)(const void *)(slices + at[4])), 1);
#else
    LMP_UNROLL for (int q = 0; q < LMP_LANES / 4; q++)
        memcpy((char *)&v + 16 * q, slices + at[4 * q], 16);
#endif
    return v;
}
#endif

/* at: bytes from `slices` on. */
LMP_INLINE void slice_lanes_load(const char *slices, const int32_t at[LMP_LANES],
                                 slice_lanes *lanes) {
#if LMP_LANES == 1
    lmp_kernel_slice one;
    memcpy(&one, slices + at[0], sizeof one);
    *lanes = (slice_lanes) { (vi)one.first,  (vi)one.rows,       (vi)one.columns, one.row_density,
                             one.row_origin, one.column_density, one.unit };
#else
    /* Its words 0 … 3, then 3 … 6. */
    vf low[4], high[4];
    for (int k = 0; k < 4; k++) {
        low[k] = slice_quarters(slices, at + k);
        high[k] = slice_quarters(slices + 12, at + k);
    }
    layout_transpose4(low);
    layout_transpose4(high);
    *lanes =
        (slice_lanes) { (vi)low[0], (vi)low[1], (vi)low[2], high[0], high[1], high[2], high[3] };
#endif
}

/* The whole part of a coordinate, which leaves a neighbor before and two after among `count`; the
 * spline's weights, times 6, of what is past it. */
LMP_INLINE vi slice_spline(vf at, vi count, vf weights[4]) {
    const vf zero = vf_set(0), one = vf_set(1), most = vf_from(count - 3);
    const vi base = vi_from(vf_min(vf_max(at, one), most));
    spline_weights(vf_min(vf_max(at - vf_from(base), zero), one), weights);
    return base;
}

LMP_INLINE void slice_aim(const char *slices, const int32_t at[LMP_LANES],
                          const measured_place *place, vf weight, brdf_slice *to) {
    slice_lanes lanes;
    vf down[4], across[4];
    slice_lanes_load(slices, at, &lanes);
    const vi row =
        slice_spline(place->row * lanes.row_density - lanes.row_origin, lanes.rows, down);
    const vi column =
        slice_spline(place->azimuth * lanes.column_density + 1, lanes.columns, across);
    const vi texel = lanes.first + (row - 1) * lanes.columns + (column - 1);
    const vi from = 3 * texel, step = 3 * lanes.columns;
    const vf scale = weight * lanes.unit * (1 / (6 * SPLINE_ONE));
    vi whole[4];
    for (int k = 0; k < 4; k++) {
        whole[k] = vi_from(down[k] * (SPLINE_ONE / 6) + 0.5f);
        across[k] = across[k] * scale;
    }
    const vi upper = whole[0] | whole[1] << 16, lower = whole[2] | whole[3] << 16;
#if LMP_LANES > 1
    layout_transpose4(across);
#endif
    memcpy(to->columns, across, sizeof to->columns);
    memcpy(to->rows[0], &upper, sizeof upper);
    memcpy(to->rows[1], &lower, sizeof lower);
    memcpy(to->from, &from, sizeof from);
    memcpy(to->row, &step, sizeof step);
}

LMP_INLINE void brdf_slices(const lmp_kernel_preintegrated_brdf *material, const brdf_block *block,
                            const measured_place *place, brdf_slice to[4]) {
    const vf beyond = block->share, before = 1 - beyond;
    const vf weights[4] = { before * place->smaller, before * place->larger,
                            beyond * place->smaller, beyond * place->larger };
    const size_t caps = material->cap_count, size = sizeof(lmp_kernel_slice);
    const vi offset = place->slice * (int32_t)size;
    int32_t at[LMP_LANES];
    memcpy(at, &offset, sizeof at);
    const char *slices = material->slices;
    LMP_ROLLED for (size_t s = 0; s < 4; s++)
        slice_aim(slices + (s / 2 * caps + s % 2) * size, at, place, weights[s], &to[s]);
}

/* --- readings --------------------------------------------------------------------------------- */

/* Four texels: TEXEL_PARTS registers of TEXEL_LANES. TEXEL_NUMBER(i) is the number of a row that is
 * number i of them; 12 and up are the next texel's and mean nothing. */
#if LMP_LANES >= 8
#define TEXEL_PARTS     2
#define TEXEL_LANES     8
#define TEXEL_NUMBER(i) ((i) < 4 ? (i) : (i) < 8 ? (i) + 4 : (i) < 12 ? (i)-4 : (i))
typedef float texel_lanes __attribute__((vector_size(32)));
#elif LMP_LANES == 4
#define TEXEL_PARTS     3
#define TEXEL_LANES     4
#define TEXEL_NUMBER(i) (i)
typedef vf texel_lanes;
#else
#define TEXEL_PARTS     12
#define TEXEL_LANES     1
#define TEXEL_NUMBER(i) (i)
typedef float texel_lanes;
#endif
#define TEXEL_NUMBERS (TEXEL_PARTS * TEXEL_LANES)

/* Four rows' texels, weighted: integers, whose sums are exact, so that every build agrees. */
#if LMP_LANES >= 8
LMP_INLINE __m256i texel_row(const int16_t *from) {
    return _mm256_loadu_si256((const __m256i *)(const void *)from);
}
LMP_INLINE void texel_rows(const int16_t *from, size_t row, const uint32_t weights[2],
                           texel_lanes sums[TEXEL_PARTS]) {
    const __m256i a = texel_row(from), b = texel_row(from + row);
    const __m256i c = texel_row(from + 2 * row), d = texel_row(from + 3 * row);
    const __m256i ab = _mm256_set1_epi32((int)weights[0]), cd = _mm256_set1_epi32((int)weights[1]);
    const __m256i low = _mm256_add_epi32(_mm256_madd_epi16(_mm256_unpacklo_epi16(a, b), ab),
                                         _mm256_madd_epi16(_mm256_unpacklo_epi16(c, d), cd));
    const __m256i high = _mm256_add_epi32(_mm256_madd_epi16(_mm256_unpackhi_epi16(a, b), ab),
                                          _mm256_madd_epi16(_mm256_unpackhi_epi16(c, d), cd));
    sums[0] = (texel_lanes)_mm256_cvtepi32_ps(low);
    sums[1] = (texel_lanes)_mm256_cvtepi32_ps(high);
}
LMP_INLINE void texel_columns(const float *weights, texel_lanes columns[TEXEL_PARTS]) {
    const __m256 four = _mm256_broadcast_ps((const __m128 *)(const void *)weights);
    columns[0] = (texel_lanes)_mm256_permutevar_ps(four, _mm256_setr_epi32(0, 0, 0, 1, 2, 3, 3, 3));
    columns[1] = (texel_lanes)_mm256_permutevar_ps(four, _mm256_setr_epi32(1, 1, 2, 2, 0, 0, 0, 0));
}
#elif LMP_LANES == 4 && defined(__SSE2__)
LMP_INLINE void texel_pair(const int16_t *from, size_t row, uint32_t weights, __m128i sums[3]) {
    const __m128i both = _mm_set1_epi32((int)weights);
    const __m128i a = _mm_loadu_si128((const __m128i *)(const void *)from);
    const __m128i b = _mm_loadu_si128((const __m128i *)(const void *)(from + row));
    const __m128i a8 = _mm_loadl_epi64((const __m128i *)(const void *)(from + 8));
    const __m128i b8 = _mm_loadl_epi64((const __m128i *)(const void *)(from + row + 8));
    sums[0] = _mm_madd_epi16(_mm_unpacklo_epi16(a, b), both);
    sums[1] = _mm_madd_epi16(_mm_unpackhi_epi16(a, b), both);
    sums[2] = _mm_madd_epi16(_mm_unpacklo_epi16(a8, b8), both);
}
LMP_INLINE void texel_rows(const int16_t *from, size_t row, const uint32_t weights[2],
                           texel_lanes sums[TEXEL_PARTS]) {
    __m128i upper[3], lower[3];
    texel_pair(from, row, weights[0], upper);
    texel_pair(from + 2 * row, row, weights[1], lower);
    LMP_UNROLL for (int i = 0; i < 3; i++) sums[i] =
        (texel_lanes)_mm_cvtepi32_ps(_mm_add_epi32(upper[i], lower[i]));
}
#else
LMP_INLINE void texel_rows(const int16_t *from, size_t row, const uint32_t weights[2],
                           texel_lanes sums[TEXEL_PARTS]) {
    int32_t totals[TEXEL_NUMBERS] = { 0 };
    for (int k = 0; k < 4; k++, from += row) {
        const int32_t weight = (int32_t)(weights[k / 2] >> 16 * (k % 2) & 0xffff);
        for (int i = 0; i < TEXEL_NUMBERS; i++)
            totals[i] += weight * from[i];
    }
    for (int i = 0; i < TEXEL_PARTS; i++) {
        vi part;
        memcpy(&part, totals + TEXEL_LANES * i, sizeof part);
        sums[i] = vf_from(part);
    }
}
#endif
#if LMP_LANES == 4
LMP_INLINE void texel_columns(const float *weights, texel_lanes columns[TEXEL_PARTS]) {
    const vf four = vf_load(weights);
    columns[0] = LMP_SHUFFLE(four, four, 0, 0, 0, 1);
    columns[1] = LMP_SHUFFLE(four, four, 1, 1, 2, 2);
    columns[2] = LMP_SHUFFLE(four, four, 2, 3, 3, 3);
}
#elif LMP_LANES == 1
LMP_INLINE void texel_columns(const float *weights, texel_lanes columns[TEXEL_PARTS]) {
    for (int i = 0; i < 12; i++)
        columns[i] = weights[i / 3];
}
#endif

/* What surfaces gather: the twelve numbers' sums over the lights. */
typedef struct brdf_sums {
    LMP_ALIGNED float at[LMP_LANES][TEXEL_NUMBERS];
} brdf_sums;

/* Adds one light's part to surface e's; radiance: its red, green, blue, as the numbers lie. */
LMP_INLINE void measured_read(const int16_t *texels, const brdf_slice slices[4], int e,
                              const texel_lanes radiance[TEXEL_PARTS], float *sums) {
    texel_lanes total[TEXEL_PARTS], sum[TEXEL_PARTS];
    LMP_UNROLL for (int s = 0; s < 4; s++) {
        const brdf_slice *slice = &slices[s];
        const uint32_t rows[2] = { slice->rows[0][e], slice->rows[1][e] };
        texel_lanes values[TEXEL_PARTS], columns[TEXEL_PARTS];
        texel_rows(texels + slice->from[e], slice->row[e], rows, values);
        texel_columns(&slice->columns[e % 4][e / 4 * 4], columns);
        LMP_UNROLL for (int i = 0; i < TEXEL_PARTS; i++) {
            const texel_lanes value = columns[i] * values[i];
            total[i] = s == 0 ? value : total[i] + value;
            LMP_OPAQUE_LANES(total[i]);
        }
    }
    memcpy(sum, sums, sizeof sum);
    LMP_UNROLL for (int i = 0; i < TEXEL_PARTS; i++) sum[i] = sum[i] + radiance[i] * total[i];
    memcpy(sums, sum, sizeof sum);
}

/* --- surfaces --------------------------------------------------------------------------------- */

LMP_INLINE void measured_radiance(lmp_rgb rgb, texel_lanes radiance[TEXEL_PARTS]) {
    const float channels[3] = { rgb.r, rgb.g, rgb.b };
    float numbers[TEXEL_NUMBERS];
    for (int i = 0; i < TEXEL_NUMBERS; i++)
        numbers[i] = channels[TEXEL_NUMBER(i) % 3];
    memcpy(radiance, numbers, sizeof numbers);
}

/* The sums over the columns, of every channel. */
LMP_INLINE void measured_channels(const brdf_sums *sums, vf rgb[3]) {
    LMP_ALIGNED float numbers[12][LMP_LANES];
    for (int i = 0; i<12; i += LMP_LANES> 1 ? 4 : 1)
#if LMP_LANES > 1
        layout_planes4(&sums->at[0][i], TEXEL_NUMBERS, numbers[TEXEL_NUMBER(i)]);
#else
        numbers[i][0] = sums->at[0][i];
#endif
    for (int c = 0; c < 3; c++)
        rgb[c] = (vf_load(numbers[c]) + vf_load(numbers[3 + c])) +
                 (vf_load(numbers[6 + c]) + vf_load(numbers[9 + c]));
}

/* The light from all around. */
LMP_INLINE void measured_ambient(const brdf_block *block, lmp_rgb radiance, vf weight, vf rgb[3]) {
    rgb[0] = rgb[0] + radiance.r * weight * block->ambient[0];
    rgb[1] = rgb[1] + radiance.g * weight * block->ambient[1];
    rgb[2] = rgb[2] + radiance.b * weight * block->ambient[2];
}

static void kernel_shade_measured(const lmp_kernel_preintegrated_brdf *material,
                                  const lmp_kernel_surfaces *surfaces,
                                  const lmp_kernel_light *lights, size_t light_count,
                                  lmp_rgb ambient, size_t count, float *const rgb[3]) {
    measured_aim aims[LMP_KERNEL_LIGHTS_MAX];
    measured_place places[LMP_KERNEL_LIGHTS_MAX];
    texel_lanes radiance[LMP_KERNEL_LIGHTS_MAX][TEXEL_PARTS];
    for (size_t i = 0; i < light_count; i++)
        measured_radiance(lights[i].radiance, radiance[i]);
    for (size_t e = 0; e < count; e += LMP_LANES) {
        const int live = count - e < LMP_LANES ? (int)(count - e) : LMP_LANES;
        brdf_block block;
        brdf_sums sums;
        vf from_all[3] = { vf_set(0), vf_set(0), vf_set(0) }, from_caps[3];
        memset(&sums, 0, sizeof sums);
        measured_block_load(material, surfaces, e, &block);
        measured_ambient(&block, ambient, vf_set(1), from_all);
        for (size_t i = 0; i < light_count; i++)
            measured_aim_at(material, &lights[i], e, &block, &aims[i]);
        for (size_t i = 0; i < light_count; i++)
            measured_place_at(material, &block, &aims[i], &places[i]);
        for (size_t i = 0; i < light_count; i++) {
            brdf_slice slices[4];
            brdf_slices(material, &block, &places[i], slices);
            for (int k = 0; k < live; k++)
                measured_read(material->texels, slices, k, radiance[i], sums.at[k]);
            if (__builtin_expect(aims[i].cap.everywhere, 0))
                measured_ambient(&block, lights[i].radiance, aims[i].cap.ambient, from_all);
        }
        measured_channels(&sums, from_caps);
        for (int c = 0; c < 3; c++)
            vf_store(rgb[c] + e, vf_load(rgb[c] + e) + (from_all[c] + from_caps[c]));
    }
}

#endif
