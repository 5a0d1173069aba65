/* SPDX-License-Identifier: MIT */
/* lampion bench cpu - what the batch kernels cost (docs/benchmarks.md). */
#include "app/base/timing.h"
#include "app/study/bench.h"
#include "app/study/bench_inputs.h"
#include "app/study/bench_peak.h"

#include <lampion/cpu.h>

#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const int bands_timed[] = { 3, 5, 6, 8, 10, 20, 50, 128 };
enum { BANDS_TIMED = sizeof bands_timed / sizeof *bands_timed, RUNS_MAX = 401, LARGE_BANDS = 10 };

/* The compiler of the kernels; gcc's version string does not name gcc. */
#ifdef __clang__
#define COMPILER __VERSION__
#else
#define COMPILER "gcc " __VERSION__
#endif

typedef struct measurement {
    const char *isa;
    timing_quartiles ns;            /* per light-point pair */
    double peak_fraction, vs_paper; /* vs_paper is 0 if the paper has no formula */
    double stores;    /* ns per pair, of storing as much by the faster kind of store */
    size_t output;    /* bytes written per call */
    double vs_scalar; /* 0 if scalar was not measured */
} measurement;

const char *const *bench_kernel_names(void) {
    static const char *names[BENCH_ROWS + 2] = { "all" };
    for (int row = 0; row < BENCH_ROWS; row++)
        names[1 + row] = bench_row(row)->name;
    return names;
}

static bool wanted(const bench_options *o, int kernel) {
    return o->kernel == 0 || o->kernel == kernel + 1;
}

/* --- measuring -------------------------------------------------------------------------------- */

static double now_ns(void) {
    return 1e9 * timing_now();
}

static double time_calls(const bench_kernel *kernel, const bench_batch *b, int calls) {
    const double start = now_ns();
    for (int i = 0; i < calls; i++)
        kernel->run(b);
    return (now_ns() - start) / calls;
}

/* Returns a number of calls that takes about 40 µs, so that a run is short enough to fall between
 * interruptions. */
static int calls_of(const bench_kernel *kernel, const bench_batch *b) {
    kernel->run(b);
    const double one = time_calls(kernel, b, 1);
    return one > 40000 ? 1 : (int)(40000 / (one + 1)) + 1;
}

/* Sizes of today's caches, smallest and largest; the cores of a server share the last one. */
enum { FIRST_CACHE = 48 << 10, SECOND_CACHE = 1 << 20, LAST_CACHE = 32 << 20 };

static const char *working_set(size_t bytes) {
    return bytes <= FIRST_CACHE    ? "L1"
           : bytes <= SECOND_CACHE ? "L2"
           : bytes <= LAST_CACHE   ? "L3"
                                   : "memory";
}

/* Returns the time of the faster kind of stores. Stores past the caches are tried only for larger
 * outputs: they would leave nothing in the caches for the kernel. */
static double fastest_stores(unsigned flag, float *to, size_t count) {
    const double plain = bench_stores(flag, to, count);
    if (count * sizeof(float) <= LAST_CACHE)
        return plain;
    const double streamed = bench_streams(flag, to, count);
    return plain < streamed ? plain : streamed;
}

/* Measures ns per pair. The peak is measured between the runs, because other load comes and
 * goes. */
static measurement measure(const bench_kernel *kernel, const bench_batch *b, unsigned flag,
                           int runs) {
    static double ns[RUNS_MAX], fraction[RUNS_MAX], stores[RUNS_MAX];
    const size_t written = b->count * kernel->values(b->bands);
    const double pairs = (double)b->count * kernel->lights;
    const double lanes = kernel->call             ? 1
                         : flag == LMP_CPU_AVX512 ? 16
                         : flag == LMP_CPU_AVX2   ? 8
                         : flag == LMP_CPU_VECTOR ? 4
                                                  : 1;
    const int calls = calls_of(kernel, b);
    for (int i = 0; i < runs; i++) {
        const double before = bench_peak(flag);
        stores[i] = fastest_stores(flag, b->out, written) / pairs;
        ns[i] = time_calls(kernel, b, calls) / pairs;
        const double after = bench_peak(flag), peak = before < after ? before : after;
        fraction[i] = kernel->slots(b->bands) / lanes / ns[i] * peak;
    }
    measurement m = { .ns = timing_of(ns, runs) };
    m.peak_fraction = timing_of(fraction, runs).median;
    m.stores = timing_of(stores, runs).lower;
    m.output = written * sizeof(float);
    return m;
}

static double measure_paper(const bench_kernel *kernel, const bench_batch *b, int runs) {
    static double ns[RUNS_MAX];
    for (int i = 0; i < runs; i++) {
        const double start = now_ns();
        for (size_t e = 0; e < 16; e++)
            kernel->paper(b, e);
        ns[i] = (now_ns() - start) / 16 / kernel->lights;
    }
    return timing_of(ns, runs).median;
}

/* Prints a ratio, or what stands for none. */
static void print_ratio(const bench_options *o, double ratio, char *to, size_t size) {
    if (ratio > 0)
        snprintf(to, size, "%.3g", ratio);
    else
        snprintf(to, size, "%s", o->json ? "null" : "-");
}

static void print_row(const bench_options *o, bool first, const bench_kernel *kernel,
                      const bench_batch *b, const measurement *m) {
    const char *name = b->layout == LMP_SH_PLANAR ? "planar" : "rows";
    char vs_scalar[32], vs_paper[32];
    print_ratio(o, m->vs_scalar, vs_scalar, sizeof vs_scalar);
    print_ratio(o, m->vs_paper, vs_paper, sizeof vs_paper);
    if (o->json)
        printf("%s    {\"kernel\": \"%s\", \"bands\": %d, \"isa\": \"%s\", \"layout\": \"%s\", "
               "\"ns\": %.4g, \"ns_quartiles\": [%.4g, %.4g], \"peak_fraction\": %.3f, "
               "\"stores_ns\": %.3g, \"output_bytes\": %zu, \"working_set\": \"%s\", \"vs_paper\": "
               "%s, "
               "\"vs_scalar\": %s}",
               first ? "" : ",\n", kernel->name, b->bands, m->isa, name, m->ns.median, m->ns.lower,
               m->ns.upper, m->peak_fraction, m->stores, m->output, working_set(m->output),
               vs_paper, vs_scalar);
    else
        printf("%-23s %5d  %-7s %-6s %10.4g  %9.4g … %-9.4g %5.2f %6.3g %6.5g %-6s %9s %9s\n",
               kernel->name, b->bands, m->isa, name, m->ns.median, m->ns.lower, m->ns.upper,
               m->peak_fraction, m->stores, (double)m->output / 1024, working_set(m->output),
               vs_paper, vs_scalar);
    fflush(stdout);
}

/* Prints the rows of one kernel on one batch. */
static void measure_batch(const bench_options *o, const bench_kernel *kernel, const bench_batch *b,
                          bool *first) {
    const int runs = o->full ? 301 : 31;
    const double paper = kernel->paper ? measure_paper(kernel, b, o->full ? 31 : 5) : 0;
    const unsigned all = (unsigned)o->mask & lmp_cpu_flags();
    double scalar = 0;
    for (unsigned flag = LMP_CPU_SCALAR; flag <= LMP_CPU_AVX512; flag *= 2) {
        if (!(flag & all) || (kernel->call && 2 * flag <= all))
            continue;
        lmp_cpu_limit(flag);
        measurement m = measure(kernel, b, flag, flag == LMP_CPU_SCALAR && !o->full ? 7 : runs);
        m.isa = lmp_cpu_name();
        m.vs_paper = paper / m.ns.median;
        scalar = flag == LMP_CPU_SCALAR && !kernel->call ? m.ns.median : scalar;
        m.vs_scalar = scalar / m.ns.median;
        print_row(o, *first, kernel, b, &m);
        *first = false;
    }
}

/* Whether a kernel is measured at so many bands: one that reads a table costs the same at any. */
static bool measured_at(const bench_options *o, const bench_kernel *kernel, int bands) {
    if (kernel->bands_max > 0)
        return bands <= kernel->bands_max;
    return kernel->table == BENCH_TABLE_NONE || o->bands || bands == BENCH_TABLE_BANDS;
}

/* Whether a kernel is also measured on large outputs: those that do little but store are, in the
 * second cache and in memory, where stores take longer. */
static bool measured_large(const bench_kernel *kernel, int bands) {
    return bands == LARGE_BANDS && kernel->large;
}

static bool measure_large(const bench_options *o, bench_inputs *in, const bench_kernel *kernel,
                          int bands, lmp_sh_layout layout, bool *first) {
    static const size_t outputs[] = { 512 << 10, 64 << 20 };
    bool made = true;
    for (int i = 0; i < 2 && made; i++) {
        bench_large large;
        made = bench_large_create(in, kernel, bands, layout, outputs[i], &large);
        if (made)
            measure_batch(o, kernel, &large.batch, first);
        bench_large_free(&large);
    }
    return made;
}

static bool measure_kernels(const bench_options *o, bench_inputs *in) {
    const int *bands = o->bands ? &o->bands : bands_timed;
    bool first = true, ok = true;
    for (int row = 0; row < BENCH_ROWS; row++)
        for (int n = 0; wanted(o, row) && n < (o->bands ? 1 : BANDS_TIMED); n++) {
            const bench_kernel *kernel = bench_row(row);
            if (!measured_at(o, kernel, bands[n]))
                continue;
            ok = ok && bench_tables_create(kernel->table, bands[n], in);
            for (int layout = kernel->one_layout ? LMP_SH_INTERLEAVED : LMP_SH_PLANAR;
                 ok && layout >= LMP_SH_INTERLEAVED; layout--) {
                const bench_batch b = bench_batch_of(in, kernel, bands[n], (lmp_sh_layout)layout);
                measure_batch(o, kernel, &b, &first);
                if (measured_large(kernel, bands[n]))
                    ok = measure_large(o, in, kernel, bands[n], (lmp_sh_layout)layout, &first);
            }
            bench_tables_free(in);
        }
    return ok;
}

/* Measures points divided among threads, each with scratch memory and an output of its own, on the
 * best kernels of the mask. */
static bool measure_threads(const bench_options *o, bench_inputs *in) {
    const int most = o->threads ? o->threads : omp_get_max_threads();
    const size_t output_size = 64 * 1200 * sizeof(float); /* of the largest batch here, padded */
    const size_t size = LMP_SCRATCH_SIZE + output_size;
    char *memory = aligned_alloc(LMP_SCRATCH_ALIGNMENT, (size_t)most * size);
    if (!memory)
        return false;
    memset(memory, 0, (size_t)most * size);
    lmp_cpu_limit((unsigned)o->mask);
    bool first = true;
    for (int k = 0; k < 4 && (!o->bands || o->bands == 10); k++) {
        double alone = 0;
        for (int threads = 1; wanted(o, k) && threads <= most; threads++) {
            static double ns[RUNS_MAX];
            bench_batch b = bench_batch_of(in, &bench_kernels[k], 10, LMP_SH_PLANAR);
            const int runs = 31, calls = 50 * calls_of(&bench_kernels[k], &b);
            for (int r = 0; r < runs; r++) {
                const double start = now_ns();
#pragma omp parallel for num_threads(threads) schedule(static) firstprivate(b)
                for (int i = 0; i < calls; i++) {
                    b.scratch.memory = memory + (size_t)omp_get_thread_num() * size;
                    b.out = (float *)b.scratch.memory + LMP_SCRATCH_SIZE / sizeof(float);
                    bench_kernels[k].run(&b);
                }
                ns[r] = (now_ns() - start) /
                        ((double)calls * (double)b.count * bench_kernels[k].lights);
            }
            const double median = timing_of(ns, runs).median;
            alone = threads == 1 ? median : alone;
            if (o->json)
                printf(
                    "%s    {\"kernel\": \"%s\", \"bands\": 10, \"isa\": \"%s\", \"threads\": %d, "
                    "\"ns\": %.4g, \"speedup\": %.3g}",
                    first ? "" : ",\n", bench_kernels[k].name, lmp_cpu_name(), threads, median,
                    alone / median);
            else
                printf("%-23s    10  %-7s %2d threads %10.4g ns  x %.2f\n", bench_kernels[k].name,
                       lmp_cpu_name(), threads, median, alone / median);
            first = false;
        }
    }
    free(memory);
    return true;
}

static void print_header(const bench_options *o) {
    char name[160];
    timing_cpu_name(name, sizeof name);
    if (o->json) {
        printf("{\n  \"cpu\": \"%s\",\n  \"compiler\": \"%s\",\n  \"flags\": \"%s\",\n"
               "  \"commit\": \"%s\",\n  \"rows\": [\n",
               name, COMPILER, LAMPION_BUILD_FLAGS, LAMPION_COMMIT);
        return;
    }
    printf("%s; compiler %s; %s; commit %s\n", name, COMPILER, LAMPION_BUILD_FLAGS, LAMPION_COMMIT);
    printf(
        "ns a light-point pair (%d lights a point where lights are summed): median, quartiles; "
        "fraction of the\nFMA peak measured between the runs (mul, add, div, sqrt: one slot each), "
        "above 1 where additions\nhave units of their own; ns of nothing but stores of the output, "
        "its KiB and where these fit; times the speed of\nthe paper's Eq. 12 and 13 one by one, "
        "and of the scalar "
        "build\n",
        BENCH_LIGHTS);
    printf("%-23s %5s  %-7s %-6s %10s  %-21s %5s %6s %6s %-6s %9s %9s\n", "kernel", "bands", "isa",
           "layout", "ns", "quartiles", "peak", "stores", "KiB", "in", "x paper", "x scalar");
}

int bench_cpu(const bench_options *o) {
    static bench_inputs in;
    base_error error = { "" };
    bool done = bench_inputs_create(&in);
    if (done) {
        print_header(o);
        done = measure_kernels(o, &in);
        if (o->json)
            printf("\n  ],\n  \"threads\": [\n");
        done = done && measure_threads(o, &in);
        if (o->json)
            printf("\n  ]\n}\n");
    }
    bench_inputs_free(&in);
    if (!done) {
        base_fail(&error, NULL, "out of memory");
        return base_report(&error);
    }
    return BASE_OK;
}
