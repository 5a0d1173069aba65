/* SPDX-License-Identifier: MIT */
/* lampion bench gpu - what a frame costs by device, method, bands and lights (docs/benchmarks.md).
 */
#include "app/bake/bake.h"
#include "app/bench/bench.h"
#include "app/override/override.h"
#include "app/shade/shade.h"
#include "app/timing/timing.h"

#include <lampion/cpu.h>

#include <cjson/cJSON.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FRAMES = 9, SECONDS = 180, SEED = 7 };

/* What shades. */
typedef struct bench_case {
    method_kind method;
    device_kind device;
} bench_case;

enum { SCENES = 2, SIZES = 3, BANDS = 6, LIGHTS = 6, SETTINGS_MAX = SIZES * BANDS * LIGHTS };

/* A row's frame, and what shades it. */
typedef struct bench_row {
    const bench_case *by;
    int bands, lights, width, height;
} bench_row;

/* What a row reads besides the scene: its bytes, and what making or loading it took. */
typedef struct bench_tables {
    size_t bytes;
    double ms, lobes_ms, responses_ms; /* tables of materials, and responses */
} bench_tables;

typedef struct bench_result {
    double ms; /* median of the shading of `frames` */
    int frames;
    double compile_ms; /* of the shader */
} bench_result;

/* One number of bands and lights, and one size, of the rows of some cases. */
typedef struct bench_setting {
    int bands, lights;
    const int *size;
} bench_setting;

/* The settings in the order of what they tell, and the time for them all. */
typedef struct bench_plan {
    bench_case cases[METHODS_TIMED * DEVICES];
    int case_count;
    unsigned reads; /* what their methods read: METHOD_READS_… */
    bench_setting settings[SETTINGS_MAX];
    int setting_count;
    int rows_ahead, rows_left_out;
    double end_ms; /* of now_ms */
} bench_plan;

/* A scene open on the device, with as many lights as any row asks for. */
typedef struct bench_stage {
    const bench_options *options;
    bench_plan *plan;
    const char *name;
    scene world;
    gpu_context context;
    gpu_renderer *renderer;
    lmp_preintegrated_lobe *lobes[LMP_BANDS_MAX + 1]; /* by bands, made on demand */
    double build_ms[LMP_BANDS_MAX + 1];
    override_set materials; /* of material_bands */
    int material_bands;     /* 0: none yet */
    double bake_ms, integrate_ms;
    bool first;
} bench_stage;

static double now_ms(void) {
    return 1e3 * timing_now();
}

/* --- which rows ---------------------------------------------------------------------------------
 */

/* What tells most first: the paper's 8 bands and 30 lights, then other bands, then other lights.
 * The first scene and size are those of the short selection. */
static const char *const all_scenes[SCENES] = { "builtin:atrium", "builtin:ball" };
static const int all_sizes[SIZES][2] = { { 1980, 995 }, { 600, 816 }, { 3400, 900 } };
static const int all_bands[BANDS + 1] = { 8, 5, 20, 10, 50, 100, 0 };
static const int all_lights[LIGHTS + 1] = { 30, 100, 10, 300, 1, 1000, 0 };

const char *const *bench_methods(void) {
    static const char *names[METHODS_TIMED + 2] = { "all" };
    cli_row_names(&method_table[0].name, sizeof *method_table, METHODS_TIMED, names + 1);
    return names;
}

const char *const *bench_devices(void) {
    static const char *names[DEVICES + 1] = { "all" };
    cli_row_names(&device_table[DEVICE_GPU].name, sizeof *device_table, DEVICES - DEVICE_GPU,
                  names + 1);
    return names;
}

/* Whether there is a row of it; bands 0: of any number. Without batch kernels the CPU takes minutes
 * a frame, which has to be asked for. */
static bool is_chosen(const bench_options *o, const bench_case *c, int bands) {
    const method_row *method = &method_table[c->method];
    return method->bands_max[c->device] > 0 && bands <= method->bands_max[c->device] &&
           (o->method == 0 || o->method == (int)c->method + 1) &&
           (o->device == 0 || o->device == (int)c->device) &&
           (method->tabulated || o->materials.count == 0) &&
           (c->device != DEVICE_CPU || method->batched || o->method != 0);
}

/* On each device the paper's own methods first, which the others are told against. */
static void plan_cases(bench_plan *plan, const bench_options *o) {
    for (int device = DEVICE_GPU; device < DEVICES; device++)
        for (int i = 0; i < METHODS_TIMED; i++) {
            const int method = (METHODS + i) % METHODS_TIMED;
            const bench_case one = { (method_kind)method, (device_kind)device };
            if (is_chosen(o, &one, o->bands)) {
                plan->cases[plan->case_count++] = one;
                plan->reads |= method_table[method].reads;
            }
        }
}

/* The paper's 30 lights over the bands, its 8 bands over the lights; whatever is fixed; or all. */
static bool is_setting(const bench_options *o, int bands, int lights) {
    return o->full || o->lights || lights == 30 || (!o->bands && bands == 8 && lights <= 300);
}

static void plan_setting(bench_plan *plan, const bench_options *o, const bench_setting *setting) {
    if (!is_setting(o, setting->bands, setting->lights))
        return;
    plan->settings[plan->setting_count++] = *setting;
    for (int i = 0; i < plan->case_count; i++)
        plan->rows_ahead += is_chosen(o, &plan->cases[i], setting->bands);
}

/* Of one scene: all bands with the first number of lights, then the other lights. */
static void plan_rows(bench_plan *plan, const bench_options *o) {
    const int own_bands[] = { o->bands, 0 }, own_lights[] = { o->lights, 0 };
    const int *const bands = o->bands ? own_bands : all_bands;
    const int *const lights = o->lights ? own_lights : all_lights;
    const int sizes = o->full && !o->size[0] ? SIZES : 1;
    for (int s = 0; s < sizes; s++) {
        const int *const size = o->size[0] ? o->size : all_sizes[s];
        for (const int *b = bands; *b; b++)
            plan_setting(plan, o, &(bench_setting) { *b, lights[0], size });
        for (const int *b = bands; *b; b++)
            for (const int *l = lights + 1; *l; l++)
                plan_setting(plan, o, &(bench_setting) { *b, *l, size });
    }
}

/* --- one row ------------------------------------------------------------------------------------
 */

static bool find_lobes(bench_stage *stage, int bands, cli_error *error) {
    if (stage->lobes[bands])
        return true;
    const double start = now_ms();
    if (!bake_lobes(bands, LMP_WINDOW_HANNING, &stage->lobes[bands], error))
        return false;
    stage->build_ms[bands] = now_ms() - start;
    return true;
}

/* The materials asked for, with so many bands, in place of the scene's. */
static bool find_materials(bench_stage *stage, int bands, cli_error *error) {
    override_set *all = &stage->materials;
    const bench_options *o = stage->options;
    const cli_list *list = &o->materials;
    if (list->count == 0 || stage->material_bands == bands)
        return true;
    override_free(all);
    stage->material_bands = bands;
    bool ok = override_open(list, &stage->world, all, error);
    const double start = now_ms();
    ok = ok && override_bake(all, bands, LMP_WINDOW_HANNING, error);
    const double baked = now_ms();
    if (ok && stage->plan->reads & METHOD_READS_PREINTEGRATED)
        ok = override_preintegrate(all, error);
    stage->bake_ms = baked - start;
    stage->integrate_ms = now_ms() - baked;
    return ok && override_apply(all, &stage->world, stage->renderer, error);
}

/* A shader that sums a material by its bands takes fewer. */
static int bands_max(const bench_stage *stage, const bench_case *c) {
    const int most = method_table[c->method].bands_max[c->device];
    for (int i = 0; i < stage->materials.count && c->device == DEVICE_GPU; i++)
        if (!stage->materials.preintegrated[i] && most > METHOD_GPU_BANDS_MAX)
            return METHOD_GPU_BANDS_MAX;
    return most;
}

static bench_tables tables_of(const bench_stage *stage, const bench_row *c) {
    const unsigned reads = method_table[c->by->method].reads;
    const bool preintegrated = reads & METHOD_READS_PREINTEGRATED;
    const override_set *all = &stage->materials;
    bench_tables sum = { .ms = stage->bake_ms };
    if (reads & METHOD_READS_TABULATED_Z)
        sum.bytes = gpu_zonal_bytes(c->bands);
    if (preintegrated) {
        sum.bytes = lmp_preintegrated_lobe_describe(stage->lobes[c->bands]).bytes;
        sum.lobes_ms = stage->build_ms[c->bands];
        sum.responses_ms = stage->integrate_ms;
    }
    for (int i = 0; i < all->count; i++)
        sum.bytes += preintegrated && all->preintegrated[i]
                         ? lmp_preintegrated_brdf_describe(all->preintegrated[i]).bytes
                         : lmp_brdf_table_size(all->tables[i]);
    return sum;
}

/* In its part of the time left, but one frame at least. */
static bool time_row(bench_stage *stage, const bench_row *c, bench_result *result,
                     cli_error *error) {
    gpu_frame frame = {
        .width = c->width,
        .height = c->height,
        .camera = scene_default_camera(&stage->world, (float)c->width / (float)c->height),
        .method = c->by->method,
        .bands = c->bands,
        .window = LMP_WINDOW_HANNING,
        .lights = stage->world.lights,
        .light_count = (size_t)c->lights,
        .host = c->by->device == DEVICE_CPU ? shade_frame : NULL,
    };
    if (method_table[c->by->method].reads & METHOD_READS_PREINTEGRATED) {
        if (!find_lobes(stage, c->bands, error))
            return false;
        frame.lobes = stage->lobes[c->bands];
    }
    double samples[FRAMES];
    int count = 0;
    gpu_times times;
    const double start = now_ms(),
                 end = start + (stage->plan->end_ms - start) / stage->plan->rows_ahead;
    if (!gpu_render(stage->renderer, &frame, &times, error))
        return false;
    result->compile_ms = now_ms() - start - times.total;
    do {
        if (!gpu_render(stage->renderer, &frame, &times, error))
            return false;
        samples[count++] = times.shade + times.transfer;
    } while (count < FRAMES && now_ms() < end);
    result->ms = timing_of(samples, count).median;
    result->frames = count;
    return true;
}

/* --- printing -----------------------------------------------------------------------------------
 */

/* Four digits. */
static void add_number(cJSON *row, const char *name, double value) {
    char text[32];
    snprintf(text, sizeof text, "%.4g", value);
    cJSON_AddRawToObject(row, name, text);
}

static void print_json(const bench_stage *stage, const bench_row *c, const bench_result *result,
                       double ns, double paper) {
    const bench_tables tables = tables_of(stage, c);
    cJSON *row = cJSON_CreateObject();
    cJSON_AddStringToObject(row, "scene", stage->name);
    cJSON_AddStringToObject(row, "device", device_table[c->by->device].name);
    cJSON_AddStringToObject(row, "method", method_table[c->by->method].name);
    cJSON_AddNumberToObject(row, "bands", c->bands);
    cJSON_AddNumberToObject(row, "lights", c->lights);
    cJSON_AddNumberToObject(row, "width", c->width);
    cJSON_AddNumberToObject(row, "height", c->height);
    add_number(row, "ms", result->ms);
    cJSON_AddNumberToObject(row, "frames", result->frames);
    add_number(row, "ns_per_pixel_light", ns);
    if (paper > 0)
        add_number(row, "vs_paper", paper / result->ms);
    else
        cJSON_AddNullToObject(row, "vs_paper");
    add_number(row, "compile_ms", result->compile_ms);
    cJSON_AddNumberToObject(row, "table_bytes", (double)tables.bytes);
    add_number(row, "table_ms", tables.ms);
    add_number(row, "lobes_ms", tables.lobes_ms);
    add_number(row, "response_ms", tables.responses_ms);
    char *text = cJSON_PrintUnformatted(row);
    printf("%s    %s", stage->first ? "" : ",\n", text ? text : "null");
    cJSON_free(text);
    cJSON_Delete(row);
}

static void print_row(bench_stage *stage, const bench_row *c, const bench_result *result,
                      double paper) {
    const double ns = 1e6 * result->ms / ((double)c->width * c->height * c->lights);
    if (stage->options->json) {
        print_json(stage, c, result, ns, paper);
    } else {
        const bench_tables tables = tables_of(stage, c);
        char ratio[32] = "-";
        if (paper > 0)
            snprintf(ratio, sizeof ratio, "%.2f", paper / result->ms);
        printf("%-15s %-4s %-14s %5d %6d  %4dx%-4d %10.3f %6d %9.3f %9s %9.0f %9zu %8.0f %8.0f "
               "%8.0f\n",
               stage->name, device_table[c->by->device].name, method_table[c->by->method].name,
               c->bands, c->lights, c->width, c->height, result->ms, result->frames, ns, ratio,
               result->compile_ms, tables.bytes / 1024, tables.ms, tables.lobes_ms,
               tables.responses_ms);
    }
    stage->first = false;
    fflush(stdout);
}

static void print_json_header(const bench_stage *stage) {
    const bench_options *o = stage->options;
    cJSON *root = cJSON_CreateObject();
    cJSON_AddStringToObject(root, "gpu", stage->context.device);
    cJSON_AddStringToObject(root, "driver", stage->context.driver);
    cJSON_AddStringToObject(root, "cpu_kernels", lmp_cpu_name());
    cJSON_AddStringToObject(root, "commit", LAMPION_COMMIT);
    cJSON_AddItemToObject(
        root, "materials",
        cJSON_CreateStringArray((const char *const *)o->materials.items, o->materials.count));
    char *text = cJSON_PrintUnformatted(root);
    if (text) /* the rows go on where it would end */
        printf("%.*s,\n  \"rows\": [\n", (int)strlen(text) - 1, text);
    cJSON_free(text);
    cJSON_Delete(root);
}

static void print_header(const bench_stage *stage) {
    const bench_options *o = stage->options;
    if (o->json) {
        print_json_header(stage);
        return;
    }
    printf("%s (%s), CPU kernels: %s; commit %s\n", stage->context.device, stage->context.driver,
           lmp_cpu_name(), LAMPION_COMMIT);
    for (int i = 0; i < o->materials.count; i++)
        printf("%s%s", i ? ", " : "materials: ", o->materials.items[i]);
    printf("%s"
           "ms: from G-buffer to radiance, to the CPU and back where it shades, median of the "
           "frames (%s); x paper: against the paper's fragment shader in the same run; ms at the "
           "end: making or reading the materials' tables, the lobes, the materials' responses\n",
           o->materials.count ? "\n" : "",
           stage->context.software ? "wall clock" : "timer queries");
    printf("%-15s %-4s %-14s %5s %6s  %9s %10s %6s %9s %9s %9s %9s %8s %8s %8s\n", "scene", "dev",
           "method", "bands", "lights", "size", "ms", "frames", "ns/pair", "x paper", "compile",
           "table KB", "table", "lobes", "response");
}

/* --- all rows -----------------------------------------------------------------------------------
 */

/* Everything that is chosen, at one setting. */
static bool time_setting(bench_stage *stage, const bench_setting *setting, cli_error *error) {
    bench_plan *plan = stage->plan;
    double paper = 0;
    for (int i = 0; i < plan->case_count; i++) {
        const bench_row row = { &plan->cases[i], setting->bands, setting->lights, setting->size[0],
                                setting->size[1] };
        bench_result result;
        if (!is_chosen(stage->options, row.by, row.bands))
            continue;
        if (now_ms() > plan->end_ms) {
            plan->rows_left_out++;
            continue;
        }
        if (!find_materials(stage, row.bands, error))
            return false;
        if (row.bands <= bands_max(stage, row.by)) {
            if (!time_row(stage, &row, &result, error))
                return false;
            paper = method_table[row.by->method].baseline ? result.ms : paper;
            print_row(stage, &row, &result, paper);
        }
        plan->rows_ahead--;
    }
    return true;
}

static bool time_all(bench_stage *stage, cli_error *error) {
    for (int i = 0; i < stage->plan->setting_count; i++)
        if (!time_setting(stage, &stage->plan->settings[i], error))
            return false;
    return true;
}

static bool open_stage(bench_stage *stage, cli_error *error) {
    return scene_load(stage->name, &(scene_options) { 0 }, &stage->world, error) &&
           scene_add_random_lights(&stage->world, SCENE_LIGHTS_MAX - (int)stage->world.light_count,
                                   SEED, error) &&
           override_open(&stage->options->materials, &stage->world, &stage->materials, error) &&
           gpu_context_create(stage->options->gl_device, &stage->context, error) &&
           (stage->renderer = gpu_renderer_create(&stage->context, &stage->world, error));
}

static void close_stage(bench_stage *stage) {
    gpu_renderer_destroy(stage->renderer);
    override_free(&stage->materials);
    gpu_context_destroy(&stage->context);
    scene_free(&stage->world);
    for (int n = 0; n <= LMP_BANDS_MAX; n++)
        lmp_preintegrated_lobe_destroy(stage->lobes[n]);
}

/* What the table of options cannot say. */
static int check_options(const cli_command *command, const bench_options *o,
                         const bench_plan *plan) {
    if (plan->case_count == 0)
        return cli_usage(command, "nothing runs by --method %s --device %s --bands %d%s",
                         bench_methods()[o->method], bench_devices()[o->device], o->bands,
                         o->materials.count ? " with --material" : "");
    if (o->materials.count && o->full && !o->scene)
        return cli_usage(command, "--material is of one scene: name it by --scene");
    return CLI_OK;
}

int bench_gpu(const cli_command *command, const bench_options *o) {
    cli_error error = { "" };
    const int scenes = o->full && !o->scene ? SCENES : 1;
    bench_plan plan = { .end_ms = (double)INFINITY };
    plan_cases(&plan, o);
    const int status = check_options(command, o, &plan);
    if (status != CLI_OK)
        return status;
    plan_rows(&plan, o);
    plan.rows_ahead *= scenes;
    if (o->seconds || !o->full)
        plan.end_ms = now_ms() + 1e3 * (o->seconds ? o->seconds : SECONDS);
    bool ok = true, first = true;
    for (int i = 0; i < scenes && ok; i++) {
        bench_stage stage = {
            .options = o, .plan = &plan, .name = o->scene ? o->scene : all_scenes[i], .first = first
        };
        ok = open_stage(&stage, &error);
        if (ok && i == 0)
            print_header(&stage);
        ok = ok && time_all(&stage, &error);
        first = stage.first;
        close_stage(&stage);
    }
    if (o->json && ok)
        printf("\n  ]\n}\n");
    if (plan.rows_left_out)
        fprintf(stderr, "lampion: %d rows left out for want of time (--time)\n",
                plan.rows_left_out);
    return ok ? CLI_OK : cli_report(&error);
}
