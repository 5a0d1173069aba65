/* SPDX-License-Identifier: MIT */
/* project.c - lights at one point, by what is fastest for their number and kinds. */
#define LMPI_BATCH 64

#include "src/base/unroll.h"
#include "src/kernels/dispatch.h"
#include "src/light/cap.h"
#include "src/light/packed.h"
#include "src/light/valid.h"
#include "src/sh/layout.h"

#include <lampion/light.h>

#include <math.h>
#include <string.h>

/* The number of lights from which on summing them side by side is faster than one after another. */
enum { MANY = 4 };

/* --- lights of several kinds side by side ----------------------------------------------------- */

/* Spheres and Diracs around the origin, which the kernel sums; and what is ambient. */
typedef struct light_stand_ins {
    float center[3][LMP_LIGHT_GROUP], radius[LMP_LIGHT_GROUP], rgb[3][LMP_LIGHT_GROUP];
    size_t count;
    lmp_rgb ambient;
} light_stand_ins;

/* The widest cap, as 1 - cos of its half angle, for which a sphere stands in: a sphere's cosine
 * comes from the square of the sine, and loses digits where it is small. */
#define WIDEST_SPHERE 0.5f

static float square_of(lmp_vec3 v) {
    return v.x * v.x + v.y * v.y + v.z * v.z;
}

static void stand(lmp_vec3 center, float radius, lmp_rgb color, float factor, light_stand_ins *to) {
    const size_t k = to->count++;
    to->center[0][k] = center.x;
    to->center[1][k] = center.y;
    to->center[2][k] = center.z;
    to->radius[k] = radius;
    to->rgb[0][k] = color.r * factor;
    to->rgb[1][k] = color.g * factor;
    to->rgb[2][k] = color.b * factor;
}

/* Whether a packed light is a cap for which no sphere stands in. */
static bool is_wide(const lmpi_packed_light *packed) {
    return packed->form == LMPI_FORM_CAP && !(packed->size <= WIDEST_SPHERE);
}

/* Puts a sphere or a Dirac that looks the same from the origin as the light from the point; returns
 * false for a wide cap. */
static bool stand_in(const lmp_light *light, lmp_vec3 point, light_stand_ins *to) {
    lmpi_packed_light packed;
    lmpi_light_pack(light, &packed);
    const lmp_vec3 at = packed.at;
    if (is_wide(&packed))
        return false;
    if (packed.form == LMPI_FORM_CAP) {
        const float t = packed.size;
        stand(at, sqrtf(t * (2 - t) * square_of(at)), packed.color, 1, to);
        to->ambient.r += packed.ambient.r;
        to->ambient.g += packed.ambient.g;
        to->ambient.b += packed.ambient.b;
        return true;
    }
    if (packed.fixed) {
        /* the kernel divides by the square of the distance, which need not be quite 1 */
        stand(at, packed.size, packed.color, square_of(at), to);
        return true;
    }
    const lmp_vec3 to_light = { at.x - point.x, at.y - point.y, at.z - point.z };
    float factor = 1;
    if (packed.form == LMPI_FORM_CONE) {
        const float distance = sqrtf(square_of(to_light)), per = distance > 0 ? -1 / distance : 0;
        factor = lmpi_cone_falloff(
            &packed, distance > 0
                         ? (lmp_vec3) { to_light.x * per, to_light.y * per, to_light.z * per }
                         : (lmp_vec3) { 0, 0, -1 });
    }
    stand(to_light, packed.size, packed.color, factor, to);
    return true;
}

static void sum_stand_ins(int bands, const light_stand_ins *lights, bool adds, float *sh) {
    static const float zeros[LMPI_KERNEL_LANES_MAX];
    const size_t values = 3 * LMP_SH_COUNT(bands);
    const lmpi_kernel_vec3 origin = { zeros, zeros, zeros };
    const lmpi_kernel_lights seen = {
        .center = { lights->center[0], lights->center[1], lights->center[2], sizeof(float) },
        .radius = { lights->radius, sizeof(float) },
        .radiance = { lights->rgb[0], lights->rgb[1], lights->rgb[2], sizeof(float) },
        .count = lights->count
    };
    const lmpi_kernel_out out = lmpi_sh_array_from(lmp_sh_interleaved(sh, 0), values, 1, 0);
    const lmpi_kernels *kernels = lmpi_kernels_get();
    (adds ? kernels->light.accumulate_more : kernels->light.accumulate)(NULL, bands, &seen, &origin,
                                                                        1, &out);
}

/* Projects lights that are no areas. Wide caps come one by one, after all others. */
static void project_side_by_side(int bands, const lmp_light *lights, size_t count, lmp_vec3 point,
                                 float *sh) {
    const size_t plane = LMP_SH_COUNT(bands);
    float *const planes[3] = { sh, sh + plane, sh + 2 * plane };
    light_stand_ins group = { .count = 0 };
    bool adds = false, any_wide = false;
    for (size_t i = 0; i < count; i++) {
        any_wide |= !stand_in(&lights[i], point, &group);
        if (group.count == LMP_LIGHT_GROUP || i + 1 == count) {
            sum_stand_ins(bands, &group, adds, sh);
            group.count = 0;
            adds = true;
        }
    }
    sh[0] += group.ambient.r / lmpi_table_pole[0];
    sh[plane] += group.ambient.g / lmpi_table_pole[0];
    sh[2 * plane] += group.ambient.b / lmpi_table_pole[0];
    for (size_t i = 0; any_wide && i < count; i++) {
        lmpi_packed_light packed;
        lmp_cap cap;
        lmpi_light_pack(&lights[i], &packed);
        if (!is_wide(&packed))
            continue;
        lmp_light_find_cap(&lights[i], point, &cap);
        lmpi_cap_add(0, bands, &cap, planes);
    }
}

/* --- all -------------------------------------------------------------------------------------- */

static LMPI_NOINLINE void project_others(int bands, const lmp_light *lights, size_t count,
                                         lmp_vec3 point, float *sh) {
    const size_t plane = LMP_SH_COUNT(bands);
    if (count < MANY || lmpi_is_any_area(lights, count))
        lmp_light_project_channels(bands, lights, count, point, sh, sh + plane, sh + 2 * plane);
    else if (lmpi_are_all_spheres(lights, count))
        lmp_light_project_n(NULL, bands, lights, count, NULL,
                            (lmp_vec3_array) { &point.x, &point.y, &point.z, sizeof point }, 1,
                            lmp_sh_interleaved(sh, 0));
    else
        project_side_by_side(bands, lights, count, point, sh);
}

void lmp_light_project(int bands, const lmp_light *lights, size_t count, lmp_vec3 point,
                       float *sh) {
    assert(lmpi_is_bands(bands) && lmpi_are_lights(lights, count) && lmpi_is_point(point));
    const size_t plane = LMP_SH_COUNT(bands);
    const lmpi_kernels *kernels = lmpi_single_for(bands);
    if (kernels && count == 1 && lmpi_light_is_sun(lights))
        kernels->single->sun[bands](lights->direction, lights->irradiance, sh, sh + plane,
                                    sh + 2 * plane);
    else
        project_others(bands, lights, count, point, sh);
}
