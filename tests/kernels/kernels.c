/* SPDX-License-Identifier: MIT */
/* Every kernel, on every instruction set this machine has: bit for bit against the scalar build and
 * the committed checksums, which hold for every compiler. Memory around each output is guarded. */
#include "tests/kernels/run.h"

#include <lampion/cpu.h>

static const int few_bands[] = { 1, 2, 3, 5, 10, 11, 33, 64, 65, 128 };
enum { FEW = sizeof few_bands / sizeof *few_bands };

static unsigned available(lmpi_kernels tables[4]) {
    unsigned count = 0;
    for (unsigned flag = LMP_CPU_SCALAR; flag <= LMP_CPU_AVX512; flag *= 2)
        if (lmp_cpu_flags() & flag)
            assert_int_equal(lmpi_kernels_init(&tables[count++], flag), flag);
    return count;
}

/* The scalar build's values of a kernel, each made once, when first needed. */
typedef struct truths {
    const lmpi_kernels *scalar;
    kind which;
    int bands;
    float *values[2][COUNT + 1]; /* by layout and count */
} truths;

static const float *truth(truths *t, const inputs *in, size_t count, int planar) {
    float **const values = &t->values[planar][count];
    if (!*values)
        *values = results(t->scalar, t->which, t->bands, in, count, planar);
    return *values;
}

static void truths_free(truths *t) {
    for (size_t count = 0; count <= COUNT; count++)
        for (int planar = 0; planar < 2; planar++)
            free(t->values[planar][count]);
}

/* Returns how a kernel differs from the scalar build, in bits or in memory beside the output, or
 * NULL. For the scalar build itself only the memory is checked. */
static const char *difference(const lmpi_kernels *k, truths *t, const inputs *in, size_t count,
                              int planar) {
    const size_t size = count * values_of(t->which, t->bands) * sizeof(float);
    const float *const expected = truth(t, in, count, planar);
    if (k == t->scalar)
        return expected ? NULL : "wrong memory";
    float *actual = results(k, t->which, t->bands, in, count, planar);
    const char *found = !expected || !actual                  ? "wrong memory"
                        : memcmp(expected, actual, size) != 0 ? "other bits"
                                                              : NULL;
    free(actual);
    return found;
}

static bool agrees(const lmpi_kernels *k, truths *t, const inputs *in, size_t count, int planar) {
    const char *found = difference(k, t, in, count, planar);
    if (found)
        printf("%s %s: %d bands, %zu elements, %s: %s\n", k->name, kind_names[t->which], t->bands,
               count, planar ? "planar" : "interleaved", found);
    return !found;
}

static bool agrees_at_any_count(const lmpi_kernels *k, truths *t, const inputs *in) {
    const size_t lanes = (size_t)k->lanes;
    const size_t counts[] = { 0, 1, lanes - 1, lanes, lanes + 1, 4 * lanes, 4 * lanes + 3, COUNT };
    bool same = true;
    for (size_t c = 0; c < sizeof counts / sizeof *counts; c++)
        for (int planar = 0; planar < 2; planar++)
            if (counts[c] <= COUNT && (t->bands < 64 || counts[c] <= lanes + 1))
                same = agrees(k, t, in, counts[c], planar) && same;
    return same;
}

static void every_instruction_set_gives_the_same_bits(void **test) {
    (void)test;
    lmpi_kernels tables[4];
    const unsigned count = available(tables);
    inputs *in = inputs_create(drawn_seed());
    bool same = true;
    for (int which = 0; which < KINDS; which++)
        for (int b = -20; b < FEW; b++) {
            if (b >= 0 && few_bands[b] <= 20)
                continue;
            truths t = { &tables[0], (kind)which, b < 0 ? -b : few_bands[b], { { NULL } } };
            for (unsigned i = 0; i < count; i++)
                same = agrees_at_any_count(&tables[i], &t, in) && same;
            truths_free(&t);
        }
    free(in);
    assert_true(same);
}

static void both_layouts_hold_the_same_bits(void **test) {
    (void)test;
    lmpi_kernels scalar;
    lmpi_kernels_init(&scalar, LMP_CPU_SCALAR);
    inputs *in = inputs_create(drawn_seed());
    for (int which = 0; which < KINDS; which++)
        for (int b = 0; b < 7; b++) {
            float *rows = results(&scalar, (kind)which, few_bands[b], in, COUNT, 0);
            float *planes = results(&scalar, (kind)which, few_bands[b], in, COUNT, 1);
            assert_non_null(rows);
            assert_non_null(planes);
            assert_memory_equal(rows, planes,
                                COUNT * values_of((kind)which, few_bands[b]) * sizeof(float));
            free(rows);
            free(planes);
        }
    free(in);
}

/* --- the same bits from every compiler -------------------------------------------------------- */

static const uint32_t golden[KINDS][FEW] = {
#include "tests/kernels/golden.h"
};

static uint32_t checksum(const lmpi_kernels *k, kind which, int bands, const inputs *in) {
    const size_t count = 35;
    float *values = results(k, which, bands, in, count, 1);
    assert_non_null(values);
    uint32_t sum = 2166136261u;
    for (size_t i = 0; i < count * values_of(which, bands); i++) {
        uint32_t bits;
        memcpy(&bits, values + i, sizeof bits);
        sum = (sum ^ bits) * 16777619u;
    }
    free(values);
    return sum;
}

/* LAMPION_GOLDEN=1 prints the rows of golden.h. */
static void every_compiler_gives_the_bits_of_the_checksums(void **test) {
    (void)test;
    lmpi_kernels tables[4];
    const unsigned count = available(tables);
    inputs *in = inputs_create(2020); /* the inputs of the checksums */
    for (unsigned i = 0; i < count; i++)
        for (int which = 0; which < KINDS; which++)
            for (int b = 0; b < FEW; b++) {
                const uint32_t sum = checksum(&tables[i], (kind)which, few_bands[b], in);
                if (getenv("LAMPION_GOLDEN")) {
                    if (i == 0)
                        printf("%s0x%08xu,%s", b ? " " : "{ ", sum, b + 1 == FEW ? " },\n" : "");
                } else {
                    assert_int_equal(sum, golden[which][b]);
                }
            }
    free(in);
}

/* --- wrong kernels ---------------------------------------------------------------------------- */

/* The wrong kernels change one value in one lane by one ulp. */
static lmpi_kernels honest;
static struct { size_t element, value; } flaw;

static void spoil(const lmpi_kernel_out *out) {
    float *at = out->at + (out->planar ? flaw.value * out->stride + flaw.element
                                       : flaw.element * out->stride + flaw.value);
    *at = nextafterf(*at, 1e9f);
}

static void spoil_accumulated(const lmpi_kernel_accumulated *sums) {
    float *const *planes = flaw.value < 3 ? sums->diffuse : sums->specular[flaw.value / 3 - 1];
    float *at = planes[flaw.value % 3] + flaw.element;
    *at = nextafterf(*at, 1e9f);
}

static void wrong_eval(int bands, const lmpi_kernel_vec3 *directions, size_t count,
                       const lmpi_kernel_out *out) {
    honest.sh.eval(bands, directions, count, out);
    spoil(out);
}
static void wrong_dot(size_t values, const lmpi_kernel_in *a, const lmpi_kernel_in *b, size_t count,
                      float *dots) {
    honest.sh.dot(values, a, b, count, dots);
    spoil(&(lmpi_kernel_out) { dots, 1, 0 });
}
static void wrong_rotate(int bands, const float *matrices, const lmpi_kernel_in *in, size_t count,
                         const lmpi_kernel_out *out) {
    honest.sh.rotate(bands, matrices, in, count, out);
    spoil(out);
}
static void wrong_zonal(int bands, const float *radius, const float *distance, size_t count,
                        const lmpi_kernel_out *out) {
    honest.light.zonal(bands, radius, distance, count, out);
    spoil(out);
}
static void wrong_project(int bands, const lmpi_kernel_pairs *pairs, size_t count,
                          const lmpi_kernel_out *out) {
    honest.light.project(bands, pairs, count, out);
    spoil(out);
}
static void wrong_accumulate(const lmp_scratch *scratch, int bands,
                             const lmpi_kernel_lights *lights, const lmpi_kernel_vec3 *points,
                             size_t count, const lmpi_kernel_out *out) {
    honest.light.accumulate(scratch, bands, lights, points, count, out);
    spoil(out);
}
static void wrong_accumulate_more(const lmp_scratch *scratch, int bands,
                                  const lmpi_kernel_lights *lights, const lmpi_kernel_vec3 *points,
                                  size_t count, const lmpi_kernel_out *out) {
    honest.light.accumulate_more(scratch, bands, lights, points, count, out);
    spoil(out);
}
static void wrong_add(const float *sh, size_t first, size_t values, const float *factors,
                      size_t count, const lmpi_kernel_out *out) {
    honest.light.add(sh, first, values, factors, count, out);
    spoil(out);
}
static void wrong_cone(const lmpi_packed_light *cone, const lmpi_kernel_vec3 *points, size_t count,
                       float *factors) {
    honest.light.cone(cone, points, count, factors);
    spoil(&(lmpi_kernel_out) { factors, 1, 0 });
}
/* The derivatives follow the values (run.h). */
static void wrong_gradient(const lmp_scratch *scratch, int bands, const lmpi_kernel_lights *lights,
                           const lmpi_kernel_vec3 *points, float cos_min, size_t count,
                           const lmpi_kernel_out *out, const lmpi_kernel_out *gradient) {
    honest.light.gradient(scratch, bands, lights, points, cos_min, count, out, gradient);
    spoil(out);
}
static void wrong_lobe(int bands, const float *lambda, const lmpi_kernel_vec3 *axes,
                       const lmpi_kernel_lights *lights, const lmpi_kernel_vec3 *points,
                       size_t count, const lmpi_kernel_out *out) {
    honest.lobe.response(bands, lambda, axes, lights, points, count, out);
    spoil(out);
}
static void wrong_fading_gradient(const lmp_scratch *scratch, int bands,
                                  const lmpi_kernel_lights *lights, const lmpi_kernel_vec3 *points,
                                  float cos_min, lmpi_kernel_fade fade, size_t count,
                                  const lmpi_kernel_out *out, const lmpi_kernel_out *gradient) {
    honest.light.fading_gradient(scratch, bands, lights, points, cos_min, fade, count, out,
                                 gradient);
    spoil(out);
}
static void wrong_interpolate(size_t values, const lmpi_kernel_cells *cells, size_t count,
                              const lmpi_kernel_out *out) {
    honest.field.interpolate(values, cells, count, out);
    spoil(out);
}
static void wrong_refine(const lmpi_kernel_brick *brick, float *nodes) {
    honest.field.refine(brick, nodes);
    nodes[flaw.element % 16 * 4 * brick->stride] += 1;
}
static void wrong_shade_field(int bands, const float *window, const float *diffuse,
                              const lmpi_kernel_surfaces *surfaces, const lmpi_kernel_in *sh,
                              size_t count, const lmpi_kernel_accumulated *accumulated) {
    honest.shade.field(bands, window, diffuse, surfaces, sh, count, accumulated);
    spoil_accumulated(accumulated);
}
static void wrong_eval_gradient(int bands, const lmpi_kernel_vec3 *directions, size_t count,
                                const lmpi_kernel_out *out, const lmpi_kernel_out *gradient) {
    honest.sh.eval_gradient(bands, directions, count, out, gradient);
    spoil(out);
}
static void wrong_reconstruct(int bands, const float *factors, const float *exponents,
                              const float *const planes[3], const lmpi_kernel_vec3 *directions,
                              size_t count, const lmpi_kernel_out *out) {
    honest.sh.reconstruct(bands, factors, exponents, planes, directions, count, out);
    spoil(out);
}
/* Adds the error to every image. */
static void wrong_image(int bands, int m, int orders, const lmpi_kernel_texels *texels,
                        size_t count, lmpi_kernel_texel_sums *sums) {
    const int n = (int)LMP_SH_COUNT(bands), index = (int)flaw.value % n;
    int l = 0;
    honest.sh.image(bands, m, orders, texels, count, sums);
    while ((l + 1) * (l + 1) <= index)
        l++;
    const int order = index - l * l - l, i = abs(order) - m;
    if (i < 0 || i >= orders)
        return;
    double *at = &(order < 0 ? sums->sine : sums->cosine)[i][flaw.value / (size_t)n][l];
    *at = (double)nextafterf((float)*at, 1e9f);
}
static void long_project(int bands, const lmpi_kernel_pairs *pairs, size_t count,
                         const lmpi_kernel_out *out) {
    honest.light.project(bands, pairs, count, out);
    out->at[-1] = 0;
}

static void wrong_shade_zonal(int bands, const float *window, const lmpi_kernel_surfaces *surfaces,
                              const lmpi_packed_light *lights, size_t light_count, size_t count,
                              const lmpi_kernel_accumulated *accumulated) {
    honest.shade.zonal(bands, window, surfaces, lights, light_count, count, accumulated);
    spoil_accumulated(accumulated);
}
static void wrong_shade_polygons(int bands, const float *window,
                                 const lmpi_kernel_surfaces *surfaces,
                                 const lmpi_kernel_polygon *lights, size_t light_count,
                                 size_t count, const lmpi_kernel_accumulated *accumulated) {
    honest.shade.polygons(bands, window, surfaces, lights, light_count, count, accumulated);
    spoil_accumulated(accumulated);
}
static void wrong_shade_disk(int bands, const float *window, const lmpi_kernel_surfaces *surfaces,
                             const lmpi_kernel_disk *light, size_t count,
                             const lmpi_kernel_accumulated *accumulated, float *left) {
    honest.shade.disk(bands, window, surfaces, light, count, accumulated, left);
    spoil_accumulated(accumulated);
}
static void wrong_shade_tube(int bands, const float *window, const lmpi_kernel_surfaces *surfaces,
                             const lmpi_kernel_tube *light, size_t count,
                             const lmpi_kernel_accumulated *accumulated, float *left) {
    honest.shade.tube(bands, window, surfaces, light, count, accumulated, left);
    spoil_accumulated(accumulated);
}
static void wrong_shade_preintegrated_lobe(const lmpi_kernel_preintegrated_lobe *lobe,
                                           const lmpi_kernel_lobe_positions *specular,
                                           const lmpi_kernel_surfaces *surfaces,
                                           const lmpi_packed_light *lights, size_t light_count,
                                           size_t count,
                                           const lmpi_kernel_accumulated *accumulated) {
    honest.shade.preintegrated_lobe(lobe, specular, surfaces, lights, light_count, count,
                                    accumulated);
    spoil_accumulated(accumulated);
}
static void wrong_shade_preintegrated_brdf(const lmpi_kernel_preintegrated_brdf *material,
                                           const lmpi_kernel_surfaces *surfaces,
                                           const lmpi_packed_light *lights, size_t light_count,
                                           lmp_rgb ambient, size_t count, float *const rgb[3]) {
    honest.shade.preintegrated_brdf(material, surfaces, lights, light_count, ambient, count, rgb);
    spoil_accumulated(&(lmpi_kernel_accumulated) { .diffuse = { rgb[0], rgb[1], rgb[2] } });
}
static void long_shade_preintegrated_brdf(const lmpi_kernel_preintegrated_brdf *material,
                                          const lmpi_kernel_surfaces *surfaces,
                                          const lmpi_packed_light *lights, size_t light_count,
                                          lmp_rgb ambient, size_t count, float *const rgb[3]) {
    honest.shade.preintegrated_brdf(material, surfaces, lights, light_count, ambient, count, rgb);
    rgb[2][-1] = 0;
}

static const lmpi_kernels wrong = { .sh.eval = wrong_eval,
                                    .sh.dot = wrong_dot,
                                    .sh.rotate = wrong_rotate,
                                    .light.zonal = wrong_zonal,
                                    .light.project = wrong_project,
                                    .light.accumulate = wrong_accumulate,
                                    .light.accumulate_more = wrong_accumulate_more,
                                    .light.add = wrong_add,
                                    .light.cone = wrong_cone,
                                    .light.gradient = wrong_gradient,
                                    .light.fading_gradient = wrong_fading_gradient,
                                    .field.interpolate = wrong_interpolate,
                                    .field.refine = wrong_refine,
                                    .lobe.response = wrong_lobe,
                                    .sh.eval_gradient = wrong_eval_gradient,
                                    .sh.reconstruct = wrong_reconstruct,
                                    .sh.image = wrong_image,
                                    .shade.zonal = wrong_shade_zonal,
                                    .shade.polygons = wrong_shade_polygons,
                                    .shade.disk = wrong_shade_disk,
                                    .shade.tube = wrong_shade_tube,
                                    .shade.field = wrong_shade_field,
                                    .shade.preintegrated_lobe = wrong_shade_preintegrated_lobe,
                                    .shade.preintegrated_brdf = wrong_shade_preintegrated_brdf };

/* The error is put into the first, a middle and the last lane and value; the checksums must notice
 * it, too. */
static void every_wrong_kernel_fails_the_checks(void **test) {
    (void)test;
    lmpi_kernels scalar;
    const lmpi_kernels longer = { .light.project = long_project,
                                  .shade.preintegrated_brdf = long_shade_preintegrated_brdf };
    lmpi_kernels_init(&honest, LMP_CPU_ALL);
    lmpi_kernels_init(&scalar, LMP_CPU_SCALAR);
    inputs *in = inputs_create(1), *same = inputs_create(2020);
    for (int which = 0; which < KINDS; which++) {
        truths t = { &scalar, (kind)which, 6, { { NULL } } };
        for (int i = 0; i < 6; i++) {
            const int planar = i % 2;
            flaw.element = (size_t)(i / 2 * (COUNT - 1) / 2);
            flaw.value = (size_t)(i / 2) * (values_of((kind)which, t.bands) - 1) / 2;
            assert_null(difference(&honest, &t, in, COUNT, planar));
            assert_non_null(difference(&wrong, &t, in, COUNT, planar));
        }
        truths_free(&t);
        flaw.element = flaw.value = 0;
        for (int b = 0; b < 5; b++)
            assert_int_not_equal(checksum(&wrong, (kind)which, few_bands[b], same),
                                 golden[which][b]);
    }
    static const kind longer_kinds[] = { PROJECT, SHADE_PREINTEGRATED_BRDF };
    for (int i = 0; i < 2; i++) {
        truths t = { &scalar, longer_kinds[i], 6, { { NULL } } };
        assert_string_equal(difference(&longer, &t, in, COUNT, 1), "wrong memory");
        truths_free(&t);
    }
    free(in);
    free(same);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(both_layouts_hold_the_same_bits),
        cmocka_unit_test(every_instruction_set_gives_the_same_bits),
        cmocka_unit_test(every_compiler_gives_the_bits_of_the_checksums),
        cmocka_unit_test(every_wrong_kernel_fails_the_checks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
