/* SPDX-License-Identifier: MIT */
/* lampion bench gpu - what a frame costs by device, method, bands and lights (docs/benchmarks.md).
 */
#include "app/command/bench.h"
#include "app/device/device.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { FRAMES = 9, SEED = 7 };

/* A row's frame, and the shader it runs. */
typedef struct bench_case {
    const char *scene, *method_name;
    device_kind device;
    gpu_method method;
    int bands, lights, width, height;
} bench_case;

/* A scene open on the device, with as many lights as any row asks for. */
typedef struct bench_stage {
    const bench_options *options;
    const char *name;
    scene world;
    gpu_context context;
    gpu_renderer *renderer;
    lmp_response *responses[LMP_BANDS_MAX + 1]; /* by bands, made on demand */
    double build_ms[LMP_BANDS_MAX + 1];
    bool first;
} bench_stage;

static const struct {
    const char *name;
    device_kind device;
    gpu_method method;
    int bands_max;
} contestants[] = {
    { "paper", DEVICE_GPU, GPU_METHOD_PAPER, 20 },
    { "coefficients", DEVICE_GPU, GPU_METHOD_COEFFICIENTS, GPU_COEFFICIENTS_MAX },
    { "tabulated-z", DEVICE_GPU, GPU_METHOD_TABULATED, GPU_COEFFICIENTS_MAX },
    { "zonal", DEVICE_GPU, GPU_METHOD_ZONAL, GPU_BANDS_MAX },
    { "preintegrated", DEVICE_GPU, GPU_METHOD_PREINTEGRATED, LMP_BANDS_MAX },
    { "zonal", DEVICE_CPU, GPU_METHOD_ZONAL, LMP_BANDS_MAX },
    { "preintegrated", DEVICE_CPU, GPU_METHOD_PREINTEGRATED, LMP_BANDS_MAX },
};
enum { CONTESTANTS = sizeof contestants / sizeof *contestants };

static double wall_ms(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
}

static int by_value(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* --- one row ------------------------------------------------------------------------------------
 */

static bool find_response(bench_stage *stage, int bands, cli_error *error) {
    if (stage->responses[bands])
        return true;
    const double start = wall_ms();
    if (!device_response(bands, LMP_WINDOW_HANNING, &stage->responses[bands], error))
        return false;
    stage->build_ms[bands] = wall_ms() - start;
    return true;
}

/* Median milliseconds of the shading, and of what compiling its shader took. */
static bool time_case(bench_stage *stage, const bench_case *c, double *ms, double *compile,
                      cli_error *error) {
    gpu_frame frame = {
        .width = c->width,
        .height = c->height,
        .camera = scene_default_camera(&stage->world, (float)c->width / (float)c->height),
        .method = c->method,
        .bands = c->bands,
        .window = LMP_WINDOW_HANNING,
        .lights = stage->world.lights,
        .light_count = (size_t)c->lights,
        .host = c->device == DEVICE_CPU ? device_shade : NULL,
    };
    if (c->method == GPU_METHOD_PREINTEGRATED) {
        if (!find_response(stage, c->bands, error))
            return false;
        frame.response = stage->responses[c->bands];
    }
    double samples[FRAMES];
    gpu_times times;
    double start = wall_ms();
    if (!gpu_render(stage->renderer, &frame, &times, error))
        return false;
    *compile = wall_ms() - start - times.total;
    for (int i = 0; i < FRAMES; i++) {
        if (!gpu_render(stage->renderer, &frame, &times, error))
            return false;
        samples[i] = times.shade + times.transfer;
        if (i == 2 && samples[i] > 2000) { /* slow ones settle with fewer */
            qsort(samples, 3, sizeof *samples, by_value);
            *ms = samples[1];
            return true;
        }
    }
    qsort(samples, FRAMES, sizeof *samples, by_value);
    *ms = samples[FRAMES / 2];
    return true;
}

static void print_row(bench_stage *stage, const bench_case *c, double ms, double compile,
                      double paper) {
    const double ns = 1e6 * ms / ((double)c->width * c->height * c->lights);
    const lmp_response *response =
        c->method == GPU_METHOD_PREINTEGRATED ? stage->responses[c->bands] : NULL;
    const size_t bytes = response                            ? lmp_response_describe(response).bytes
                         : c->method == GPU_METHOD_TABULATED ? gpu_zonal_bytes(c->bands)
                                                             : 0;
    const double build = response ? stage->build_ms[c->bands] : 0;
    if (stage->options->json) {
        printf("%s    {\"scene\": \"%s\", \"device\": \"%s\", \"method\": \"%s\", \"bands\": %d, "
               "\"lights\": %d, \"width\": %d, \"height\": %d, \"ms\": %.4g, "
               "\"ns_per_pixel_light\": %.4g, ",
               stage->first ? "" : ",\n", c->scene, device_names[c->device], c->method_name,
               c->bands, c->lights, c->width, c->height, ms, ns);
        if (paper > 0)
            printf("\"vs_paper\": %.4g, ", paper / ms);
        else
            printf("\"vs_paper\": null, ");
        printf("\"compile_ms\": %.4g, \"table_bytes\": %zu, \"table_ms\": %.4g}", compile, bytes,
               build);
    } else {
        printf("%-15s %-4s %-14s %5d %6d  %4dx%-4d %10.3f %9.3f", c->scene, device_names[c->device],
               c->method_name, c->bands, c->lights, c->width, c->height, ms, ns);
        if (paper > 0)
            printf(" %9.2f", paper / ms);
        else
            printf(" %9s", "-");
        printf(" %9.0f %9zu %8.0f\n", compile, bytes / 1024, build);
    }
    stage->first = false;
    fflush(stdout);
}

/* Every contestant at one number of bands and lights and one size. */
static bool time_setting(bench_stage *stage, int bands, int lights, const int size[2],
                         cli_error *error) {
    double paper = 0;
    for (int i = 0; i < CONTESTANTS; i++) {
        if (bands > contestants[i].bands_max)
            continue;
        const bench_case c = { stage->name,
                               contestants[i].name,
                               contestants[i].device,
                               contestants[i].method,
                               bands,
                               lights,
                               size[0],
                               size[1] };
        double ms, compile;
        if (!time_case(stage, &c, &ms, &compile, error))
            return false;
        paper = i == 0 ? ms : paper;
        print_row(stage, &c, ms, compile, paper);
    }
    return true;
}

/* --- all rows -----------------------------------------------------------------------------------
 */

static const int all_bands[] = { 5, 8, 10, 20, 50, 100, 0 };
static const int all_lights[] = { 1, 10, 30, 100, 300, 1000, 0 };
static const int all_sizes[][2] = { { 600, 816 }, { 1980, 995 }, { 3400, 900 } };

/* One setting; or the paper's over the bands, then over the lights; with --full every combination.
 */
static bool time_all(bench_stage *stage, cli_error *error) {
    const bench_options *o = stage->options;
    if (o->bands)
        return time_setting(stage, o->bands, o->lights, o->size, error);
    if (o->full) {
        for (int s = 0; s < 3; s++)
            for (const int *b = all_bands; *b; b++)
                for (const int *l = all_lights; *l; l++)
                    if (!time_setting(stage, *b, *l, all_sizes[s], error))
                        return false;
        return true;
    }
    for (const int *b = all_bands; *b; b++)
        if (!time_setting(stage, *b, o->lights, o->size, error))
            return false;
    for (const int *l = all_lights; *l && *l <= 300; l++)
        if (*l != o->lights && !time_setting(stage, 8, *l, o->size, error))
            return false;
    return true;
}

static bool open_stage(bench_stage *stage, cli_error *error) {
    return scene_load(stage->name, &(scene_options) { 0 }, &stage->world, error) &&
           scene_add_random_lights(&stage->world, SCENE_LIGHTS_MAX - (int)stage->world.light_count,
                                   SEED, error) &&
           gpu_context_create(stage->options->gl_device, &stage->context, error) &&
           (stage->renderer = gpu_renderer_create(&stage->context, &stage->world, error));
}

static void close_stage(bench_stage *stage) {
    gpu_renderer_destroy(stage->renderer);
    gpu_context_destroy(&stage->context);
    scene_free(&stage->world);
    for (int n = 0; n <= LMP_BANDS_MAX; n++)
        lmp_response_destroy(stage->responses[n]);
}

static void print_header(const bench_stage *stage) {
    if (stage->options->json)
        return;
    printf("%s (%s), CPU kernels: %s; commit %s\n", stage->context.device, stage->context.driver,
           lmp_cpu_name(), LAMPION_COMMIT);
    printf(
        "ms: from G-buffer to radiance, to the CPU and back where it shades, median of %d frames "
        "(%s); x paper: against the paper's fragment shader in the same run\n",
        FRAMES, stage->context.software ? "wall clock" : "timer queries");
    printf("%-15s %-4s %-14s %5s %6s  %9s %10s %9s %9s %9s %9s %8s\n", "scene", "dev", "method",
           "bands", "lights", "size", "ms", "ns/pair", "x paper", "compile", "table KB",
           "table ms");
}

int bench_gpu(const bench_options *o) {
    static const char *const scenes[] = { "builtin:atrium", "builtin:ball" };
    cli_error error = { "" };
    bool ok = true, first = true;
    for (int i = 0; i < (o->full ? 2 : 1) && ok; i++) {
        bench_stage stage = { .options = o,
                              .name = o->full ? scenes[i] : o->scene,
                              .first = first };
        ok = open_stage(&stage, &error);
        if (ok && i == 0) {
            if (o->json)
                printf("{\n  \"gpu\": \"%s\",\n  \"driver\": \"%s\",\n  \"cpu_kernels\": \"%s\",\n"
                       "  \"commit\": \"%s\",\n  \"rows\": [\n",
                       stage.context.device, stage.context.driver, lmp_cpu_name(), LAMPION_COMMIT);
            print_header(&stage);
        }
        ok = ok && time_all(&stage, &error);
        first = stage.first;
        close_stage(&stage);
    }
    if (o->json && ok)
        printf("\n  ]\n}\n");
    return ok ? CLI_OK : cli_report(&error);
}
