/* SPDX-License-Identifier: MIT */
#include "tests/oracle/oracle.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double pi = ORACLE_PI;

static void *allocate(size_t count) {
    void *memory = malloc(count * sizeof(double));
    if (!memory)
        abort();
    return memory;
}

static void normalize(const double v[3], double w[3]) {
    const double length = hypot(hypot(v[0], v[1]), v[2]);
    for (int k = 0; k < 3; k++)
        w[k] = v[k] / length;
}

/* Finds two directions that make a right-handed frame with w. */
static void frame(const double w[3], double u[3], double v[3]) {
    const double helper[3] = { fabs(w[0]) < 0.5, fabs(w[0]) >= 0.5, 0 };
    const double cross[3] = { helper[1] * w[2] - helper[2] * w[1],
                              helper[2] * w[0] - helper[0] * w[2],
                              helper[0] * w[1] - helper[1] * w[0] };
    normalize(cross, u);
    v[0] = w[1] * u[2] - w[2] * u[1];
    v[1] = w[2] * u[0] - w[0] * u[2];
    v[2] = w[0] * u[1] - w[1] * u[0];
}

/* --- the basis -------------------------------------------------------------------------------- */

/* Computed in extended precision: next to t = 1 the rounding of t alone costs P_l l² units. */
static void legendre(int bands, long double t, double *p) {
    long double before = 0, now = 1;
    for (int l = 0; l < bands; l++) {
        p[l] = (double)now;
        const long double next = ((2 * l + 1) * t * now - l * before) / (l + 1);
        before = now;
        now = next;
    }
}

void oracle_legendre(int bands, double t, double *p) {
    legendre(bands, (long double)t, p);
}

/* Returns K_m^m of paper Eq. 2. */
static long double first_normalization(int m) {
    long double k = sqrtl((2 * m + 1) / (4 * (long double)pi));
    for (int i = 1; i <= 2 * m; i++)
        k /= sqrtl(i);
    return k;
}

/* K_l^m at [m][l], once for all directions: its roots took most of a test's time. No test calls
 * from several threads. */
static long double normalization[ORACLE_BANDS_MAX][ORACLE_BANDS_MAX];

static void find_normalization(void) {
    if (normalization[ORACLE_BANDS_MAX - 1][ORACLE_BANDS_MAX - 1] > 0)
        return;
    for (int m = 0; m < ORACLE_BANDS_MAX; m++) {
        long double k = first_normalization(m);
        for (int l = m; l < ORACLE_BANDS_MAX; l++) {
            normalization[m][l] = k;
            k *= sqrtl((2 * l + 3) * (l + 1 - m) / ((2 * l + 1) * (long double)(l + 1 + m)));
        }
    }
}

void oracle_sh_eval(int bands, const double direction[3], double *sh) {
    assert(bands >= 1 && bands <= ORACLE_BANDS_MAX);
    find_normalization();
    double w[3];
    normalize(direction, w);
    const long double z = (long double)w[2];
    const double sine = hypot(w[0], w[1]), phi = atan2(w[1], w[0]);
    for (int m = 0; m < bands; m++) {
        /* P_m^m = (-1)^m (2m-1)!! sin^m */
        long double before = 0, now = 1;
        for (int k = 1; k <= m; k++)
            now *= -(2 * k - 1) * (long double)sine;
        const double c = cos(m * phi), s = sin(m * phi);
        for (int l = m; l < bands; l++) {
            const double value = (double)(normalization[m][l] * now);
            if (m == 0) {
                sh[l * l + l] = value;
            } else {
                sh[l * l + l + m] = sqrt(2) * value * c;
                sh[l * l + l - m] = sqrt(2) * value * s;
            }
            const long double next = ((2 * l + 1) * z * now - (l + m) * before) / (l + 1 - m);
            before = now;
            now = next;
        }
    }
}

/* --- quadrature ------------------------------------------------------------------------------- */

void oracle_gauss_legendre(int count, double *nodes, double *weights) {
    for (int i = 0; i < count; i++) {
        long double x = -cosl((long double)pi * (i + 0.75L) / (count + 0.5L)), slope = 1;
        for (int step = 0; step < 100; step++) {
            long double before = 0, now = 1;
            for (int l = 0; l < count; l++) {
                const long double next = ((2 * l + 1) * x * now - l * before) / (l + 1);
                before = now;
                now = next;
            }
            slope = count * (x * now - before) / (x * x - 1);
            const long double change = now / slope;
            x -= change;
            if (fabsl(change) < 1e-17L)
                break;
        }
        nodes[i] = (double)x;
        weights[i] = (double)(2 / ((1 - x * x) * slope * slope));
    }
}

void oracle_project(int bands, oracle_function function, void *user, int nodes, double *sh) {
    const size_t count = (size_t)bands * (size_t)bands;
    double *z = allocate(2 * (size_t)nodes + count), *weight = z + nodes, *y = weight + nodes;
    oracle_gauss_legendre(nodes, z, weight);
    memset(sh, 0, count * sizeof *sh);
    for (int i = 0; i < nodes; i++) {
        for (int j = 0; j < 2 * nodes; j++) {
            const double phi = pi * (j + 0.5) / nodes, sine = sqrt((1 - z[i]) * (1 + z[i]));
            const double w[3] = { sine * cos(phi), sine * sin(phi), z[i] };
            const double value = function(w, user) * weight[i] * pi / nodes;
            oracle_sh_eval(bands, w, y);
            for (size_t k = 0; k < count; k++)
                sh[k] += value * y[k];
        }
    }
    free(z);
}

/* --- caps and spheres ------------------------------------------------------------------------- */

void oracle_cap_zonal(int bands, double one_minus_cos, double *zonal) {
    const int nodes = bands / 2 + 1;
    double x[ORACLE_BANDS_MAX], weight[ORACLE_BANDS_MAX], p[ORACLE_BANDS_MAX];
    oracle_gauss_legendre(nodes, x, weight);
    memset(zonal, 0, (size_t)bands * sizeof *zonal);
    for (int i = 0; i < nodes; i++) {
        legendre(bands, 1 - (long double)one_minus_cos * (1 - (long double)x[i]) / 2, p);
        for (int l = 0; l < bands; l++)
            zonal[l] += sqrt((2 * l + 1) / (4 * pi)) * pi * one_minus_cos * weight[i] * p[l];
    }
}

void oracle_cap(int bands, const double axis[3], double one_minus_cos, double *sh) {
    const int nodes = bands / 2 + 1, azimuths = 2 * bands;
    const size_t count = (size_t)bands * (size_t)bands;
    double x[ORACLE_BANDS_MAX], weight[ORACLE_BANDS_MAX], w[3], u[3], v[3];
    double *y = allocate(count);
    oracle_gauss_legendre(nodes, x, weight);
    normalize(axis, w);
    frame(w, u, v);
    memset(sh, 0, count * sizeof *sh);
    for (int i = 0; i < nodes; i++) {
        const double drop = one_minus_cos * (1 - x[i]) / 2, sine = sqrt(drop * (2 - drop));
        for (int j = 0; j < azimuths; j++) {
            const double c = cos(2 * pi * j / azimuths), s = sin(2 * pi * j / azimuths);
            double direction[3];
            for (int k = 0; k < 3; k++)
                direction[k] = sine * (c * u[k] + s * v[k]) + (1 - drop) * w[k];
            oracle_sh_eval(bands, direction, y);
            for (size_t k = 0; k < count; k++)
                sh[k] += one_minus_cos / 2 * weight[i] * 2 * pi / azimuths * y[k];
        }
    }
    free(y);
}

/* Returns the derivative of Y along the great circle from w towards e. Y is a trigonometric
 * polynomial of degree bands-1 there, so M. Riesz's interpolation formula is exact. */
static void circle_derivative(int bands, const double w[3], const double e[3], double *slope) {
    const int degree = bands > 1 ? bands - 1 : 1;
    const size_t count = (size_t)bands * (size_t)bands;
    double *y = allocate(count);
    memset(slope, 0, count * sizeof *slope);
    for (int r = 1; r <= 2 * degree; r++) {
        const double t = (2 * r - 1) * pi / (2 * degree), s = sin(t / 2);
        double direction[3];
        for (int k = 0; k < 3; k++)
            direction[k] = w[k] * cos(t) + e[k] * sin(t);
        oracle_sh_eval(bands, direction, y);
        for (size_t k = 0; k < count; k++)
            slope[k] += (r % 2 ? 1 : -1) / (4 * degree * s * s) * y[k];
    }
    free(y);
}

/* L_lm = G_l(d) Y_lm(w), G_l = 2 pi ∫ P_l over the cap. */
void oracle_sphere(int bands, const double center[3], double radius, const double point[3],
                   double *sh, double *gradient) {
    const size_t count = (size_t)bands * (size_t)bands;
    double v[3], w[3] = { 0, 0, 1 };
    for (int k = 0; k < 3; k++)
        v[k] = center[k] - point[k];
    const double d = hypot(hypot(v[0], v[1]), v[2]);
    if (d > 0)
        normalize(v, w);
    const int inside = d < radius;
    const double near = inside ? d : radius, far = inside ? radius : d, ratio = near / far;
    const double cosine = sqrt((far - near) * (far + near)) / far;
    const double alpha = inside ? -cosine : cosine;
    double zonal[ORACLE_BANDS_MAX], p[ORACLE_BANDS_MAX];
    oracle_cap_zonal(bands, inside ? 1 + cosine : ratio * ratio / (1 + cosine), zonal);
    oracle_sh_eval(bands, w, sh);
    if (gradient) {
        double *along_u = allocate(2 * count), *along_v = along_u + count, e[2][3];
        frame(w, e[0], e[1]);
        circle_derivative(bands, w, e[0], along_u);
        circle_derivative(bands, w, e[1], along_v);
        oracle_legendre(bands, alpha, p);
        /* d alpha/dd; inside alpha = -sqrt(1 - d²/r²) */
        const double slope = inside ? d / (radius * radius * cosine) : ratio * ratio / (d * alpha);
        for (int l = 0, i = 0; l < bands; l++) {
            const double g = zonal[l] * sqrt(4 * pi / (2 * l + 1));
            for (int m = -l; m <= l; m++, i++)
                for (int k = 0; k < 3; k++)
                    gradient[(size_t)k * count + (size_t)i] =
                        2 * pi * p[l] * slope * sh[i] * w[k] -
                        g / d * (along_u[i] * e[0][k] + along_v[i] * e[1][k]);
        }
        free(along_u);
    }
    for (int l = 0, i = 0; l < bands; l++)
        for (int m = -l; m <= l; m++, i++)
            sh[i] *= d > 0 || l == 0 ? zonal[l] * sqrt(4 * pi / (2 * l + 1)) : 0;
}

/* --- lobes ------------------------------------------------------------------------------------ */

/* A point of an integral over s in 0 … 1: the weight ds carries, and the argument t of P_l(t). */
typedef struct sample {
    long double weight, t;
} sample;

static void moments(int bands, sample (*at)(long double s, double parameter), double parameter,
                    double *moment) {
    enum { NODES = 24, PANELS = 100 };
    double x[NODES], weight[NODES], p[ORACLE_BANDS_MAX];
    long double sum[ORACLE_BANDS_MAX] = { 0 };
    oracle_gauss_legendre(NODES, x, weight);
    for (int panel = 0; panel < PANELS; panel++) {
        for (int i = 0; i < NODES; i++) {
            const sample here = at((panel + (1 + (long double)x[i]) / 2) / PANELS, parameter);
            legendre(bands, here.t, p);
            for (int l = 0; l < bands; l++)
                sum[l] += here.weight * (long double)weight[i] * (long double)p[l] / (2 * PANELS);
        }
    }
    for (int l = 0; l < bands; l++)
        moment[l] = (double)sum[l];
}

/* Past this, exp(-y) vanishes in double. */
static const long double depth = 60;

/* Substitutes t = exp(-y/(e+1)), so that the kernel's (e+1) t^e dt is exp(-y) dy; y = u², because
 * P_l oscillates evenly in u. */
static sample phong_sample(long double s, double exponent) {
    const long double u = s * sqrtl(depth);
    return (sample) { 2 * u * sqrtl(depth) * expl(-u * u),
                      expl(-u * u / ((long double)exponent + 1)) };
}

/* Substitutes t = cos theta, up to where exp(k (t-1)) ends. */
static sample vmf_sample(long double s, double concentration) {
    const long double k = (long double)concentration;
    const long double end = 2 * asinl(sqrtl(fminl(1, depth / (2 * k)))), theta = s * end;
    const long double half_sine = sinl(theta / 2), y = 2 * k * half_sine * half_sine;
    return (sample) { end * k * sinl(theta) * expl(-y) / -expm1l(-2 * k),
                      1 - 2 * half_sine * half_sine };
}

/* Returns the integral of max(a + b cos phi, 0) over a turn, b >= 0. */
static double above_horizon(double a, double b) {
    if (a >= b)
        return 2 * pi * a;
    if (a <= -b)
        return 0;
    const double end = acos(-a / b);
    return 2 * (a * end + b * sin(end));
}

double oracle_irradiance(double cosine, double one_minus_cos) {
    enum { NODES = 64 };
    static double x[NODES], weight[NODES];
    double sum = 0;
    const double sine = sqrt(fmax((1 - cosine) * (1 + cosine), 0));
    const double end = 2 * asin(sqrt(one_minus_cos / 2)), kink = atan2(fabs(cosine), sine);
    /* Circles around the axis: at the kinks the horizon begins and ends to cut them. */
    const double ends[4] = { 0, fmin(kink, end), fmin(pi - kink, end), end };
    if (weight[0] == 0)
        oracle_gauss_legendre(NODES, x, weight);
    for (int piece = 0; piece < 3; piece++)
        for (int i = 0; i < NODES; i++) {
            const double length = ends[piece + 1] - ends[piece], t = (1 + x[i]) / 2;
            /* The substitution is slow at both ends, where derivatives are infinite. */
            const double angle = ends[piece] + length * t * t * (3 - 2 * t);
            sum += 3 * length * t * (1 - t) * weight[i] * sin(angle) *
                   above_horizon(cosine * cos(angle), sine * sin(angle));
        }
    return sum;
}

void oracle_lobe_diffuse(int bands, double *lambda) {
    double x[ORACLE_BANDS_MAX], weight[ORACLE_BANDS_MAX], p[ORACLE_BANDS_MAX];
    const int nodes = bands / 2 + 1;
    oracle_gauss_legendre(nodes, x, weight);
    memset(lambda, 0, (size_t)bands * sizeof *lambda);
    for (int i = 0; i < nodes; i++) {
        const double t = (1 + x[i]) / 2;
        oracle_legendre(bands, t, p);
        for (int l = 0; l < bands; l++)
            lambda[l] += pi * weight[i] * t * p[l];
    }
}

void oracle_lobe_phong(int bands, double exponent, double *lambda) {
    moments(bands, phong_sample, exponent, lambda);
}

void oracle_lobe_vmf(int bands, double concentration, double *lambda) {
    moments(bands, vmf_sample, concentration, lambda);
}

/* --- rotation --------------------------------------------------------------------------------- */

void oracle_quaternion_matrix(const double q[4], double rotation[9]) {
    const double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    const double x = q[0] / length, y = q[1] / length, z = q[2] / length, w = q[3] / length;
    const double matrix[9] = { 1 - 2 * (y * y + z * z), 2 * (x * y - w * z),
                               2 * (x * z + w * y),     2 * (x * y + w * z),
                               1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
                               2 * (x * z - w * y),     2 * (y * z + w * x),
                               1 - 2 * (x * x + y * y) };
    memcpy(rotation, matrix, sizeof matrix);
}

void oracle_rotation(int bands, const double rotation[9], double *matrices) {
    const size_t count = (size_t)bands * (size_t)bands;
    const size_t total = (4 * count - 1) * (size_t)bands / 3;
    double x[ORACLE_BANDS_MAX], weight[ORACLE_BANDS_MAX];
    double *y = allocate(2 * count), *rotated = y + count;
    oracle_gauss_legendre(bands, x, weight);
    memset(matrices, 0, total * sizeof *matrices);
    for (int i = 0; i < bands; i++) {
        for (int j = 0; j < 2 * bands; j++) {
            const double sine = sqrt((1 - x[i]) * (1 + x[i])), phi = pi * j / bands;
            const double w[3] = { sine * cos(phi), sine * sin(phi), x[i] };
            double direction[3];
            for (int k = 0; k < 3; k++)
                direction[k] = rotation[3 * k] * w[0] + rotation[3 * k + 1] * w[1] +
                               rotation[3 * k + 2] * w[2];
            oracle_sh_eval(bands, w, y);
            oracle_sh_eval(bands, direction, rotated);
            double *entry = matrices;
            for (int l = 0; l < bands; l++)
                for (int m = l * l; m < (l + 1) * (l + 1); m++)
                    for (int k = l * l; k < (l + 1) * (l + 1); k++)
                        *entry++ += weight[i] * pi / bands * rotated[m] * y[k];
        }
    }
    free(y);
}
