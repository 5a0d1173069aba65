/* SPDX-License-Identifier: MIT */
/* Every kernel, on every instruction set this machine has: against the oracle in double precision,
 * and bit for bit against the scalar build and the committed checksums, which hold for every
 * compiler. Memory around each output is guarded. */
#include "tests/kernels/shaded.h"

#include <lampion/cpu.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { GUARD = 64 };

/* --- running a kernel ------------------------------------------------------------------------ */

typedef enum kind {
    EVAL,
    DOT,
    ROTATE,
    ZONAL,
    PROJECT,
    ACCUMULATE,
    GRADIENT,
    LOBE,
    SHADE_ZONAL,
    SHADE_PREINTEGRATED_LOBE,
    SHADE_PREINTEGRATED_BRDF,
    KINDS
} kind;
static const char *const kind_names[] = { "eval",
                                          "dot",
                                          "rotate",
                                          "zonal",
                                          "project",
                                          "accumulate",
                                          "gradient",
                                          "lobe",
                                          "shade_zonal",
                                          "shade_preintegrated_lobe",
                                          "shade_preintegrated_brdf" };

static size_t values_of(kind which, int bands) {
    const size_t n = LMP_SH_COUNT(bands);
    switch (which) {
    case DOT:
        return 1;
    case ZONAL:
        return (size_t)bands;
    case ACCUMULATE:
        return 3 * n;
    case GRADIENT:
        return 12 * n;
    case LOBE:
    case SHADE_PREINTEGRATED_BRDF:
        return 3;
    case SHADE_ZONAL:
    case SHADE_PREINTEGRATED_LOBE:
        return 6;
    default:
        return n;
    }
}

/* Lobes and coefficients that the kernels of those take. */
static void make_lambda(int bands, float *lambda) {
    for (int l = 0; l < bands; l++)
        lambda[l] = 1 / (1 + 0.25f * (float)l);
}

static float *make_matrices(int bands) {
    float *matrices = malloc(LMP_SH_ROTATION_COUNT(bands) * sizeof *matrices);
    assert_non_null(matrices);
    set_seed(bands > 0 ? (uint64_t)bands : 1);
    for (size_t i = 0; i < LMP_SH_ROTATION_COUNT(bands); i++)
        matrices[i] = grid(1.0f / 1024);
    return matrices;
}

/* Coefficients are the same for both layouts: of element e, value v. */
static float coefficient(size_t e, size_t v) {
    set_seed(e * 7919 + v);
    grid(1);
    return grid(1.0f / 1024);
}

static float *make_vectors(size_t values, size_t count, int planar, size_t stride, size_t shift) {
    float *at = malloc((planar ? values : count) * stride * sizeof *at + 64);
    assert_non_null(at);
    for (size_t e = 0; e < count; e++)
        for (size_t v = 0; v < values; v++)
            at[planar ? v * stride + e : e * stride + v] = coefficient(e + shift, v);
    return at;
}

static void run_vectors(const lmp_kernels *k, kind which, int bands, size_t count, int planar,
                        const lmp_kernel_out *out) {
    const size_t values = LMP_SH_COUNT(bands), stride = (planar ? count : values) + 3;
    float *a = make_vectors(values, count, planar, stride, 0);
    const lmp_kernel_in from_a = { a, stride, planar };
    if (which == DOT) {
        float *b = make_vectors(values, count, planar, stride, 1000);
        const lmp_kernel_in from_b = { b, stride, planar };
        k->dot(values, &from_a, &from_b, count, out->at);
        free(b);
    } else {
        float *matrices = make_matrices(bands);
        k->rotate(bands, matrices, &from_a, count, out);
        free(matrices);
    }
    free(a);
}

/* The kernels of shading add to planes, up to a whole number of lanes: what is beside them is
 * guarded here. */
enum { PLANE = (COUNT / LMP_KERNEL_LANES_MAX + 1) * LMP_KERNEL_LANES_MAX + 2 * GUARD };

static void call_shading(const lmp_kernels *k, kind which, const shading *s, size_t count,
                         float *const planes[6]) {
    const inputs *in = s->in;
    const lmp_kernel_accumulated sums = { { planes[0], planes[1], planes[2] },
                                          { planes[3], planes[4], planes[5] } };
    const lmp_kernel_surfaces surfaces = { { in->point[0], in->point[1], in->point[2] },
                                           { in->normal[0], in->normal[1], in->normal[2] },
                                           { in->view[0], in->view[1], in->view[2] },
                                           in->exponent };
    const lmp_kernel_preintegrated_lobe response = { s->pairs };
    const lmp_kernel_lobe_positions broad = { s->broad_first, s->broad_columns, s->broad[0],
                                              s->broad[1], s->broad[2] };
    const lmp_kernel_lobe_positions sharp = { s->first, s->columns, s->share, s->density,
                                              s->angle };
    if (which == SHADE_ZONAL)
        k->shade_zonal(s->bands, s->window, s->diffuse, &surfaces, s->lights, SHADE_LIGHTS, count,
                       &sums);
    else if (which == SHADE_PREINTEGRATED_LOBE)
        k->shade_preintegrated_lobe(&response, &broad, &sharp, &surfaces, s->lights, SHADE_LIGHTS,
                                    count, &sums);
    else
        k->shade_preintegrated_brdf(&s->measured, &surfaces, s->lights, SHADE_LIGHTS, s->ambient,
                                    count, sums.diffuse);
}

static void run_shading(const lmp_kernels *k, kind which, int bands, const inputs *in, size_t count,
                        const lmp_kernel_out *out) {
    _Alignas(64) float memory[6][PLANE];
    float *planes[6];
    const size_t whole =
        (count + LMP_KERNEL_LANES_MAX - 1) / LMP_KERNEL_LANES_MAX * LMP_KERNEL_LANES_MAX;
    const size_t values = values_of(which, bands);
    shading *s = shading_create(in, bands);
    for (size_t v = 0; v < 6; v++) {
        planes[v] = memory[v] + GUARD;
        for (size_t i = 0; i < PLANE; i++)
            memory[v][i] = (float)v; /* what the kernel adds to */
    }
    call_shading(k, which, s, count, planes);
    shading_free(s);
    for (size_t v = 0; v < 6; v++) {
        for (size_t e = 0; v < values && e < count; e++)
            out->at[out->planar ? v * out->stride + e : e * out->stride + v] = planes[v][e];
        for (size_t i = 0; i < PLANE; i++)
            if ((v >= values || i < GUARD || i >= GUARD + whole) &&
                (memory[v][i] < (float)v || memory[v][i] > (float)v))
                out->at[-1] = 0; /* seen as memory that is not the kernel's */
    }
}

static void run(const lmp_kernels *k, kind which, int bands, const inputs *in, size_t count,
                int planar, const lmp_kernel_out *out) {
    const lmp_kernel_vec3 point = { in->point[0], in->point[1], in->point[2] };
    const lmp_kernel_vec3 center = { in->center[0], in->center[1], in->center[2] };
    const lmp_kernel_vec3 axis = { in->axis[0], in->axis[1], in->axis[2] };
    const lmp_kernel_pairs pairs = { center, point, in->radius };
    const lmp_kernel_lights lights = { { center.x, center.y, center.z, sizeof(float) },
                                       { in->radius, sizeof(float) },
                                       { in->rgb[0], in->rgb[1], in->rgb[2], sizeof(float) },
                                       LIGHTS };
    /* Gradients follow the values: further on in a row, or in the planes after them. */
    lmp_kernel_out gradient = *out;
    gradient.at += 3 * LMP_SH_COUNT(bands) * (planar ? out->stride : 1);
    float lambda[LMP_BANDS_MAX];
    make_lambda(bands, lambda);
    switch (which) {
    case EVAL:
        k->eval(bands, &axis, count, out);
        break;
    case DOT:
    case ROTATE:
        run_vectors(k, which, bands, count, planar, out);
        break;
    case ZONAL:
        k->zonal(bands, in->radius, in->distance, count, out);
        break;
    case PROJECT:
        k->project(bands, &pairs, count, out);
        break;
    case ACCUMULATE:
        k->accumulate(bands, &lights, &point, count, out);
        break;
    case GRADIENT:
        k->gradient(bands, &lights, &point, LMP_COS_MIN, count, out, &gradient);
        break;
    case LOBE:
        k->lobe(bands, lambda, &axis, &lights, &point, count, out);
        break;
    case SHADE_ZONAL:
    case SHADE_PREINTEGRATED_LOBE:
    case SHADE_PREINTEGRATED_BRDF:
        run_shading(k, which, bands, in, count, out);
        break;
    case KINDS:
        break;
    }
}

/* Runs a kernel into guarded memory and returns its values as tight rows, or NULL if it wrote
 * outside the output or left a value unwritten. */
static float *results(const lmp_kernels *k, kind which, int bands, const inputs *in, size_t count,
                      int planar) {
    const size_t values = values_of(which, bands);
    const size_t pad = which == DOT ? 0 : 5;
    const size_t stride = (planar ? count : values) + pad, rows = planar ? values : count;
    const size_t size = rows * stride + 2 * GUARD;
    const uint32_t mark = 0x7fc0beef; /* a NaN that no kernel makes */
    float *memory = aligned_alloc(64, (size * sizeof(float) + 63) / 64 * 64);
    float *tight = malloc((count * values + 1) * sizeof(float));
    assert_non_null(memory);
    assert_non_null(tight);
    for (size_t i = 0; i < size; i++)
        memcpy(memory + i, &mark, sizeof mark);
    const lmp_kernel_out out = { memory + GUARD, stride, planar };
    run(k, which, bands, in, count, planar, &out);
    int clean = 1;
    for (size_t i = 0; i < size; i++) {
        const size_t at = i < GUARD || stride == 0 ? size : i - GUARD;
        const size_t row = stride ? at / stride : rows, column = stride ? at % stride : 0;
        const int inside = row < rows && column < stride - pad;
        uint32_t bits;
        memcpy(&bits, memory + i, sizeof bits);
        clean = clean && inside == (bits != mark);
        if (inside)
            tight[planar ? column * values + row : row * values + column] = memory[i];
    }
    free(memory);
    if (!clean) {
        free(tight);
        return NULL;
    }
    return tight;
}

/* --- checks ------------------------------------------------------------------------------------
 */

static const int few_bands[] = { 1, 2, 3, 5, 10, 11, 33, 64, 65, 128 };
enum { FEW = sizeof few_bands / sizeof *few_bands };

static unsigned available(lmp_kernels tables[4]) {
    unsigned count = 0;
    for (unsigned flag = LMP_CPU_SCALAR; flag <= LMP_CPU_AVX512; flag *= 2)
        if (lmp_cpu_flags() & flag)
            assert_int_equal(lmp_kernels_init(&tables[count++], flag), flag);
    return count;
}

/* What a kernel does otherwise than the scalar build, or NULL: its bits, or memory beside the
 * output.
 */
static const char *difference(const lmp_kernels *k, const lmp_kernels *scalar, kind which,
                              int bands, const inputs *in, size_t count, int planar) {
    const size_t size = count * values_of(which, bands) * sizeof(float);
    float *expected = results(scalar, which, bands, in, count, planar);
    float *actual = results(k, which, bands, in, count, planar);
    const char *found = !expected || !actual                  ? "wrong memory"
                        : memcmp(expected, actual, size) != 0 ? "other bits"
                                                              : NULL;
    free(expected);
    free(actual);
    return found;
}

static bool agrees(const lmp_kernels *k, const lmp_kernels *scalar, kind which, int bands,
                   const inputs *in, size_t count, int planar) {
    const char *found = difference(k, scalar, which, bands, in, count, planar);
    if (found)
        printf("%s %s: %d bands, %zu elements, %s: %s\n", k->name, kind_names[which], bands, count,
               planar ? "planes" : "rows", found);
    return !found;
}

static bool agrees_everywhere(const lmp_kernels *k, const lmp_kernels *scalar, kind which,
                              int bands, const inputs *in) {
    const size_t lanes = (size_t)k->lanes;
    const size_t counts[] = { 0, 1, lanes - 1, lanes, lanes + 1, 4 * lanes, 4 * lanes + 3, COUNT };
    bool same = true;
    for (size_t c = 0; c < sizeof counts / sizeof *counts; c++)
        for (int planar = 0; planar < 2; planar++)
            if (counts[c] <= COUNT && (bands < 64 || counts[c] <= lanes + 1))
                same = agrees(k, scalar, which, bands, in, counts[c], planar) && same;
    return same;
}

/* LAMPION_SEED draws others. */
static uint64_t drawn_seed(void) {
    const uint64_t seed = (uint64_t)(check_random() * 1e9);
    printf("inputs of seed %llu\n", (unsigned long long)seed);
    return seed;
}

static void every_instruction_set_gives_the_same_bits(void **test) {
    (void)test;
    lmp_kernels tables[4];
    const unsigned count = available(tables);
    inputs *in = inputs_create(drawn_seed());
    bool same = true;
    for (unsigned i = 0; i < count; i++)
        for (int which = 0; which < KINDS; which++) {
            for (int bands = 1; bands <= 20; bands++)
                same = agrees_everywhere(&tables[i], &tables[0], (kind)which, bands, in) && same;
            for (int b = 6; b < FEW; b++)
                same = agrees_everywhere(&tables[i], &tables[0], (kind)which, few_bands[b], in) &&
                       same;
        }
    free(in);
    assert_true(same);
}

static void both_layouts_hold_the_same_bits(void **test) {
    (void)test;
    lmp_kernels scalar;
    lmp_kernels_init(&scalar, LMP_CPU_SCALAR);
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

/* --- against the oracle ------------------------------------------------------------------------
 */

/* Of an element's largest value: two to eight times what was seen with nine seeds. alpha2 = cos² a.
 */
static double bound_of(kind which, int bands, double alpha2) {
    switch (which) {
    case EVAL:
        return 1e-6 * bands;
    case PROJECT:
        return 3e-6 + 1e-6 * bands + surface_bound(alpha2);
    case GRADIENT: /* as 1 / cos a */
        return 1e-6 + 6e-7 * bands + 0.1 * surface_bound(alpha2) / sqrt(fmax(alpha2, 1e-30));
    case ZONAL:
        return 2e-6 + surface_bound(alpha2);
    default:
        return 1e-6 + surface_bound(alpha2);
    }
}

static void check_element(int i, int bands, kind which, size_t values, const double *expected,
                          const float *actual, double alpha2) {
    const double error = check_error(values, expected, actual);
    const double bound = bound_of(which, bands, alpha2);
    if (!(error <= bound))
        printf("%s, %d bands, element %d\n", kind_names[which], bands, i);
    CHECK_WITHIN(error, bound);
}

static void basis_zonal_and_project_match_double_precision(void **test) {
    (void)test;
    lmp_kernels best;
    lmp_kernels_init(&best, LMP_CPU_ALL);
    inputs *in = inputs_create(drawn_seed());
    double *expected = malloc(128 * 128 * sizeof *expected);
    assert_non_null(expected);
    for (int bands = 1; bands <= 128; bands += bands < 20 ? 1 : 108) {
        float *basis = results(&best, EVAL, bands, in, COUNT, 0);
        float *zonal = results(&best, ZONAL, bands, in, COUNT, 0);
        float *project = results(&best, PROJECT, bands, in, COUNT, 0);
        const size_t n = LMP_SH_COUNT(bands);
        for (int i = 0; i<COUNT; i += bands> 20 ? 4 : 1) {
            double center[3], point[3], axis[3], v2 = 0;
            widen(VECTOR(in->center), i, center);
            widen(VECTOR(in->point), i, point);
            widen(VECTOR(in->axis), i, axis);
            for (int k = 0; k < 3; k++)
                v2 += (center[k] - point[k]) * (center[k] - point[k]);
            const double radius = (double)in->radius[i];
            const double alpha2 =
                fabs(v2 - radius * radius) / fmax(fmax(v2, radius * radius), 1e-30);
            oracle_sh_eval(bands, axis, expected);
            check_element(i, bands, EVAL, n, expected, basis + (size_t)i * n, alpha2);
            if (radius == 0 && v2 == 0) {
                for (size_t j = 0; j < n; j++)
                    assert_true(project[(size_t)i * n + j] == 0);
                continue;
            }
            oracle_sphere(bands, center, radius, point, expected, NULL);
            check_element(i, bands, PROJECT, n, expected, project + (size_t)i * n, alpha2);
            /* The zonal coefficients are those along z. */
            oracle_sphere(bands, (double[]) { 0, 0, (double)in->distance[i] }, radius,
                          (double[]) { 0, 0, 0 }, expected, NULL);
            for (int l = 1; l < bands; l++)
                expected[l] = expected[l * l + l];
            check_element(i, bands, ZONAL, (size_t)bands, expected, zonal + i * bands, alpha2);
        }
        free(basis);
        free(zonal);
        free(project);
    }
    free(expected);
    free(in);
}

/* Of points and lights that the oracle sees. */
typedef struct sums_expected {
    double *sh, *axis_sh; /* red, green, blue; then by x, by y, by z */
    double response[3];
    double alpha2; /* the least cos² a */
    bool slopes;   /* they are finite, none is held back (LMP_COS_MIN), and so they are here */
} sums_expected;

/* cos² a of a light from a point; 1 where there is nothing to see. */
static double seen_alpha2(inputs *in, int light, int i, double center[3], double point[3]) {
    const double r = (double)in->radius[light];
    double v2 = 0;
    widen(VECTOR(in->center), light, center);
    widen(VECTOR(in->point), i, point);
    for (int k = 0; k < 3; k++)
        v2 += (center[k] - point[k]) * (center[k] - point[k]);
    return r == 0 && v2 == 0 ? 1 : fabs(v2 - r * r) / fmax(v2, r * r);
}

/* The oracle's derivatives cost 2 bands times its values: past 74 bands they are had of few. */
static void expect_sums(int bands, inputs *in, int i, const double *lambda, double *one,
                        sums_expected *e) {
    const size_t n = LMP_SH_COUNT(bands);
    double center[3], point[3], axis[3];
    widen(VECTOR(in->axis), i, axis);
    oracle_sh_eval(bands, axis, e->axis_sh);
    memset(e->sh, 0, 12 * n * sizeof *e->sh);
    memset(e->response, 0, sizeof e->response);
    e->alpha2 = 1;
    for (int light = 0; light < LIGHTS; light++)
        e->alpha2 = fmin(e->alpha2, seen_alpha2(in, light, i, center, point));
    e->slopes = e->alpha2 >= (double)(LMP_COS_MIN * LMP_COS_MIN) && (bands <= 74 || i % 8 == 0) &&
                i != 4; /* the center of a light */
    for (int light = 0; light < LIGHTS; light++) {
        const double r = (double)in->radius[light];
        seen_alpha2(in, light, i, center, point);
        if (r == 0 && memcmp(center, point, sizeof point) == 0)
            continue; /* nothing to see */
        oracle_sphere(bands, center, r, point, one, e->slopes ? one + n : NULL);
        const double lit = lobe_of(bands, lambda, one, e->axis_sh);
        for (int c = 0; c < 3; c++) {
            const double rgb = (double)in->rgb[c][light];
            e->response[c] += rgb * lit;
            for (size_t set = 0; set < (e->slopes ? 4 : 1); set++)
                for (size_t j = 0; j < n; j++)
                    e->sh[(3 * set + (size_t)c) * n + j] += rgb * one[set * n + j];
        }
    }
}

/* Point i < LIGHTS sees light i in the way of special[i]: touching, from inside, at the center. */
static void sums_gradients_and_lobes_match_double_precision(void **test) {
    (void)test;
    lmp_kernels best;
    lmp_kernels_init(&best, LMP_CPU_ALL);
    inputs *in = inputs_create(drawn_seed());
    sums_expected e = { malloc(12 * 128 * 128 * sizeof *e.sh),
                        malloc(128 * 128 * sizeof *e.axis_sh),
                        { 0 },
                        0,
                        false };
    double *one = malloc(4 * 128 * 128 * sizeof *one);
    assert_true(e.sh && e.axis_sh && one);
    for (int bands = 1; bands <= 128; bands += bands < 20 ? 1 : 54) {
        const size_t n = LMP_SH_COUNT(bands);
        float *total = results(&best, ACCUMULATE, bands, in, COUNT, 1);
        float *slopes = results(&best, GRADIENT, bands, in, COUNT, 1);
        float *lobes = results(&best, LOBE, bands, in, COUNT, 1), lambda[LMP_BANDS_MAX];
        double wide[LMP_BANDS_MAX];
        make_lambda(bands, lambda);
        for (int l = 0; l < bands; l++)
            wide[l] = (double)lambda[l];
        for (int i = 0; i<COUNT; i += bands> 20 || i >= LIGHTS ? 4 : 1) {
            expect_sums(bands, in, i, wide, one, &e);
            check_element(i, bands, ACCUMULATE, 3 * n, e.sh, total + (size_t)i * 3 * n, e.alpha2);
            for (int c = 0; c < 3; c++)
                CHECK_WITHIN(fabs((double)lobes[3 * i + c] - e.response[c]),
                             4e-6 + LIGHTS * surface_bound(e.alpha2));
            if (e.slopes)
                check_element(i, bands, GRADIENT, 12 * n, e.sh, slopes + (size_t)i * 12 * n,
                              e.alpha2);
        }
        free(total);
        free(slopes);
        free(lobes);
    }
    free(e.sh);
    free(e.axis_sh);
    free(one);
    free(in);
}

static void rotation_and_dot_match_double_precision(void **test) {
    (void)test;
    lmp_kernels best;
    lmp_kernels_init(&best, LMP_CPU_ALL);
    inputs *in = inputs_create(drawn_seed());
    for (int bands = 1; bands <= 128; bands += bands < 20 ? 1 : bands == 20 ? 13 : 95) {
        const size_t n = LMP_SH_COUNT(bands);
        float *rotated = results(&best, ROTATE, bands, in, 18, 0);
        float *dots = results(&best, DOT, bands, in, 18, 0), *matrices = make_matrices(bands);
        for (size_t e = 0; e < 18; e++) {
            const float *matrix = matrices;
            double dot = 0, size = 0;
            for (size_t v = 0; v < n; v++) {
                dot += (double)coefficient(e, v) * (double)coefficient(e + 1000, v);
                size += fabs((double)coefficient(e, v) * (double)coefficient(e + 1000, v));
            }
            CHECK_WITHIN(fabs(dot - (double)dots[e]), 1e-6 * size);
            for (int l = 0; l < bands; matrix += (2 * l + 1) * (2 * l + 1), l++)
                for (int i = 0; i<2 * l + 1; i += bands> 33 ? 9 : 1) {
                    double value = 0;
                    for (int j = 0; j < 2 * l + 1; j++)
                        value += (double)matrix[i * (2 * l + 1) + j] *
                                 (double)coefficient(e, (size_t)(l * l + j));
                    CHECK_WITHIN(fabs(value - (double)rotated[e * n + (size_t)(l * l + i)]),
                                 2e-7 * (2 * l + 1));
                }
        }
        free(rotated);
        free(dots);
        free(matrices);
    }
    free(in);
}

static void shading_matches_double_precision(void **test) {
    (void)test;
    static void (*const expect[])(const shading *, int, shaded *) = { expect_zonal, expect_response,
                                                                      expect_measured };
    lmp_kernels best;
    lmp_kernels_init(&best, LMP_CPU_ALL);
    inputs *in = inputs_create(drawn_seed());
    for (int which = SHADE_ZONAL; which < KINDS; which++) {
        check_errors errors = { 0 };
        double largest = 0, ratio = 0;
        for (int bands = 1; bands <= 128; bands += bands < 20 ? 1 : 54) {
            const size_t values = values_of((kind)which, bands);
            float *actual = results(&best, (kind)which, bands, in, COUNT, 0);
            shading *s = shading_create(in, bands);
            for (int i = 0; i<COUNT; i += bands> 20 ? 11 : 1) {
                shaded e;
                expect[which - SHADE_ZONAL](s, i, &e);
                for (size_t v = 0; v < values; v++) {
                    const double error =
                        fabs((double)actual[(size_t)i * values + v] - (double)v - e.values[v]);
                    if (!(error <= e.bound))
                        printf("%s, %d bands, element %d\n", kind_names[which], bands, i);
                    CHECK_WITHIN(error, e.bound);
                    check_errors_add(&errors, error);
                    largest = fmax(largest, fabs(e.values[v]));
                    ratio = fmax(ratio, error / e.bound);
                }
            }
            shading_free(s);
            free(actual);
        }
        printf("%s: error max %.2g, rms %.2g, of values to %.3g, of the bound %.2g\n",
               kind_names[which], errors.largest, check_errors_rms(&errors), largest, ratio);
    }
    free(in);
}

/* --- the same bits from every compiler ---------------------------------------------------------
 */

static const uint32_t golden[KINDS][FEW] = {
#include "tests/kernels/golden.h"
};

static uint32_t checksum(const lmp_kernels *k, kind which, int bands, const inputs *in) {
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
    lmp_kernels tables[4];
    const unsigned count = available(tables);
    inputs *in = inputs_create(2020); /* the checksums' */
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

/* --- wrong kernels -----------------------------------------------------------------------------
 */

/* One ulp in one lane of one value. */
static lmp_kernels honest;
static struct { size_t element, value; } flaw;

static void spoil(const lmp_kernel_out *out) {
    float *at = out->at + (out->planar ? flaw.value * out->stride + flaw.element
                                       : flaw.element * out->stride + flaw.value);
    *at = nextafterf(*at, 1e9f);
}

static void spoil_gathered(const lmp_kernel_accumulated *sums) {
    float *const *planes = flaw.value < 3 ? sums->diffuse : sums->specular;
    float *at = planes[flaw.value % 3] + flaw.element;
    *at = nextafterf(*at, 1e9f);
}

static void wrong_eval(int bands, const lmp_kernel_vec3 *directions, size_t count,
                       const lmp_kernel_out *out) {
    honest.eval(bands, directions, count, out);
    spoil(out);
}
static void wrong_dot(size_t values, const lmp_kernel_in *a, const lmp_kernel_in *b, size_t count,
                      float *dots) {
    honest.dot(values, a, b, count, dots);
    spoil(&(lmp_kernel_out) { dots, 1, 0 });
}
static void wrong_rotate(int bands, const float *matrices, const lmp_kernel_in *in, size_t count,
                         const lmp_kernel_out *out) {
    honest.rotate(bands, matrices, in, count, out);
    spoil(out);
}
static void wrong_zonal(int bands, const float *radius, const float *distance, size_t count,
                        const lmp_kernel_out *out) {
    honest.zonal(bands, radius, distance, count, out);
    spoil(out);
}
static void wrong_project(int bands, const lmp_kernel_pairs *pairs, size_t count,
                          const lmp_kernel_out *out) {
    honest.project(bands, pairs, count, out);
    spoil(out);
}
static void wrong_accumulate(int bands, const lmp_kernel_lights *lights,
                             const lmp_kernel_vec3 *points, size_t count,
                             const lmp_kernel_out *out) {
    honest.accumulate(bands, lights, points, count, out);
    spoil(out);
}
/* Its derivatives follow the values (run). */
static void wrong_gradient(int bands, const lmp_kernel_lights *lights,
                           const lmp_kernel_vec3 *points, float cos_min, size_t count,
                           const lmp_kernel_out *out, const lmp_kernel_out *gradient) {
    honest.gradient(bands, lights, points, cos_min, count, out, gradient);
    spoil(out);
}
static void wrong_lobe(int bands, const float *lambda, const lmp_kernel_vec3 *axes,
                       const lmp_kernel_lights *lights, const lmp_kernel_vec3 *points, size_t count,
                       const lmp_kernel_out *out) {
    honest.lobe(bands, lambda, axes, lights, points, count, out);
    spoil(out);
}
static void long_project(int bands, const lmp_kernel_pairs *pairs, size_t count,
                         const lmp_kernel_out *out) {
    honest.project(bands, pairs, count, out);
    out->at[-1] = 0;
}

static void wrong_shade_zonal(int bands, const float *window, const float *diffuse,
                              const lmp_kernel_surfaces *surfaces, const lmp_kernel_light *lights,
                              size_t light_count, size_t count,
                              const lmp_kernel_accumulated *gathered) {
    honest.shade_zonal(bands, window, diffuse, surfaces, lights, light_count, count, gathered);
    spoil_gathered(gathered);
}
static void wrong_shade_response(const lmp_kernel_preintegrated_lobe *response,
                                 const lmp_kernel_lobe_positions *diffuse,
                                 const lmp_kernel_lobe_positions *specular,
                                 const lmp_kernel_surfaces *surfaces,
                                 const lmp_kernel_light *lights, size_t light_count, size_t count,
                                 const lmp_kernel_accumulated *gathered) {
    honest.shade_preintegrated_lobe(response, diffuse, specular, surfaces, lights, light_count,
                                    count, gathered);
    spoil_gathered(gathered);
}
static void wrong_shade_measured(const lmp_kernel_preintegrated_brdf *material,
                                 const lmp_kernel_surfaces *surfaces,
                                 const lmp_kernel_light *lights, size_t light_count,
                                 lmp_rgb ambient, size_t count, float *const rgb[3]) {
    honest.shade_preintegrated_brdf(material, surfaces, lights, light_count, ambient, count, rgb);
    spoil_gathered(&(lmp_kernel_accumulated) { { rgb[0], rgb[1], rgb[2] }, { NULL } });
}
static void long_shade_measured(const lmp_kernel_preintegrated_brdf *material,
                                const lmp_kernel_surfaces *surfaces, const lmp_kernel_light *lights,
                                size_t light_count, lmp_rgb ambient, size_t count,
                                float *const rgb[3]) {
    honest.shade_preintegrated_brdf(material, surfaces, lights, light_count, ambient, count, rgb);
    rgb[2][-1] = 0;
}

static const lmp_kernels wrong = { .eval = wrong_eval,
                                   .dot = wrong_dot,
                                   .rotate = wrong_rotate,
                                   .zonal = wrong_zonal,
                                   .project = wrong_project,
                                   .accumulate = wrong_accumulate,
                                   .gradient = wrong_gradient,
                                   .lobe = wrong_lobe,
                                   .shade_zonal = wrong_shade_zonal,
                                   .shade_preintegrated_lobe = wrong_shade_response,
                                   .shade_preintegrated_brdf = wrong_shade_measured };

/* In the first, a middle and the last lane and value; the checksums, too. */
static void every_wrong_kernel_fails_the_checks(void **test) {
    (void)test;
    lmp_kernels scalar;
    const lmp_kernels longer = { .project = long_project,
                                 .shade_preintegrated_brdf = long_shade_measured };
    lmp_kernels_init(&honest, LMP_CPU_ALL);
    lmp_kernels_init(&scalar, LMP_CPU_SCALAR);
    inputs *in = inputs_create(1), *same = inputs_create(2020);
    for (int which = 0; which < KINDS; which++) {
        for (int i = 0; i < 6; i++) {
            const int planar = i % 2, bands = 6;
            flaw.element = (size_t)(i / 2 * (COUNT - 1) / 2);
            flaw.value = (size_t)(i / 2) * (values_of((kind)which, bands) - 1) / 2;
            assert_null(difference(&honest, &scalar, (kind)which, bands, in, COUNT, planar));
            assert_non_null(difference(&wrong, &scalar, (kind)which, bands, in, COUNT, planar));
        }
        flaw.element = flaw.value = 0;
        for (int b = 0; b < 5; b++)
            assert_int_not_equal(checksum(&wrong, (kind)which, few_bands[b], same),
                                 golden[which][b]);
    }
    assert_string_equal(difference(&longer, &scalar, PROJECT, 6, in, COUNT, 1), "wrong memory");
    assert_string_equal(difference(&longer, &scalar, SHADE_PREINTEGRATED_BRDF, 6, in, COUNT, 1),
                        "wrong memory");
    free(in);
    free(same);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(both_layouts_hold_the_same_bits),
        cmocka_unit_test(every_instruction_set_gives_the_same_bits),
        cmocka_unit_test(basis_zonal_and_project_match_double_precision),
        cmocka_unit_test(sums_gradients_and_lobes_match_double_precision),
        cmocka_unit_test(rotation_and_dot_match_double_precision),
        cmocka_unit_test(shading_matches_double_precision),
        cmocka_unit_test(every_compiler_gives_the_bits_of_the_checksums),
        cmocka_unit_test(every_wrong_kernel_fails_the_checks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
