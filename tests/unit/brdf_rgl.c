/* SPDX-License-Identifier: MIT */
/* RGL tensor files made by hand: what the reader takes, what it makes of it, what it refuses. */
#include "src/base/bytes.h"
#include "tests/oracle/check.h"
#include "tests/oracle/oracle.h"

#include <lampion/brdf.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { U8 = 1, F32 = 10, FIELDS_MAX = 12 };

/* One array of a tensor file. */
typedef struct field {
    const char *name;
    unsigned type, dimensions;
    uint64_t shape[5];
    float *values; /* owned; a U8 field holds its bytes as floats */
} field;

typedef struct tensor {
    int count;
    field fields[FIELDS_MAX];
} tensor;

static size_t field_count(const field *f) {
    size_t count = 1;
    for (unsigned d = 0; d < f->dimensions; d++)
        count *= (size_t)f->shape[d];
    return count;
}

/* Adds a field of `value` everywhere. */
static field *add(tensor *t, const char *name, unsigned type, unsigned dimensions,
                  const uint64_t *shape, float value) {
    field *f = &t->fields[t->count++];
    *f = (field) { .name = name, .type = type, .dimensions = dimensions };
    memcpy(f->shape, shape, dimensions * sizeof *shape);
    f->values = malloc(field_count(f) * sizeof *f->values);
    assert_non_null(f->values);
    for (size_t i = 0; i < field_count(f); i++)
        f->values[i] = value;
    return f;
}
#define SHAPE(...)                                                                                 \
    sizeof((uint64_t[]) { __VA_ARGS__ }) / sizeof(uint64_t), (const uint64_t[]) {                  \
        __VA_ARGS__                                                                                \
    }

static field *find(tensor *t, const char *name) {
    for (int i = 0; i < t->count; i++)
        if (strcmp(t->fields[i].name, name) == 0)
            return &t->fields[i];
    fail_msg("no field '%s'", name);
    return NULL;
}

/* An isotropic file without samples, whose warp is the identity and whose model is 1 / 4. */
static tensor flat(void) {
    tensor t = { 0 };
    add(&t, "theta_i", F32, SHAPE(2), 0)->values[1] = 1.5f;
    add(&t, "phi_i", F32, SHAPE(1), 0);
    add(&t, "ndf", F32, SHAPE(2, 2), 1);
    add(&t, "sigma", F32, SHAPE(2, 2), 1);
    add(&t, "vndf", F32, SHAPE(1, 2, 2, 2), 1);
    add(&t, "jacobian", U8, SHAPE(1), 1);
    return t;
}

static tensor flat_rgb(void) {
    tensor t = flat();
    field *rgb = add(&t, "rgb", F32, SHAPE(1, 2, 3, 2, 2), 0);
    for (size_t i = 0; i < field_count(rgb); i++)
        rgb->values[i] = (float)(i / 4 % 3 + 1);
    return t;
}

/* `count` wavelengths in nm, their spectrum the same everywhere. */
static tensor flat_spectral(size_t count, const float *nm, const float *spectrum) {
    tensor t = flat();
    memcpy(add(&t, "wavelengths", F32, SHAPE(count), 0)->values, nm, count * sizeof *nm);
    field *spectra = add(&t, "spectra", F32, SHAPE(1, 2, count, 2, 2), 0);
    for (size_t i = 0; i < field_count(spectra); i++)
        spectra->values[i] = spectrum[i / 4 % count];
    return t;
}

static void drop(tensor *t) {
    for (int i = 0; i < t->count; i++)
        free(t->fields[i].values);
    t->count = 0;
}

static size_t directory_size(const tensor *t) {
    size_t size = 18;
    for (int i = 0; i < t->count; i++)
        size += 13 + strlen(t->fields[i].name) + 8 * t->fields[i].dimensions;
    return size;
}

/* The bytes of a file, in a block of exactly their size. */
static unsigned char *bytes_of(const tensor *t, size_t *size) {
    size_t at = directory_size(t);
    *size = at;
    for (int i = 0; i < t->count; i++)
        *size += field_count(&t->fields[i]) * (t->fields[i].type == U8 ? 1 : 4);
    unsigned char *bytes = malloc(*size), *p = bytes;
    assert_non_null(bytes);
    memcpy(p, "tensor_file\0\1", 14); /* version 1.0 */
    p = lmp_bytes_store_u32(p + 14, (uint32_t)t->count);
    for (int i = 0; i < t->count; i++) {
        const field *f = &t->fields[i];
        p = lmp_bytes_store_u16(p, (uint16_t)strlen(f->name));
        memcpy(p, f->name, strlen(f->name));
        p = lmp_bytes_store_u16(p + strlen(f->name), (uint16_t)f->dimensions);
        *p++ = (unsigned char)f->type;
        p = lmp_bytes_store_u64(p, at);
        for (unsigned d = 0; d < f->dimensions; d++)
            p = lmp_bytes_store_u64(p, f->shape[d]);
        for (size_t k = 0; k < field_count(f); k++)
            if (f->type == U8)
                bytes[at++] = (unsigned char)f->values[k];
            else {
                lmp_bytes_store_f32(bytes + at, f->values[k]);
                at += 4;
            }
    }
    return bytes;
}

static lmp_brdf *read_bytes(const unsigned char *bytes, size_t size) {
    lmp_brdf *brdf = NULL;
    lmp_parse_error fault = { 0 };
    if (lmp_brdf_read_rgl(NULL, bytes, size, &fault, &brdf) != LMP_OK)
        fail_msg("%s", fault.text);
    return brdf;
}

/* Reads the tensor, which is dropped. */
static lmp_brdf *opened(tensor t) {
    size_t size = 0;
    unsigned char *bytes = bytes_of(&t, &size);
    drop(&t);
    lmp_brdf *brdf = read_bytes(bytes, size);
    free(bytes);
    return brdf;
}

static void random_pair(double a[3], double b[3]) {
    const lmp_vec3 u = check_random_direction(), v = check_random_direction();
    for (int k = 0; k < 3; k++) {
        a[k] = (double)(&u.x)[k];
        b[k] = (double)(&v.x)[k];
    }
    a[2] = fmax(fabs(a[2]), 0.05);
    b[2] = fmax(fabs(b[2]), 0.05);
    const double scale = 1 / sqrt(b[0] * b[0] + b[1] * b[1] + b[2] * b[2]);
    for (int k = 0; k < 3; k++)
        b[k] *= scale;
}

/* --- values ------------------------------------------------------------------------------------
 */

/* The value over the second cosine, times ndf / (4 sigma) where the file says so. */
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

/* As the database stores isotropic materials: two equal slices, at -pi and pi. */
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

/* A field of bytes that nobody knows, and `luminance`, are passed over. */
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

/* Linear sRGB of CIE XYZ under illuminant E, step by step: Bradford's cones, D65's white over E's,
 * back, and the primaries of IEC 61966-2-1. */
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

/* Lines of the CIE's own table, 20 nm apart, one by one on a gray ground, which keeps negative
 * colors in sight. */
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

/* --- folding -----------------------------------------------------------------------------------
 */

/* Takes a written file apart. */
static tensor taken_apart(const unsigned char *bytes) {
    tensor t = { 0 };
    static const char *const names[] = { "theta_i", "phi_i", "ndf",      "sigma",
                                         "vndf",    "rgb",   "jacobian", NULL };
    const unsigned char *p = bytes + 14;
    for (uint32_t left = lmp_bytes_load_u32(&p); left > 0; left--) {
        const size_t length = lmp_bytes_load_u16(&p);
        const char *const name = (const char *)p;
        p += length;
        const unsigned dimensions = lmp_bytes_load_u16(&p), type = *p++;
        const unsigned char *data = bytes + lmp_bytes_at_u64(p);
        uint64_t shape[5];
        p += 8;
        for (unsigned d = 0; d < dimensions; d++, p += 8)
            shape[d] = lmp_bytes_at_u64(p);
        for (int i = 0; names[i]; i++) {
            if (strlen(names[i]) != length || memcmp(names[i], name, length) != 0)
                continue;
            field *f = add(&t, names[i], type, dimensions, shape, 0);
            for (size_t k = 0; k < field_count(f); k++)
                f->values[k] = type == U8 ? (float)data[k] : lmp_bytes_at_f32(data + 4 * k);
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
static void fold(int turn, double middle, double a[3], double b[3]) {
    const double side[2] = { cos(middle), sin(middle) };
    const bool opposite = a[0] * side[0] + a[1] * side[1] < 0;
    for (int k = 0; k < 2; k++)
        if (turn == 2 ? opposite : a[k] * side[k] < 0) {
            a[k] = -a[k];
            b[k] = -b[k];
        }
}

static void parts_of_a_turn_are_folded(void **state) {
    (void)state;
    const lmp_ggx desc = { 0.5f, 0.2f, { 0.9f, 0.6f, 0.3f }, { 0.1f, 0.1f, 0.2f } };
    static const struct {
        int turn;
        size_t first, last;
    } parts[] = { { 2, 16, 32 }, { 2, 0, 16 }, { 2, 8, 24 }, { 4, 16, 24 }, { 4, 8, 16 } };
    lmp_brdf *original = NULL;
    void *bytes = NULL;
    size_t size = 0;
    assert_int_equal(lmp_brdf_create_ggx(NULL, &desc, &original), LMP_OK);
    assert_int_equal(lmp_brdf_write_rgl(original, NULL, &bytes, &size), LMP_OK);
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
            fold(parts[i].turn, middle, a, b);
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

/* --- refusals ----------------------------------------------------------------------------------
 */

static void expect_fault(const unsigned char *bytes, size_t size, lmp_result result,
                         const char *text) {
    lmp_brdf *brdf = NULL;
    lmp_parse_error fault = { 0 };
    const lmp_result got = lmp_brdf_read_rgl(NULL, bytes, size, &fault, &brdf);
    assert_null(brdf);
    if (!strstr(fault.text, text))
        fail_msg("'%s' does not say '%s'", fault.text, text);
    assert_int_equal(got, result);
    assert_int_equal(lmp_brdf_read_rgl(NULL, bytes, size, NULL, &brdf), result);
}

/* Refuses the tensor, which is dropped. */
static void expect_refusal(tensor t, const char *text) {
    size_t size = 0;
    unsigned char *bytes = bytes_of(&t, &size);
    drop(&t);
    expect_fault(bytes, size, LMP_ERROR_FORMAT, text);
    free(bytes);
}

static void headers_are_checked(void **state) {
    (void)state;
    tensor t = flat_rgb();
    size_t size = 0;
    unsigned char *bytes = bytes_of(&t, &size);
    drop(&t);
    expect_fault(bytes, 0, LMP_ERROR_FORMAT, "not a tensor file");
    bytes[12] = 2;
    expect_fault(bytes, size, LMP_ERROR_VERSION, "version 2.0");
    bytes[12] = 1;
    bytes[0] = 'T';
    expect_fault(bytes, size, LMP_ERROR_FORMAT, "not a tensor file");
    bytes[0] = 't';
    lmp_bytes_store_u32(bytes + 14, 0xffffffff);
    expect_fault(bytes, size, LMP_ERROR_FORMAT, "field 7");
    free(bytes);
}

/* Field 0 is theta_i: its length at 18, name at 20, dimensions at 27, type at 29, offset at 30,
 * shape at 38. */
static void directories_are_checked(void **state) {
    (void)state;
    static const struct {
        size_t offset, width;
        uint64_t value;
        const char *text;
    } damages[] = {
        { 18, 2, 0xffff, "ends within field 0" },
        { 27, 2, 9, "9 dimensions" },
        { 27, 2, 0, "dimensions of type" },
        { 29, 1, 0, "unknown type 0" },
        { 29, 1, 12, "unknown type 12" },
        { 29, 1, 11, "type 11, not 1 of type 10" },
        { 30, 8, UINT64_MAX, "end past the file's" },
        { 30, 8, UINT64_MAX - 7, "end past the file's" },
        { 30, 8, 100000, "end past the file's" },
        { 38, 8, 0, "dimension 0 of size 0" },
        { 38, 8, UINT64_MAX, "more elements than the file has bytes" },
        { 38, 8, UINT64_C(1) << 62, "more elements than the file has bytes" },
        { 38, 8, 200, "end past the file's" },
    };
    for (size_t i = 0; i < sizeof damages / sizeof *damages; i++) {
        tensor t = flat_rgb();
        size_t size = 0;
        unsigned char *bytes = bytes_of(&t, &size);
        drop(&t);
        for (size_t k = 0; k < damages[i].width; k++)
            bytes[damages[i].offset + k] = (unsigned char)(damages[i].value >> 8 * k);
        expect_fault(bytes, size, LMP_ERROR_FORMAT, damages[i].text);
        free(bytes);
    }
}

/* Each dimension small enough, their product too large for the file, or for 64 bits. */
static void products_of_dimensions_are_checked(void **state) {
    (void)state;
    for (int shift = 4; shift <= 40; shift += 9) {
        tensor t = flat_rgb();
        size_t size = 0;
        unsigned char *bytes = bytes_of(&t, &size);
        const size_t shape = directory_size(&t) - 40; /* of rgb, the last field */
        drop(&t);
        for (size_t d = 0; d < 5; d++)
            lmp_bytes_store_u64(bytes + shape + 8 * d, UINT64_C(1) << shift);
        expect_fault(bytes, size, LMP_ERROR_FORMAT, "more elements than the file has bytes");
        free(bytes);
    }
}

static void missing_and_duplicate_fields_are_refused(void **state) {
    (void)state;
    static const char *const required[] = { "theta_i", "phi_i", "ndf",     "sigma",
                                            "vndf",    "rgb",   "jacobian" };
    for (size_t i = 0; i < 7; i++) {
        tensor t = flat_rgb();
        find(&t, required[i])->name = "other";
        expect_refusal(t, required[i]);
    }
    tensor t = flat_rgb();
    add(&t, "sigma", F32, SHAPE(2, 2), 1);
    expect_refusal(t, "'sigma' is there twice");
    t = flat_spectral(1, (const float[]) { 550 }, (const float[]) { 1 });
    find(&t, "wavelengths")->name = "lengths";
    expect_refusal(t, "'wavelengths' is missing");
}

static void shapes_must_agree(void **state) {
    (void)state;
    tensor t = flat();
    add(&t, "rgb", F32, SHAPE(1, 3, 3, 2, 2), 1);
    expect_refusal(t, "dimension 1 of 'rgb' is 3, theta_i says 2");
    t = flat();
    add(&t, "rgb", F32, SHAPE(2, 2, 3, 2, 2), 1);
    expect_refusal(t, "dimension 0 of 'rgb' is 2, phi_i says 1");
    t = flat();
    add(&t, "rgb", F32, SHAPE(1, 2, 4, 2, 2), 1);
    expect_refusal(t, "dimension 2 of 'rgb' is 4");
    t = flat();
    add(&t, "spectra", F32, SHAPE(1, 2, 3, 2, 2), 1);
    add(&t, "wavelengths", F32, SHAPE(2), 500)->values[1] = 600;
    expect_refusal(t, "wavelengths says 2");
    t = flat_rgb();
    find(&t, "vndf")->shape[3] = 1;
    expect_refusal(t, "2 x 2 samples");
}

static tensor with_value(const char *name, size_t index, float value) {
    tensor t = flat_rgb();
    find(&t, name)->values[index] = value;
    return t;
}

static void values_out_of_range_are_refused(void **state) {
    (void)state;
    static const char *const names[] = { "theta_i", "phi_i", "ndf", "sigma", "vndf", "rgb" };
    for (size_t i = 0; i < 6; i++) {
        char text[40];
        snprintf(text, sizeof text, "of '%s' is not a finite number", names[i]);
        expect_refusal(with_value(names[i], 0, NAN), text);
        expect_refusal(with_value(names[i], 0, INFINITY), text);
        snprintf(text, sizeof text, "of '%s' is below its range", names[i]);
        expect_refusal(with_value(names[i], 0, -INFINITY), text);
    }
    expect_refusal(with_value("ndf", 3, -1), "value 3 of 'ndf' is below");
    expect_refusal(with_value("sigma", 2, -1e-30f), "value 2 of 'sigma' is below");
    expect_refusal(with_value("vndf", 5, -1), "value 5 of 'vndf' is below");
    tensor t = flat_rgb();
    for (size_t i = 4; i < 8; i++)
        find(&t, "vndf")->values[i] = 0;
    expect_refusal(t, "slice 1 of 'vndf' is zero");
    for (int k = 0; k < 3; k++) {
        const float bad[3] = { NAN, INFINITY, -INFINITY };
        expect_refusal(
            flat_spectral(2, (const float[]) { 500, 600 }, (const float[]) { 1, bad[k] }),
            "'spectra' is not a finite number");
    }
}

static tensor with_phis(size_t count, float first, float last) {
    tensor t = flat();
    field *phi = find(&t, "phi_i");
    free(phi->values);
    phi->values = malloc(count * sizeof *phi->values);
    assert_non_null(phi->values);
    phi->shape[0] = count;
    for (size_t i = 0; i < count; i++)
        phi->values[i] = first + (last - first) * (float)i / (float)(count - 1);
    field *vndf = find(&t, "vndf");
    free(vndf->values);
    *vndf = t.fields[--t.count];
    add(&t, "vndf", F32, SHAPE(count, 2, 2, 2), 1);
    add(&t, "rgb", F32, SHAPE(count, 2, 3, 2, 2), 1);
    return t;
}

static void angles_out_of_order_or_range_are_refused(void **state) {
    (void)state;
    expect_refusal(with_value("theta_i", 0, 1.5f), "'theta_i' does not ascend at value 1");
    expect_refusal(with_value("theta_i", 0, 1.55f), "'theta_i' does not ascend at value 1");
    expect_refusal(with_value("theta_i", 0, -0.5f), "'theta_i' leaves 0 to pi/2");
    expect_refusal(with_value("theta_i", 1, 1.7f), "'theta_i' leaves 0 to pi/2");
    expect_refusal(with_value("phi_i", 0, 6.9f), "'phi_i' leaves one turn");
    expect_refusal(with_phis(5, 3, -3), "'phi_i' does not ascend at value 1");
    expect_refusal(with_phis(5, -3.2f, 4), "'phi_i' leaves one turn");
    expect_refusal(with_phis(5, 0, 2.2f), "half or quarter turn");
    expect_refusal(with_phis(5, 0.3f, 0.3f + 1.57f), "half or quarter turn");
    lmp_brdf_destroy(opened(with_phis(5, 0, 1.5708f)));
    lmp_brdf_destroy(opened(with_phis(5, 0.3f, 0.3f + 3.1416f)));
    const float flat_spectrum[2] = { 1, 1 };
    expect_refusal(flat_spectral(2, (const float[]) { 600, 500 }, flat_spectrum),
                   "'wavelengths' does not ascend");
    expect_refusal(flat_spectral(2, (const float[]) { 500, NAN }, flat_spectrum),
                   "'wavelengths' is not a finite number");
    expect_refusal(flat_spectral(2, (const float[]) { 1000, 1100 }, flat_spectrum),
                   "miss the visible range");
}

static void every_truncation_is_refused(void **state) {
    (void)state;
    tensor t = flat_rgb();
    size_t size = 0;
    unsigned char *bytes = bytes_of(&t, &size);
    drop(&t);
    for (size_t length = 0; length < size; length++) {
        /* an exact block, so that a sanitizer sees any over-read */
        unsigned char *copy = malloc(length > 0 ? length : 1);
        assert_non_null(copy);
        memcpy(copy, bytes, length);
        expect_fault(copy, length, LMP_ERROR_FORMAT, "");
        free(copy);
    }
    free(bytes);
}

/* A changed byte is refused, or makes a BRDF that is finite everywhere. */
static void every_changed_byte_is_survived(void **state) {
    (void)state;
    tensor t = flat_rgb();
    size_t size = 0;
    int accepted = 0;
    unsigned char *bytes = bytes_of(&t, &size);
    drop(&t);
    for (size_t at = 0; at < 8 * size; at++) {
        bytes[at / 8] = (unsigned char)(bytes[at / 8] ^ 1u << at % 8);
        lmp_brdf *brdf = NULL;
        if (lmp_brdf_read_rgl(NULL, bytes, size, NULL, &brdf) == LMP_OK) {
            accepted++;
            for (int n = 0; n < 4; n++) {
                double a[3], b[3], rgb[3];
                random_pair(a, b);
                lmp_brdf_eval_double(brdf, a, b, rgb);
                assert_true(isfinite(rgb[0]) && isfinite(rgb[1]) && isfinite(rgb[2]));
            }
        }
        lmp_brdf_destroy(brdf);
        bytes[at / 8] = (unsigned char)(bytes[at / 8] ^ 1u << at % 8);
    }
    assert_true(accepted > 0);
    free(bytes);
}

static void every_failing_allocation_is_reported(void **state) {
    (void)state;
    tensor tensors[2] = { flat_rgb(),
                          flat_spectral(1, (const float[]) { 550 }, (const float[]) { 1 }) };
    for (int i = 0; i < 2; i++) {
        size_t size = 0;
        unsigned char *bytes = bytes_of(&tensors[i], &size);
        drop(&tensors[i]);
        for (int refuse = 0;; refuse++) {
            check_heap heap = { .refuse = refuse };
            const lmp_allocator allocator = check_allocator(&heap);
            lmp_brdf *brdf = NULL;
            lmp_parse_error fault = { 0 };
            const lmp_result result = lmp_brdf_read_rgl(&allocator, bytes, size, &fault, &brdf);
            lmp_brdf_destroy(brdf);
            assert_int_equal(heap.live, 0);
            if (result == LMP_OK) {
                assert_int_equal(refuse, i + 1); /* the object; for spectra also their weights */
                break;
            }
            assert_int_equal(result, LMP_ERROR_MEMORY);
            assert_non_null(strstr(fault.text, "no memory"));
        }
        free(bytes);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(samples_are_scaled_by_the_model_and_the_cosine),
        cmocka_unit_test(files_of_two_azimuths_are_isotropic),
        cmocka_unit_test(negative_samples_reflect_nothing),
        cmocka_unit_test(unknown_fields_are_skipped),
        cmocka_unit_test(flat_spectra_are_grey),
        cmocka_unit_test(spectral_lines_have_the_color_of_the_observer),
        cmocka_unit_test(parts_of_a_turn_are_folded),
        cmocka_unit_test(headers_are_checked),
        cmocka_unit_test(directories_are_checked),
        cmocka_unit_test(products_of_dimensions_are_checked),
        cmocka_unit_test(missing_and_duplicate_fields_are_refused),
        cmocka_unit_test(shapes_must_agree),
        cmocka_unit_test(values_out_of_range_are_refused),
        cmocka_unit_test(angles_out_of_order_or_range_are_refused),
        cmocka_unit_test(every_truncation_is_refused),
        cmocka_unit_test(every_changed_byte_is_survived),
        cmocka_unit_test(every_failing_allocation_is_reported),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
