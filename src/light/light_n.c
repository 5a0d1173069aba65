/* SPDX-License-Identifier: MIT */
/* light_n.c - lights of any kind at many points. To the kernel, lights with a position are spheres
 * and Diracs, copied a group per call. Others are the same cap from everywhere: their coefficients
 * are computed once for a chunk of points. Areas are projected point by point. */
#define LMPI_BATCH 64

#include "src/kernels/batch.h"
#include "src/kernels/dispatch.h"
#include "src/light/cap.h"
#include "src/light/packed.h"
#include "src/light/seen.h"
#include "src/light/valid.h"
#include "src/sh/layout.h"

#include <lampion/light.h>

_Static_assert(LMP_LIGHT_GROUP <= LMPI_KERNEL_LIGHTS_MAX, "a group is a call");

/* Points whose factors are computed together. */
enum { BLOCK = LMPI_KERNEL_LANES_MAX };

/* --- lights that stand somewhere -------------------------------------------------------------- */

/* A group of lights as the kernel reads them, and their indices among the caller's. */
typedef struct light_group {
    float center[3][LMP_LIGHT_GROUP], radius[LMP_LIGHT_GROUP], rgb[3][LMP_LIGHT_GROUP];
    unsigned at[LMP_LIGHT_GROUP];
    size_t count;
    bool has_cones;
} light_group;

/* The arguments of a call. */
typedef struct light_call {
    const lmp_scratch *scratch;
    int bands;
    const lmp_light *lights;
    size_t light_count;
    const float *visibility; /* of the chunk's first point; NULL means 1 everywhere */
    size_t visibility_stride;
} light_call;

/* Takes as many lights from light i on as fit the group; returns the index of the next one. */
static size_t take_group(const light_call *call, size_t i, light_group *group) {
    group->count = 0;
    group->has_cones = false;
    for (; i < call->light_count && group->count < LMP_LIGHT_GROUP; i++) {
        const lmp_light *light = &call->lights[i];
        lmpi_packed_light packed;
        if (lmpi_light_is_fixed(light) || lmpi_light_is_area(light))
            continue;
        lmpi_light_pack(light, &packed);
        const size_t k = group->count++;
        group->at[k] = (unsigned)i;
        group->center[0][k] = packed.at.x;
        group->center[1][k] = packed.at.y;
        group->center[2][k] = packed.at.z;
        group->radius[k] = packed.size;
        group->rgb[0][k] = packed.color.r;
        group->rgb[1][k] = packed.color.g;
        group->rgb[2][k] = packed.color.b;
        group->has_cones |= packed.form == LMPI_FORM_CONE;
    }
    return i;
}

/* Computes a plane of factors per light of the group, for `count` points of the chunk from `first`
 * on. */
static void take_factors(const light_call *call, const light_group *group,
                         const lmpi_kernel_vec3 *points, size_t first, size_t count,
                         float (*factors)[BLOCK]) {
    for (size_t k = 0; k < group->count; k++) {
        const lmp_light *light = &call->lights[group->at[k]];
        for (size_t p = 0; p < BLOCK; p++)
            factors[k][p] = 1;
        if (call->visibility)
            memcpy(factors[k], call->visibility + group->at[k] * call->visibility_stride + first,
                   count * sizeof *factors[k]);
        if (lmpi_light_form_of(light) == LMPI_FORM_CONE) {
            lmpi_packed_light cone;
            lmpi_light_pack(light, &cone);
            lmpi_kernels_get()->light.cone(&cone, points, count, factors[k]);
        }
    }
}

/* Sums lights by the kernel that overwrites, or by the one that adds. */
static void sum_lights(const light_call *call, const lmpi_kernel_lights *lights,
                       const lmpi_kernel_vec3 *points, size_t count, bool adds,
                       const lmpi_kernel_out *out) {
    const lmpi_kernels *kernels = lmpi_kernels_get();
    if (adds)
        kernels->light.accumulate_more(call->scratch, call->bands, lights, points, count, out);
    else
        kernels->light.accumulate(call->scratch, call->bands, lights, points, count, out);
}

static void sum_group(const light_call *call, const light_group *group,
                      const lmpi_kernel_vec3 *points, size_t count, bool adds,
                      const lmpi_kernel_out *out) {
    lmpi_kernel_lights lights = {
        .center = { group->center[0], group->center[1], group->center[2], sizeof(float) },
        .radius = { group->radius, sizeof(float) },
        .radiance = { group->rgb[0], group->rgb[1], group->rgb[2], sizeof(float) },
        .count = group->count
    };
    float factors[LMP_LIGHT_GROUP][BLOCK];
    if (!group->has_cones && !call->visibility) {
        sum_lights(call, &lights, points, count, adds, out);
        return;
    }
    lights.visibility = factors[0];
    lights.visibility_stride = BLOCK;
    for (size_t first = 0; first < count; first += BLOCK) {
        const size_t n = count - first < BLOCK ? count - first : BLOCK;
        const lmpi_kernel_vec3 at = { points->x + first, points->y + first, points->z + first };
        lmpi_kernel_out to = *out;
        to.at += out->planar ? first : first * out->stride;
        take_factors(call, group, &at, first, n, factors);
        sum_lights(call, &lights, &at, n, adds, &to);
    }
}

/* --- lights that are alike from everywhere ---------------------------------------------------- */

/* Coefficients of a channel that are computed together. */
enum { TOGETHER = 1024 };

/* Adds bands low … high-1 of three channels, stored one after the other. */
static void add_bands(int bands, int low, int high, const float *sh, const float *factors,
                      size_t count, const lmpi_kernel_out *out) {
    const size_t all = LMP_SH_COUNT(bands), before = LMP_SH_COUNT(low);
    const size_t values = LMP_SH_COUNT(high) - before;
    if (values == all) {
        lmpi_kernels_get()->light.add(sh, 0, 3 * all, factors, count, out);
        return;
    }
    for (size_t c = 0; c < 3; c++)
        lmpi_kernels_get()->light.add(sh + c * values, c * all + before, values, factors, count,
                                      out);
}

/* Adds what is seen of a light, the same from each of `count` points. */
static void add_seen(int bands, const lmpi_seen *seen, const float *factors, size_t count,
                     const lmpi_kernel_out *out) {
    float sh[3 * TOGETHER];
    for (int low = 0, high; low < bands; low = high) {
        high = low + 1;
        while (high < bands && LMP_SH_COUNT(high + 1) - LMP_SH_COUNT(low) <= TOGETHER)
            high++;
        const size_t values = LMP_SH_COUNT(high) - LMP_SH_COUNT(low);
        float *const planes[3] = { sh, sh + values, sh + 2 * values };
        memset(sh, 0, 3 * values * sizeof *sh);
        lmpi_seen_add(low, high, seen, planes);
        add_bands(bands, low, high, sh, factors, count, out);
    }
}

static void add_area(const light_call *call, const lmp_light *light, const float *factors,
                     const lmpi_kernel_vec3 *points, size_t count, const lmpi_kernel_out *out) {
    lmpi_area area;
    lmpi_area_prepare(light, &area);
    for (size_t p = 0; p < count; p++) {
        const lmpi_kernel_out to = lmpi_batch_from(out, p);
        lmpi_seen seen;
        lmpi_area_see(&area, lmpi_batch_get(points, p), &seen);
        lmpi_seen_close(&seen);
        add_seen(call->bands, &seen, factors + p, 1, &to);
    }
}

/* Adds the lights that are not in groups. */
static LMPI_NOINLINE void add_one_by_one(const light_call *call, const lmpi_kernel_vec3 *points,
                                         size_t count, const lmpi_kernel_out *out) {
    float ones[LMPI_BATCH];
    for (size_t p = 0; p < LMPI_BATCH; p++)
        ones[p] = 1;
    for (size_t i = 0; i < call->light_count; i++) {
        const lmp_light *light = &call->lights[i];
        const float *factors =
            call->visibility ? call->visibility + i * call->visibility_stride : ones;
        if (lmpi_light_is_area(light)) {
            add_area(call, light, factors, points, count, out);
        } else if (lmpi_light_is_fixed(light)) {
            lmpi_seen seen;
            lmpi_light_see(light, (lmp_vec3) { 0, 0, 0 }, &seen);
            add_seen(call->bands, &seen, factors, count, out);
        }
    }
}

/* --- all -------------------------------------------------------------------------------------- */

/* Sums spheres, which are read where the caller keeps them. */
static void sum_spheres(const light_call *call, const lmpi_kernel_vec3 *points, size_t count,
                        bool adds, const lmpi_kernel_out *out) {
    const lmp_spheres spheres = lmp_spheres_of(call->lights);
    const lmpi_kernel_lights lights = { .center = spheres.center,
                                        .radius = spheres.radius,
                                        .radiance = spheres.radiance,
                                        .count = call->light_count,
                                        .visibility = call->visibility,
                                        .visibility_stride = call->visibility_stride };
    sum_lights(call, &lights, points, count, adds, out);
}

static void sum_any(const light_call *call, const lmpi_kernel_vec3 *points, size_t count, bool adds,
                    const lmpi_kernel_out *out) {
    light_group group;
    size_t i = 0;
    do {
        i = take_group(call, i, &group);
        if (group.count > 0 || !adds)
            sum_group(call, &group, points, count, adds, out);
        adds = true;
    } while (i < call->light_count);
    add_one_by_one(call, points, count, out);
}

static void sum_chunks(const lmp_scratch *scratch, int bands, const lmp_light *lights,
                       size_t light_count, const float *visibility, lmp_vec3_array points,
                       size_t point_count, bool adds, lmp_sh_array sh) {
    const size_t values = 3 * LMP_SH_COUNT(bands);
    assert(lmpi_is_bands(bands) && lmpi_is_scratch(scratch) &&
           lmpi_are_lights(lights, light_count));
    assert(lmpi_is_sh_array(sh, values, point_count));
    assert(lmpi_are_finite(points, point_count));
    light_call call = { scratch, bands, lights, light_count, visibility, point_count };
    const bool spheres = lmpi_are_all_spheres(lights, light_count);
    /* For one point, planes side by side form a row, which is written in whole registers. */
    if (point_count == 1 && lmpi_batch_stride(sh.stride, 1) == 1)
        sh.layout = LMP_SH_INTERLEAVED;
    lmpi_batch_room room;
    for (size_t first = 0; first < point_count; first += LMPI_BATCH) {
        const size_t n = lmpi_batch_count(point_count, first);
        const lmpi_kernel_vec3 at = lmpi_batch_vectors(&points, first, n, lmpi_batch_in(&room));
        const lmpi_kernel_out out = lmpi_sh_array_from(sh, values, point_count, first);
        if (visibility)
            call.visibility = visibility + first;
        if (spheres)
            sum_spheres(&call, &at, n, adds, &out);
        else
            sum_any(&call, &at, n, adds, &out);
    }
}

void lmp_light_project_n(const lmp_scratch *scratch, int bands, const lmp_light *lights,
                         size_t light_count, const float *visibility, lmp_vec3_array points,
                         size_t point_count, lmp_sh_array sh) {
    sum_chunks(scratch, bands, lights, light_count, visibility, points, point_count, false, sh);
}

void lmp_light_add_n(const lmp_scratch *scratch, int bands, const lmp_light *lights,
                     size_t light_count, const float *visibility, lmp_vec3_array points,
                     size_t point_count, lmp_sh_array sh) {
    sum_chunks(scratch, bands, lights, light_count, visibility, points, point_count, true, sh);
}
