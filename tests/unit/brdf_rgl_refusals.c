/* SPDX-License-Identifier: MIT */
/* The reader of RGL tensor files: what it refuses, and damage that it survives. */
#include "tests/unit/tensor.h"

static void expect_parse_error(const unsigned char *bytes, size_t size, lmp_result result,
                               const char *text) {
    lmp_brdf *brdf = NULL;
    lmp_parse_error error = { 0 };
    const lmp_result got = lmp_brdf_read_rgl(NULL, bytes, size, &error, &brdf);
    assert_null(brdf);
    if (!strstr(error.text, text))
        fail_msg("'%s' does not say '%s'", error.text, text);
    assert_int_equal(got, result);
    assert_int_equal(lmp_brdf_read_rgl(NULL, bytes, size, NULL, &brdf), result);
}

/* Expects a tensor to be refused, and frees it. */
static void expect_refusal(tensor t, const char *text) {
    size_t size = 0;
    unsigned char *bytes = bytes_of(&t, &size);
    drop(&t);
    expect_parse_error(bytes, size, LMP_ERROR_FORMAT, text);
    free(bytes);
}

static void headers_are_checked(void **state) {
    (void)state;
    tensor t = flat_rgb();
    size_t size = 0;
    unsigned char *bytes = bytes_of(&t, &size);
    drop(&t);
    expect_parse_error(bytes, 0, LMP_ERROR_FORMAT, "not a tensor file");
    bytes[12] = 2;
    expect_parse_error(bytes, size, LMP_ERROR_VERSION, "version 2.0");
    bytes[12] = 1;
    bytes[0] = 'T';
    expect_parse_error(bytes, size, LMP_ERROR_FORMAT, "not a tensor file");
    bytes[0] = 't';
    lmpi_bytes_store_u32(bytes + 14, 0xffffffff);
    expect_parse_error(bytes, size, LMP_ERROR_FORMAT, "field 7");
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
        expect_parse_error(bytes, size, LMP_ERROR_FORMAT, damages[i].text);
        free(bytes);
    }
}

/* An unknown field at the end of a file holds, for each type, as many elements as fit into 24
 * bytes, and one more. The format numbers types from 1: integers of 8, 16, 32 and 64 bits, without
 * and with a sign, then floating-point numbers of 16, 32 and 64. */
static void elements_have_the_size_of_their_type(void **state) {
    (void)state;
    static const uint64_t sizes[] = { 1, 1, 2, 2, 4, 4, 8, 8, 2, 4, 8 };
    for (unsigned type = 1; type <= sizeof sizes / sizeof *sizes; type++) {
        tensor t = flat_rgb();
        add(&t, "made_by", U8, SHAPE(24), 0);
        const size_t end = directory_size(&t); /* type, offset and shape are its last 17 bytes */
        size_t size = 0;
        unsigned char *bytes = bytes_of(&t, &size);
        drop(&t);
        bytes[end - 17] = (unsigned char)type;
        lmpi_bytes_store_u64(bytes + end - 8, 24 / sizes[type - 1]);
        lmp_brdf_destroy(read_bytes(bytes, size));
        lmpi_bytes_store_u64(bytes + end - 8, 24 / sizes[type - 1] + 1);
        expect_parse_error(bytes, size, LMP_ERROR_FORMAT, "end past the file's");
        free(bytes);
    }
}

/* Each dimension is small enough, but their product is too large for the file, or for 64 bits. */
static void products_of_dimensions_are_checked(void **state) {
    (void)state;
    for (int shift = 4; shift <= 40; shift += 9) {
        tensor t = flat_rgb();
        size_t size = 0;
        unsigned char *bytes = bytes_of(&t, &size);
        const size_t shape = directory_size(&t) - 40; /* shape of rgb, the last field */
        drop(&t);
        for (size_t d = 0; d < 5; d++)
            lmpi_bytes_store_u64(bytes + shape + 8 * d, UINT64_C(1) << shift);
        expect_parse_error(bytes, size, LMP_ERROR_FORMAT, "more elements than the file has bytes");
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
    /* a thousandth more is rounding */
    const float pi = 3.14159274f;
    expect_refusal(with_value("theta_i", 1, pi / 2 + 0.0015f), "'theta_i' leaves 0 to pi/2");
    expect_refusal(with_value("phi_i", 0, 2 * pi + 0.0015f), "'phi_i' leaves one turn");
    expect_refusal(with_phis(5, -pi, pi + 0.0015f), "'phi_i' leaves one turn");
    lmp_brdf_destroy(opened(with_value("theta_i", 1, pi / 2 + 0.0005f)));
    lmp_brdf_destroy(opened(with_value("phi_i", 0, 2 * pi + 0.0005f)));
    lmp_brdf_destroy(opened(with_phis(5, -pi, pi + 0.0005f)));
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
        expect_parse_error(copy, length, LMP_ERROR_FORMAT, "");
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
            check_hooks hooks = { .refuse = refuse };
            const lmp_host host = check_host(&hooks);
            lmp_brdf *brdf = NULL;
            lmp_parse_error error = { 0 };
            const lmp_result result = lmp_brdf_read_rgl(&host, bytes, size, &error, &brdf);
            lmp_brdf_destroy(brdf);
            assert_int_equal(hooks.live, 0);
            if (result == LMP_OK) {
                assert_int_equal(refuse, i + 1); /* the object; for spectra also their weights */
                break;
            }
            assert_int_equal(result, LMP_ERROR_MEMORY);
            assert_non_null(strstr(error.text, "out of memory"));
        }
        free(bytes);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(headers_are_checked),
        cmocka_unit_test(directories_are_checked),
        cmocka_unit_test(elements_have_the_size_of_their_type),
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
