/* SPDX-License-Identifier: MIT */
/* Fits linearly transformed cosines to glTF's GGX and prints app/truth/scoreboard_cosines_table.c.
 * At each node the Nelder-Mead method optimizes three parameters of the matrix, starting from the
 * fit of a neighboring node. The error is the cubed difference, as in Heitz et al. (2016),
 * estimated over directions sampled from both distributions. */
#include "app/truth/scoreboard_cosines_table.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

enum { MEMBERS = 3, STEPS = 400, DRAWS = 24, NORM_DRAWS = 96 };

static const double pi = 3.14159265358979323846;

typedef struct vector {
    double x, y, z;
} vector;

static vector unit(double x, double y, double z) {
    const double length = sqrt(x * x + y * y + z * z);
    return (vector) { x / length, y / length, z / length };
}

static double dot(vector a, vector b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/* --- GGX -------------------------------------------------------------------------------------- */

typedef struct ggx {
    double alpha;
    vector view;     /* in the xz plane, x >= 0 */
    double norm[2];  /* integrals of D V cos, and of D V cos (1 - v·h)^5 */
    double along[2]; /* x and z of the mean direction */
} ggx;

static double smith(double alpha, double cosine) {
    return sqrt(alpha * alpha + (1 - alpha * alpha) * cosine * cosine);
}

/* Returns D V cos at w; *density receives the probability density of ggx_draw there. */
static double ggx_at(const ggx *g, vector w, double *density) {
    *density = 0;
    if (w.z <= 0)
        return 0;
    const vector h = unit(w.x + g->view.x, w.y + g->view.y, w.z + g->view.z);
    const double a2 = g->alpha * g->alpha, d = h.z * h.z * (a2 - 1) + 1;
    const double distribution = a2 / (pi * d * d), vh = dot(g->view, h);
    *density = distribution * h.z / (4 * vh);
    return distribution * 0.5 * w.z /
           (w.z * smith(g->alpha, g->view.z) + g->view.z * smith(g->alpha, w.z));
}

static vector ggx_draw(const ggx *g, double u, double v) {
    const double tangent = g->alpha * sqrt(u / (1 - u)), phi = 2 * pi * v;
    const vector h = unit(tangent * cos(phi), tangent * sin(phi), 1);
    const double vh = dot(g->view, h);
    return (vector) { 2 * vh * h.x - g->view.x, 2 * vh * h.y - g->view.y,
                      2 * vh * h.z - g->view.z };
}

static ggx ggx_create(double alpha, double cosine) {
    ggx g = { .alpha = alpha, .view = { sqrt(1 - cosine * cosine), 0, cosine } };
    for (int k = 0; k < NORM_DRAWS * NORM_DRAWS; k++) {
        const vector w =
            ggx_draw(&g, (k % NORM_DRAWS + 0.5) / NORM_DRAWS, (k / NORM_DRAWS + 0.5) / NORM_DRAWS);
        double density;
        const double value = ggx_at(&g, w, &density);
        if (!(density > 0))
            continue;
        const double weight = value / density / (NORM_DRAWS * NORM_DRAWS);
        const double vh = sqrt((1 + dot(g.view, w)) / 2);
        g.norm[0] += weight;
        g.norm[1] += weight * pow(1 - vh, 5);
        g.along[0] += weight * w.x;
        g.along[1] += weight * w.z;
    }
    return g;
}

/* --- linearly transformed cosines ------------------------------------------------------------- */

/* The matrix with columns X, Y, Z times (a, 0, b; 0, c, 0; 0, 0, 1), where Z is the mean direction.
 * If the view direction is the normal, X is the x axis, a = c and b = 0. */
typedef struct cosines {
    double m[4]; /* xx, xz, zx, zz */
    double y;
    double determinant;
} cosines;

static cosines cosines_create(const ggx *g, const double p[MEMBERS]) {
    const double a = fmax(p[0], 1e-5), c = fmax(p[1], 1e-5), b = p[2];
    const double length = hypot(g->along[0], g->along[1]);
    const double sine = g->along[0] / length, cosine = g->along[1] / length;
    cosines t = { .m = { cosine * a, cosine * b + sine, -sine * a, -sine * b + cosine }, .y = c };
    t.determinant = t.y * (t.m[0] * t.m[3] - t.m[1] * t.m[2]);
    return t;
}

static void inverse(const cosines *t, double i[4]) {
    const double d = t->m[0] * t->m[3] - t->m[1] * t->m[2];
    i[0] = t->m[3] / d;
    i[1] = -t->m[1] / d;
    i[2] = -t->m[2] / d;
    i[3] = t->m[0] / d;
}

static double cosines_at(const cosines *t, const double i[4], vector w) {
    const double x = i[0] * w.x + i[1] * w.z, y = w.y / t->y, z = i[2] * w.x + i[3] * w.z;
    const double squared = x * x + y * y + z * z;
    return z > 0 ? z / pi / (fabs(t->determinant) * squared * squared) : 0;
}

static vector cosines_draw(const cosines *t, double u, double v) {
    const double r = sqrt(u), x = r * cos(2 * pi * v), y = r * sin(2 * pi * v), z = sqrt(1 - u);
    return unit(t->m[0] * x + t->m[1] * z, t->y * y, t->m[2] * x + t->m[3] * z);
}

/* --- the fit ---------------------------------------------------------------------------------- */

/* Returns the cubed difference divided by the sum of the two sampling densities. */
static double error_at(const ggx *g, const cosines *t, const double i[4], vector w) {
    double density;
    const double value = ggx_at(g, w, &density), fit = g->norm[0] * cosines_at(t, i, w);
    const double off = fabs(value - fit), both = density + fit / g->norm[0];
    return both > 0 ? off * off * off / both : 0;
}

static double error_of(const ggx *g, bool at_normal, const double p[MEMBERS]) {
    const double symmetric[MEMBERS] = { p[0], p[0], 0 };
    const cosines t = cosines_create(g, at_normal ? symmetric : p);
    double sum = 0, i[4];
    inverse(&t, i);
    for (int k = 0; k < DRAWS * DRAWS; k++) {
        const double u = (k % DRAWS + 0.5) / DRAWS, v = (k / DRAWS + 0.5) / DRAWS;
        sum += error_at(g, &t, i, ggx_draw(g, u, v)) + error_at(g, &t, i, cosines_draw(&t, u, v));
    }
    return sum;
}

typedef struct corner {
    double p[MEMBERS], error;
} corner;

static corner between(const ggx *g, bool at_normal, const double a[MEMBERS],
                      const double b[MEMBERS], double t) {
    corner c;
    for (int k = 0; k < MEMBERS; k++)
        c.p[k] = a[k] + t * (b[k] - a[k]);
    c.error = error_of(g, at_normal, c.p);
    return c;
}

static void sort(corner s[MEMBERS + 1]) {
    for (int i = 1; i <= MEMBERS; i++)
        for (int k = i; k > 0 && s[k].error < s[k - 1].error; k--) {
            const corner c = s[k];
            s[k] = s[k - 1];
            s[k - 1] = c;
        }
}

/* Takes one step of the simplex, whose corners are sorted by error. */
static void step(const ggx *g, bool at_normal, corner s[MEMBERS + 1]) {
    corner *const worst = &s[MEMBERS];
    double middle[MEMBERS] = { 0 };
    for (int i = 0; i < MEMBERS; i++)
        for (int k = 0; k < MEMBERS; k++)
            middle[k] += s[i].p[k] / MEMBERS;
    const corner reflected = between(g, at_normal, middle, worst->p, -1);
    if (reflected.error < s[0].error) {
        const corner further = between(g, at_normal, middle, worst->p, -2);
        *worst = further.error < reflected.error ? further : reflected;
    } else if (reflected.error < s[MEMBERS - 1].error) {
        *worst = reflected;
    } else {
        const corner nearer = between(g, at_normal, middle, worst->p, 0.5);
        if (nearer.error < worst->error)
            *worst = nearer;
        else
            for (int i = 1; i <= MEMBERS; i++)
                s[i] = between(g, at_normal, s[0].p, s[i].p, 0.5);
    }
    sort(s);
}

/* Fits the matrix, starting from p and storing the result in p. */
static void fit(const ggx *g, bool at_normal, double p[MEMBERS]) {
    corner s[MEMBERS + 1];
    for (int i = 0; i <= MEMBERS; i++) {
        memcpy(s[i].p, p, sizeof s[i].p);
        if (i > 0)
            s[i].p[i - 1] += i == MEMBERS ? 0.1 * p[0] : 0.1 * p[i - 1];
        s[i].error = error_of(g, at_normal, s[i].p);
    }
    sort(s);
    for (int k = 0; k < STEPS && s[MEMBERS].error > s[0].error * (1 + 1e-7); k++)
        step(g, at_normal, s);
    memcpy(p, s[0].p, sizeof s[0].p);
    if (at_normal) {
        p[1] = p[0];
        p[2] = 0;
    }
}

static void print_node(const ggx *g, const double p[MEMBERS]) {
    const cosines t = cosines_create(g, p);
    double i[4];
    inverse(&t, i);
    printf("    { ");
    for (int k = 0; k < 4; k++)
        printf("%#.6gf, ", i[k] * t.y);
    printf("%#.6gf, %#.6gf },\n", g->norm[0], g->norm[1]);
}

int main(void) {
    static double fitted[COSINES_SIZE][COSINES_SIZE][MEMBERS];
    static ggx all[COSINES_SIZE][COSINES_SIZE];
    const double last = COSINES_SIZE - 1;
    for (int i = COSINES_SIZE - 1; i >= 0; i--)
        for (int j = 0; j < COSINES_SIZE; j++) {
            double *const p = fitted[i][j];
            const double first[MEMBERS] = { 1, 1, 0 };
            const double alpha = fmax(i / last * i / last, 1e-4);
            all[i][j] = ggx_create(alpha, fmax(1 - j / last * j / last, 2e-3));
            memcpy(p,
                   j > 0                  ? fitted[i][j - 1]
                   : i + 1 < COSINES_SIZE ? fitted[i + 1][0]
                                          : first,
                   sizeof first);
            fit(&all[i][j], j == 0, p);
        }
    printf("/* SPDX-License-Identifier: MIT */\n/* clang-format off */\n"
           "/* Written by tests/ruler/generate_cosines.c: do not edit. */\n"
           "#include \"app/truth/scoreboard_cosines_table.h\"\n\n"
           "const float cosines_nodes[COSINES_SIZE * COSINES_SIZE][COSINES_MEMBERS] = {\n");
    for (int i = 0; i < COSINES_SIZE; i++)
        for (int j = 0; j < COSINES_SIZE; j++)
            print_node(&all[i][j], fitted[i][j]);
    printf("};\n");
    return 0;
}
