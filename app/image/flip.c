/* SPDX-License-Identifier: MIT */
#include "app/image/flip.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The constants of the paper. */
#define PIXELS_A_DEGREE 67.02
#define FEATURE_WIDTH   0.082 /* degrees */
#define COLOR_POWER     0.7
#define FEATURE_POWER   0.5
#define KNEE            0.4  /* color differences below this fraction of the largest … */
#define KNEE_VALUE      0.95 /* … are mapped to this part of the scale */

enum { REACH = 10, TAPS = 2 * REACH + 1 };
enum { LIGHTNESS, RED_GREEN, BLUE_YELLOW, EDGE, POINT, PLANES };

static const double white[3] = { 0.950428545, 1, 1.088900371 }; /* D65 */

typedef double kernel[TAPS];

/* The features of one image: L*a*b* after filtering by the eye's contrast sensitivity, and the
 * strength of edges and points. */
typedef struct seen {
    int width, height;
    float *planes[PLANES], *source, *filtered; /* the last two are temporary */
} seen;

/* --- color ------------------------------------------------------------------------------------ */

static double decoded(double v) {
    const double held = fmin(fmax(v, 0), 1);
    return held <= 0.04045 ? held / 12.92 : pow((held + 0.055) / 1.055, 2.4);
}

static void to_xyz(const double rgb[3], double xyz[3]) {
    xyz[0] = 0.4124564 * rgb[0] + 0.3575761 * rgb[1] + 0.1804375 * rgb[2];
    xyz[1] = 0.2126729 * rgb[0] + 0.7151522 * rgb[1] + 0.0721750 * rgb[2];
    xyz[2] = 0.0193339 * rgb[0] + 0.1191920 * rgb[1] + 0.9503041 * rgb[2];
}

static void to_rgb(const double xyz[3], double rgb[3]) {
    rgb[0] = 3.2404542 * xyz[0] - 1.5371385 * xyz[1] - 0.4985314 * xyz[2];
    rgb[1] = -0.9692660 * xyz[0] + 1.8760108 * xyz[1] + 0.0415560 * xyz[2];
    rgb[2] = 0.0556434 * xyz[0] - 0.2040259 * xyz[1] + 1.0572252 * xyz[2];
}

/* Convert to the linear opponent space Y Cx Cz, and back. */
static void to_opponent(const double rgb[3], double opponent[3]) {
    double xyz[3];
    to_xyz(rgb, xyz);
    for (int k = 0; k < 3; k++)
        xyz[k] /= white[k];
    opponent[0] = 116 * xyz[1] - 16;
    opponent[1] = 500 * (xyz[0] - xyz[1]);
    opponent[2] = 200 * (xyz[1] - xyz[2]);
}

static void from_opponent(const double opponent[3], double rgb[3]) {
    const double y = (opponent[0] + 16) / 116;
    const double xyz[3] = { (y + opponent[1] / 500) * white[0], y * white[1],
                            (y - opponent[2] / 200) * white[2] };
    to_rgb(xyz, rgb);
    for (int k = 0; k < 3; k++)
        rgb[k] = fmin(fmax(rgb[k], 0), 1);
}

static double lab_root(double t) {
    const double knee = 6.0 / 29;
    return t > knee * knee * knee ? cbrt(t) : t / (3 * knee * knee) + 4.0 / 29;
}

/* Converts to L*a*b* with Hunt's adjustment, which weights colors by their lightness. */
static void to_lab(const double rgb[3], double lab[3]) {
    double xyz[3];
    to_xyz(rgb, xyz);
    for (int k = 0; k < 3; k++)
        xyz[k] = lab_root(xyz[k] / white[k]);
    lab[0] = 116 * xyz[1] - 16;
    lab[1] = 0.01 * lab[0] * 500 * (xyz[0] - xyz[1]);
    lab[2] = 0.01 * lab[0] * 200 * (xyz[1] - xyz[2]);
}

static double hyab(const double a[3], const double b[3]) {
    return fabs(a[0] - b[0]) + hypot(a[1] - b[1], a[2] - b[2]);
}

/* --- filters ---------------------------------------------------------------------------------- */

static void scale_to(kernel k, double positive, double negative) {
    double sums[2] = { 0, 0 };
    for (int i = 0; i < TAPS; i++)
        sums[k[i] < 0] += fabs(k[i]);
    for (int i = 0; i < TAPS; i++)
        k[i] *= k[i] < 0 ? negative / sums[1] : positive / sums[0];
}

/* Fills a kernel of the contrast sensitivity, exp(-pi² x² / b) with x in degrees; returns its
 * weight in two dimensions, a sqrt(pi / b) times the square of its sum. */
static double fill_sensitivity(double a, double b, kernel k) {
    double sum = 0;
    for (int i = 0; i < TAPS; i++) {
        const double x = (i - REACH) / PIXELS_A_DEGREE;
        sum += k[i] = exp(-M_PI * M_PI * x * x / b);
    }
    scale_to(k, 1, 0);
    return a * sqrt(M_PI / b) * sum * sum;
}

/* Fills a Gaussian and its first two derivatives. */
static void fill_features(kernel smooth, kernel edge, kernel point) {
    const double sigma = 0.5 * FEATURE_WIDTH * PIXELS_A_DEGREE, s2 = sigma * sigma;
    for (int i = 0; i < TAPS; i++) {
        const double x = i - REACH;
        smooth[i] = fabs(x) <= ceil(3 * sigma) ? exp(-x * x / (2 * s2)) : 0;
        edge[i] = -x * smooth[i];
        point[i] = (x * x / s2 - 1) * smooth[i];
    }
    scale_to(smooth, 1, 0);
    scale_to(edge, 1, 1);
    scale_to(point, 1, 1);
}

static int held(int at, int count) {
    return at < 0 ? 0 : at < count ? at : count - 1;
}

/* Filters s->source by a kernel along rows, then by another one along columns; `use` receives the
 * value of each pixel. The image is extended by its edge pixels. */
static void filter(const seen *s, const kernel across, const kernel down, float weight, bool square,
                   float *sum) {
#pragma omp parallel for schedule(static)
    for (int y = 0; y < s->height; y++)
        for (int x = 0; x < s->width; x++) {
            double value = 0;
            for (int i = 0; i < TAPS; i++)
                value += across[i] * (double)s->source[(size_t)y * (size_t)s->width +
                                                       (size_t)held(x + i - REACH, s->width)];
            s->filtered[(size_t)y * (size_t)s->width + (size_t)x] = (float)value;
        }
#pragma omp parallel for schedule(static)
    for (int y = 0; y < s->height; y++)
        for (int x = 0; x < s->width; x++) {
            double value = 0;
            for (int i = 0; i < TAPS; i++)
                value +=
                    down[i] *
                    (double)s->filtered[(size_t)held(y + i - REACH, s->height) * (size_t)s->width +
                                        (size_t)x];
            sum[(size_t)y * (size_t)s->width + (size_t)x] +=
                weight * (float)(square ? value * value : value);
        }
}

/* --- an image --------------------------------------------------------------------------------- */

static size_t pixels_of(const seen *s) {
    return (size_t)s->width * (size_t)s->height;
}

static void load_channel(const seen *s, const image *from, int channel) {
    for (size_t p = 0; p < pixels_of(s); p++) {
        const float *v = from->rgb + 3 * p;
        const double rgb[3] = { decoded((double)v[0]), decoded((double)v[1]),
                                decoded((double)v[2]) };
        double opponent[3];
        to_opponent(rgb, opponent);
        s->source[p] = (float)opponent[channel];
    }
}

static void filter_channels(const seen *s, const image *from) {
    static const double sensitivity[3][2][2] = { { { 1, 0.0047 }, { 0, 1 } },
                                                 { { 1, 0.0053 }, { 0, 1 } },
                                                 { { 34.1, 0.04 }, { 13.5, 0.025 } } };
    for (int c = 0; c < 3; c++) {
        kernel parts[2];
        double weights[2];
        for (int i = 0; i < 2; i++)
            weights[i] = fill_sensitivity(sensitivity[c][i][0], sensitivity[c][i][1], parts[i]);
        load_channel(s, from, c);
        for (int i = 0; i < 2; i++)
            if (weights[i] > 0)
                filter(s, parts[i], parts[i], (float)(weights[i] / (weights[0] + weights[1])),
                       false, s->planes[LIGHTNESS + c]);
    }
}

static void find_features(const seen *s, const image *from) {
    kernel smooth, edge, point;
    fill_features(smooth, edge, point);
    load_channel(s, from, 0);
    for (size_t p = 0; p < pixels_of(s); p++)
        s->source[p] = (s->source[p] + 16) / 116;
    filter(s, edge, smooth, 1, true, s->planes[EDGE]);
    filter(s, smooth, edge, 1, true, s->planes[EDGE]);
    filter(s, point, smooth, 1, true, s->planes[POINT]);
    filter(s, smooth, point, 1, true, s->planes[POINT]);
}

static void finish_colors(const seen *s) {
    for (size_t p = 0; p < pixels_of(s); p++) {
        double opponent[3], rgb[3], lab[3];
        for (int c = 0; c < 3; c++)
            opponent[c] = (double)s->planes[LIGHTNESS + c][p];
        from_opponent(opponent, rgb);
        to_lab(rgb, lab);
        for (int c = 0; c < 3; c++)
            s->planes[LIGHTNESS + c][p] = (float)lab[c];
    }
}

static bool look(const image *from, seen *s) {
    const size_t count = (size_t)from->width * (size_t)from->height;
    float *memory = calloc(count * (PLANES + 2), sizeof *memory);
    *s = (seen) { .width = from->width, .height = from->height, .source = memory };
    if (!memory)
        return false;
    s->filtered = memory + count;
    for (int i = 0; i < PLANES; i++)
        s->planes[i] = memory + (size_t)(i + 2) * count;
    filter_channels(s, from);
    find_features(s, from);
    finish_colors(s);
    return true;
}

/* --- the difference --------------------------------------------------------------------------- */

/* Returns the largest color difference, which is that between green and blue. */
static double largest_color(void) {
    double green[3], blue[3];
    to_lab((const double[]) { 0, 1, 0 }, green);
    to_lab((const double[]) { 0, 0, 1 }, blue);
    return pow(hyab(green, blue), COLOR_POWER);
}

static double color_difference(const seen *a, const seen *b, size_t p, double largest) {
    double lab[2][3];
    for (int c = 0; c < 3; c++) {
        lab[0][c] = (double)a->planes[LIGHTNESS + c][p];
        lab[1][c] = (double)b->planes[LIGHTNESS + c][p];
    }
    const double d = pow(hyab(lab[0], lab[1]), COLOR_POWER) / largest;
    return d < KNEE ? KNEE_VALUE / KNEE * d
                    : KNEE_VALUE + (d - KNEE) / (1 - KNEE) * (1 - KNEE_VALUE);
}

static double feature_difference(const seen *a, const seen *b, size_t p) {
    double largest = 0;
    for (int k = EDGE; k <= POINT; k++)
        largest =
            fmax(largest, fabs(sqrt((double)a->planes[k][p]) - sqrt((double)b->planes[k][p])));
    return pow(largest / sqrt(2), FEATURE_POWER);
}

bool compare_flip(const image *candidate, const image *reference, double *flip) {
    seen a, b = { .source = NULL };
    const bool ok = look(candidate, &a) && look(reference, &b);
    const double largest = largest_color();
    double sum = 0;
    for (size_t p = 0; ok && p < pixels_of(&a); p++)
        sum += pow(color_difference(&a, &b, p, largest), 1 - feature_difference(&a, &b, p));
    *flip = ok ? sum / (double)pixels_of(&a) : 0;
    free(a.source);
    free(b.source);
    return ok;
}
