/* SPDX-License-Identifier: MIT */
/* Writes src/base/tables.c to standard output, using only +, -, *, / and sqrt, which IEEE 754
 * rounds correctly, so that every machine writes the same bytes. The result is kept in the tree,
 * because a cross build could not run this program. */
#include "src/base/tables.h"
#include "src/base/tables_few.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

/* --- triangular ------------------------------------------------------------------------------- */

static double recurrence_a(int l, int m) {
    return l == m ? 0 : sqrt((4.0 * l * l - 1) / ((double)(l - m) * (l + m)));
}

static double recurrence_b(int l, int m) {
    if (l <= m + 1)
        return 0;
    const double numerator = (2.0 * l + 1) * (l - 1 - m) * (l - 1 + m);
    return -sqrt(numerator / ((2.0 * l - 3) * (l - m) * (l + m)));
}

static double diagonal(int m) {
    double q = sqrt(1 / (4 * pi));
    for (int k = 1; k <= m; k++)
        q *= k == 1 ? -sqrt(3) : -sqrt((2.0 * k + 1) / (2.0 * k));
    return q;
}

static double monic(int l, int m) {
    const double k = l - 1;
    return l <= m + 1 ? 0 : (k - m) * (k + m) / (4 * k * k - 1);
}

static double norm(int l, int m) {
    double n = diagonal(m);
    for (int k = m + 1; k <= l; k++)
        n *= recurrence_a(k, m);
    return n;
}

static double slope(int l, int m) {
    return -(m == 0 ? sqrt(0.5) : 1) * sqrt((double)(l - m) * (l + m + 1));
}

/* --- by band ---------------------------------------------------------------------------------- */

static double cap_d(int l) {
    return l < 2 ? 0 : (l - 2.0) / (l + 1.0);
}

static double cap_t(int l) {
    return l < 2 ? 0 : (2.0 * l - 1) / (l + 1.0);
}

static double legendre_d(int l) {
    return l < 1 ? 0 : (l - 1.0) / l;
}

static double legendre_t(int l) {
    return l < 1 ? 0 : (2.0 * l - 1) / l;
}

static double pole(int l) {
    return sqrt((2.0 * l + 1) / (4 * pi));
}

/* --- zonal sums, in monic form: P_l = u P_(l-1) - c_l P_(l-2) ----------------------------------
 */

static double zonal_lobe(int l) {
    return l < 2 ? 0 : (l - 1) * (l - 1) / (double)((2 * l - 1) * (2 * l - 3));
}

/* R_l = (2l-1)/(l+1) x R_(l-1) - (l-2)/(l+1) R_(l-2) */
static double zonal_cap(int l) {
    return l < 2 ? 0 : (l - 2) * l / (double)((2 * l - 1) * (2 * l - 3));
}

static double zonal_scale(int form, int l) {
    double norm_p = 1, norm_r = 1;
    for (int k = 1; form && k <= l; k++) {
        norm_p *= (2 * k - 1) / (double)k;
        norm_r *= k < 2 ? 1 : (2 * k - 1) / (double)(k + 1);
    }
    return (l == 0 ? 0.5 : (2 * l + 1) / 4.0) * norm_p * norm_r;
}

/* --- a quarter turn around x ------------------------------------------------------------------ */

/* Computes d^l_mk of a quarter turn, m >= 0, by the recurrence of src/sh/rotation.c from l = max(m,
 * |k|). */
static double quarter_wigner(int l, int m, int k) {
    const int first = m > abs(k) ? m : abs(k), other = m > abs(k) ? k : k < 0 ? -m : m;
    double before = 0, now = 1, root = 0;
    for (int i = 1; i <= first - other; i++)
        now *= (first + other + i) / (double)i;
    now = sqrt(now);
    for (int i = 0; i < first; i++)
        now /= 2;
    if ((first - other) % 2 != 0 && k <= m)
        now = -now;
    for (int i = first; i < l; i++) {
        const double up = (i + 1.0) * (i + 1.0);
        const double next = sqrt((up - (double)m * m) * (up - (double)k * k));
        const double tilt = i > 0 ? (double)m * k / i : 0;
        const double value =
            -(2 * i + 1) * tilt * now - (i > first ? (i + 1) * root / i * before : 0);
        before = now;
        now = value / next;
        root = next;
    }
    return now;
}

/* Returns the cosine of so many quarter turns. */
static int quarter_cosine(int quarters) {
    const int of[4] = { 1, 0, -1, 0 };
    return of[((quarters % 4) + 4) % 4];
}
static int quarter_sine(int quarters) {
    return quarter_cosine(quarters - 1);
}

/* Returns row m, column k of band l's matrix. A quarter turn around x is one around z by -90
 * degrees, one around y, and one around z. */
static double quarter(int l, int m, int k) {
    const int am = abs(m), ak = abs(k), sum = ak - am, difference = -am - ak;
    const double p = quarter_wigner(l, am, ak);
    const double s = (ak % 2 ? -1 : 1) * quarter_wigner(l, am, -ak);
    if (m == 0 || k == 0) {
        const double scale = m == 0 && k == 0 ? 1 : sqrt(2);
        return scale * p *
               (m < 0   ? quarter_sine(sum)
                : k < 0 ? -quarter_sine(sum)
                        : quarter_cosine(sum));
    }
    if (m > 0)
        return k > 0 ? p * quarter_cosine(sum) + s * quarter_cosine(difference)
                     : s * quarter_sine(difference) - p * quarter_sine(sum);
    return k > 0 ? p * quarter_sine(sum) + s * quarter_sine(difference)
                 : p * quarter_cosine(sum) - s * quarter_cosine(difference);
}

/* --- rotation of few bands by their values ------------------------------------------------------
 */

enum { ROTATE_AXES = 2 * LMPI_TABLE_FEW_BANDS - 1 };

/* Returns coordinate k of an axis, as rounded as programs read it. The axes were searched for small
 * inverses of the matrices of all bands: their rows' sums are at most 4.8 where values are those of
 * harmonics whose mean square is 1. */
static double rotate_axis(int i, int k) {
    static const int axes[ROTATE_AXES][3] = { { 2, 9, 13 },   { -5, 14, 5 }, { 12, -9, 6 },
                                              { 12, 8, 7 },   { -9, 10, 9 }, { 16, -1, 3 },
                                              { 12, 1, 10 },  { 7, -11, 9 }, { -1, 6, 15 },
                                              { 0, -12, 10 }, { 10, -13, 0 } };
    const int *of = axes[i];
    return (double)(float)(of[k] / sqrt(of[0] * of[0] + of[1] * of[1] + of[2] * of[2]));
}

/* Returns the square of a positive root of q_l^m over its norm, the greatest first, or 0. It is z
 * or 1 times z² - a, or times z⁴ - a z² + b. */
static double monic_square(int l, int m, int which) {
    double a = 0, b = 0;
    for (int k = m + 2; k <= l; k++) {
        /* q_k = z q_(k-1) - c_k q_(k-2): each product of two c lacks neighbors */
        for (int j = k + 2; j <= l; j++)
            b += monic(k, m) * monic(j, m);
        a += monic(k, m);
    }
    const double middle = a / 2, off = sqrt(middle * middle - b);
    return which == 0 ? middle + off : l - m >= 4 ? middle - off : 0;
}

/* Evaluates the harmonic at an axis. */
static double rotate_harmonic(int l, int m, int axis) {
    const double x = rotate_axis(axis, 0), y = rotate_axis(axis, 1), z = rotate_axis(axis, 2);
    double q = norm(l, abs(m)), c = 1, s = 0;
    for (int i = 0; i < abs(m); i++) {
        const double next = c * x - s * y;
        s = c * y + s * x;
        c = next;
    }
    for (int i = 0; i < (l - abs(m)) / 2; i++)
        q *= z * z - monic_square(l, abs(m), i);
    return q * ((l - m) % 2 != 0 ? z : 1) * (m < 0 ? s : c);
}

/* Computes, right of the matrix that evaluates band l at the axes, its inverse (Gauss, Jordan). */
static void rotate_invert(int l, double matrix[ROTATE_AXES][2 * ROTATE_AXES]) {
    const int count = 2 * l + 1;
    for (int i = 0; i < count; i++)
        for (int k = 0; k < count; k++) {
            matrix[i][k] = rotate_harmonic(l, k - l, i);
            matrix[i][count + k] = i == k ? 1 : 0;
        }
    for (int k = 0; k < count; k++) {
        int best = k;
        for (int i = k + 1; i < count; i++)
            if (fabs(matrix[i][k]) > fabs(matrix[best][k]))
                best = i;
        double row[2 * ROTATE_AXES];
        memcpy(row, matrix[best], sizeof row);
        memcpy(matrix[best], matrix[k], sizeof row);
        for (int j = 0; j < 2 * count; j++)
            matrix[k][j] = row[j] / row[k];
        for (int i = 0; i < count; i++) {
            const double factor = matrix[i][k];
            for (int j = 0; j < 2 * count && i != k; j++)
                matrix[i][j] -= factor * matrix[k][j];
        }
    }
}

/* --- products of few bands -------------------------------------------------------------------- */

/* Computes height i of Gauss's rule and its weight; heights of the first half lie above 0, and
 * those of the second are their opposites. Newton's last steps from the estimate change only the
 * last bits. */
static double product_height(int i, double *weight) {
    enum { HEIGHTS = LMPI_TABLE_PRODUCT_HEIGHTS };
    static const double estimates[HEIGHTS / 2] = { 0.96, 0.8, 0.53, 0.18 };
    double x = estimates[i % (HEIGHTS / 2)], slope = 1;
    for (int step = 0; step < 6; step++) {
        double before = 0, now = 1;
        for (int l = 0; l < HEIGHTS; l++) {
            const double next = ((2 * l + 1) * x * now - l * before) / (l + 1);
            before = now;
            now = next;
        }
        slope = HEIGHTS * (x * now - before) / (x * x - 1);
        x -= now / slope;
    }
    *weight = 2 / ((1 - x * x) * slope * slope);
    return i < HEIGHTS / 2 ? x : -x;
}

/* Computes q_l^m r^m (tables.h), with r the radius of the circle at height z. */
static double product_column(int l, int m, double z) {
    double before = 0, now = diagonal(m);
    for (int i = 0; i < m; i++)
        now *= sqrt((1 - z) * (1 + z));
    for (int k = m + 1; k <= l; k++) {
        const double next = recurrence_a(k, m) * z * now + recurrence_b(k, m) * before;
        before = now;
        now = next;
    }
    return now;
}

/* --- output ----------------------------------------------------------------------------------- */

static void print_value(int index, double value) {
    const float rounded = (float)value;
    if (!isfinite(rounded)) {
        fprintf(stderr, "generate_tables: a value overflows float32\n");
        exit(1);
    }
    char text[32];
    snprintf(text, sizeof text, "%.9g", (double)rounded);
    /* the suffix f needs a point or an exponent before it */
    const char *point = strpbrk(text, ".e") ? "" : ".";
    printf("%s%s%sf,", index % 8 == 0 ? "\n" : "", text, point);
}

static void print_triangle(const char *name, double (*entry)(int l, int m)) {
    printf("\nconst float lmpi_table_%s[LMPI_TABLE_COUNT] = {", name);
    int index = 0;
    for (int m = 0; m < LMP_BANDS_MAX; m++)
        for (int l = m; l < LMP_BANDS_MAX; l++)
            print_value(index++, entry(l, m));
    printf("\n};\n");
}

static void print_few(void) {
    enum { BANDS = LMPI_TABLE_FEW_BANDS };
    const double less[6][4] = {
        { 0, 0, monic_square(2, 0, 0), 0 },
        { 1, 1 / 3.0, 0, monic_square(3, 1, 0) },
        { monic_square(3, 0, 0), monic_square(3, 1, 0), 1, 3 },
        { monic_square(4, 2, 0), monic_square(4, 1, 0), monic_square(4, 0, 0),
          monic_square(4, 0, 1) },
        { monic_square(5, 2, 0), monic_square(5, 1, 0), monic_square(5, 0, 0),
          monic_square(5, 3, 0) },
        { 0, monic_square(5, 1, 1), monic_square(5, 0, 1), 0 },
    };
    printf("\nconst float lmpi_table_few_scale[] = {");
    for (int l = 0; l < BANDS; l++)
        for (int m = -l; m <= l; m++)
            print_value(l * (l + 1) + m, (m >= -4 && m <= -2 ? -m : 1) * norm(l, abs(m)));
    printf("\n};\n\nconst float lmpi_table_few_less[6][4] = { {");
    for (int i = 0; i < 24; i++) {
        printf("%s", i > 0 && i % 4 == 0 ? "\n}, {" : "");
        print_value(i % 4, less[i / 4][i % 4]);
    }
    printf("\n} };\n");
}

static void print_bands(const char *name, double (*entry)(int l)) {
    printf("\nconst float lmpi_table_%s[LMP_BANDS_MAX] = {", name);
    for (int l = 0; l < LMP_BANDS_MAX; l++)
        print_value(l, entry(l));
    printf("\n};\n");
}

static void print_scale(void) {
    printf("\nconst double lmpi_table_zonal_scale[2][LMP_BANDS_MAX] = { {");
    for (int form = 0; form < 2; form++) {
        for (int l = 0; l < LMP_BANDS_MAX; l++)
            printf("%s%.17g,", l % 4 == 0 ? "\n" : "", zonal_scale(form, l));
        printf(form ? "\n} };\n" : "\n}, {");
    }
}

static void print_quarters(void) {
    int index = 0;
    printf("\nconst float lmpi_table_quarter[LMPI_TABLE_QUARTERS] = {");
    for (int l = 0; l < LMPI_TABLE_QUARTER_BANDS; l++)
        for (int m = -l; m <= l; m++)
            for (int k = lmpi_table_quarter_first(l, m), n = lmpi_table_quarter_count(l, m); n > 0;
                 n--, k += 2)
                print_value(index++, quarter(l, m, k));
    printf("\n};\n");
}

static void print_rotate(void) {
    enum { BANDS = LMPI_TABLE_FEW_BANDS, LANES = LMPI_TABLE_ROTATE_AXES };
    printf("\nconst float lmpi_table_rotate_axes[3][LMPI_TABLE_ROTATE_AXES] = {");
    for (int k = 0; k < 3; k++) {
        printf("%s{", k == 0 ? " " : "\n}, ");
        for (int i = 0; i < LANES; i++)
            print_value(i, i < ROTATE_AXES ? rotate_axis(i, k) : 0);
    }
    printf("\n} };\n\nconst float lmpi_table_rotate_norms[] = {");
    for (int l = 0; l < BANDS; l++)
        for (int m = -l; m <= l; m++)
            print_value(l * (l + 1) + m, norm(l, abs(m)));
    printf("\n};\n\nconst float lmpi_table_rotate_squares[][LMPI_TABLE_FEW_BANDS][2] = {");
    for (int l = 0; l < BANDS; l++) {
        printf("%s{", l == 0 ? " " : "\n}, ");
        for (int m = 0; m < BANDS; m++) {
            printf("%s{", m == 0 ? " " : " }, ");
            for (int i = 0; i < 2; i++)
                print_value(i, m <= l ? monic_square(l, m, i) : 0);
        }
        printf(" }");
    }
    printf("\n} };\n\nconst float lmpi_table_rotate_inverse[][2 * LMPI_TABLE_FEW_BANDS - 1]"
           "[LMPI_TABLE_ROTATE_AXES] = {");
    for (int l = 2; l < BANDS; l++) {
        double matrix[ROTATE_AXES][2 * ROTATE_AXES];
        rotate_invert(l, matrix);
        printf("%s{", l == 2 ? " " : "\n}, ");
        for (int i = 0; i < ROTATE_AXES; i++) {
            printf("%s{", i == 0 ? " " : "\n}, ");
            for (int m = 0; m < LANES; m++)
                print_value(m, i <= 2 * l && m <= 2 * l ? matrix[m][2 * l + 1 + i] : 0);
        }
        printf("\n}");
    }
    printf("\n} };\n");
}

static void print_product(void) {
    double weight;
    printf("\nconst float lmpi_table_product_in[][LMPI_TABLE_PRODUCT_HEIGHTS] = {");
    for (int m = 0; m < LMPI_TABLE_PRODUCT_BANDS; m++)
        for (int l = m; l < LMPI_TABLE_PRODUCT_BANDS; l++) {
            printf("%s{", l + m == 0 ? " " : "\n}, ");
            for (int i = 0; i < LMPI_TABLE_PRODUCT_HEIGHTS; i++)
                print_value(i, (m == 0 ? 2 : 1) * product_column(l, m, product_height(i, &weight)));
        }
    printf("\n} };\n\nconst float lmpi_table_product_out[][LMPI_TABLE_PRODUCT_HEIGHTS / 2] = {");
    for (int l = 0; l < LMPI_TABLE_PRODUCT_BANDS; l++)
        for (int m = -l; m <= l; m++) {
            printf("%s{", l == 0 ? " " : "\n}, ");
            for (int i = 0; i < LMPI_TABLE_PRODUCT_HEIGHTS / 2; i++) {
                const double column = product_column(l, abs(m), product_height(i, &weight));
                print_value(i, (m == 0 ? pi : pi / 2) * weight * column);
            }
        }
    printf("\n} };\n");
}

int main(void) {
    printf("/* SPDX-License-Identifier: MIT */\n"
           "/* Written by src/base/generate/tables.c; do not edit. */\n"
           "/* clang-format off */\n"
           "#include \"src/base/tables.h\"\n#include \"src/base/tables_few.h\"\n");
    print_triangle("a", recurrence_a);
    print_triangle("b", recurrence_b);
    print_bands("diagonal", diagonal);
    print_few();
    print_triangle("monic", monic);
    print_triangle("norm", norm);
    print_triangle("slope", slope);
    print_bands("cap_d", cap_d);
    print_bands("cap_t", cap_t);
    print_bands("legendre_d", legendre_d);
    print_bands("legendre_t", legendre_t);
    print_scale();
    print_bands("zonal_cap", zonal_cap);
    print_bands("zonal_lobe", zonal_lobe);
    print_bands("pole", pole);
    print_quarters();
    print_rotate();
    print_product();
    return 0;
}
