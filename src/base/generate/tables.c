/* SPDX-License-Identifier: MIT */
/* Writes src/base/tables.c to standard output. Only +, -, *, / and sqrt, all rounded correctly by
 * IEEE 754, so every machine writes the same bytes. What it writes is kept in the tree, for a cross
 * build could not run it. */
#include "src/base/tables.h"

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

/* d^l_mk of a quarter turn, m >= 0, by the recurrence of src/sh/rotation.c from l = max(m, |k|). */
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

/* The cosine of so many quarters of a turn. */
static int quarter_cosine(int quarters) {
    const int of[4] = { 1, 0, -1, 0 };
    return of[((quarters % 4) + 4) % 4];
}
static int quarter_sine(int quarters) {
    return quarter_cosine(quarters - 1);
}

/* Row m, column k of band l's matrix: x by a quarter is z by -a quarter, y by one, z by one. */
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

/* --- triple products -------------------------------------------------------------------------- */

enum { DEGREES = 3 * LMP_TABLE_TRIPLE_BANDS }; /* of a product of three, and more */

/* Coefficients of a polynomial in z. */
typedef struct polynomial {
    double at[DEGREES];
} polynomial;

static polynomial times(const polynomial *a, const polynomial *b) {
    polynomial product = { { 0 } };
    for (int i = 0; i < DEGREES; i++)
        for (int j = 0; i + j < DEGREES; j++)
            product.at[i + j] += a->at[i] * b->at[j];
    return product;
}

/* q_l^m (tables.h). */
static polynomial column_of(int l, int m) {
    polynomial before = { { 0 } }, now = { { diagonal(m) } };
    for (int k = m + 1; k <= l; k++) {
        polynomial next = { { 0 } };
        for (int i = 0; i < DEGREES; i++)
            next.at[i] = (i > 0 ? recurrence_a(k, m) * now.at[i - 1] : 0) +
                         recurrence_b(k, m) * before.at[i];
        before = now;
        now = next;
    }
    return now;
}

/* What a product of three of cos(m phi), m >= 0, and sin(-m phi), m < 0, adds up to around z: each
 * is a sum of exp(± i m phi). */
static double around(const int m[3]) {
    const int sines = (m[0] < 0) + (m[1] < 0) + (m[2] < 0);
    double sum = 0;
    for (int signs = 0; sines % 2 == 0 && signs < 8; signs++) {
        int frequency = 0, sign = sines ? -1 : 1;
        for (int i = 0; i < 3; i++) {
            const int s = signs >> i & 1 ? -1 : 1;
            frequency += s * abs(m[i]);
            sign *= m[i] < 0 ? s : 1;
        }
        sum += frequency == 0 ? sign : 0;
    }
    return 2 * pi * sum / 8;
}

/* ∫ Y_i Y_j Y_k: the squared radius 1 - z² is there as often as half of all m. */
static double triple_of(const int index[3]) {
    const polynomial radius = { { 1, 0, -1 } };
    polynomial product = { { 1 } };
    int m[3], power = 0;
    for (int i = 0; i < 3; i++) {
        int l = 0;
        while ((l + 1) * (l + 1) <= index[i])
            l++;
        m[i] = index[i] - l * l - l;
        power += abs(m[i]);
        const polynomial column = column_of(l, abs(m[i]));
        product = times(&product, &column);
    }
    const double azimuth = around(m);
    for (int i = 0; azimuth != 0 && i < power / 2; i++)
        product = times(&product, &radius);
    double sum = 0;
    for (int i = 0; i < DEGREES; i += 2)
        sum += 2 * product.at[i] / (i + 1);
    return sum * azimuth;
}

/* Divided by how many orders of i, j, k are the same one. */
static double triple_share(int i, int j, int k) {
    const double value = triple_of((int[]) { i, j, k });
    return i == k ? value / 6 : i == j || j == k ? value / 2 : value;
}

/* Returns how many there are whose largest index is k; the smallest that is not 0 is above 1e-3. */
static int print_triples_of(int k, bool print) {
    int count = 0;
    for (int j = 0; j <= k; j++)
        for (int i = 0; i <= j; i++) {
            const double value = triple_share(i, j, k);
            if (fabs(value) < 1e-9)
                continue;
            if (print)
                printf("%s{ %d, %d, %d, %.9gf },", count % 4 == 0 ? "\n" : " ", i, j, k,
                       (double)(float)value);
            count++;
        }
    return count;
}

static void print_triples(void) {
    int ends[LMP_TABLE_TRIPLE_BANDS + 1] = { 0 };
    for (int bands = 1; bands <= LMP_TABLE_TRIPLE_BANDS; bands++) {
        ends[bands] = ends[bands - 1];
        for (int k = (bands - 1) * (bands - 1); k < bands * bands; k++)
            ends[bands] += print_triples_of(k, false);
    }
    printf("\nconst int lmp_table_triple_ends[LMP_TABLE_TRIPLE_BANDS + 1] = {");
    for (int bands = 0; bands <= LMP_TABLE_TRIPLE_BANDS; bands++)
        printf(" %d,", ends[bands]);
    printf(" };\n\nconst lmp_table_triple lmp_table_triples[%d] = {", ends[LMP_TABLE_TRIPLE_BANDS]);
    for (int k = 0; k < LMP_TABLE_TRIPLE_BANDS * LMP_TABLE_TRIPLE_BANDS; k++)
        print_triples_of(k, true);
    printf("\n};\n");
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
    printf("\nconst float lmp_table_%s[LMP_TABLE_COUNT] = {", name);
    int index = 0;
    for (int m = 0; m < LMP_BANDS_MAX; m++)
        for (int l = m; l < LMP_BANDS_MAX; l++)
            print_value(index++, entry(l, m));
    printf("\n};\n");
}

static void print_bands(const char *name, double (*entry)(int l)) {
    printf("\nconst float lmp_table_%s[LMP_BANDS_MAX] = {", name);
    for (int l = 0; l < LMP_BANDS_MAX; l++)
        print_value(l, entry(l));
    printf("\n};\n");
}

static void print_scale(void) {
    printf("\nconst double lmp_table_zonal_scale[2][LMP_BANDS_MAX] = { {");
    for (int form = 0; form < 2; form++) {
        for (int l = 0; l < LMP_BANDS_MAX; l++)
            printf("%s%.17g,", l % 4 == 0 ? "\n" : "", zonal_scale(form, l));
        printf(form ? "\n} };\n" : "\n}, {");
    }
}

static void print_quarters(void) {
    int index = 0;
    printf("\nconst float lmp_table_quarter[LMP_TABLE_QUARTERS] = {");
    for (int l = 0; l < LMP_TABLE_QUARTER_BANDS; l++)
        for (int m = -l; m <= l; m++)
            for (int k = lmp_table_quarter_first(l, m), n = lmp_table_quarter_count(l, m); n > 0;
                 n--, k += 2)
                print_value(index++, quarter(l, m, k));
    printf("\n};\n");
}

static void print_quarter_lanes(bool lanes) {
    enum { LANES = LMP_TABLE_QUARTER_LANES };
    printf("\nconst %s lmp_table_quarter_%s[4][3][LMP_TABLE_QUARTER_LANES] = {",
           lanes ? "int32_t" : "float", lanes ? "lanes" : "terms");
    for (int l = 2; l < 6; l++) {
        printf("%s", l == 2 ? " {" : " }, {");
        for (int term = 0; term < 3; term++) {
            printf("%s", term == 0 ? " {" : "\n}, {");
            for (int lane = 0; lane < LANES; lane++) {
                const int m = lane - LANES / 2;
                const bool is = abs(m) <= l && term < lmp_table_quarter_count(l, m);
                const int k = is ? lmp_table_quarter_first(l, m) + 2 * term : 0;
                if (lanes)
                    printf("%s%d,", lane == 0 ? "\n" : "", LANES / 2 + k);
                else
                    print_value(lane, is ? quarter(l, m, k) : 0);
            }
        }
        printf("\n}");
    }
    printf(" } };\n");
}

int main(void) {
    printf("/* SPDX-License-Identifier: MIT */\n"
           "/* Written by src/base/generate/tables.c; do not edit. */\n"
           "/* clang-format off */\n"
           "#include \"src/base/tables.h\"\n");
    print_triangle("a", recurrence_a);
    print_triangle("b", recurrence_b);
    print_bands("diagonal", diagonal);
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
    print_quarter_lanes(false);
    print_quarter_lanes(true);
    print_triples();
    return 0;
}
