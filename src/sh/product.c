/* SPDX-License-Identifier: MIT */
/* product.c - products of functions. The number of nonzero Γ_ijk grows as n^5, so instead the two
 * functions are evaluated on circles of constant height, multiplied there, and projected back by a
 * quadrature rule that is exact for products of three harmonics. Few bands are handled by
 * src/kernels/single_product_tmpl.h, more by a grid that is separable in azimuth and height and
 * takes O(n^3). */
#include "src/base/host.h"
#include "src/base/precondition.h"
#include "src/base/unroll.h"
#include "src/kernels/dispatch.h"
#include "src/sh/quadrature.h"

#include <lampion/sh.h>

#include <math.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

struct lmp_sh_product {
    lmp_host host;
    int bands;
    /* The grid, for more than LMP_SH_FEW_BANDS bands: for each height, its weight and q_l^m(z) r^m,
     * ordered by m, then l; for each azimuth, cos and sin of m phi. */
    int heights, azimuths;
    float *weights, *columns, *cosines, *sines;
};

/* --- the grid --------------------------------------------------------------------------------- */

/* Computes Y_l,m at azimuth 0 for m = 0 … bands-1 and l = m … bands-1, by the recurrence of
 * tables.h in double precision, with the power of the radius included. */
static void fill_columns(int bands, double z, double *column) {
    const double radius = sqrt((1 - z) * (1 + z));
    double diagonal = sqrt(1 / (4 * pi));
    for (int m = 0; m < bands; m++) {
        double before = 0, now = diagonal;
        for (int l = m; l < bands; l++) {
            *column++ = now;
            const double span = (double)(l + 1 - m) * (l + 1 + m);
            double next = sqrt((4.0 * (l + 1) * (l + 1) - 1) / span) * z * now;
            if (l > m)
                next -= sqrt((2 * l + 3.0) * (l - m) * (l + m) / ((2 * l - 1.0) * span)) * before;
            before = now;
            now = next;
        }
        diagonal *= -radius * (m == 0 ? sqrt(3) : sqrt((2 * m + 3.0) / (2 * m + 2.0)));
    }
}

static int height_count(int bands) {
    return (3 * bands - 1) / 2;
}

static int azimuth_count(int bands) {
    return bands == 1 ? 1 : 3 * bands - 2;
}

static lmp_result create_grid(lmp_sh_product *product) {
    const int bands = product->bands;
    product->heights = height_count(bands);
    product->azimuths = azimuth_count(bands);
    const size_t columns = (size_t)product->heights * LMP_SH_HALF_COUNT(bands);
    const size_t waves = (size_t)product->azimuths * (size_t)bands;
    const size_t total = (size_t)product->heights + columns + 2 * waves;
    product->weights = lmpi_allocate(&product->host, total * sizeof(float));
    double *column = lmpi_allocate(&product->host, LMP_SH_HALF_COUNT(bands) * sizeof(double));
    if (!product->weights || !column) {
        lmpi_release(&product->host, column);
        return LMP_ERROR_MEMORY;
    }
    product->columns = product->weights + product->heights;
    product->cosines = product->columns + columns;
    product->sines = product->cosines + waves;
    for (int i = 0; i < product->heights; i++) {
        double z, weight;
        lmpi_gauss_legendre(product->heights, i, &z, &weight);
        product->weights[i] = (float)(weight * 2 * pi / product->azimuths);
        fill_columns(bands, z, column);
        for (size_t k = 0; k < LMP_SH_HALF_COUNT(bands); k++)
            product->columns[(size_t)i * LMP_SH_HALF_COUNT(bands) + k] = (float)column[k];
    }
    for (int j = 0; j < product->azimuths; j++) {
        for (int m = 0; m < bands; m++) {
            const double phi = 2 * pi * ((double)j * m / product->azimuths);
            product->cosines[j * bands + m] = (float)cos(phi);
            product->sines[j * bands + m] = (float)sin(phi);
        }
    }
    lmpi_release(&product->host, column);
    return LMP_OK;
}

/* A function along one circle of constant height: Σ_m cosine[m] cos(m phi) + sine[m] sin(m phi). */
typedef struct fourier {
    float cosine[LMP_BANDS_MAX], sine[LMP_BANDS_MAX];
} fourier;

static void circle_of(int bands, const float *column, const float *sh, fourier *circle) {
    for (int m = 0; m < bands; m++) {
        float cosine = 0, sine = 0;
        for (int l = m; l < bands; l++) {
            const float q = *column++;
            cosine += q * sh[LMP_SH_INDEX(l, m)];
            sine += q * sh[LMP_SH_INDEX(l, -m)];
        }
        circle->cosine[m] = cosine;
        circle->sine[m] = m > 0 ? sine : 0;
    }
}

static float circle_value(int bands, const fourier *circle, const float *c, const float *s) {
    float value = 0;
    for (int m = 0; m < bands; m++)
        value += circle->cosine[m] * c[m] + circle->sine[m] * s[m];
    return value;
}

static LMPI_NOINLINE void multiply_on_grid(const lmp_sh_product *product, const float *a,
                                           const float *b, float *c) {
    const int bands = product->bands;
    memset(c, 0, LMP_SH_COUNT(bands) * sizeof *c);
    for (int i = 0; i < product->heights; i++) {
        const float *column = product->columns + (size_t)i * LMP_SH_HALF_COUNT(bands);
        fourier of_a, of_b, of_c = { { 0 }, { 0 } };
        circle_of(bands, column, a, &of_a);
        circle_of(bands, column, b, &of_b);
        for (int j = 0; j < product->azimuths; j++) {
            const float *cosine = product->cosines + j * bands, *sine = product->sines + j * bands;
            const float value = product->weights[i] * circle_value(bands, &of_a, cosine, sine) *
                                circle_value(bands, &of_b, cosine, sine);
            for (int m = 0; m < bands; m++) {
                of_c.cosine[m] += value * cosine[m];
                of_c.sine[m] += value * sine[m];
            }
        }
        for (int m = 0; m < bands; m++) {
            for (int l = m; l < bands; l++) {
                const float q = *column++;
                c[LMP_SH_INDEX(l, m)] += q * of_c.cosine[m];
                if (m > 0)
                    c[LMP_SH_INDEX(l, -m)] += q * of_c.sine[m];
            }
        }
    }
}

/* --- few bands -------------------------------------------------------------------------------- */

_Static_assert(LMP_SH_FEW_BANDS <= LMPI_SINGLE_BANDS, "there is no straight-line code for so many");

static LMPI_NOINLINE void multiply_first(int bands, const float *a, const float *b, float *c) {
    lmpi_single_get()->multiply[bands](bands, a, b, c);
}

void lmp_sh_multiply_few(int bands, const float *a, const float *b, float *c) {
    assert(bands >= 1 && bands <= LMP_SH_FEW_BANDS);
    assert(lmpi_are_apart(a, LMP_SH_COUNT(bands), c, LMP_SH_COUNT(bands)));
    assert(lmpi_are_apart(b, LMP_SH_COUNT(bands), c, LMP_SH_COUNT(bands)));
    const lmpi_kernels *kernels = lmpi_single_for(bands);
    (kernels ? kernels->single->multiply[bands] : multiply_first)(bands, a, b, c);
}

/* --- the object ------------------------------------------------------------------------------- */

lmp_result lmp_sh_product_create(const lmp_host *host, int bands, lmp_sh_product **product) {
    *product = NULL;
    if (bands < 1 || bands > LMP_BANDS_MAX)
        return LMP_ERROR_ARGUMENT;
    const lmp_host resolved = lmpi_host_resolve(host);
    lmp_sh_product *created = lmpi_allocate(&resolved, sizeof *created);
    if (!created)
        return LMP_ERROR_MEMORY;
    *created = (lmp_sh_product) { .host = resolved, .bands = bands };
    const lmp_result result = bands <= LMP_SH_FEW_BANDS ? LMP_OK : create_grid(created);
    if (result != LMP_OK) {
        lmp_sh_product_destroy(created);
        return result;
    }
    *product = created;
    return LMP_OK;
}

void lmp_sh_product_destroy(lmp_sh_product *product) {
    if (!product)
        return;
    const lmp_host host = product->host;
    lmpi_release(&host, product->weights);
    lmpi_release(&host, product);
}

void lmp_sh_multiply(const lmp_sh_product *product, const float *a, const float *b, float *c) {
    assert(lmpi_are_apart(a, LMP_SH_COUNT(product->bands), c, LMP_SH_COUNT(product->bands)));
    assert(lmpi_are_apart(b, LMP_SH_COUNT(product->bands), c, LMP_SH_COUNT(product->bands)));
    if (product->bands <= LMP_SH_FEW_BANDS)
        lmp_sh_multiply_few(product->bands, a, b, c);
    else
        multiply_on_grid(product, a, b, c);
}
