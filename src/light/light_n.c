/* SPDX-License-Identifier: MIT */
/* light_n.c - lights of any kind at many points. Those that stand somewhere are spheres and Diracs
 * to the kernel, a group of them a call, copied to what it reads; the others are the same cap from
 * everywhere: coefficients that are found once for a chunk of points. */
#define LMP_BATCH 64

#include "src/kernels/batch.h"
#include "src/light/cap.h"
#include "src/light/packed.h"
#include "src/sh/layout.h"

#include <lampion/light.h>

_Static_assert(LMP_LIGHT_GROUP <= LMP_KERNEL_LIGHTS_MAX, "a group is a call");

/* Points whose factors are made together. */
enum { BLOCK = LMP_KERNEL_LANES_MAX };

/* --- lights that stand somewhere -------------------------------------------------------------- */

/* As the kernel reads them, and which of the caller's they are. */
typedef struct light_group {
    float center[3][LMP_LIGHT_GROUP], radius[LMP_LIGHT_GROUP], rgb[3][LMP_LIGHT_GROUP];
    unsigned at[LMP_LIGHT_GROUP];
    size_t count;
    bool has_cones;
} light_group;

/* What a call is about. */
typedef struct light_call {
    const lmp_scratch *scratch;
    int bands;
    const lmp_light *lights;
    size_t light_count;
    const float *visibility; /* of the chunk's first point; NULL: all 1 */
    size_t visibility_stride;
} light_call;

/* Takes lights from light i on, as many as find room, and returns which is the next. */
static size_t take_group(const light_call *call, size_t i, light_group *group) {
    group->count = 0;
    group->has_cones = false;
    for (; i < call->light_count && group->count < LMP_LIGHT_GROUP; i++) {
        const lmp_light *light = &call->lights[i];
        lmp_packed_light packed;
        if (lmp_light_is_fixed(light))
            continue;
        lmp_light_pack(light, &packed);
        const size_t k = group->count++;
        group->at[k] = (unsigned)i;
        group->center[0][k] = packed.at.x;
        group->center[1][k] = packed.at.y;
        group->center[2][k] = packed.at.z;
        group->radius[k] = packed.size;
        group->rgb[0][k] = packed.color.r;
        group->rgb[1][k] = packed.color.g;
        group->rgb[2][k] = packed.color.b;
        group->has_cones |= packed.form == LMP_FORM_CONE;
    }
    return i;
}

/* A plane of factors a light of the group, for `count` points from `first` of the chunk on. */
static void take_factors(const light_call *call, const light_group *group,
                         const lmp_kernel_vec3 *points, size_t first, size_t count,
                         float (*factors)[BLOCK]) {
    for (size_t k = 0; k < group->count; k++) {
        const lmp_light *light = &call->lights[group->at[k]];
        for (size_t p = 0; p < BLOCK; p++)
            factors[k][p] = 1;
        if (call->visibility)
            memcpy(factors[k], call->visibility + group->at[k] * call->visibility_stride + first,
                   count * sizeof *factors[k]);
        if (lmp_light_form_of(light) == LMP_FORM_CONE) {
            lmp_packed_light cone;
            lmp_light_pack(light, &cone);
            lmp_kernels_get()->cone(&cone, points, count, factors[k]);
        }
    }
}

/* The kernel that writes, or the one that adds. */
static void sum_lights(const light_call *call, const lmp_kernel_lights *lights,
                       const lmp_kernel_vec3 *points, size_t count, bool adds,
                       const lmp_kernel_out *out) {
    const lmp_kernels *kernels = lmp_kernels_get();
    if (adds)
        kernels->accumulate_more(call->scratch, call->bands, lights, points, count, out);
    else
        kernels->accumulate(call->scratch, call->bands, lights, points, count, out);
}

static void sum_group(const light_call *call, const light_group *group,
                      const lmp_kernel_vec3 *points, size_t count, bool adds,
                      const lmp_kernel_out *out) {
    lmp_kernel_lights lights = {
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
        const lmp_kernel_vec3 at = { points->x + first, points->y + first, points->z + first };
        lmp_kernel_out to = *out;
        to.at += out->planar ? first : first * out->stride;
        take_factors(call, group, &at, first, n, factors);
        sum_lights(call, &lights, &at, n, adds, &to);
    }
}

/* --- lights that are alike from everywhere ---------------------------------------------------- */

/* Coefficients of a channel that are found together. */
enum { TOGETHER = 1024 };

/* Adds bands low … high-1 of three channels, which follow one another. */
static void add_bands(int bands, int low, int high, const float *sh, const float *factors,
                      size_t count, const lmp_kernel_out *out) {
    const size_t all = LMP_SH_COUNT(bands), before = LMP_SH_COUNT(low);
    const size_t values = LMP_SH_COUNT(high) - before;
    if (values == all) {
        lmp_kernels_get()->add(sh, 0, 3 * all, factors, count, out);
        return;
    }
    for (size_t c = 0; c < 3; c++)
        lmp_kernels_get()->add(sh + c * values, c * all + before, values, factors, count, out);
}

static void add_alike(int bands, const lmp_light *light, const float *factors, size_t count,
                      const lmp_kernel_out *out) {
    float sh[3 * TOGETHER];
    lmp_cap cap;
    lmp_light_cap(light, (lmp_vec3) { 0, 0, 0 }, &cap);
    for (int low = 0, high; low < bands; low = high) {
        high = low + 1;
        while (high < bands && LMP_SH_COUNT(high + 1) - LMP_SH_COUNT(low) <= TOGETHER)
            high++;
        const size_t values = LMP_SH_COUNT(high) - LMP_SH_COUNT(low);
        float *const planes[3] = { sh, sh + values, sh + 2 * values };
        memset(sh, 0, 3 * values * sizeof *sh);
        lmp_cap_add(low, high, &cap, planes);
        add_bands(bands, low, high, sh, factors, count, out);
    }
}

static LMP_NOINLINE void add_all_alike(const light_call *call, size_t count,
                                       const lmp_kernel_out *out) {
    float ones[LMP_BATCH];
    for (size_t p = 0; p < LMP_BATCH; p++)
        ones[p] = 1;
    for (size_t i = 0; i < call->light_count; i++)
        if (lmp_light_is_fixed(&call->lights[i]))
            add_alike(call->bands, &call->lights[i],
                      call->visibility ? call->visibility + i * call->visibility_stride : ones,
                      count, out);
}

/* --- all -------------------------------------------------------------------------------------- */

static bool are_spheres(const lmp_light *lights, size_t count) {
    bool all = true;
    for (size_t i = 0; i < count; i++)
        all &= lmp_light_form_of(&lights[i]) == LMP_FORM_SPHERE;
    return all;
}

/* Spheres alone are read where they are. */
static void sum_spheres(const light_call *call, const lmp_kernel_vec3 *points, size_t count,
                        bool adds, const lmp_kernel_out *out) {
    const lmp_spheres spheres = lmp_spheres_of(call->lights);
    const lmp_kernel_lights lights = { .center = spheres.center,
                                       .radius = spheres.radius,
                                       .radiance = spheres.radiance,
                                       .count = call->light_count,
                                       .visibility = call->visibility,
                                       .visibility_stride = call->visibility_stride };
    sum_lights(call, &lights, points, count, adds, out);
}

static void sum_any(const light_call *call, const lmp_kernel_vec3 *points, size_t count, bool adds,
                    const lmp_kernel_out *out) {
    light_group group;
    size_t i = 0;
    do {
        i = take_group(call, i, &group);
        if (group.count > 0 || !adds)
            sum_group(call, &group, points, count, adds, out);
        adds = true;
    } while (i < call->light_count);
    add_all_alike(call, count, out);
}

static void sum_chunks(const lmp_scratch *scratch, int bands, const lmp_light *lights,
                       size_t light_count, const float *visibility, lmp_vec3_array points,
                       size_t point_count, bool adds, lmp_sh_layout layout, size_t stride,
                       float *sh) {
    const size_t values = 3 * LMP_SH_COUNT(bands);
    assert(lmp_is_bands(bands) && lmp_is_scratch(scratch) && lmp_are_lights(lights, light_count));
    assert(lmp_is_layout(layout, stride, values, point_count));
    assert(lmp_are_finite(points, point_count));
    light_call call = { scratch, bands, lights, light_count, visibility, point_count };
    const bool spheres = are_spheres(lights, light_count);
    lmp_batch_room room;
    for (size_t first = 0; first < point_count; first += LMP_BATCH) {
        const size_t n = lmp_batch_count(point_count, first);
        const lmp_kernel_vec3 at = lmp_batch_vectors(&points, first, n, lmp_batch_in(&room));
        const lmp_kernel_out out =
            lmp_batch_out(sh, values, point_count, layout == LMP_SH_PLANAR, stride, first);
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
                         size_t point_count, lmp_sh_layout layout, size_t stride, float *sh) {
    sum_chunks(scratch, bands, lights, light_count, visibility, points, point_count, false, layout,
               stride, sh);
}

void lmp_light_add_n(const lmp_scratch *scratch, int bands, const lmp_light *lights,
                     size_t light_count, const float *visibility, lmp_vec3_array points,
                     size_t point_count, lmp_sh_layout layout, size_t stride, float *sh) {
    sum_chunks(scratch, bands, lights, light_count, visibility, points, point_count, true, layout,
               stride, sh);
}
