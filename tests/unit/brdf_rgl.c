/* SPDX-License-Identifier: MIT */
/* The reader of RGL tensor files: what it makes of them. */
#include "tests/oracle/oracle.h"
#include "tests/unit/tensor.h"

/* --- values ----------------------------------------------------------------------------------- */

/* The value is that of the file over the second cosine, times ndf / (4 sigma) where the file says
 * so. */
static void samples_are_scaled_by_the_model_and_the_cosine(void **state) {
    (void)state;
    for (int jacobian = 0; jacobian < 2; jacobian++) {
        tensor t = flat_rgb();
        find(&t, "jacobian")->values[0] = (float)jacobian;
        for (size_t i = 0; i < 4; i++) {
            find(&t, "ndf")->values[i] = 3;
            find(&t, "sigma")->values[i] = 0.5f;
        }
        lmp_brdf *brdf = opened(t);
        for (int n = 0; n < 100; n++) {
            double a[3], b[3], rgb[3];
            random_pair(a, b);
            lmp_brdf_eval_double(brdf, a, b, rgb);
            for (int c = 0; c < 3; c++)
                CHECK_WITHIN(fabs(rgb[c] * b[2] - (c + 1) * (jacobian ? 3 / (4 * 0.5) : 1)), 1e-12);
        }
        lmp_brdf_destroy(brdf);
    }
}

/* The database stores isotropic materials as two equal slices, at -pi and pi. */
static void files_of_two_azimuths_are_isotropic(void **state) {
    (void)state;
    for (uint64_t phis = 1; phis <= 2; phis++) {
        tensor t = { 0 };
        float *theta = add(&t, "theta_i", F32, SHAPE(3), 0)->values;
        theta[1] = 0.75f, theta[2] = 1.5f;
        float *phi = add(&t, "phi_i", F32, SHAPE(phis), -3.14159265f)->values;
        phi[phis - 1] = phis == 2 ? 3.14159265f : 0;
        add(&t, "ndf", F32, SHAPE(2, 2), 1);
        add(&t, "sigma", F32, SHAPE(2, 2), 1);
        add(&t, "vndf", F32, SHAPE(phis, 3, 2, 2), 1);
        add(&t, "rgb", F32, SHAPE(phis, 3, 3, 4, 5), 1);
        add(&t, "jacobian", U8, SHAPE(1), 1);
        lmp_brdf *brdf = opened(t);
        const lmp_brdf_info info = lmp_brdf_describe(brdf);
        assert_false(info.anisotropic);
        assert_int_equal(info.shape[0], phis);
        assert_int_equal(info.shape[1], 3);
        lmp_brdf_destroy(brdf);
    }
}

static void negative_samples_reflect_nothing(void **state) {
    (void)state;
    tensor t = flat_rgb();
    for (size_t i = 0; i < 24; i++)
        find(&t, "rgb")->values[i] = i / 4 % 3 == 1 ? -1.0f : 1.0f;
    lmp_brdf *brdf = opened(t);
    const double up[3] = { 0, 0, 1 };
    double rgb[3];
    lmp_brdf_eval_double(brdf, up, up, rgb);
    assert_true(rgb[0] > 0 && rgb[1] == 0 && rgb[2] > 0);
    lmp_brdf_destroy(brdf);
}

/* Unknown fields of bytes, and `luminance`, are skipped. */
static void unknown_fields_are_skipped(void **state) {
    (void)state;
    tensor t = flat_rgb();
    add(&t, "made_by", U8, SHAPE(3), 'x');
    add(&t, "luminance", F32, SHAPE(1, 2, 2, 2), NAN);
    lmp_brdf_destroy(opened(t));
}

static void spectral_color(size_t count, const float *nm, const float *spectrum, double rgb[3]) {
    tensor t = flat_spectral(count, nm, spectrum);
    find(&t, "jacobian")->values[0] = 0;
    lmp_brdf *brdf = opened(t);
    assert_true(lmp_brdf_describe(brdf).spectral);
    const double up[3] = { 0, 0, 1 };
    lmp_brdf_eval_double(brdf, up, up, rgb);
    lmp_brdf_destroy(brdf);
}

static void flat_spectra_are_grey(void **state) {
    (void)state;
    float nm[40], spectrum[40];
    for (int i = 0; i < 40; i++) {
        nm[i] = 360 + 10.5f * (float)i;
        spectrum[i] = 0.75f;
    }
    double rgb[3];
    spectral_color(40, nm, spectrum, rgb);
    for (int c = 0; c < 3; c++)
        CHECK_WITHIN(fabs(rgb[c] - 0.75), 1e-6);
}

static void multiply(const double m[3][3], const double v[3], double out[3]) {
    for (int r = 0; r < 3; r++)
        out[r] = m[r][0] * v[0] + m[r][1] * v[1] + m[r][2] * v[2];
}

/* Converts CIE XYZ under illuminant E to linear sRGB, step by step: Bradford's cones, D65's white
 * over E's, back, and the primaries of IEC 61966-2-1. */
static void srgb_of(const double xyz[3], double rgb[3]) {
    static const double cones[3][3] = { { 0.8951, 0.2664, -0.1614 },
                                        { -0.7502, 1.7135, 0.0367 },
                                        { 0.0389, -0.0685, 1.0296 } };
    static const double back[3][3] = { { 0.9869929, -0.1470543, 0.1599627 },
                                       { 0.4323053, 0.5183603, 0.0492912 },
                                       { -0.0085287, 0.0400428, 0.9684867 } };
    static const double primaries[3][3] = { { 3.2404542, -1.5371385, -0.4985314 },
                                            { -0.9692660, 1.8760108, 0.0415560 },
                                            { 0.0556434, -0.2040259, 1.0572252 } };
    static const double e[3] = { 1, 1, 1 }, d65[3] = { 0.95047, 1, 1.08883 };
    double from[3], to[3], lms[3], adapted[3];
    multiply(cones, e, from);
    multiply(cones, d65, to);
    multiply(cones, xyz, lms);
    for (int k = 0; k < 3; k++)
        lms[k] *= to[k] / from[k];
    multiply(back, lms, adapted);
    multiply(primaries, adapted, rgb);
}

/* Lines of the CIE's own table, 20 nm apart, are read one by one over a gray base, which keeps
 * negative colors visible. */
static void spectral_lines_have_the_color_of_the_observer(void **state) {
    (void)state;
    enum { LINES = 13 };
    static const double cie[LINES][3] = {
        { 0.13438, 0.00400, 0.64560 }, { 0.34828, 0.02300, 1.74706 }, { 0.29080, 0.06000, 1.66920 },
        { 0.09564, 0.13902, 0.81295 }, { 0.00490, 0.32300, 0.27200 }, { 0.06327, 0.71000, 0.07825 },
        { 0.29040, 0.95400, 0.02030 }, { 0.59450, 0.99500, 0.00390 }, { 0.91630, 0.87000, 0.00165 },
        { 1.06220, 0.63100, 0.00080 }, { 0.85445, 0.38100, 0.00019 }, { 0.44790, 0.17500, 0.00002 },
        { 0.16490, 0.06100, 0.00000 },
    };
    double sum[3] = { 0, 0, 0 }, worst = 0;
    float nm[LINES];
    for (int i = 0; i < LINES; i++) {
        nm[i] = 420 + 20 * (float)i;
        for (int c = 0; c < 3; c++)
            sum[c] += (i % (LINES - 1) ? 1 : 0.5) * cie[i][c];
    }
    for (int line = 0; line < LINES; line++) {
        double xyz[3], expected[3], rgb[3];
        for (int c = 0; c < 3; c++)
            xyz[c] = (line % (LINES - 1) ? 1 : 0.5) * cie[line][c] / sum[c];
        srgb_of(xyz, expected);
        float spectrum[LINES];
        for (int i = 0; i < LINES; i++)
            spectrum[i] = i == line ? 2 : 1;
        spectral_color(LINES, nm, spectrum, rgb);
        for (int c = 0; c < 3; c++)
            worst = fmax(worst, fabs(rgb[c] - 1 - expected[c]));
    }
    print_message("colors of spectral lines: %.4f off the CIE's\n", worst);
    CHECK_WITHIN(worst, 0.012);
}

/* --- the parameterization --------------------------------------------------------------------- */

/* Evaluates a bilinear function on the unit square, with values row after row. */
static double bilinear(const float *values, int width, int height, double x, double y) {
    const double u = x * (width - 1), v = y * (height - 1);
    const int i = u < width - 2 ? (int)u : width - 2, j = v < height - 2 ? (int)v : height - 2;
    const float *at = values + j * width + i;
    const double s = u - i, t = v - j;
    return (1 - t) * ((1 - s) * (double)at[0] + s * (double)at[1]) +
           t * ((1 - s) * (double)at[width] + s * (double)at[width + 1]);
}

/* Integrates along x from 0 to `end` of a row at y: pieces are linear, so midpoints suffice. */
static double row_integral(const float *values, int width, int height, double end, double y) {
    double sum = 0;
    for (int i = 0; i < width - 1; i++) {
        const double low = (double)i / (width - 1), high = fmin((double)(i + 1) / (width - 1), end);
        if (high > low)
            sum += (high - low) * bilinear(values, width, height, (low + high) / 2, y);
    }
    return sum;
}

/* Integrates the rows from y = 0 to `end`; they are linear between nodes, too. */
static double area_integral(const float *values, int width, int height, double end) {
    double sum = 0;
    for (int j = 0; j < height - 1; j++) {
        const double low = (double)j / (height - 1);
        const double high = fmin((double)(j + 1) / (height - 1), end);
        if (high > low)
            sum += (high - low) * row_integral(values, width, height, 1, (low + high) / 2);
    }
    return sum;
}

enum { THETAS = 4, PHIS = 5, DENSITY_X = 5, DENSITY_Y = 6, VALUE_X = 4, VALUE_Y = 6 };

/* Makes a file of random values: anisotropic over a whole turn, or isotropic. Rows of density at
 * the bottom of a slice may be 0. */
static tensor random_tensor(int phis, int zero_rows) {
    tensor t = { 0 };
    field *theta = add(&t, "theta_i", F32, SHAPE(THETAS), 0);
    for (int i = 0; i < THETAS; i++)
        theta->values[i] = 1.5f * (float)(i * i + i) / (THETAS * (THETAS - 1));
    field *phi = add(&t, "phi_i", F32, SHAPE((uint64_t)phis), 0);
    for (int i = 0; i < phis; i++)
        phi->values[i] = phis > 1 ? (float)(ORACLE_PI * (2.0 * i / (phis - 1) - 1)) : 0;
    add(&t, "ndf", F32, SHAPE(7, 5), 0);
    add(&t, "sigma", F32, SHAPE(3, 4), 0);
    add(&t, "vndf", F32, SHAPE((uint64_t)phis, THETAS, DENSITY_Y, DENSITY_X), 0);
    add(&t, "rgb", F32, SHAPE((uint64_t)phis, THETAS, 3, VALUE_Y, VALUE_X), 0);
    for (int f = 2; f < 6; f++)
        for (size_t i = 0; i < field_count(&t.fields[f]); i++)
            t.fields[f].values[i] = (float)check_random_between(0.2, 2);
    field *density = find(&t, "vndf");
    for (size_t i = 0; i < field_count(density); i++)
        if ((int)(i / DENSITY_X) % DENSITY_Y < zero_rows)
            density->values[i] = 0;
    add(&t, "jacobian", U8, SHAPE(1), 1);
    return t;
}

/* Finds the nodes around an angle; returns its distance from the first of them. */
static double between(const float *nodes, int count, double angle, int *first) {
    for (*first = 0; *first < count - 2 && (double)nodes[*first + 1] <= angle;)
        ++*first;
    if (count < 2)
        return 0;
    const double low = (double)nodes[*first], high = (double)nodes[*first + 1];
    return fmin(fmax((angle - low) / (high - low), 0), 1);
}

/* Evaluates by the integrals that define the parameterization (Dupuy and Jakob 2018): half vectors
 * are distributed over the square by the density of visible normals, each slice's integral 1, of
 * the four slices around a. */
static void value_by_integrals(tensor *t, const double a[3], const double b[3], double rgb[3]) {
    const int phis = (int)find(t, "phi_i")->shape[0];
    const double length = sqrt((a[0] + b[0]) * (a[0] + b[0]) + (a[1] + b[1]) * (a[1] + b[1]) +
                               (a[2] + b[2]) * (a[2] + b[2]));
    const double m[3] = { (a[0] + b[0]) / length, (a[1] + b[1]) / length, (a[2] + b[2]) / length };
    const double theta = acos(a[2]), phi = atan2(a[1], a[0]);
    const double phi_m = atan2(m[1], m[0]) - (phis == 1 ? phi : 0);
    const double turns = (phi_m + ORACLE_PI) / (2 * ORACLE_PI);
    const double x = sqrt(acos(m[2]) * 2 / ORACLE_PI), y = turns - floor(turns);
    int i, j;
    const double p = between(find(t, "phi_i")->values, phis, phi, &i);
    const double q = between(find(t, "theta_i")->values, THETAS, theta, &j);
    double row = 0, part = 0, below = 0, value[3] = { 0 };
    for (int pass = 0; pass < 2; pass++)
        for (int k = 0; k < (phis == 1 ? 2 : 4); k++) {
            const double weight = (k & 1 ? q : 1 - q) * (k & 2 ? p : 1 - p);
            const int slice = (i + k / 2) * THETAS + j + k % 2;
            const float *density = find(t, "vndf")->values + slice * DENSITY_X * DENSITY_Y;
            const double scale = weight / area_integral(density, DENSITY_X, DENSITY_Y, 1);
            if (pass == 0) {
                row += scale * row_integral(density, DENSITY_X, DENSITY_Y, 1, y);
                part += scale * row_integral(density, DENSITY_X, DENSITY_Y, x, y);
                below += scale * area_integral(density, DENSITY_X, DENSITY_Y, y);
                continue;
            }
            for (int c = 0; c < 3; c++)
                value[c] +=
                    weight * bilinear(find(t, "rgb")->values + (3 * slice + c) * VALUE_X * VALUE_Y,
                                      VALUE_X, VALUE_Y, row > 0 ? part / row : x, below);
        }
    const double ndf = bilinear(find(t, "ndf")->values, 5, 7, x, y);
    const double sigma = bilinear(find(t, "sigma")->values, 4, 3, sqrt(theta * 2 / ORACLE_PI),
                                  (phi + ORACLE_PI) / (2 * ORACLE_PI));
    for (int c = 0; c < 3; c++)
        rgb[c] = value[c] * ndf / (4 * sigma) / b[2];
}

static void values_follow_the_density_of_visible_normals(void **state) {
    (void)state;
    for (int kind = 0; kind < 6; kind++) {
        tensor t = random_tensor(kind % 2 ? PHIS : 1, kind / 2);
        size_t size = 0;
        unsigned char *bytes = bytes_of(&t, &size);
        lmp_brdf *brdf = read_bytes(bytes, size);
        double worst = 0;
        for (int n = 0; n < 2000; n++) {
            double a[3], b[3], expected[3], rgb[3];
            random_pair(a, b);
            const double scale = 1 / sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
            for (int k = 0; k < 3; k++)
                a[k] *= scale;
            lmp_brdf_eval_double(brdf, a, b, rgb);
            value_by_integrals(&t, a, b, expected);
            for (int c = 0; c < 3; c++)
                worst = fmax(worst, fabs(rgb[c] / expected[c] - 1));
        }
        print_message("%s, %d rows without density: %.1e\n", kind % 2 ? "anisotropic" : "isotropic",
                      kind / 2, worst);
        CHECK_WITHIN(worst, 2e-6);
        lmp_brdf_destroy(brdf);
        free(bytes);
        drop(&t);
    }
}

/* --- folding ---------------------------------------------------------------------------------- */

/* Parses a written file. */
static tensor taken_apart(const unsigned char *bytes) {
    tensor t = { 0 };
    static const char *const names[] = { "theta_i", "phi_i", "ndf",      "sigma",
                                         "vndf",    "rgb",   "jacobian", NULL };
    const unsigned char *p = bytes + 14;
    for (uint32_t left = lmpi_bytes_load_u32(&p); left > 0; left--) {
        const size_t length = lmpi_bytes_load_u16(&p);
        const char *const name = (const char *)p;
        p += length;
        const unsigned dimensions = lmpi_bytes_load_u16(&p), type = *p++;
        const unsigned char *data = bytes + lmpi_bytes_at_u64(p);
        uint64_t shape[5];
        p += 8;
        for (unsigned d = 0; d < dimensions; d++, p += 8)
            shape[d] = lmpi_bytes_at_u64(p);
        for (int i = 0; names[i]; i++) {
            if (strlen(names[i]) != length || memcmp(names[i], name, length) != 0)
                continue;
            field *f = add(&t, names[i], type, dimensions, shape, 0);
            for (size_t k = 0; k < field_count(f); k++)
                f->values[k] = type == U8 ? (float)data[k] : lmpi_bytes_at_f32(data + 4 * k);
        }
    }
    assert_int_equal(t.count, 7);
    return t;
}

/* Keeps nodes first … last of phi_i. */
static void cut(tensor *t, size_t first, size_t last) {
    static const char *const names[] = { "phi_i", "vndf", "rgb" };
    for (size_t i = 0; i < 3; i++) {
        field *f = find(t, names[i]);
        const size_t slice = field_count(f) / (size_t)f->shape[0];
        f->shape[0] = last - first + 1;
        memmove(f->values, f->values + first * slice, field_count(f) * sizeof *f->values);
    }
}

/* Moves both directions as the symmetry of a part of a turn allows, to bring a into that part. */
static void fold(int symmetry, double middle, double a[3], double b[3]) {
    const double side[2] = { cos(middle), sin(middle) };
    const bool opposite = a[0] * side[0] + a[1] * side[1] < 0;
    for (int k = 0; k < 2; k++)
        if (symmetry == 2 ? opposite : a[k] * side[k] < 0) {
            a[k] = -a[k];
            b[k] = -b[k];
        }
}

static void parts_of_a_turn_are_folded(void **state) {
    (void)state;
    const lmp_ggx desc = { 0.5f, 0.2f, { 0.9f, 0.6f, 0.3f }, { 0.1f, 0.1f, 0.2f } };
    static const struct {
        int symmetry;
        size_t first, last;
    } parts[] = { { 2, 16, 32 }, { 2, 0, 16 }, { 2, 8, 24 }, { 4, 16, 24 }, { 4, 8, 16 } };
    lmp_brdf *original = NULL;
    void *bytes = NULL;
    size_t size = 0;
    assert_int_equal(lmp_brdf_create_ggx(NULL, &desc, &original), LMP_OK);
    assert_int_equal(lmp_brdf_encode_rgl(NULL, original, &bytes, &size), LMP_OK);
    lmp_brdf *whole = read_bytes(bytes, size);
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        tensor t = taken_apart(bytes);
        cut(&t, parts[i].first, parts[i].last);
        lmp_brdf *part = opened(t);
        assert_true(lmp_brdf_describe(part).anisotropic);
        const double middle = ORACLE_PI * ((double)(parts[i].first + parts[i].last) / 2 - 16) / 16;
        double error = 0, error_whole = 0;
        for (int n = 0; n < 2000; n++) {
            double a[3], b[3], f[3], g[3], h[3];
            random_pair(a, b);
            lmp_brdf_eval_double(whole, a, b, h);
            lmp_brdf_eval_double(part, a, b, f);
            lmp_brdf_eval_double(original, a, b, g);
            error += fabs(f[1] - g[1]);
            error_whole += fabs(h[1] - g[1]);
            fold(parts[i].symmetry, middle, a, b);
            lmp_brdf_eval_double(whole, a, b, h);
            for (int c = 0; c < 3; c++)
                CHECK_WITHIN(fabs(f[c] - h[c]), 1e-9 * (1 + h[c]));
        }
        CHECK_WITHIN(error, 1.2 * error_whole);
        lmp_brdf_destroy(part);
    }
    free(bytes);
    lmp_brdf_destroy(whole);
    lmp_brdf_destroy(original);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(samples_are_scaled_by_the_model_and_the_cosine),
        cmocka_unit_test(files_of_two_azimuths_are_isotropic),
        cmocka_unit_test(negative_samples_reflect_nothing),
        cmocka_unit_test(unknown_fields_are_skipped),
        cmocka_unit_test(flat_spectra_are_grey),
        cmocka_unit_test(spectral_lines_have_the_color_of_the_observer),
        cmocka_unit_test(values_follow_the_density_of_visible_normals),
        cmocka_unit_test(parts_of_a_turn_are_folded),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
