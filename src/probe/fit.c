/* SPDX-License-Identifier: MIT */
/* fit.c - coefficients from scattered samples by least squares.
 *
 * The normal equations are summed and solved in double from values in float: the condition number
 * may reach 1e7 before digits of the values are lost. Samples spread over a sphere stay far below
 * that; others are refused. */
#include "src/base/element.h"
#include "src/base/host.h"

#include <lampion/probe.h>

#include <math.h>
#include <string.h>

/* Samples between two reports of progress: each costs bands⁴ / 2 multiplications, up to half a
 * million. */
enum { SAMPLES_A_REPORT = 64 };

/* The fraction of the largest pivot below which a coefficient counts as undetermined. */
static const double pivot_least = 1e-10;

typedef struct normal_equations {
    size_t count;   /* coefficients */
    double *matrix; /* count rows, of which the lower triangle is used */
    double *right;  /* right-hand side */
} normal_equations;

/* Adds a sample; returns false if one of its numbers is not finite or its weight is negative. */
static bool add_sample(normal_equations *equations, int bands, const lmp_probe_samples *samples,
                       size_t i, float *basis) {
    const lmp_vec3 w = lmpi_vec3_element(&samples->directions, i);
    const double value = (double)lmpi_element(samples->values.at, samples->values.stride, i);
    const double weight =
        samples->weights.at ? (double)lmpi_element(samples->weights.at, samples->weights.stride, i)
                            : 1;
    if (!isfinite(w.x) || !isfinite(w.y) || !isfinite(w.z) || !isfinite(value) ||
        !isfinite(weight) || weight < 0)
        return false;
    lmp_sh_eval(bands, w, basis);
    for (size_t row = 0; row < equations->count; row++) {
        const double scaled = weight * (double)basis[row];
        double *line = equations->matrix + row * equations->count;
        equations->right[row] += scaled * value;
        for (size_t column = 0; column <= row; column++)
            line[column] += scaled * (double)basis[column];
    }
    return true;
}

/* Factorizes in place A = L Lᵀ (Cholesky); returns false if a pivot is lost in rounding. */
static bool factorize(normal_equations *equations) {
    const size_t n = equations->count;
    double *a = equations->matrix, largest = 0;
    for (size_t i = 0; i < n; i++)
        largest = fmax(largest, a[i * n + i]);
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j <= i; j++) {
            double sum = a[i * n + j];
            for (size_t k = 0; k < j; k++)
                sum -= a[i * n + k] * a[j * n + k];
            if (i != j)
                a[i * n + j] = sum / a[j * n + j];
            else if (sum > pivot_least * largest)
                a[i * n + i] = sqrt(sum);
            else
                return false;
        }
    return true;
}

static void solve(const normal_equations *equations, float *sh) {
    const size_t n = equations->count;
    const double *a = equations->matrix;
    double *x = equations->right;
    for (size_t i = 0; i < n; i++) {
        for (size_t k = 0; k < i; k++)
            x[i] -= a[i * n + k] * x[k];
        x[i] /= a[i * n + i];
    }
    for (size_t i = n; i-- > 0;) {
        for (size_t k = i + 1; k < n; k++)
            x[i] -= a[k * n + i] * x[k];
        x[i] /= a[i * n + i];
        sh[i] = (float)x[i];
    }
}

static lmp_result add_samples(const lmp_host *host, normal_equations *equations, int bands,
                              const lmp_probe_samples *samples) {
    float basis[LMP_SH_COUNT(LMP_PROBE_FIT_BANDS_MAX)];
    lmp_result result = LMP_OK;
    for (size_t i = 0; i < samples->count && result == LMP_OK; i++) {
        if (i % SAMPLES_A_REPORT == 0)
            result = lmpi_host_report(host, (double)i / (double)samples->count);
        if (!add_sample(equations, bands, samples, i, basis))
            return LMP_ERROR_ARGUMENT;
    }
    return result;
}

static lmp_result fit(const lmp_host *host, normal_equations *equations, int bands,
                      double smoothness, const lmp_probe_samples *samples, float *sh) {
    const lmp_result result = add_samples(host, equations, bands, samples);
    if (result != LMP_OK)
        return result;
    for (int l = 0; l < bands; l++)
        for (int m = -l; m <= l; m++) {
            const double eigenvalue = (double)l * (l + 1);
            equations->matrix[LMP_SH_INDEX(l, m) * (equations->count + 1)] +=
                smoothness * eigenvalue * eigenvalue;
        }
    if (!factorize(equations))
        return LMP_ERROR_ARGUMENT;
    solve(equations, sh);
    return lmpi_host_report(host, 1);
}

lmp_result lmp_probe_fit(const lmp_host *host, int bands, float smoothness,
                         const lmp_probe_samples *samples, float *sh) {
    if (bands < 1 || bands > LMP_PROBE_FIT_BANDS_MAX || !(smoothness >= 0 && isfinite(smoothness)))
        return LMP_ERROR_ARGUMENT;
    const lmp_host resolved = lmpi_host_resolve(host);
    const size_t count = LMP_SH_COUNT(bands), size = count * (count + 1) * sizeof(double);
    normal_equations equations = { .count = count, .matrix = lmpi_allocate(&resolved, size) };
    if (!equations.matrix)
        return LMP_ERROR_MEMORY;
    memset(equations.matrix, 0, size);
    equations.right = equations.matrix + count * count;
    const lmp_result result = fit(&resolved, &equations, bands, (double)smoothness, samples, sh);
    lmpi_release(&resolved, equations.matrix);
    return result;
}
