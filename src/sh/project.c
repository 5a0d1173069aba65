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

/* A function of one channel or of three. */
typedef struct sampled {
    int channels;
    lmp_sh_function one;
    lmp_sh_function_rgb three;
    void *user;
} sampled;

static void sample(const sampled *f, lmp_vec3 w, float value[3]) {
    if (f->channels == 1) {
        value[0] = f->one(w, f->user);
        return;
    }
    const lmp_rgb color = f->three(w, f->user);
    value[0] = color.r;
    value[1] = color.g;
    value[2] = color.b;
}

/* Adds a ring of nodes at height z, given the sums over its azimuths. The sums are of unit vectors,
 * so the radius to the power m is multiplied here. */
static void add_ring(int bands, double z, double radius, const double *cosine, const double *sine,
                     float *sh) {
    float q[LMP_BANDS_MAX];
    double power = 1;
    for (int m = 0; m < bands; m++) {
        lmpi_sh_column(bands, m, (float)z, q);
        for (int l = m; l < bands; l++) {
            sh[LMP_SH_INDEX(l, m)] += q[l] * (float)(power * cosine[m]);
            if (m > 0)
                sh[LMP_SH_INDEX(l, -m)] += q[l] * (float)(power * sine[m]);
        }
        power *= radius;
    }
}

static void project(int bands, int nodes, const sampled *f, float *sh) {
    const size_t plane = LMP_SH_COUNT(bands);
    assert(lmpi_is_bands(bands));
    assert(nodes >= 0);
    if (nodes == 0)
        nodes = bands;
    const double step = pi / nodes, step_c = cos(step), step_s = sin(step);
    memset(sh, 0, (size_t)f->channels * plane * sizeof *sh);
    for (int i = 0; i < nodes; i++) {
        double cosine[3][LMP_BANDS_MAX] = { 0 }, sine[3][LMP_BANDS_MAX] = { 0 }, z, weight;
        lmpi_gauss_legendre(nodes, i, &z, &weight);
        const double radius = sqrt((1 - z) * (1 + z));
        double c = cos(step / 2), s = sin(step / 2); /* of the azimuth step (j + 1/2) */
        for (int j = 0; j < 2 * nodes; j++) {
            float value[3];
            sample(f, (lmp_vec3) { (float)(radius * c), (float)(radius * s), (float)z }, value);
            for (int k = 0; k < f->channels; k++)
                add_azimuth(bands, c, s, (double)value[k] * weight * step, cosine[k], sine[k]);
            const double turned = c * step_c - s * step_s;
            s = s * step_c + c * step_s;
            c = turned;
        }
        for (int k = 0; k < f->channels; k++)
            add_ring(bands, z, radius, cosine[k], sine[k], sh + (size_t)k * plane);
    }
}

void lmp_sh_project_function(int bands, int nodes, lmp_sh_function function, void *user,
                             float *sh) {
    project(bands, nodes, &(sampled) { .channels = 1, .one = function, .user = user }, sh);
}

void lmp_sh_project_function_rgb(int bands, int nodes, lmp_sh_function_rgb function, void *user,
                                 float *sh) {
    project(bands, nodes, &(sampled) { .channels = 3, .three = function, .user = user }, sh);
}
