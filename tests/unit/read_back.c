/* SPDX-License-Identifier: MIT */
/* The files that the library writes, parsed by hand as docs/formats.md and their own publications
 * describe them, hold what was in memory. */
#include "src/brdf/brdf.h"
#include "tests/oracle/check.h"

#include <lampion/preintegrated.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846

/* --- bytes, least first ----------------------------------------------------------------------- */

typedef struct cursor {
    const unsigned char *bytes;
    size_t at, size;
} cursor;

static uint64_t take(cursor *c, int size) {
    uint64_t number = 0;
    assert_true(c->at + (size_t)size <= c->size);
    for (int i = 0; i < size; i++)
        number |= (uint64_t)c->bytes[c->at + (size_t)i] << (8 * i);
    c->at += (size_t)size;
    return number;
}

static float take_float(cursor *c) {
    const uint32_t bits = (uint32_t)take(c, 4);
    float number;
    memcpy(&number, &bits, sizeof number);
    return number;
}

static double take_double(cursor *c) {
    const uint64_t bits = take(c, 8);
    double number;
    memcpy(&number, &bits, sizeof number);
    return number;
}

static void expect(cursor *c, int size, uint64_t number) {
    const size_t at = c->at;
    const uint64_t found = take(c, size);
    if (found != number)
        fail_msg("byte %zu: %llu is not %llu", at, (unsigned long long)found,
                 (unsigned long long)number);
}

static void expect_floats(cursor *c, const float *numbers, size_t count) {
    for (size_t i = 0; i < count; i++) {
        const size_t at = c->at;
        const float found = take_float(c);
        if (memcmp(&found, &numbers[i], sizeof found) != 0)
            fail_msg("byte %zu: %.9g is not %.9g", at, (double)found, (double)numbers[i]);
    }
}

static void expect_shorts(cursor *c, const int16_t *numbers, size_t count) {
    for (size_t i = 0; i < count; i++)
        expect(c, 2, (uint16_t)numbers[i]);
}

/* Opens a file in a format of our own: a magic number, a version, and CRC-32C over everything. */
static cursor open_frame(const unsigned char *bytes, size_t size, const char *name) {
    cursor c = { bytes, 0, size };
    uint32_t crc = ~0u;
    for (size_t i = 0; i + 4 < size; i++) {
        crc ^= bytes[i];
        for (int bit = 0; bit < 8; bit++)
            crc = crc >> 1 ^ (crc & 1 ? 0x82f63b78u : 0);
    }
    assert_memory_equal(bytes, name, 4);
    assert_memory_equal(bytes + 4, "\r\n\x1a\n", 4);
    c.at = size - 4;
    expect(&c, 4, ~crc);
    c.at = 8;
    expect(&c, 4, 1);
    return c;
}

/* --- .lmpt ------------------------------------------------------------------------------------ */

static lmp_brdf *create_ggx(float alpha_x, float alpha_y) {
    lmp_brdf *brdf;
    const lmp_ggx ggx = { .alpha_x = alpha_x, .alpha_y = alpha_y, .f0 = { 0.9f, 0.5f, 0.1f } };
    assert_int_equal(lmp_brdf_create_ggx(NULL, &ggx, &brdf), LMP_OK);
    return brdf;
}

static lmp_brdf_table *create_table(float alpha_y, int azimuths) {
    lmp_brdf_table *table;
    lmp_brdf *brdf = create_ggx(0.5f, alpha_y);
    const lmp_brdf_table_desc desc = {
        .bands = 5, .views = 9, .azimuths = azimuths, .window = LMP_WINDOW_LANCZOS, .window_size = 7
    };
    assert_int_equal(lmp_brdf_table_create(NULL, &desc, brdf, &table), LMP_OK);
    lmp_brdf_destroy(brdf);
    return table;
}

static void check_table(lmp_brdf_table *table, uint64_t azimuths, uint64_t mirrored, size_t count) {
    const lmp_brdf_table_info info = lmp_brdf_table_describe(table);
    const size_t size = lmp_brdf_table_size(table), floats = 3 * count * 9 * azimuths;
    unsigned char *bytes = malloc(size);
    assert_non_null(bytes);
    lmp_brdf_table_write(table, lmp_brdf_table_size(table), bytes);
    cursor c = open_frame(bytes, size, "LMPT");
    const uint64_t shape[] = { 5, 9, azimuths, mirrored, 2 };
    for (size_t i = 0; i < sizeof shape / sizeof *shape; i++)
        expect(&c, 4, shape[i]);
    expect_floats(&c, (const float[]) { 7 }, 1);
    expect(&c, 4, (uint64_t)info.rings);
    expect_floats(&c, &info.change, 1);
    expect(&c, 4, 0);
    assert_int_equal(c.at, 48);
    expect_floats(&c, lmp_brdf_table_coefficients(table), floats);
    assert_int_equal(c.at + 4, size);
    free(bytes);
    lmp_brdf_table_destroy(table);
}

static void tables_hold_their_coefficients(void **state) {
    (void)state;
    check_table(create_table(0.5f, 1), 1, 1, 15);
    check_table(create_table(0.2f, 8), 8, 0, 25);
}

/* --- .lmpr and .lmps -------------------------------------------------------------------------- */

static void preintegrated_lobes_hold_their_cells(void **state) {
    (void)state;
    lmp_preintegrated_lobe *lobe;
    const lmp_preintegrated_lobe_desc desc = { .bands = 6, .window = LMP_WINDOW_HANNING };
    assert_int_equal(lmp_preintegrated_lobe_create(NULL, &desc, &lobe), LMP_OK);
    const lmp_preintegrated_lobe_info info = lmp_preintegrated_lobe_describe(lobe);
    const size_t size = lmp_preintegrated_lobe_size(lobe);
    unsigned char *bytes = malloc(size);
    assert_non_null(bytes);
    lmp_preintegrated_lobe_write(lobe, lmp_preintegrated_lobe_size(lobe), bytes);
    cursor c = open_frame(bytes, size, "LMPR");
    expect(&c, 4, 6);
    expect(&c, 4, 1);
    expect_floats(&c, &info.window_size, 1);
    expect_floats(&c, &info.error, 1);
    expect(&c, 4, info.cell_count);
    expect_floats(&c, info.remap, 321);
    assert_int_equal(c.at, 1316);
    for (uint32_t i = 0; i < info.cell_count; i++) {
        expect_floats(&c, &info.cells[i].scale, 1);
        expect_floats(&c, &info.cells[i].offset, 1);
    }
    expect_shorts(&c, info.coefficients, 2 * info.pair_count);
    assert_int_equal(c.at + 4, size);
    free(bytes);
    lmp_preintegrated_lobe_destroy(lobe);
}

static void expect_slice(cursor *c, const lmp_preintegrated_brdf_slice *slice) {
    expect(c, 4, slice->rows);
    expect(c, 4, slice->columns);
    expect_floats(c,
                  (const float[]) { slice->row_density, slice->row_origin, slice->column_density,
                                    slice->unit },
                  4);
}

static void preintegrated_brdfs_hold_their_slices(void **state) {
    (void)state;
    lmp_preintegrated_brdf *brdf;
    lmp_brdf_table *table = create_table(0.5f, 1);
    assert_int_equal(lmp_preintegrated_brdf_create(NULL, NULL, table, &brdf), LMP_OK);
    const lmp_preintegrated_brdf_info info = lmp_preintegrated_brdf_describe(brdf);
    const size_t size = lmp_preintegrated_brdf_size(brdf);
    unsigned char *bytes = malloc(size);
    assert_non_null(bytes);
    lmp_preintegrated_brdf_write(brdf, lmp_preintegrated_brdf_size(brdf), bytes);
    cursor c = open_frame(bytes, size, "LMPS");
    expect(&c, 4, 5);
    expect(&c, 2, 2);
    expect(&c, 2, info.mirrored);
    expect_floats(&c,
                  (const float[]) { 7, info.error, info.width, info.radius, info.reach, info.slope,
                                    info.lobe_angle },
                  7);
    const uint32_t counts[] = { info.view_count, info.cap_count, info.view_steps, info.cap_steps,
                                (uint32_t)info.texel_count };
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++)
        expect(&c, 4, counts[i]);
    assert_int_equal(c.at, 68);
    expect_floats(&c, info.view_remap, info.view_steps + 1);
    expect_floats(&c, info.cap_remap, info.cap_steps + 1);
    expect_floats(&c, &info.ambient->r, 3 * (size_t)info.view_count);
    for (size_t i = 0; i < (size_t)info.view_count * info.cap_count; i++)
        expect_slice(&c, &info.slices[i]);
    expect_shorts(&c, info.texels, 3 * info.texel_count);
    assert_int_equal(c.at + 4, size);
    free(bytes);
    lmp_preintegrated_brdf_destroy(brdf);
    lmp_brdf_table_destroy(table);
}

/* --- .binary, as MERL's BRDFRead.cpp has it --------------------------------------------------- */

static void rotate(const double axis[3], double angle, double v[3]) {
    const double c = cos(angle), s = sin(angle);
    const double along = axis[0] * v[0] + axis[1] * v[1] + axis[2] * v[2];
    const double cross[3] = { axis[1] * v[2] - axis[2] * v[1], axis[2] * v[0] - axis[0] * v[2],
                              axis[0] * v[1] - axis[1] * v[0] };
    for (int i = 0; i < 3; i++)
        v[i] = v[i] * c + axis[i] * along * (1 - c) + cross[i] * s;
}

/* Finds the directions of a half angle and a difference (Rusinkiewicz 1998). */
static void directions_of(double theta_h, double theta_d, double phi_d, double in[3],
                          double out[3]) {
    const double y[3] = { 0, 1, 0 }, half_vector[3] = { sin(theta_h), 0, cos(theta_h) };
    in[0] = sin(theta_d) * cos(phi_d);
    in[1] = sin(theta_d) * sin(phi_d);
    in[2] = cos(theta_d);
    rotate(y, theta_h, in);
    const double along =
        2 * (in[0] * half_vector[0] + in[1] * half_vector[1] + in[2] * half_vector[2]);
    for (int i = 0; i < 3; i++)
        out[i] = along * half_vector[i] - in[i];
}

static void merl_files_hold_each_cell(void **state) {
    (void)state;
    static const double scales[3] = { 1.0 / 1500, 1.15 / 1500, 1.66 / 1500 };
    const size_t cells = 90 * 90 * 180;
    lmp_brdf *brdf = create_ggx(0.4f, 0.4f);
    void *data;
    size_t size, compared = 0;
    assert_int_equal(lmp_brdf_encode_merl(NULL, brdf, &data, &size), LMP_OK);
    cursor c = { data, 0, size };
    expect(&c, 4, 90);
    expect(&c, 4, 90);
    expect(&c, 4, 180);
    assert_int_equal(size, 12 + 3 * cells * 8);
    for (size_t cell = 0; cell < cells; cell += 7) {
        const double h = ((double)(cell / 180 / 90) + 0.5) / 90;
        const double theta_d = ((double)(cell / 180 % 90) + 0.5) / 90 * PI / 2;
        double in[3], out[3], rgb[3];
        directions_of(h * h * PI / 2, theta_d, ((double)(cell % 180) + 0.5) / 180 * PI, in, out);
        const bool seen = in[2] > 1e-9 && out[2] > 1e-9, hidden = in[2] < -1e-9 || out[2] < -1e-9;
        if (seen)
            brdf->eval(brdf, in, out, rgb);
        for (size_t k = 0; k < 3; k++) {
            c.at = 12 + 8 * (k * cells + cell);
            const double value = take_double(&c) * scales[k];
            if (seen)
                CHECK_WITHIN(fabs(value - rgb[k]), 1e-9 * (rgb[k] + 1e-6));
            assert_true(!hidden || value < 0);
        }
        compared += seen;
    }
    assert_true(compared > cells / 7 / 3);
    free(data);
    lmp_brdf_destroy(brdf);
}

/* --- .bsdf, as the RGL database's tensor files are -------------------------------------------- */

typedef struct field {
    uint64_t type, dimensions, shape[5], offset, count;
} field;

static field find_field(const void *data, size_t size, const char *wanted) {
    cursor c = { data, 12, size };
    assert_memory_equal(data, "tensor_file", 12);
    expect(&c, 1, 1);
    expect(&c, 1, 0);
    for (uint64_t left = take(&c, 4); left > 0; left--) {
        const size_t length = take(&c, 2);
        const char *name = (const char *)data + c.at;
        field f = { .count = 1 };
        c.at += length;
        f.dimensions = take(&c, 2);
        f.type = take(&c, 1);
        f.offset = take(&c, 8);
        for (uint64_t d = 0; d < f.dimensions; d++) {
            const uint64_t n = take(&c, 8);
            f.count *= n;
            f.shape[d < 5 ? d : 0] = n;
        }
        if (strlen(wanted) == length && memcmp(name, wanted, length) == 0)
            return f;
    }
    fail_msg("there is no field %s", wanted);
    return (field) { .count = 0 };
}

/* Compares the file's own floats with those of the object made from it. */
static void expect_field(const void *data, size_t size, const char *name, const float *numbers,
                         size_t count) {
    const field f = find_field(data, size, name);
    cursor c = { data, f.offset, size };
    assert_int_equal(f.type, 10);
    assert_int_equal(f.count, count);
    expect_floats(&c, numbers, count);
}

static void check_tensor(float alpha_y, int phis, int thetas) {
    lmp_brdf *brdf = create_ggx(0.3f, alpha_y), *copy;
    void *data;
    size_t size;
    assert_int_equal(lmp_brdf_encode_rgl(NULL, brdf, &data, &size), LMP_OK);
    assert_int_equal(lmp_brdf_read_rgl(NULL, data, size, NULL, &copy), LMP_OK);
    const brdf_rgl *rgl = &copy->rgl;
    expect_field(data, size, "theta_i", rgl->theta, (size_t)thetas);
    expect_field(data, size, "phi_i", rgl->phi, (size_t)phis);
    expect_field(data, size, "ndf", rgl->ndf.values,
                 (size_t)rgl->ndf.height * (size_t)rgl->ndf.width);
    expect_field(data, size, "sigma", rgl->sigma.values,
                 (size_t)rgl->sigma.height * (size_t)rgl->sigma.width);
    expect_field(data, size, "rgb", rgl->rgb,
                 3 * (size_t)phis * (size_t)thetas * (size_t)rgl->rgb_height *
                     (size_t)rgl->rgb_width);
    assert_int_equal(find_field(data, size, "vndf").count, (size_t)phis * (size_t)thetas *
                                                               (size_t)rgl->vndf_height *
                                                               (size_t)rgl->vndf_width);
    assert_int_equal(find_field(data, size, "jacobian").type, 1);
    free(data);
    lmp_brdf_destroy(copy);
    lmp_brdf_destroy(brdf);
}

static void tensor_files_hold_their_fields(void **state) {
    (void)state;
    check_tensor(0.3f, 1, 48);
    check_tensor(0.15f, 33, 12);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tables_hold_their_coefficients),
        cmocka_unit_test(preintegrated_lobes_hold_their_cells),
        cmocka_unit_test(preintegrated_brdfs_hold_their_slices),
        cmocka_unit_test(merl_files_hold_each_cell),
        cmocka_unit_test(tensor_files_hold_their_fields),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
