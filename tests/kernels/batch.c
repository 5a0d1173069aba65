/* SPDX-License-Identifier: MIT */
/* The batch functions of sh.h, light.h and lobe.h: the scalar functions' results whatever the
 * layout, the strides and the chunk, and the masks that choose the kernels. */
#include "src/kernels/batch.h"
#include "src/kernels/dispatch.h"
#include "src/lobe/ggx.h"
#include "tests/oracle/check.h"

#include <lampion/cpu.h>
#include <lampion/lampion.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { COUNT = 600, BANDS = 6, VALUES = BANDS * BANDS };

static lmp_light lights[COUNT];
static lmp_vec3 points[COUNT], axes[COUNT];
static float out[COUNT * 12 * VALUES], other[COUNT * 12 * VALUES];

static int fill(void **test) {
    (void)test;
    for (int i = 0; i < COUNT; i++) {
        const lmp_vec3 way = check_random_direction();
        const float d = (float)check_random_between(1, 4);
        axes[i] = check_random_direction();
        points[i] = (lmp_vec3) { (float)check_random(), (float)check_random(), 0 };
        lights[i] = (lmp_light) { .kind = LMP_LIGHT_SPHERE,
                                  .position = { points[i].x + d * way.x, points[i].y + d * way.y,
                                                points[i].z + d * way.z },
                                  .radius = (float)check_random_between(0.01, 0.3),
                                  .radiance = { 1, 2, 3 } };
    }
    return 0;
}

static void check_same(const float *expected, const float *actual, size_t count) {
    double wide[12 * VALUES];
    for (size_t i = 0; i < count; i++)
        wide[i] = (double)expected[i];
    CHECK_WITHIN(check_error(count, wide, actual), 5e-6);
}

static void project_takes_structures_and_gives_rows(void **test) {
    (void)test;
    const lmp_spheres spheres = lmp_spheres_of(lights);
    lmp_sphere_project_n(BANDS, &spheres, lmp_vec3_array_of(points), COUNT,
                         lmp_sh_interleaved(out, 0));
    for (int i = 0; i < COUNT; i++) {
        float sh[VALUES];
        lmp_sphere_project(BANDS, lights[i].position, lights[i].radius, points[i], sh);
        check_same(sh, out + i * VALUES, VALUES);
    }
}

static void planes_are_rows_transposed(void **test) {
    (void)test;
    const lmp_spheres spheres = lmp_spheres_of(lights);
    const size_t stride = COUNT + 8; /* of planes, in floats */
    lmp_sphere_project_n(BANDS, &spheres, lmp_vec3_array_of(points), COUNT,
                         lmp_sh_interleaved(out, 0));
    lmp_sphere_project_n(BANDS, &spheres, lmp_vec3_array_of(points), COUNT,
                         lmp_sh_planar(other, stride * sizeof(float)));
    for (size_t i = 0; i < COUNT; i++)
        for (size_t v = 0; v < VALUES; v++)
            assert_memory_equal(&out[i * VALUES + v], &other[v * stride + i], sizeof(float));
}

static void all_pairs_are_every_sphere_at_every_point(void **test) {
    (void)test;
    const lmp_spheres spheres = lmp_spheres_of(lights);
    lmp_sphere_project_all_n(BANDS, &spheres, 7, lmp_vec3_array_of(points), 80,
                             lmp_sh_interleaved(out, 0));
    for (size_t p = 0; p < 80; p++) {
        lmp_sphere_project_n(BANDS, &spheres, lmp_vec3_array_same(&points[p]), 7,
                             lmp_sh_interleaved(other, 0));
        assert_memory_equal(other, out + p * 7 * VALUES, 7 * VALUES * sizeof(float));
    }
}

static void a_split_of_the_points_changes_no_bit(void **test) {
    (void)test;
    const lmp_spheres spheres = lmp_spheres_of(lights);
    lmp_sphere_sum_n(NULL, BANDS, &spheres, 5, NULL, lmp_vec3_array_of(points), COUNT,
                     lmp_sh_interleaved(out, 0));
    for (size_t first = 0, n = 1; first < COUNT; first += n, n = n * 2 + 1) {
        const size_t part = first + n < COUNT ? n : COUNT - first;
        lmp_sphere_sum_n(NULL, BANDS, &spheres, 5, NULL, lmp_vec3_array_of(points + first), part,
                         lmp_sh_interleaved(other + first * 3 * VALUES, 0));
    }
    assert_memory_equal(out, other, COUNT * 3 * VALUES * sizeof(float));
}

/* Compares the sums of one point in a call of its own, where lanes are lights, with those among
 * `count` points. */
static void check_alone(int bands, int light_count, int point, int count, lmp_sh_layout layout) {
    static float among[17 * 3 * 35 * 35], alone[3 * 35 * 35];
    const lmp_spheres spheres = lmp_spheres_of(lights);
    const size_t values = 3 * LMP_SH_COUNT(bands);
    lmp_sphere_sum_n(NULL, bands, &spheres, (size_t)light_count, NULL, lmp_vec3_array_of(points),
                     (size_t)count, lmp_sh_interleaved(among, 0));
    lmp_sphere_sum_n(NULL, bands, &spheres, (size_t)light_count, NULL,
                     lmp_vec3_array_of(points + point), 1, (lmp_sh_array) { alone, 0, layout });
    assert_memory_equal(alone, among + (size_t)point * values, values * sizeof(float));
}

static void a_point_alone_gets_the_bits_of_a_batch(void **test) {
    (void)test;
    const unsigned all = lmp_cpu_flags();
    const lmp_light before[] = { lights[1], lights[2] };
    lights[1].position = points[3];
    lights[2].position = (lmp_vec3) { points[3].x, points[3].y + 0.1f, 0 };
    lights[2].radius = 0.5f;
    for (unsigned flag = LMP_CPU_SCALAR; flag <= all; flag *= 2)
        for (int bands = 1; bands <= 35 && lmp_cpu_limit(flag) == flag; bands++)
            for (int count = 3; count <= 83; count += 16)
                for (lmp_sh_layout layout = LMP_SH_INTERLEAVED; layout <= LMP_SH_PLANAR; layout++)
                    check_alone(bands, count, bands % 2 ? 3 : 11, 17, layout);
    lmp_cpu_limit(LMP_CPU_ALL);
    memcpy(lights + 1, before, sizeof before);
}

/* The sum is that of each light by itself, times its visibility, whether lanes are points or, for
 * one point, lights. */
static void visibility_weighs_every_light_at_every_point(void **test) {
    (void)test;
    enum { SPHERES = 37, POINTS = 21, VALUES3 = 3 * VALUES };
    static float visibility[SPHERES * POINTS], sums[POINTS * VALUES3], ones[POINTS * VALUES3];
    const lmp_spheres spheres = lmp_spheres_of(lights);
    const lmp_vec3_array at = lmp_vec3_array_of(points);
    for (int i = 0; i < SPHERES * POINTS; i++)
        visibility[i] = (float)(i * 7919 % 101) / 100;
    lmp_sphere_sum_n(NULL, BANDS, &spheres, SPHERES, visibility, at, POINTS,
                     lmp_sh_interleaved(sums, 0));
    for (int p = 0; p < POINTS; p++) {
        float sum[VALUES3] = { 0 }, one[VALUES3], alone[VALUES3], mine[SPHERES];
        for (int i = 0; i < SPHERES; i++) {
            mine[i] = visibility[i * POINTS + p];
            lmp_light_project(BANDS, &lights[i], 1, points[p], one);
            for (int v = 0; v < VALUES3; v++)
                sum[v] += mine[i] * one[v];
        }
        check_same(sum, sums + p * VALUES3, VALUES3);
        lmp_sphere_sum_n(NULL, BANDS, &spheres, SPHERES, mine, lmp_vec3_array_of(points + p), 1,
                         lmp_sh_interleaved(alone, 0));
        assert_memory_equal(alone, sums + p * VALUES3, sizeof alone);
    }
    for (int i = 0; i < SPHERES * POINTS; i++)
        visibility[i] = 1;
    lmp_sphere_sum_n(NULL, BANDS, &spheres, SPHERES, visibility, at, POINTS,
                     lmp_sh_interleaved(ones, 0));
    lmp_sphere_sum_n(NULL, BANDS, &spheres, SPHERES, NULL, at, POINTS, lmp_sh_interleaved(sums, 0));
    assert_memory_equal(ones, sums, sizeof sums);
}

static void accumulate_is_the_sum_of_the_lights(void **test) {
    (void)test;
    const lmp_spheres spheres = lmp_spheres_of(lights);
    lmp_sphere_sum_n(NULL, BANDS, &spheres, 11, NULL, lmp_vec3_array_of(points), COUNT,
                     lmp_sh_interleaved(out, 0));
    for (int i = 0; i < COUNT; i += 17) {
        float sh[3 * VALUES];
        lmp_light_project(BANDS, lights, 11, points[i], sh);
        check_same(sh, out + i * 3 * VALUES, 3 * VALUES);
    }
    lmp_sphere_sum_n(NULL, BANDS, &spheres, 0, NULL, lmp_vec3_array_of(points), 3,
                     lmp_sh_interleaved(out, 0));
    for (int i = 0; i < 3 * 3 * VALUES; i++)
        assert_true(out[i] == 0);
}

static void gradients_are_those_of_one_light(void **test) {
    (void)test;
    const lmp_spheres spheres = lmp_spheres_of(lights + 3);
    lmp_sphere_sum_gradient_n(NULL, BANDS, &spheres, 1, lmp_vec3_array_of(points), COUNT,
                              lmp_sh_interleaved(out, 0), lmp_sh_interleaved(other, 0));
    for (int i = 0; i < COUNT; i += 13) {
        float sh[VALUES], gradient[3 * VALUES];
        lmp_sphere_project_gradient(BANDS, lights[3].position, lights[3].radius, points[i], sh,
                                    gradient);
        check_same(sh, out + i * 3 * VALUES, VALUES);
        for (int axis = 0; axis < 3; axis++) /* the radiance of red is 1 */
            check_same(gradient + axis * VALUES, other + (i * 9 + axis * 3) * VALUES, VALUES);
    }
}

/* Computes sums of lights, then their derivatives. */
static void sum_all(const lmp_scratch *scratch, int bands, lmp_sh_layout layout, float *sums) {
    enum { POINTS = 17, LIGHTS = 40 };
    const lmp_spheres spheres = lmp_spheres_of(lights);
    const lmp_vec3_array at = lmp_vec3_array_of(points);
    float *slopes = sums + POINTS * 3 * LMP_SH_COUNT(bands);
    lmp_sphere_sum_gradient_n(scratch, bands, &spheres, LIGHTS, at, POINTS,
                              (lmp_sh_array) { sums, 0, layout },
                              (lmp_sh_array) { slopes, 0, layout });
    lmp_sphere_sum_n(scratch, bands, &spheres, LIGHTS, NULL, at, POINTS,
                     (lmp_sh_array) { sums, 0, layout });
}

static void scratch_changes_no_bit_and_is_not_overrun(void **test) {
    enum { MOST = LMP_SCRATCH_SIZE + 4096, PAINT = 0xa5 };
    static _Alignas(LMP_SCRATCH_ALIGNMENT) unsigned char memory[MOST];
    static const size_t sizes[] = { 0, 100, 60000, 131076, LMP_SCRATCH_SIZE, MOST };
    static const int bands[] = { 6, 17, 35 };
    (void)test;
    for (unsigned flag = LMP_CPU_SCALAR; flag <= lmp_cpu_flags(); flag *= 2)
        for (int i = 0; i < 12 * 3 && lmp_cpu_limit(flag) == flag; i++) {
            const lmp_sh_layout layout = i % 2 ? LMP_SH_PLANAR : LMP_SH_INTERLEAVED;
            const lmp_scratch scratch = { memory, sizes[i / 2 % 6] };
            const int n = bands[i / 12];
            memset(memory, PAINT, sizeof memory);
            sum_all(NULL, n, layout, out);
            sum_all(&scratch, n, layout, other);
            assert_memory_equal(out, other, 17 * 12 * LMP_SH_COUNT(n) * sizeof(float));
            for (size_t k = scratch.size < LMP_SCRATCH_SIZE ? scratch.size : LMP_SCRATCH_SIZE;
                 k < MOST; k++)
                assert_int_equal(memory[k], PAINT);
        }
    lmp_cpu_limit(LMP_CPU_ALL);
}

static void lobes_respond_as_one_by_one(void **test) {
    (void)test;
    const lmp_spheres spheres = lmp_spheres_of(lights);
    float lambda[BANDS];
    lmp_rgb response[COUNT];
    lmp_lobe_make_phong(BANDS, 7, lambda);
    lmp_lobe_response_n(BANDS, lambda, lmp_vec3_array_of(axes), &spheres, 9,
                        lmp_vec3_array_of(points), COUNT, lmp_rgb_array_of(response));
    for (int i = 0; i < COUNT; i++) {
        const lmp_rgb one = lmp_lobe_response(BANDS, lambda, axes[i], lights, 9, points[i]);
        CHECK_WITHIN((double)(response[i].b - one.b), 1e-5);
        CHECK_WITHIN((double)(one.b - response[i].b), 1e-5);
    }
}

static void basis_zonal_rotation_and_dot_are_the_scalar_ones(void **test) {
    (void)test;
    const lmp_quat rotation = check_random_rotation();
    static float matrices[LMP_SH_ROTATION_COUNT(BANDS)];
    float dots[COUNT], distances[COUNT], sh[VALUES], rotated[VALUES];
    lmp_sh_make_rotation(BANDS, rotation, matrices);
    lmp_sh_eval_n(BANDS, lmp_vec3_array_of(axes), COUNT, lmp_sh_interleaved(out, 0));
    lmp_sh_rotate_n(BANDS, matrices, out, COUNT, lmp_sh_interleaved(other, 0));
    lmp_sh_dot_n(BANDS, LMP_SH_INTERLEAVED, 0, out, other, COUNT, dots);
    for (int i = 0; i < COUNT; i++) {
        lmp_sh_eval(BANDS, axes[i], sh);
        check_same(sh, out + i * VALUES, VALUES);
        lmp_sh_rotate(BANDS, matrices, sh, rotated);
        check_same(rotated, other + i * VALUES, VALUES);
        CHECK_WITHIN((double)(dots[i] - lmp_sh_dot(BANDS, sh, rotated)), 1e-5);
        distances[i] = 1 + lights[i].radius * (float)i;
    }
    const lmp_float_array radii = { &lights->radius, sizeof *lights };
    lmp_sphere_project_zonal_n(BANDS, radii, (lmp_float_array) { distances, sizeof(float) }, COUNT,
                               lmp_sh_interleaved(out, 0));
    for (int i = 0; i < COUNT; i++) {
        lmp_sphere_project_zonal(BANDS, lights[i].radius, distances[i], sh);
        check_same(sh, out + i * BANDS, BANDS);
    }
}

/* Slopes agree in chunks and with any stride, and what lies between the elements is left alone. */
static void slopes_of_the_basis_are_those_of_one_direction(void **test) {
    (void)test;
    const size_t row = VALUES + 3, slope_row = 3 * VALUES + 5, plane = COUNT + 8;
    for (size_t i = 0; i < sizeof out / sizeof *out; i++)
        out[i] = other[i] = -77;
    lmp_sh_eval_gradient_n(BANDS, lmp_vec3_array_of(axes), COUNT,
                           lmp_sh_interleaved(out, row * sizeof(float)),
                           lmp_sh_interleaved(other, slope_row * sizeof(float)));
    for (size_t i = 0; i < COUNT; i++) {
        float sh[VALUES], gradient[3 * VALUES];
        lmp_sh_eval_gradient(BANDS, axes[i], sh, gradient);
        check_same(sh, out + i * row, VALUES);
        check_same(gradient, other + i * slope_row, 3 * VALUES);
        for (size_t gap = VALUES; gap < row; gap++)
            assert_true(out[i * row + gap] == -77);
        for (size_t gap = 3 * VALUES; gap < slope_row; gap++)
            assert_true(other[i * slope_row + gap] == -77);
    }
    float *slopes = other + (COUNT - 20) * slope_row; /* compared below */
    lmp_sh_eval_gradient_n(BANDS, lmp_vec3_array_of(axes), COUNT, lmp_sh_planar(out, 0),
                           lmp_sh_planar(out + VALUES * COUNT, plane * sizeof(float)));
    for (size_t i = COUNT - 20; i < COUNT; i++, slopes += slope_row)
        for (size_t v = 0; v < 3 * VALUES; v++)
            assert_memory_equal(&out[VALUES * COUNT + v * plane + i], &slopes[v], sizeof(float));
}

/* Projects a cube map and a panorama whose rows fit no lanes, and finds irradiance from both. */
static void project_images(float *sh, lmp_rgb *irradiance) {
    enum { SIZE = 37, CHANNELS = 3 };
    lmp_cubemap cube = { .size = SIZE, .channels = CHANNELS };
    const lmp_latlong panorama = {
        .pixels = other, .width = 301, .height = 29, .channels = CHANNELS
    };
    for (int face = 0; face < 6; face++)
        cube.faces[face] = other + face * SIZE * SIZE * CHANNELS;
    lmp_sh_project_cubemap(BANDS, &cube, sh);
    lmp_sh_project_latlong(BANDS, &panorama, sh + CHANNELS * VALUES);
    lmp_probe_irradiance_n(BANDS, sh, lmp_vec3_array_of(axes), COUNT, lmp_rgb_array_of(irradiance));
}

static void images_have_the_same_bits_by_every_mask(void **test) {
    (void)test;
    static float expected[6 * VALUES], actual[6 * VALUES];
    static lmp_rgb expected_rgb[COUNT], actual_rgb[COUNT];
    for (size_t i = 0; i < sizeof other / sizeof *other; i++)
        other[i] = (float)check_random();
    for (unsigned flag = LMP_CPU_SCALAR; flag <= LMP_CPU_AVX512; flag *= 2) {
        lmp_cpu_limit(flag);
        project_images(flag == LMP_CPU_SCALAR ? expected : actual,
                       flag == LMP_CPU_SCALAR ? expected_rgb : actual_rgb);
        if (flag == LMP_CPU_SCALAR)
            continue;
        assert_memory_equal(expected, actual, sizeof expected);
        assert_memory_equal(expected_rgb, actual_rgb, sizeof expected_rgb);
    }
    lmp_cpu_limit(LMP_CPU_ALL);
}

static void the_mask_chooses_the_kernels(void **test) {
    (void)test;
    const unsigned all = lmp_cpu_flags();
    assert_true(all & LMP_CPU_SCALAR);
    assert_int_equal(lmp_cpu_limit(LMP_CPU_SCALAR), LMP_CPU_SCALAR);
    assert_string_equal(lmp_cpu_name(), "scalar");
    assert_int_equal(lmp_cpu_limit(0), LMP_CPU_SCALAR);
    for (unsigned flag = LMP_CPU_SCALAR; flag <= LMP_CPU_AVX512; flag *= 2)
        assert_int_equal(lmp_cpu_limit(flag), all & flag ? flag : (unsigned)LMP_CPU_SCALAR);
    assert_true(lmp_cpu_limit(LMP_CPU_ALL) * 2 > all);
}

/* Reads rows of seven floats in any order as planes, and writes three planes as colors that leave
 * what is beside them alone. */
static void rows_are_planes_wherever_they_are(void **test) {
    (void)test;
    enum { ROWS = 48, WIDTH = 9, TAKEN = 37, COLOR = 5 };
    static const float clamped[5][2] = {
        { 2, 2 }, { -2, 0 }, { 0, 0 }, { -0.0f, 0 }, { NAN, NAN }
    };
    float rows[ROWS * WIDTH], planes[7][ROWS], sums[3][ROWS], *to[7];
    size_t at[ROWS];
    for (size_t i = 0; i < ROWS; i++) {
        at[i] = (i < TAKEN ? i : TAKEN - 1) * 7 % ROWS;
        for (size_t v = 0; v < WIDTH; v++)
            rows[i * WIDTH + v] = (float)(100 * i + v);
        for (size_t c = 0; c < 3; c++)
            sums[c][i] = clamped[(i + c) % 5][0];
    }
    for (size_t v = 0; v < 7; v++)
        to[v] = planes[v];
    const lmpi_kernel_rows from = { at, WIDTH * sizeof(float) };
    const lmpi_kernel_rows into = { at, COLOR * sizeof(float) };
    const float *const sum[3] = { sums[0], sums[1], sums[2] };
    for (unsigned flag = LMP_CPU_SCALAR; flag <= LMP_CPU_AVX512; flag *= 2) {
        lmpi_kernels kernels;
        float colors[ROWS * COLOR];
        size_t written = 0;
        (void)lmpi_kernels_init(&kernels, flag);
        memset(planes, 0, sizeof planes);
        for (size_t i = 0; i < ROWS * COLOR; i++)
            colors[i] = 77;
        kernels.convert.load_rows(7, rows, &from, TAKEN, to);
        kernels.convert.store_colors(sum, TAKEN, &into, colors);
        for (size_t i = 0; i < TAKEN; i++) {
            for (size_t v = 0; v < 7; v++)
                assert_memory_equal(&planes[v][i], &rows[at[i] * WIDTH + v], sizeof(float));
            for (size_t c = 0; c < 3; c++)
                assert_memory_equal(&colors[at[i] * COLOR + c], &clamped[(i + c) % 5][1],
                                    sizeof(float));
        }
        for (size_t i = 0; i < ROWS * COLOR; i++)
            written += !(colors[i] >= 77 && colors[i] <= 77);
        assert_int_equal(written, 3 * TAKEN);
    }
}

/* Lobes of views from behind on, and of any roughness, have the bits of one surface in every build.
 */
static void lobes_of_ggx_are_those_of_one_surface(void **test) {
    (void)test;
    enum { SURFACES = 48, TAKEN = 41, MEMBERS = 6 };
    static const float strange[4] = { NAN, -1, 7, 0 };
    float vectors[6][SURFACES], rough[SURFACES], lost[SURFACES];
    float planes[LMP_GGX_LOBES][MEMBERS][SURFACES];
    lmpi_kernel_ggx_lobe to[LMP_GGX_LOBES];
    for (size_t i = 0; i < SURFACES; i++) {
        const lmp_vec3 n = check_random_direction(), v = i % 5 ? check_random_direction() : n;
        const float both[6] = { n.x, n.y, n.z, v.x, v.y, v.z };
        rough[i] = i % 7 ? (float)check_random() : strange[i / 7 % 4];
        for (size_t c = 0; c < 6; c++)
            vectors[c][i] = both[c];
    }
    for (int k = 0; k < LMP_GGX_LOBES; k++)
        to[k] = (lmpi_kernel_ggx_lobe) {
            { planes[k][0], planes[k][1], planes[k][2] }, planes[k][3], planes[k][4], planes[k][5]
        };
    const lmpi_kernel_vec3 normal = { vectors[0], vectors[1], vectors[2] };
    const lmpi_kernel_vec3 view = { vectors[3], vectors[4], vectors[5] };
    for (unsigned flag = LMP_CPU_SCALAR; flag <= LMP_CPU_AVX512; flag *= 2) {
        lmp_cpu_limit(flag);
        lmpi_lobe_ggx_n(&normal, &view, rough, TAKEN, LMP_GGX_LOBES, to, lost);
        for (size_t i = 0; i < TAKEN; i++) {
            lmp_ggx_lobes one;
            lmp_lobe_find_ggx(lmpi_batch_get(&normal, i), lmpi_batch_get(&view, i), rough[i], &one);
            assert_memory_equal(&lost[i], &one.diffuse_f90, sizeof(float));
            for (int k = 0; k < LMP_GGX_LOBES; k++) {
                const lmp_ggx_lobe *lobe = &one.lobe[k];
                const float members[MEMBERS] = { lobe->axis.x,   lobe->axis.y, lobe->axis.z,
                                                 lobe->exponent, lobe->f0,     lobe->f90 };
                for (int m = 0; m < MEMBERS; m++)
                    assert_memory_equal(&planes[k][m][i], &members[m], sizeof(float));
            }
        }
    }
    lmp_cpu_limit(LMP_CPU_ALL);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(project_takes_structures_and_gives_rows),
        cmocka_unit_test(planes_are_rows_transposed),
        cmocka_unit_test(all_pairs_are_every_sphere_at_every_point),
        cmocka_unit_test(a_split_of_the_points_changes_no_bit),
        cmocka_unit_test(a_point_alone_gets_the_bits_of_a_batch),
        cmocka_unit_test(visibility_weighs_every_light_at_every_point),
        cmocka_unit_test(accumulate_is_the_sum_of_the_lights),
        cmocka_unit_test(scratch_changes_no_bit_and_is_not_overrun),
        cmocka_unit_test(gradients_are_those_of_one_light),
        cmocka_unit_test(lobes_respond_as_one_by_one),
        cmocka_unit_test(basis_zonal_rotation_and_dot_are_the_scalar_ones),
        cmocka_unit_test(slopes_of_the_basis_are_those_of_one_direction),
        cmocka_unit_test(images_have_the_same_bits_by_every_mask),
        cmocka_unit_test(rows_are_planes_wherever_they_are),
        cmocka_unit_test(lobes_of_ggx_are_those_of_one_surface),
        cmocka_unit_test(the_mask_chooses_the_kernels),
    };
    return cmocka_run_group_tests(tests, fill, NULL);
}
