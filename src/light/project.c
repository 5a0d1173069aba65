/* SPDX-License-Identifier: MIT */
/* project.c - lights at one point, by what is fastest for their number and kinds. */
#include "src/base/unroll.h"
#include "src/kernels/dispatch.h"
#include "src/light/packed.h"
#include "src/light/valid.h"
#include "src/sphere/sphere.h"

#include <lampion/light.h>

/* The number of spheres from which on the batch of one point is faster than one light after
 * another. */
enum { SPHERES_MANY = 4 };

static LMPI_NOINLINE void project_others(int bands, const lmp_light *lights, size_t count,
                                         lmp_vec3 point, float *sh) {
    const size_t plane = LMP_SH_COUNT(bands);
    if (count >= SPHERES_MANY && lmpi_are_all_spheres(lights, count))
        lmp_light_project_n(NULL, bands, lights, count, NULL,
                            (lmp_vec3_array) { &point.x, &point.y, &point.z, sizeof point }, 1,
                            lmp_sh_interleaved(sh, 0));
    else
        lmp_light_project_channels(bands, lights, count, point, sh, sh + plane, sh + 2 * plane);
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
