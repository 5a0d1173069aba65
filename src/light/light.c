/* SPDX-License-Identifier: MIT */
#include "src/base/precondition.h"
#include "src/kernels/dispatch.h"
#include "src/light/seen.h"

#include <lampion/light.h>

#include <string.h>

/* Projects a single light of few bands, which adds to nothing. */
static void project_one(int bands, const lmp_light *light, lmp_vec3 point, float *const planes[3]) {
    lmp_cap cap;
    lmp_light_find_cap(light, point, &cap);
    lmpi_single_cap single = { .axis = cap.axis };
    const float constant = 1 / lmpi_table_pole[0];
    const lmp_rgb ambient = { cap.ambient.r * constant, cap.ambient.g * constant,
                              cap.ambient.b * constant };
    if (cap.one_minus_cos > 0)
        LMPI_STRAIGHT(bands, lmpi_cap_polynomials, cap.one_minus_cos, single.factors)
    else
        for (int l = 0; l < LMPI_SINGLE_BANDS; l++)
            single.factors[l] = 1;
    lmpi_single_get()->colors[bands](&single, cap.strength, ambient, planes);
}

/* Add an area to coefficients and to irradiance; functions of their own, because what is seen of an
 * area takes much of the stack. */
static LMPI_NOINLINE void add_area(int bands, const lmp_light *area, lmp_vec3 point,
                                   float *const planes[3]) {
    lmpi_seen seen;
    lmpi_light_see(area, point, &seen);
    lmpi_seen_add(0, bands, &seen, planes);
}

static LMPI_NOINLINE void add_area_irradiance(const lmp_light *area, lmp_vec3 point,
                                              lmp_vec3 normal, lmp_rgb *sum) {
    lmpi_area prepared;
    lmpi_seen seen;
    lmpi_area_prepare(area, &prepared);
    lmpi_area_see(&prepared, point, &seen);
    lmpi_seen_add_irradiance(&seen, normal, sum);
}

void lmp_light_project_channels(int bands, const lmp_light *lights, size_t count, lmp_vec3 point,
                                float *red, float *green, float *blue) {
    assert(lmpi_is_bands(bands));
    float *const planes[3] = { red, green, blue };
    for (int c = 0; c < 3; c++)
        assert(!planes[c] || !planes[(c + 1) % 3] ||
               lmpi_are_apart(planes[c], LMP_SH_COUNT(bands), planes[(c + 1) % 3],
                              LMP_SH_COUNT(bands)));
    if (count == 1 && bands <= LMPI_SINGLE_BANDS && red && green && blue &&
        !lmpi_light_is_area(lights)) {
        project_one(bands, lights, point, planes);
        return;
    }
    for (int c = 0; c < 3; c++)
        if (planes[c])
            memset(planes[c], 0, LMP_SH_COUNT(bands) * sizeof *planes[c]);
    for (size_t i = 0; i < count; i++) {
        lmp_cap cap;
        if (lmpi_light_is_area(&lights[i])) {
            add_area(bands, &lights[i], point, planes);
            continue;
        }
        lmp_light_find_cap(&lights[i], point, &cap);
        lmpi_cap_add(0, bands, &cap, planes);
    }
}

lmp_rgb lmp_light_irradiance(const lmp_light *lights, size_t count, lmp_vec3 point,
                             lmp_vec3 normal) {
    assert(lmpi_is_unit(normal));
    lmp_rgb sum = { 0, 0, 0 };
    for (size_t i = 0; i < count; i++) {
        lmp_cap cap;
        if (lmpi_light_is_area(&lights[i])) {
            add_area_irradiance(&lights[i], point, normal, &sum);
            continue;
        }
        lmp_light_find_cap(&lights[i], point, &cap);
        lmpi_cap_add_irradiance(&cap, normal, &sum);
    }
    return sum;
}
