/* SPDX-License-Identifier: MIT */
#include "src/brdf/quadrature.h"
#include "src/sh/quadrature.h"

#include <math.h>

/* Computes Y_lm(z, phi = 0) for m >= 0, with sqrt 2 and (-1)^m (paper Eq. 1-2). In double, because
 * float tables would lose 100 bands. */
static void legendre_ring(int bands, double z, double *row) {
    const double s = sqrt((1 - z) * (1 + z));
    double diagonal = sqrt(1 / (4 * BRDF_PI));
    for (int m = 0; m < bands; m++) {
        if (m > 0)
            diagonal *= -s * (m == 1 ? sqrt(3) : sqrt((2 * m + 1.0) / (2 * m)));
        double before = 0, value = diagonal;
        for (int l = m; l < bands; l++) {
            *row++ = value;
            const double n = l + 1, span = n * n - (double)m * m;
            const double back = (n - 1) * (n - 1) - (double)m * m;
            const double b = back > 0 ? sqrt((2 * n + 1) * back / ((2 * n - 3) * span)) : 0;
            const double next = sqrt((4 * n * n - 1) / span) * z * value - b * before;
            before = value;
            value = next;
        }
    }
}

lmp_result lmpi_brdf_quadrature_create(const lmp_host *host, int bands, int rings,
                                       brdf_quadrature *quadrature) {
    const size_t n = (size_t)bands, k = (size_t)rings, half_count = LMP_SH_HALF_COUNT(bands);
    double *block = lmpi_allocate(host, (6 * k + 4 * k * n + k * half_count) * sizeof *block);
    if (!block)
        return LMP_ERROR_MEMORY;
    *quadrature = (brdf_quadrature) { .bands = bands,
                                      .rings = rings,
                                      .azimuths = 2 * rings,
                                      .z = block,
                                      .weight = block + k,
                                      .x = block + 2 * k,
                                      .y = block + 4 * k,
                                      .cosine = block + 6 * k,
                                      .sine = block + 6 * k + 2 * k * n,
                                      .legendre = block + 6 * k + 4 * k * n,
                                      .block = block };
    for (size_t i = 0; i < k; i++) {
        double node, weight;
        lmpi_gauss_legendre(rings, (int)i, &node, &weight);
        const double z = quadrature->z[i] = (1 + node) / 2;
        quadrature->weight[i] = weight / 2 * z * 2 * BRDF_PI / quadrature->azimuths;
        legendre_ring(bands, z, quadrature->legendre + i * half_count);
    }
    for (size_t j = 0; j < 2 * k; j++) {
        const double phi = BRDF_PI * (double)(2 * j + 1) / (double)(2 * k);
        quadrature->x[j] = cos(phi);
        quadrature->y[j] = sin(phi);
        for (size_t m = 0; m < n; m++) {
            const double angle = BRDF_PI * (double)((2 * j + 1) * m % (4 * k)) / (double)(2 * k);
            quadrature->cosine[j * n + m] = cos(angle);
            quadrature->sine[j * n + m] = sin(angle);
        }
    }
    return LMP_OK;
}

void lmpi_brdf_quadrature_destroy(const lmp_host *host, brdf_quadrature *quadrature) {
    lmpi_release(host, quadrature->block);
    quadrature->block = NULL;
}

/* Whether the half circle y > 0 suffices: only cosines are needed, and f_r is symmetric or provides
 * its mirrored mean. */
static bool is_halved(const brdf_projection *p) {
    return p->mirrored && (p->brdf->info.mirrored || p->brdf->eval_mirrored);
}

/* Computes Σ_j f(phi_j) cos(m phi_j) of one ring, and the same sum with sin. */
static void transform_ring(const brdf_projection *p, const brdf_quadrature *q, double z, int count,
                           double cosine[3][LMP_BANDS_MAX], double sine[3][LMP_BANDS_MAX]) {
    const double s = sqrt((1 - z) * (1 + z));
    const int bands = q->bands;
    memset(cosine, 0, 3 * sizeof *cosine);
    memset(sine, 0, 3 * sizeof *sine);
    for (int j = 0; j < count; j++) {
        const double *c = q->cosine + (size_t)j * (size_t)bands;
        const double *d = q->sine + (size_t)j * (size_t)bands;
        const double x = s * q->x[j], y = s * q->y[j];
        const double light[3] = { p->rotation[0] * x - p->rotation[1] * y,
                                  p->rotation[1] * x + p->rotation[0] * y, z };
        double rgb[3];
        if (p->mirrored && p->brdf->eval_mirrored)
            p->brdf->eval_mirrored(p->brdf, p->view, light, rgb);
        else
            p->brdf->eval(p->brdf, p->view, light, rgb);
        for (int channel = 0; channel < 3; channel++) {
            for (int m = 0; m < bands; m++)
                cosine[channel][m] += rgb[channel] * c[m];
            if (!p->mirrored)
                for (int m = 1; m < bands; m++)
                    sine[channel][m] += rgb[channel] * d[m];
        }
    }
}

void lmpi_brdf_project_view(const brdf_projection *projection, const brdf_quadrature *quadrature,
                            double *cosine, double *sine) {
    const int bands = quadrature->bands;
    const size_t half_count = LMP_SH_HALF_COUNT(bands);
    const bool halved = is_halved(projection);
    const int count = halved ? quadrature->azimuths / 2 : quadrature->azimuths;
    memset(cosine, 0, 3 * half_count * sizeof *cosine);
    if (!projection->mirrored)
        memset(sine, 0, 3 * half_count * sizeof *sine);
    for (int k = 0; k < quadrature->rings; k++) {
        double ring_cosine[3][LMP_BANDS_MAX], ring_sine[3][LMP_BANDS_MAX];
        transform_ring(projection, quadrature, quadrature->z[k], count, ring_cosine, ring_sine);
        const double weight = quadrature->weight[k] * (halved ? 2 : 1);
        for (size_t channel = 0; channel < 3; channel++) {
            const double *q = quadrature->legendre + (size_t)k * half_count;
            double *out_c = cosine + channel * half_count, *out_s = sine + channel * half_count;
            for (int m = 0; m < bands; m++) {
                const double c = weight * ring_cosine[channel][m];
                const double s = weight * ring_sine[channel][m];
                const int run = bands - m;
                for (int l = 0; l < run; l++)
                    out_c[l] += c * q[l];
                if (!projection->mirrored)
                    for (int l = 0; l < run; l++)
                        out_s[l] += s * q[l];
                q += run;
                out_c += run;
                out_s += run;
            }
        }
    }
}
