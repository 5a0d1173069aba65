/* SPDX-License-Identifier: MIT */
#include "src/brdf/brdf.h"

#include <float.h>
#include <math.h>

lmp_result lmpi_brdf_new(const lmp_host *host, lmp_brdf_kind kind, size_t extra, lmp_brdf **brdf) {
    *brdf = NULL;
    const size_t head = (sizeof **brdf + 15) & ~(size_t)15;
    if (extra > SIZE_MAX - head)
        return LMP_ERROR_MEMORY;
    const lmp_host resolved = lmpi_host_resolve(host);
    lmp_brdf *made = lmpi_allocate(&resolved, head + extra);
    if (!made)
        return LMP_ERROR_MEMORY;
    memset(made, 0, head + extra);
    made->host = resolved;
    made->info.kind = kind;
    made->info.bytes = head + extra;
    *brdf = made;
    return LMP_OK;
}

void lmp_brdf_destroy(lmp_brdf *brdf) {
    lmpi_release_object(brdf);
}

lmp_brdf_info lmp_brdf_describe(const lmp_brdf *brdf) {
    return brdf->info;
}

void lmpi_brdf_half_vector(const double a[3], const double b[3], double h[3]) {
    for (int k = 0; k < 3; k++)
        h[k] = a[k] + b[k];
    const double length = sqrt(brdf_dot(h, h));
    for (int k = 0; k < 3; k++)
        h[k] /= length;
}

void lmp_brdf_eval_double(const lmp_brdf *brdf, const double wi[3], const double wo[3],
                          double rgb[3]) {
    const double i2 = brdf_dot(wi, wi), o2 = brdf_dot(wo, wo);
    rgb[0] = rgb[1] = rgb[2] = isnan(i2 + o2) ? i2 + o2 : 0;
    if (!(wi[2] > 0 && wo[2] > 0 && isfinite(i2) && isfinite(o2)))
        return;
    double a[3], b[3];
    for (int k = 0; k < 3; k++) {
        a[k] = wi[k] / sqrt(i2);
        b[k] = wo[k] / sqrt(o2);
    }
    if (a[2] > 0 && b[2] > 0)
        brdf->eval(brdf, a, b, rgb);
}

/* Converts to float a value that near the horizon may be finite but too large for a float. */
static float narrow(double value) {
    return value > (double)FLT_MAX ? FLT_MAX : (float)value;
}

lmp_rgb lmp_brdf_eval(const lmp_brdf *brdf, lmp_vec3 wi, lmp_vec3 wo) {
    const double a[3] = { (double)wi.x, (double)wi.y, (double)wi.z };
    const double b[3] = { (double)wo.x, (double)wo.y, (double)wo.z };
    double rgb[3];
    lmp_brdf_eval_double(brdf, a, b, rgb);
    return (lmp_rgb) { narrow(rgb[0]), narrow(rgb[1]), narrow(rgb[2]) };
}
