/* SPDX-License-Identifier: MIT */
/* lampion bench - what the batch kernels cost (docs/benchmarks.md). */
#include "app/command/bench.h"
#include "app/command/command.h"
#include "app/override/override.h"
#include "app/timing/timing.h"

#include <lampion/lampion.h>

#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#if defined(__x86_64__)
#include <immintrin.h>
#endif

/* Sizes: outputs of a call fit the first cache (48 KiB), as a caller that uses them at once sees;
 * LIGHTS lights go into each point. */
enum { LIGHTS = 32, ELEMENTS_MAX = 480, OUTPUT_FLOATS = 6144, RUNS_MAX = 401 };

static const int bands_measured[] = { 3, 5, 6, 8, 10, 20, 50, 128 };
enum { BANDS_MEASURED = sizeof bands_measured / sizeof *bands_measured };

/* What a kernel works on. */
typedef struct bench_batch {
    int bands;
    lmp_sh_layout layout;
    size_t count, stride;
    lmp_vec3_array axes, points;
    lmp_spheres spheres;
    const float *distances, *lambda, *matrices, *vectors;
    lmp_surfaces surfaces;
    const lmp_light *lights;
    const lmp_preintegrated_lobe *response; /* of the kernels that read one */
    float *out;
} bench_batch;

typedef struct measurement {
    const char *isa;
    timing_quartiles ns; /* a light-point pair */
    double peak_fraction, vs_paper;
    double vs_scalar; /* 0: scalar was not measured */
} measurement;

/* What a kernel reads. Its bands do not concern the cost: 10, unless others are asked for. */
typedef enum bench_table { TABLE_NONE, TABLE_LOBES, TABLE_MEASURED } bench_table;
enum { TABLE_BANDS = 10 };

/* One light a pair, or LIGHTS of them. */
typedef struct bench_kernel {
    const char *name;
    size_t (*values)(int bands); /* of an element */
    double (*slots)(int bands);  /* mul, add, div and sqrt a light-point pair */
    void (*run)(const bench_batch *b);
    void (*paper)(const bench_batch *b, size_t element);
    int lights;  /* pairs an element */
    bool shades; /* its output has one layout */
    bench_table table;
} bench_kernel;

/* --- the batch functions -----------------------------------------------------------------------
 */

static void run_basis(const bench_batch *b) {
    lmp_sh_eval_n(b->bands, b->axes, b->count, b->layout, b->stride, b->out);
}
static void run_dot(const bench_batch *b) {
    lmp_sh_dot_n(b->bands, b->vectors, b->vectors, b->count, b->layout, b->stride, b->out);
}
static void run_rotate(const bench_batch *b) {
    lmp_sh_rotate_n(b->bands, b->matrices, b->vectors, b->count, b->layout, b->stride, b->out);
}
static void run_zonal(const bench_batch *b) {
    const lmp_float_array distances = { b->distances, sizeof(float) };
    lmp_sphere_zonal_n(b->bands, b->spheres.radius, distances, b->count, b->layout, b->stride,
                       b->out);
}
static void run_project(const bench_batch *b) {
    lmp_sphere_project_n(b->bands, &b->spheres, b->points, b->count, b->layout, b->stride, b->out);
}
static void run_accumulate(const bench_batch *b) {
    lmp_sphere_accumulate_n(b->bands, &b->spheres, LIGHTS, b->points, b->count, b->layout,
                            b->stride, b->out);
}
static void run_gradient(const bench_batch *b) {
    const size_t n = LMP_SH_COUNT(b->bands);
    float *slopes = b->out + 3 * n * (b->layout == LMP_SH_PLANAR ? b->stride : b->count);
    const size_t stride = b->layout == LMP_SH_PLANAR ? b->stride : 0;
    lmp_sphere_accumulate_gradient_n(b->bands, &b->spheres, LIGHTS, b->points, b->count, b->layout,
                                     stride, b->out, stride, slopes);
}
static void run_lobe(const bench_batch *b) {
    lmp_lobe_response_n(b->bands, b->lambda, b->axes, &b->spheres, LIGHTS, b->points, b->count,
                        b->layout, b->stride, b->out);
}

static void run_shade_zonal(const bench_batch *b) {
    const lmp_shade_settings settings = { .bands = b->bands };
    lmp_shade_n(&settings, &b->surfaces, b->count, b->lights, LIGHTS, 0, b->out);
}
static void run_shade_preintegrated(const bench_batch *b) {
    const lmp_shade_settings settings = { .method = LMP_SHADE_PREINTEGRATED, .lobe = b->response };
    lmp_shade_n(&settings, &b->surfaces, b->count, b->lights, LIGHTS, 0, b->out);
}

/* --- the paper, one by one ---------------------------------------------------------------------
 */

static float coefficient_sink[12 * LMP_SH_COUNT(LMP_BANDS_MAX)];

static lmp_vec3 vector_at(const lmp_vec3_array *array, size_t i) {
    const size_t step = i * array->stride / sizeof(float);
    return (lmp_vec3) { array->x[step], array->y[step], array->z[step] };
}

/* Eq. 12 as printed, then Eq. 13, at a point moved by `shift` along x, y or z. */
static void paper_light(const bench_batch *b, size_t sphere, lmp_vec3 at, float *sh) {
    const lmp_vec3 center = vector_at(&b->spheres.center, sphere);
    const lmp_vec3 v = { center.x - at.x, center.y - at.y, center.z - at.z };
    const float d = sqrtf(v.x * v.x + v.y * v.y + v.z * v.z),
                sine = b->spheres.radius.at[sphere] / d;
    float zonal[LMP_BANDS_MAX];
    lmp_zonal_printed(b->bands, sqrtf(1 - sine * sine), zonal);
    lmp_sh_from_zonal(b->bands, zonal, (lmp_vec3) { v.x / d, v.y / d, v.z / d }, sh);
}
static void paper_basis(const bench_batch *b, size_t i) {
    lmp_sh_eval(b->bands, vector_at(&b->axes, i), coefficient_sink);
}
static void paper_dot(const bench_batch *b, size_t i) {
    const float *vector = b->vectors + i * LMP_SH_COUNT(b->bands);
    coefficient_sink[0] = lmp_sh_dot(b->bands, vector, vector);
}
static void paper_rotate(const bench_batch *b, size_t i) {
    lmp_sh_rotate(b->bands, b->matrices, b->vectors + i * LMP_SH_COUNT(b->bands), coefficient_sink);
}
static void paper_zonal(const bench_batch *b, size_t i) {
    const float sine = b->spheres.radius.at[i] / b->distances[i];
    lmp_zonal_printed(b->bands, sqrtf(1 - sine * sine), coefficient_sink);
}
static void paper_project(const bench_batch *b, size_t i) {
    paper_light(b, i, vector_at(&b->points, i), coefficient_sink);
}
static void paper_sum(const bench_batch *b, size_t point, lmp_vec3 shift, float *sum) {
    const size_t n = LMP_SH_COUNT(b->bands);
    lmp_vec3 at = vector_at(&b->points, point);
    at = (lmp_vec3) { at.x + shift.x, at.y + shift.y, at.z + shift.z };
    memset(sum, 0, 3 * n * sizeof *sum);
    for (size_t light = 0; light < LIGHTS; light++) {
        static float sh[LMP_SH_COUNT(LMP_BANDS_MAX)];
        const lmp_vec3 rgb = vector_at(&b->spheres.radiance, light);
        paper_light(b, light, at, sh);
        for (size_t i = 0; i < n; i++) {
            sum[i] += rgb.x * sh[i];
            sum[n + i] += rgb.y * sh[i];
            sum[2 * n + i] += rgb.z * sh[i];
        }
    }
}
static void paper_accumulate(const bench_batch *b, size_t i) {
    paper_sum(b, i, (lmp_vec3) { 0, 0, 0 }, coefficient_sink);
}
/* The paper has no gradient: one-sided differences. */
static void paper_gradient(const bench_batch *b, size_t i) {
    const size_t n = 3 * LMP_SH_COUNT(b->bands);
    const float h = 0.001f;
    paper_sum(b, i, (lmp_vec3) { 0, 0, 0 }, coefficient_sink);
    for (size_t axis = 0; axis < 3; axis++) {
        float *slope = coefficient_sink + (1 + axis) * n;
        paper_sum(b, i, (lmp_vec3) { axis == 0 ? h : 0, axis == 1 ? h : 0, axis == 2 ? h : 0 },
                  slope);
        for (size_t v = 0; v < n; v++)
            slope[v] = (slope[v] - coefficient_sink[v]) / h;
    }
}
static void paper_lobe(const bench_batch *b, size_t i) {
    static float lobe[LMP_SH_COUNT(LMP_BANDS_MAX)];
    const size_t n = LMP_SH_COUNT(b->bands);
    paper_sum(b, i, (lmp_vec3) { 0, 0, 0 }, coefficient_sink);
    lmp_lobe_project(b->bands, b->lambda, vector_at(&b->axes, i), lobe);
    for (size_t c = 0; c < 3; c++)
        coefficient_sink[c] = lmp_sh_dot(b->bands, coefficient_sink + c * n, lobe);
}

/* Both lobes, or the one of a table. */
static void paper_shade(const bench_batch *b, size_t i) {
    static float lobe[LMP_SH_COUNT(LMP_BANDS_MAX)];
    const size_t n = LMP_SH_COUNT(b->bands);
    const lmp_vec3_array around[2] = { b->surfaces.normal, b->axes };
    float rgb[3] = { 0, 0, 0 };
    paper_sum(b, i, (lmp_vec3) { 0, 0, 0 }, coefficient_sink);
    for (int k = b->surfaces.material->kind == LMP_MATERIAL_TABLE ? 1 : 0; k < 2; k++) {
        lmp_lobe_project(b->bands, b->lambda, vector_at(&around[k], i), lobe);
        for (size_t c = 0; c < 3; c++)
            rgb[c] += lmp_sh_dot(b->bands, coefficient_sink + c * n, lobe);
    }
    memcpy(coefficient_sink, rgb, sizeof rgb);
}

/* --- operations: what src/kernels asks for, no FMA
 * ------------------------------------------------ */

static size_t values_basis(int n) {
    return LMP_SH_COUNT(n);
}
static size_t values_zonal(int n) {
    return (size_t)n;
}
static size_t values_rgb(int n) {
    return 3 * LMP_SH_COUNT(n);
}
static size_t values_gradient(int n) {
    return 12 * LMP_SH_COUNT(n);
}
static size_t values_lobe(int n) {
    (void)n;
    return 3;
}

/* Past the second band; entries (l, m) with m >= 0, and steps of their recurrences. */
static double later(int n) {
    return n > 2 ? n - 2 : 0;
}
static double entries(int n) {
    return n * (n + 1) / 2.0;
}
static double steps(int n) {
    return n * (n - 1) / 2.0;
}
static double slots_basis(int n) {
    /* A column: 2 for its first step, 4 for the next; times C_m and S_m; C_m and S_m: 6. */
    return 2 * (n - 1) + 4 * (steps(n) - (n - 1)) + 2 * steps(n) + 6 * later(n);
}
static double slots_dot(int n) {
    return 2.0 * n * n + 15;
}
static double slots_rotate(int n) {
    double slots = 0;
    for (int side = 1; side < 2 * n; side += 2)
        slots += side * (2.0 * side - 1);
    return slots;
}
static double slots_zonal(int n) {
    return 14 + 5 * later(n) + n;
}
static double slots_project(int n) {
    return 24 + 5 * later(n) + slots_basis(n) + entries(n);
}
static double slots_accumulate(int n) {
    return 24 + 11 * later(n) + 6 * n + entries(n) + 6 * n + 12 * steps(n) + 3 * steps(n) +
           3.0 * n * n / LIGHTS;
}
static double slots_gradient(int n) {
    return 29 + 16 * later(n) + 5 + 8 * n + 4 * steps(n) + 11 * entries(n) + 32 * n + 64 * steps(n);
}
static double slots_lobe(int n) {
    return 19 + 6 + 2 + (n > 1 ? 3 : 0) + 11 * later(n) + 7;
}

/* A cap seen from two axes, and three channels of two lobes. */
enum { SLOTS_CAP = 17, SLOTS_AIM = 12, SLOTS_GATHER = 12 };
static double slots_shade_zonal(int n) {
    /* The cap's R_l, the mirror direction's P_l and their sum; every other band the normal's. */
    const double band = n <= 48 ? 9 + 3.5 : 12 + 4;
    return SLOTS_CAP + SLOTS_AIM + SLOTS_GATHER + 8 + band * later(n);
}
/* Floats alone: the products of 16-bit coefficients with their weights are integers. */
static double slots_shade_response(int n) {
    (void)n;
    /* Three angles; two readings: coordinates, two splines' weights, rounded, four rows. */
    return SLOTS_CAP + SLOTS_AIM + SLOTS_GATHER + 17 + 2 * 21 + 2 * (4 + 30 + 19 + 9) + 10;
}
static double slots_shade_measured(int n) {
    (void)n;
    /* Three cosines and three angles; the row's coordinate, the cap's share; four slices: splines'
     * weights and the sums of 12 numbers; those times the radiance. */
    return SLOTS_CAP + 18 + 66 + 50 + 5 + 4 * (59 + 24) + 24;
}

static const bench_kernel kernels[] = {
    { "project", values_basis, slots_project, run_project, paper_project, 1, false, TABLE_NONE },
    { "accumulate", values_rgb, slots_accumulate, run_accumulate, paper_accumulate, LIGHTS, false,
      TABLE_NONE },
    { "gradient", values_gradient, slots_gradient, run_gradient, paper_gradient, LIGHTS, false,
      TABLE_NONE },
    { "lobe", values_lobe, slots_lobe, run_lobe, paper_lobe, LIGHTS, false, TABLE_NONE },
    { "zonal", values_zonal, slots_zonal, run_zonal, paper_zonal, 1, false, TABLE_NONE },
    { "basis", values_basis, slots_basis, run_basis, paper_basis, 1, false, TABLE_NONE },
    { "rotate", values_basis, slots_rotate, run_rotate, paper_rotate, 1, false, TABLE_NONE },
    { "dot", values_basis, slots_dot, run_dot, paper_dot, 1, false, TABLE_NONE },
    { "shade-zonal", values_lobe, slots_shade_zonal, run_shade_zonal, paper_shade, LIGHTS, true,
      TABLE_NONE },
    { "shade-response", values_lobe, slots_shade_response, run_shade_preintegrated, paper_shade,
      LIGHTS, true, TABLE_LOBES },
    { "shade-measured", values_lobe, slots_shade_measured, run_shade_preintegrated, paper_shade,
      LIGHTS, true, TABLE_MEASURED },
};
enum { KERNELS = sizeof kernels / sizeof *kernels };
static const char *const kernel_choices[] = {
    "all",    "project", "accumulate",  "gradient",       "lobe",           "zonal", "basis",
    "rotate", "dot",     "shade-zonal", "shade-response", "shade-measured", NULL
};
_Static_assert(sizeof kernel_choices / sizeof *kernel_choices == KERNELS + 2, "all, kernels, NULL");

static bool wanted(const bench_options *o, int kernel) {
    return o->kernel == 0 || o->kernel == kernel + 1;
}

/* --- measuring ---------------------------------------------------------------------------------
 */

static double now(void) {
    return 1e9 * timing_now();
}

/* ns a slot: independent multiply-adds on the units that also multiply, add, divide and take roots
 * (multiplications where the instruction set has no FMA). Enough chains for two units of 5 cycles,
 * and turns for the clock's own 30 ns not to count. */
enum { PEAK_CHAINS = 12, PEAK_TURNS = 3400 };
#if defined(__x86_64__)
#define PEAK_STEP(a, step)                                                                         \
    (a) = step(a, one, one);                                                                       \
    __asm__ volatile("" : "+x"(a));
#define PEAK_LOOP(type, step)                                                                      \
    type a = one, b = one, c = one, d = one, e = one, f = one;                                     \
    type g = one, h = one, i = one, j = one, k = one, l = one;                                     \
    const double from = now();                                                                     \
    for (int r = 0; r < PEAK_TURNS; r++) {                                                         \
        PEAK_STEP(a, step)                                                                         \
        PEAK_STEP(b, step)                                                                         \
        PEAK_STEP(c, step)                                                                         \
        PEAK_STEP(d, step)                                                                         \
        PEAK_STEP(e, step)                                                                         \
        PEAK_STEP(f, step)                                                                         \
        PEAK_STEP(g, step)                                                                         \
        PEAK_STEP(h, step)                                                                         \
        PEAK_STEP(i, step)                                                                         \
        PEAK_STEP(j, step)                                                                         \
        PEAK_STEP(k, step)                                                                         \
        PEAK_STEP(l, step)                                                                         \
    }                                                                                              \
    return (now() - from) / ((double)PEAK_CHAINS * PEAK_TURNS);
#define PEAK_MULTIPLY(a, b, c) _mm_mul_ps(a, b)
__attribute__((target("avx512f"))) static double peak_avx512(void) {
    const __m512 one = _mm512_set1_ps(1);
    PEAK_LOOP(__m512, _mm512_fmadd_ps)
}
__attribute__((target("avx2,fma"))) static double peak_avx2(void) {
    const __m256 one = _mm256_set1_ps(1);
    PEAK_LOOP(__m256, _mm256_fmadd_ps)
}
static double peak_sse2(void) {
    const __m128 one = _mm_set1_ps(1);
    PEAK_LOOP(__m128, PEAK_MULTIPLY)
}
static double bench_peak(unsigned flag) {
    return flag == LMP_CPU_AVX512 ? peak_avx512()
           : flag == LMP_CPU_AVX2 ? peak_avx2()
                                  : peak_sse2();
}
#else
typedef float peak_lanes __attribute__((vector_size(16)));
static double bench_peak(unsigned flag) {
    (void)flag;
    peak_lanes a[PEAK_CHAINS];
    const double from = now();
    for (int i = 0; i < PEAK_CHAINS; i++)
        a[i] = (peak_lanes) { 1, 1, 1, 1 };
    for (int r = 0; r < PEAK_TURNS; r++)
        for (int i = 0; i < PEAK_CHAINS; i++) {
            a[i] = a[i] * 0.5f;
            __asm__ volatile("" : "+w"(a[i]));
        }
    return (now() - from) / ((double)PEAK_CHAINS * PEAK_TURNS);
}
#endif

static double time_calls(const bench_kernel *kernel, const bench_batch *b, int calls) {
    const double start = now();
    for (int i = 0; i < calls; i++)
        kernel->run(b);
    return (now() - start) / calls;
}

/* Calls that take about 40 µs, so that a run is short enough to fall between interruptions. */
static int calls_of(const bench_kernel *kernel, const bench_batch *b) {
    kernel->run(b);
    const double one = time_calls(kernel, b, 1);
    return one > 40000 ? 1 : (int)(40000 / (one + 1)) + 1;
}

/* ns a pair; the peak is measured between the runs, for other loads come and go. */
static measurement measure(const bench_kernel *kernel, const bench_batch *b, unsigned flag,
                           int runs) {
    static double ns[RUNS_MAX], fraction[RUNS_MAX];
    const double pairs = (double)b->count * kernel->lights;
    const double lanes = flag == LMP_CPU_AVX512   ? 16
                         : flag == LMP_CPU_AVX2   ? 8
                         : flag == LMP_CPU_VECTOR ? 4
                                                  : 1;
    const int calls = calls_of(kernel, b);
    for (int i = 0; i < runs; i++) {
        const double before = bench_peak(flag);
        ns[i] = time_calls(kernel, b, calls) / pairs;
        const double after = bench_peak(flag), peak = before < after ? before : after;
        fraction[i] = kernel->slots(b->bands) / lanes / ns[i] * peak;
    }
    measurement m = { .ns = timing_of(ns, runs) };
    m.peak_fraction = timing_of(fraction, runs).median;
    return m;
}

static double measure_paper(const bench_kernel *kernel, const bench_batch *b, int runs) {
    static double ns[RUNS_MAX];
    for (int i = 0; i < runs; i++) {
        const double start = now();
        for (size_t e = 0; e < 16; e++)
            kernel->paper(b, e);
        ns[i] = (now() - start) / 16 / kernel->lights;
    }
    return timing_of(ns, runs).median;
}

/* --- inputs ------------------------------------------------------------------------------------
 */

typedef struct bench_inputs {
    float center[3][ELEMENTS_MAX], point[3][ELEMENTS_MAX], axis[3][ELEMENTS_MAX];
    float radiance[3][ELEMENTS_MAX], radius[ELEMENTS_MAX], distance[ELEMENTS_MAX];
    float normal[3][ELEMENTS_MAX];
    lmp_material material[ELEMENTS_MAX], tabulated;
    float lambda[LMP_BANDS_MAX];
    float *out, *vectors, *matrices;
    lmp_light lights[LIGHTS];
    /* What the kernels that read a table read now. */
    lmp_preintegrated_lobe *lobes;
    lmp_brdf_table *table;
    lmp_preintegrated_brdf *measured;
} bench_inputs;

static float uniform(uint32_t *state) {
    *state = *state * 1664525u + 1013904223u;
    return (float)(*state >> 8) / 16777216.0f;
}

static bool inputs_create(bench_inputs *in) {
    const size_t values = 12 * (size_t)OUTPUT_FLOATS + 16 * 12 * LMP_SH_COUNT(LMP_BANDS_MAX) * 4;
    uint32_t state = 1;
    for (int i = 0; i < ELEMENTS_MAX; i++) {
        float length = 0;
        for (int k = 0; k < 3; k++) {
            in->point[k][i] = uniform(&state);
            in->center[k][i] = 2 + 3 * uniform(&state);
            in->axis[k][i] = 2 * uniform(&state) - 1;
            in->radiance[k][i] = 1 + uniform(&state);
            length += in->axis[k][i] * in->axis[k][i];
        }
        for (int k = 0; k < 3; k++)
            in->axis[k][i] /= sqrtf(length);
        in->radius[i] = 0.05f + 0.5f * uniform(&state);
        in->distance[i] = 1 + 3 * uniform(&state);
    }
    for (int i = 0; i < ELEMENTS_MAX; i++) {
        /* Both axes on the lights' side, where a surface sees most of them. */
        const float x = uniform(&state), y = uniform(&state), z = 0.1f + uniform(&state);
        const float length = sqrtf(x * x + y * y + z * z);
        in->normal[0][i] = x / length;
        in->normal[1][i] = y / length;
        in->normal[2][i] = z / length;
        const lmp_rgb color = { in->radiance[0][i], in->radiance[1][i], in->radiance[2][i] };
        in->material[i] = (lmp_material) { .diffuse = color, .specular = color, .exponent = 20 };
    }
    for (int i = 0; i < LIGHTS; i++)
        in->lights[i] =
            (lmp_light) { .position = { in->center[0][i], in->center[1][i], in->center[2][i] },
                          .radius = in->radius[i],
                          .radiance = { in->radiance[0][i], in->radiance[1][i],
                                        in->radiance[2][i] } };
    lmp_lobe_phong(LMP_BANDS_MAX, 20, in->lambda);
    in->out = aligned_alloc(64, values * sizeof(float));
    in->vectors = aligned_alloc(64, values * sizeof(float));
    in->matrices = malloc(LMP_SH_ROTATION_COUNT(LMP_BANDS_MAX) * sizeof(float));
    if (!in->out || !in->vectors || !in->matrices)
        return false;
    for (size_t i = 0; i < values; i++) {
        in->out[i] = 0;
        in->vectors[i] = uniform(&state);
    }
    lmp_sh_rotation(LMP_BANDS_MAX, (lmp_quat) { 0.5f, 0.5f, -0.5f, 0.5f }, in->matrices);
    return true;
}

static lmp_vec3_array planes_of(float (*planes)[ELEMENTS_MAX]) {
    return (lmp_vec3_array) { planes[0], planes[1], planes[2], sizeof(float) };
}

/* As many elements as keep the output in the first cache: a multiple of 48 lanes or of 16. */
static bench_batch batch_of(bench_inputs *in, const bench_kernel *kernel, int bands,
                            lmp_sh_layout layout) {
    const size_t values = kernel->values(bands), fit = OUTPUT_FLOATS / values;
    bench_batch b = { .bands = bands, .layout = layout };
    b.count = fit >= ELEMENTS_MAX ? ELEMENTS_MAX : fit >= 48 ? fit / 48 * 48 : fit >= 32 ? 32 : 16;
    /* An odd number of cache lines, for planes whose distance is a power of two collide. */
    b.stride =
        layout == LMP_SH_PLANAR ? (b.count / 16 | 1) * 16 + (b.count / 16 % 2 ? 32 : 0) : values;
    b.axes = planes_of(in->axis);
    b.points = planes_of(in->point);
    b.spheres = (lmp_spheres) { planes_of(in->center),
                                { in->radius, sizeof(float) },
                                planes_of(in->radiance) };
    b.distances = in->distance;
    b.lambda = in->lambda;
    b.matrices = in->matrices;
    b.vectors = in->vectors;
    b.out = in->out;
    b.lights = in->lights;
    b.response = in->lobes;
    b.surfaces = (lmp_surfaces) { .position = b.points,
                                  .normal = planes_of(in->normal),
                                  .view = b.axes,
                                  .material = in->material,
                                  .material_stride = sizeof *in->material };
    if (kernel->table == TABLE_MEASURED) {
        in->tabulated = (lmp_material) { .kind = LMP_MATERIAL_TABLE,
                                         .table = in->table,
                                         .preintegrated = in->measured };
        b.surfaces.material = &in->tabulated;
        b.surfaces.material_stride = 0;
    }
    return b;
}

/* --- tables ------------------------------------------------------------------------------------
 */

static void tables_free(bench_inputs *in) {
    lmp_preintegrated_lobe_destroy(in->lobes);
    lmp_preintegrated_brdf_destroy(in->measured);
    lmp_brdf_table_destroy(in->table);
    in->lobes = NULL;
    in->measured = NULL;
    in->table = NULL;
}

static bool measured_create(int bands, bench_inputs *in) {
    const lmp_brdf_table_desc desc = { .bands = bands };
    lmp_sgd sgd;
    lmp_brdf *brdf;
    if (lmp_sgd_find("gold-metallic-paint", &sgd) != LMP_OK ||
        lmp_brdf_create_sgd(NULL, &sgd, &brdf) != LMP_OK)
        return false;
    const bool made = lmp_brdf_table_create(NULL, brdf, &desc, &in->table) == LMP_OK &&
                      lmp_preintegrated_brdf_create(NULL, in->table, NULL, &in->measured) == LMP_OK;
    lmp_brdf_destroy(brdf);
    return made;
}

static bool tables_create(bench_table table, int bands, bench_inputs *in) {
    const lmp_preintegrated_lobe_desc desc = { .bands = bands };
    return table == TABLE_NONE ||
           (lmp_preintegrated_lobe_create(NULL, &desc, &in->lobes) == LMP_OK &&
            (table == TABLE_LOBES || measured_create(bands, in)));
}

/* --- results -----------------------------------------------------------------------------------
 */

static void print_row(const bench_options *o, bool first, const bench_kernel *kernel, int bands,
                      lmp_sh_layout layout, const measurement *m) {
    const char *name = layout == LMP_SH_PLANAR ? "planar" : "rows";
    char vs_scalar[32] = "-";
    if (m->vs_scalar > 0)
        snprintf(vs_scalar, sizeof vs_scalar, "%.3g", m->vs_scalar);
    else if (o->json)
        strcpy(vs_scalar, "null");
    if (o->json)
        printf("%s    {\"kernel\": \"%s\", \"bands\": %d, \"isa\": \"%s\", \"layout\": \"%s\", "
               "\"ns\": %.4g, \"ns_quartiles\": [%.4g, %.4g], \"peak_fraction\": %.3f, "
               "\"vs_paper\": %.3g, \"vs_scalar\": %s}",
               first ? "" : ",\n", kernel->name, bands, m->isa, name, m->ns.median, m->ns.lower,
               m->ns.upper, m->peak_fraction, m->vs_paper, vs_scalar);
    else
        printf("%-14s %5d  %-7s %-6s %10.4g  %9.4g … %-9.4g %5.2f %9.3g %9s\n", kernel->name, bands,
               m->isa, name, m->ns.median, m->ns.lower, m->ns.upper, m->peak_fraction, m->vs_paper,
               vs_scalar);
    fflush(stdout);
}

/* The rows of one kernel at one number of bands, of one layout. */
static void measure_rows(const bench_options *o, bench_inputs *in, const bench_kernel *kernel,
                         int bands, lmp_sh_layout layout, bool *first) {
    const int runs = o->full ? 301 : 31;
    const bench_batch b = batch_of(in, kernel, bands, layout);
    const double paper = measure_paper(kernel, &b, o->full ? 31 : 5);
    double scalar = 0;
    for (unsigned flag = LMP_CPU_SCALAR; flag <= LMP_CPU_AVX512; flag *= 2) {
        if (!(flag & (unsigned)o->mask & lmp_cpu_flags()))
            continue;
        lmp_cpu_mask(flag);
        measurement m = measure(kernel, &b, flag, flag == LMP_CPU_SCALAR && !o->full ? 7 : runs);
        m.isa = lmp_cpu_name();
        m.vs_paper = paper / m.ns.median;
        scalar = flag == LMP_CPU_SCALAR ? m.ns.median : scalar;
        m.vs_scalar = scalar / m.ns.median;
        print_row(o, *first, kernel, bands, layout, &m);
        *first = false;
    }
}

static bool measure_kernels(const bench_options *o, bench_inputs *in) {
    const int *bands = o->bands ? &o->bands : bands_measured;
    bool first = true, ok = true;
    for (int k = 0; k < KERNELS; k++)
        for (int n = 0; wanted(o, k) && n < (o->bands ? 1 : BANDS_MEASURED); n++) {
            const bench_kernel *kernel = &kernels[k];
            if (kernel->table != TABLE_NONE && !o->bands && bands[n] != TABLE_BANDS)
                continue;
            ok = ok && tables_create(kernel->table, bands[n], in);
            for (int layout = kernel->shades ? LMP_SH_INTERLEAVED : LMP_SH_PLANAR;
                 ok && layout >= LMP_SH_INTERLEAVED; layout--)
                measure_rows(o, in, kernel, bands[n], (lmp_sh_layout)layout, &first);
            tables_free(in);
        }
    return ok;
}

/* Points split among threads, each with an output of its own, on the best kernels of the mask. */
static bool measure_threads(const bench_options *o, bench_inputs *in) {
    const int most = o->threads ? o->threads : omp_get_max_threads();
    const size_t room = 64 * 1200; /* of the widest batch here, padded */
    float *outputs = aligned_alloc(64, (size_t)most * room * sizeof *outputs);
    if (!outputs)
        return false;
    memset(outputs, 0, (size_t)most * room * sizeof *outputs);
    lmp_cpu_mask((unsigned)o->mask);
    bool first = true;
    for (int k = 0; k < 4 && (!o->bands || o->bands == 10); k++) {
        double alone = 0;
        for (int threads = 1; wanted(o, k) && threads <= most; threads++) {
            static double ns[RUNS_MAX];
            bench_batch b = batch_of(in, &kernels[k], 10, LMP_SH_PLANAR);
            const int runs = 31, calls = 50 * calls_of(&kernels[k], &b);
            for (int r = 0; r < runs; r++) {
                const double start = now();
#pragma omp parallel for num_threads(threads) schedule(static) firstprivate(b)
                for (int i = 0; i < calls; i++) {
                    b.out = outputs + (size_t)omp_get_thread_num() * room;
                    kernels[k].run(&b);
                }
                ns[r] = (now() - start) / ((double)calls * (double)b.count * kernels[k].lights);
            }
            const double median = timing_of(ns, runs).median;
            alone = threads == 1 ? median : alone;
            if (o->json)
                printf(
                    "%s    {\"kernel\": \"%s\", \"bands\": 10, \"isa\": \"%s\", \"threads\": %d, "
                    "\"ns\": %.4g, \"speedup\": %.3g}",
                    first ? "" : ",\n", kernels[k].name, lmp_cpu_name(), threads, median,
                    alone / median);
            else
                printf("%-14s    10  %-7s %2d threads %10.4g ns  x %.2f\n", kernels[k].name,
                       lmp_cpu_name(), threads, median, alone / median);
            first = false;
        }
    }
    free(outputs);
    return true;
}

/* --- the command -------------------------------------------------------------------------------
 */

static void print_header(const bench_options *o) {
    char name[160];
    timing_cpu_name(name, sizeof name);
    if (o->json) {
        printf("{\n  \"cpu\": \"%s\",\n  \"compiler\": \"%s\",\n  \"flags\": \"%s\",\n"
               "  \"commit\": \"%s\",\n  \"rows\": [\n",
               name, __VERSION__, LAMPION_BUILD_FLAGS, LAMPION_COMMIT);
        return;
    }
    printf("%s; compiler %s; %s; commit %s\n", name, __VERSION__, LAMPION_BUILD_FLAGS,
           LAMPION_COMMIT);
    printf("ns a light-point pair (%d lights a point where lights are summed): median, quartiles; "
           "share of the\nFMA peak measured between the runs (mul, add, div, sqrt: one slot each); "
           "times the speed of the paper's\nEq. 12 and 13 one by one, and of the scalar build\n",
           LIGHTS);
    printf("%-14s %5s  %-7s %-6s %10s  %-21s %5s %9s %9s\n", "kernel", "bands", "isa", "layout",
           "ns", "quartiles", "peak", "x paper", "x scalar");
}

static int bench_cpu(const bench_options *o) {
    static bench_inputs in;
    cli_error error = { "" };
    bool done = inputs_create(&in);
    if (done) {
        print_header(o);
        done = measure_kernels(o, &in);
        if (o->json)
            printf("\n  ],\n  \"threads\": [\n");
        done = done && measure_threads(o, &in);
        if (o->json)
            printf("\n  ]\n}\n");
    }
    free(in.out);
    free(in.vectors);
    free(in.matrices);
    if (!done) {
        cli_fail(&error, NULL, "out of memory");
        return cli_report(&error);
    }
    return CLI_OK;
}

static int run(const cli_command *command, int argc, char **argv) {
    bench_options o = { .mask = LMP_CPU_ALL };
    bool size_given;
    const cli_option options[] = {
        { .name = "json", .kind = CLI_FLAG, .target = &o.json, .help = "print JSON" },
        { .name = "full",
          .kind = CLI_FLAG,
          .target = &o.full,
          .help =
              "cpu: ten times the runs; gpu: every combination of the scenes, sizes, lights and "
              "bands that no option fixes" },
        cli_cpu_mask(&o.mask),
        { .name = "threads",
          .kind = CLI_INT,
          .target = &o.threads,
          .argument = "N",
          .help = "cpu: most threads of the scaling rows; 0 = every processor",
          .minimum = 0,
          .maximum = 1024 },
        { .name = "kernel",
          .kind = CLI_CHOICE,
          .target = &o.kernel,
          .argument = "KERNEL",
          .help = "cpu: the rows of one kernel",
          .choices = kernel_choices },
        { .name = "bands",
          .kind = CLI_INT,
          .target = &o.bands,
          .argument = "N",
          .help = "the rows of so many bands alone; 0: of several",
          .minimum = 0,
          .maximum = LMP_BANDS_MAX },
        { .name = "device",
          .kind = CLI_CHOICE,
          .target = &o.device,
          .argument = "DEVICE",
          .help = "gpu: the rows of one device",
          .choices = bench_devices() },
        { .name = "method",
          .kind = CLI_CHOICE,
          .target = &o.method,
          .argument = "METHOD",
          .help = "gpu: the rows of one method; paper is the paper's fragment shader",
          .choices = bench_methods() },
        { .name = "scene",
          .kind = CLI_TEXT,
          .target = &o.scene,
          .argument = "SCENE",
          .help = "gpu: the rows of one scene; without it builtin:atrium" },
        { .name = "lights",
          .kind = CLI_INT,
          .target = &o.lights,
          .argument = "N",
          .help = "gpu: the rows of so many lights alone; 0: of several",
          .minimum = 0,
          .maximum = SCENE_LIGHTS_MAX },
        { .name = "size",
          .kind = CLI_SIZE,
          .target = o.size,
          .argument = "WxH",
          .help = "gpu: pixels of the rows; without it 1980x995",
          .minimum = 1,
          .maximum = GPU_SIZE_MAX,
          .given = &size_given },
        { .name = "time",
          .kind = CLI_INT,
          .target = &o.seconds,
          .argument = "SECONDS",
          .help = "gpu: how long the rows may take, the most telling first; 0: 180, or with --full "
                  "as long as they take",
          .minimum = 0,
          .maximum = 86400 },
        OVERRIDE_OPTION_ROW(o.materials),
        { .name = "gl-device",
          .kind = CLI_TEXT,
          .target = &o.gl_device,
          .argument = "DEVICE",
          .help = "gpu: a number, part of a name, or software" },
        { .name = NULL },
    };
    int count, status;
    char **operands;
    if (!cli_parse(command, options, argc, argv, &count, &operands, &status))
        return status;
    if (count == 1 && strcmp(operands[0], "gpu") == 0) {
        lmp_cpu_mask((unsigned)o.mask);
        return bench_gpu(command, &o);
    }
    if (count != 1)
        return cli_usage(command, "what to measure: %s", command->operands);
    if (strcmp(operands[0], "cpu") != 0)
        return cli_usage_operand(command, operands[0]);
    return bench_cpu(&o);
}

const cli_command command_bench = {
    .name = "bench",
    .operands = "cpu|gpu",
    .summary = "measure the batch kernels on every instruction set, or the shaders",
    .examples = "lampion bench cpu\n"
                "lampion bench cpu --cpu-mask 4 --json > avx2.json\n"
                "lampion bench cpu --kernel accumulate --bands 6\n"
                "lampion bench gpu --json > gpu.json\n"
                "lampion bench gpu --scene builtin:ball --bands 8 --size 3400x900\n"
                "lampion bench gpu --full --size 600x816 --method preintegrated\n"
                "lampion bench gpu --scene builtin:ball --material test_material=sgd:nickel\n",
    .run = run,
};
