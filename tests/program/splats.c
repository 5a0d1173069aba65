/* SPDX-License-Identifier: MIT */
/* examples/rotate_splats.c on a file of splats, checked by the formulas of Kerbl et al. 2023 ("3D
 * Gaussian Splatting", computeColorFromSH of their rasterizer), written again here. */
#include "tests/program/folder.h"

#include <math.h>

enum {
    SPLATS = 50,
    POSITION = 0,
    NORMAL = 3,
    COLOR = 6,
    REST = 9,
    REST_COUNT = 45,
    OPACITY = REST + REST_COUNT,
    SCALE = OPACITY + 1,
    ORIENTATION = SCALE + 3,
    ROW = ORIENTATION + 4,
};

static float original[SPLATS][ROW], rotated[SPLATS][ROW];

/* --- files ------------------------------------------------------------------------------------ */

static size_t put_header(char *text, size_t size, int rest_count) {
    size_t n = (size_t)snprintf(text, size,
                                "ply\nformat binary_little_endian 1.0\nelement vertex %d\n"
                                "property float x\nproperty float y\nproperty float z\n"
                                "property float nx\nproperty float ny\nproperty float nz\n"
                                "property float f_dc_0\nproperty float f_dc_1\n"
                                "property float f_dc_2\n",
                                SPLATS);
    for (int i = 0; i < rest_count; i++)
        n += (size_t)snprintf(text + n, size - n, "property float f_rest_%d\n", i);
    return n + (size_t)snprintf(text + n, size - n,
                                "property float opacity\nproperty float scale_0\n"
                                "property float scale_1\nproperty float scale_2\n"
                                "property float rot_0\nproperty float rot_1\n"
                                "property float rot_2\nproperty float rot_3\nend_header\n");
}

static char file_bytes[8192 + sizeof original];

static size_t write_splats(const char *name, int rest_count) {
    const size_t header = put_header(file_bytes, 8192, rest_count);
    memcpy(file_bytes + header, original, sizeof original);
    folder_write(name, file_bytes, header + sizeof original);
    return header;
}

static void read_splats(const char *name, float (*rows)[ROW]) {
    static char bytes[sizeof file_bytes];
    const size_t header = put_header(file_bytes, 8192, REST_COUNT);
    FILE *file = fopen(in_folder(name), "rb");
    assert_non_null(file);
    assert_int_equal(fread(bytes, 1, sizeof bytes, file), header + sizeof original);
    assert_int_equal(fclose(file), 0);
    assert_memory_equal(bytes, file_bytes, header);
    memcpy(rows, bytes + header, sizeof original);
}

static int rotate(const char *in, const char *out, const char *rotation) {
    char command[2048];
    snprintf(command, sizeof command, "cd '%s' && rm -f '%s' && '%s' '%s' '%s' %s 2>error", folder,
             out, SPLATS_PROGRAM, in, out, rotation);
    return system(command);
}

static int make_splats(void **state) {
    (void)state;
    for (int i = 0; i < SPLATS; i++) {
        for (int k = 0; k < ROW; k++)
            original[i][k] = (float)check_random_between(-1, 1);
        float length = 0;
        for (int k = 0; k < 4; k++)
            length += original[i][ORIENTATION + k] * original[i][ORIENTATION + k];
        for (int k = 0; k < 4; k++)
            original[i][ORIENTATION + k] /= sqrtf(length);
    }
    if (!mkdtemp(folder))
        return -1;
    write_splats("in.ply", REST_COUNT);
    return 0;
}

/* --- the judges ------------------------------------------------------------------------------- */

/* Returns the color of a channel seen along unit d, as the rasterizer sums it. */
static double color_seen(const float *row, int channel, const double d[3]) {
    static const double c1 = 0.4886025119029199;
    static const double c2[5] = { 1.0925484305920792, -1.0925484305920792, 0.31539156525252005,
                                  -1.0925484305920792, 0.5462742152960396 };
    static const double c3[7] = { -0.5900435899266435, 2.890611442640554,   -0.4570457994644658,
                                  0.3731763325901154,  -0.4570457994644658, 1.445305721320277,
                                  -0.5900435899266435 };
    const double x = d[0], y = d[1], z = d[2], xx = x * x, yy = y * y, zz = z * z;
    const float *sh = row + REST + channel * REST_COUNT / 3 - 1; /* sh[1] is f_rest's first */
    double sum = 0.28209479177387814 * (double)row[COLOR + channel];
    sum += c1 * (-y * (double)sh[1] + z * (double)sh[2] - x * (double)sh[3]);
    const double p2[5] = { x * y, y * z, 2 * zz - xx - yy, x * z, xx - yy };
    const double p3[7] = { y * (3 * xx - yy),      x * y * z,
                           y * (4 * zz - xx - yy), z * (2 * zz - 3 * xx - 3 * yy),
                           x * (4 * zz - xx - yy), z * (xx - yy),
                           x * (xx - 3 * yy) };
    for (int i = 0; i < 5; i++)
        sum += c2[i] * p2[i] * (double)sh[4 + i];
    for (int i = 0; i < 7; i++)
        sum += c3[i] * p3[i] * (double)sh[9 + i];
    return sum;
}

/* Rotates by `degrees` around an axis, by Rodrigues' formula. */
static void rodrigues(const double axis[3], double degrees, const double v[3], double out[3]) {
    const double length = sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
    const double k[3] = { axis[0] / length, axis[1] / length, axis[2] / length };
    const double angle = degrees * acos(-1.0) / 180, c = cos(angle), s = sin(angle);
    const double along = (k[0] * v[0] + k[1] * v[1] + k[2] * v[2]) * (1 - c);
    out[0] = v[0] * c + (k[1] * v[2] - k[2] * v[1]) * s + k[0] * along;
    out[1] = v[1] * c + (k[2] * v[0] - k[0] * v[2]) * s + k[1] * along;
    out[2] = v[2] * c + (k[0] * v[1] - k[1] * v[0]) * s + k[2] * along;
}

/* Computes a column of the matrix of an orientation, as the rasterizer builds it (computeCov3D). */
static void orientation_column(const float *row, int column, double out[3]) {
    const float *o = row + ORIENTATION;
    const double r = (double)o[0], x = (double)o[1], y = (double)o[2], z = (double)o[3];
    const double m[3][3] = {
        { 1 - 2 * (y * y + z * z), 2 * (x * y - r * z), 2 * (x * z + r * y) },
        { 2 * (x * y + r * z), 1 - 2 * (x * x + z * z), 2 * (y * z - r * x) },
        { 2 * (x * z - r * y), 2 * (y * z + r * x), 1 - 2 * (x * x + y * y) },
    };
    for (int i = 0; i < 3; i++)
        out[i] = m[i][column];
}

static void assert_rotated(const double v[3], const float *got, const double axis[3],
                           double degrees) {
    double expected[3];
    rodrigues(axis, degrees, v, expected);
    for (int i = 0; i < 3; i++)
        assert_true(fabs(expected[i] - (double)got[i]) <= 1e-6);
}

static const double AXIS[3] = { 1, 2, -0.5 };
static const double DEGREES = 77;

static void seen_along_rotated_directions_colors_are_the_same(void **state) {
    (void)state;
    assert_int_equal(rotate("in.ply", "out.ply", "1 2 -0.5 77"), 0);
    read_splats("out.ply", rotated);
    for (int i = 0; i < SPLATS; i++) {
        const lmp_vec3 direction = check_random_direction();
        const double d[3] = { (double)direction.x, (double)direction.y, (double)direction.z };
        double there[3];
        rodrigues(AXIS, DEGREES, d, there);
        for (int channel = 0; channel < 3; channel++) {
            const double error =
                color_seen(rotated[i], channel, there) - color_seen(original[i], channel, d);
            assert_true(fabs(error) <= 3e-6);
        }
    }
}

static void shapes_rotate_and_sizes_stay(void **state) {
    (void)state;
    assert_int_equal(rotate("in.ply", "out.ply", "1 2 -0.5 77"), 0);
    read_splats("out.ply", rotated);
    for (int i = 0; i < SPLATS; i++) {
        const float *a = original[i], *b = rotated[i];
        const double p[3] = { (double)a[POSITION], (double)a[POSITION + 1],
                              (double)a[POSITION + 2] };
        const double n[3] = { (double)a[NORMAL], (double)a[NORMAL + 1], (double)a[NORMAL + 2] };
        assert_rotated(p, b + POSITION, AXIS, DEGREES);
        assert_rotated(n, b + NORMAL, AXIS, DEGREES);
        for (int column = 0; column < 3; column++) {
            double before[3], after[3];
            orientation_column(a, column, before);
            orientation_column(b, column, after);
            const float got[3] = { (float)after[0], (float)after[1], (float)after[2] };
            assert_rotated(before, got, AXIS, DEGREES);
        }
        assert_memory_equal(a + COLOR, b + COLOR, 3 * sizeof *a);
        assert_memory_equal(a + OPACITY, b + OPACITY, 4 * sizeof *a);
    }
}

static void there_and_back_is_the_identity(void **state) {
    (void)state;
    assert_int_equal(rotate("in.ply", "there.ply", "1 2 -0.5 77"), 0);
    assert_int_equal(rotate("there.ply", "back.ply", "1 2 -0.5 -77"), 0);
    read_splats("back.ply", rotated);
    for (int i = 0; i < SPLATS; i++)
        for (int k = 0; k < ROW; k++)
            assert_true(fabsf(rotated[i][k] - original[i][k]) <= 2e-6f);
}

static void what_is_no_file_of_splats_is_refused(void **state) {
    (void)state;
    folder_write_text("none.ply", "plywood\n");
    folder_write_text("ascii.ply", "ply\nformat ascii 1.0\nelement vertex 1\nend_header\n");
    folder_write_text("double.ply", "ply\nformat binary_little_endian 1.0\nelement vertex 1\n"
                                    "property double x\nend_header\n");
    folder_write_text("endless.ply", "ply\nformat binary_little_endian 1.0\n");
    const size_t header = write_splats("short.ply", REST_COUNT);
    folder_write("short.ply", file_bytes, header + sizeof original - 1);
    write_splats("odd.ply", REST_COUNT - 1);
    static const char *const names[] = { "none.ply",    "ascii.ply", "double.ply",
                                         "endless.ply", "short.ply", "odd.ply" };
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        assert_int_not_equal(rotate(names[i], "refused.ply", "0 0 1 90"), 0);
        assert_null(fopen(in_folder("refused.ply"), "rb"));
    }
    assert_int_not_equal(rotate("in.ply", "refused.ply", "0 0 0 90"), 0);
    assert_int_not_equal(rotate("in.ply", "refused.ply", "0 0 1 nan"), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(seen_along_rotated_directions_colors_are_the_same),
        cmocka_unit_test(shapes_rotate_and_sizes_stay),
        cmocka_unit_test(there_and_back_is_the_identity),
        cmocka_unit_test(what_is_no_file_of_splats_is_refused),
    };
    return cmocka_run_group_tests(tests, make_splats, folder_remove);
}
