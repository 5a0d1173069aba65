/* SPDX-License-Identifier: MIT */
#include "src/base/precondition.h"
#include "src/sh/column.h"
#include "src/sh/quadrature.h"

#include <lampion/sh.h>

#include <math.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

/* --- any function ----------------------------------------------------------------------------- */

/* Adds weight * value cos(m phi) and sin(m phi) for all m < bands. */
static void add_azimuth(int bands, double c, double s, double value, double *cosine, double *sine) {
    double cm = value, sm = 0;
    for (int m = 0; m < bands; m++) {
        cosine[m] += cm;
        sine[m] += sm;
        const double next = c * cm - s * sm;
        sm = s * cm + c * sm;
        cm = next;
    }
}

void lmp_sh_project_function(int bands, int nodes, lmp_sh_function function, void *user,
                             float *sh) {
    assert(lmp_is_bands(bands));
    assert(nodes >= 0);
    if (nodes == 0)
        nodes = bands;
    memset(sh, 0, LMP_SH_COUNT(bands) * sizeof *sh);
    for (int i = 0; i < nodes; i++) {
        double cosine[LMP_BANDS_MAX] = { 0 }, sine[LMP_BANDS_MAX] = { 0 }, z, weight;
        lmp_gauss_legendre(nodes, i, &z, &weight);
        const double radius = sqrt((1 - z) * (1 + z));
        for (int j = 0; j < 2 * nodes; j++) {
            const double c = cos(pi * (j + 0.5) / nodes), s = sin(pi * (j + 0.5) / nodes);
            const lmp_vec3 w = { (float)(radius * c), (float)(radius * s), (float)z };
            const double value = (double)function(w, user) * weight * pi / nodes;
            add_azimuth(bands, c, s, value, cosine, sine);
        }
        float q[LMP_BANDS_MAX];
        double power = 1; /* radius^m: the azimuths above are those of unit vectors */
        for (int m = 0; m < bands; m++) {
            lmp_sh_column(bands, m, (float)z, q);
            for (int l = m; l < bands; l++) {
                sh[LMP_SH_INDEX(l, m)] += q[l] * (float)(power * cosine[m]);
                if (m > 0)
                    sh[LMP_SH_INDEX(l, -m)] += q[l] * (float)(power * sine[m]);
            }
            power *= radius;
        }
    }
}
