/* SPDX-License-Identifier: MIT */
/* lampion bench gpu - the cost of frames by device, method, bands, lights (docs/benchmarks.md). */
#include "app/study/bench_gpu.h"
#include "app/base/choice.h"
#include "app/base/cli.h"
#include "app/base/timing.h"
#include "app/scene/bake.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FRAMES = 9, SECONDS = 180, SEED = 7, LIGHTS_MADE = 1024, WARM_MS = 200 };
enum { SCENES = 2, SIZES = 3, BANDS = 6, LIGHTS = 6 };
_Static_assert(SIZES *BANDS *CLI_NUMBERS_MAX == BENCH_SETTINGS_MAX, "room for all settings");

static double now_ms(void) {
    return 1e3 * timing_now();
}

/* --- which rows ------------------------------------------------------------------------------- */

/* Rows in the order of their interest: the paper's 8 bands and 30 lights, then other bands, then
 * other lights. The first scene and size are those of the short selection. */
static const char *const all_scenes[SCENES] = { "builtin:atrium", "builtin:ball" };
static const int all_sizes[SIZES][2] = { { 1980, 995 }, { 600, 816 }, { 3400, 900 } };
static const int all_bands[BANDS + 1] = { 8, 5, 20, 10, 50, 100, 0 };
static const int all_lights[LIGHTS + 1] = { 30, 100, 10, 300, 1, 1000, 0 };

const char *const *bench_methods(void) {
    static const char *names[METHODS_TIMED + 2] = { "all" };
    choice_names(&method_table[0].name, sizeof *method_table, METHODS_TIMED, names + 1);
    return names;
}

const char *const *bench_devices(void) {
    static const char *names[DEVICES + 1] = { "all" };
    choice_names(&device_table[DEVICE_FIRST].name, sizeof *device_table, DEVICES - DEVICE_FIRST,
                 names + 1);
    return names;
}

/* Whether a case has rows of so many bands, or of any number if bands is 0. Without batch kernels
 * the CPU takes minutes per frame, so such a method must be named. */
static bool is_chosen(const bench_options *o, const bench_case *c, int bands) {
    const method_row *method = &method_table[c->method];
    return method->bands_max[c->device] > 0 && bands <= method->bands_max[c->device] &&
           (o->method == 0 || o->method == (int)c->method + 1) &&
           (o->device == 0 || o->device == (int)c->device) &&
           (method->tabulated || o->materials.count == 0) &&
           (!device_table[c->device].on_cpu || method->batched || o->method != 0);
}

/* Lists the cases: on each device the paper's own methods first, which the others are compared
 * with. */
static void plan_cases(bench_plan *plan, const bench_options *o) {
    for (int device = DEVICE_FIRST; device < DEVICES; device++)
        for (int i = 0; i < METHODS_TIMED; i++) {
            const int method = (METHODS + i) % METHODS_TIMED;
            const bench_case one = { (method_kind)method, (device_kind)device };
            if (is_chosen(o, &one, o->bands)) {
                plan->cases[plan->case_count++] = one;
                plan->reads |= method_table[method].reads;
            }
        }
}

/* Whether a setting has a row: the paper's 30 lights at all bands, its 8 bands with other lights;
 * whatever an option fixes; or all. */
static bool is_setting(const bench_options *o, int bands, int lights) {
    return o->full || o->lights.count || lights == 30 || (!o->bands && bands == 8 && lights <= 300);
}

static void plan_setting(bench_plan *plan, const bench_options *o, const bench_setting *setting) {
    if (!is_setting(o, setting->bands, setting->lights))
        return;
    plan->settings[plan->setting_count++] = *setting;
    for (int i = 0; i < plan->case_count; i++)
        plan->rows_ahead += is_chosen(o, &plan->cases[i], setting->bands);
}

/* Lists the settings of one scene: all bands with the first number of lights, then the other
 * lights. */
static void plan_rows(bench_plan *plan, const bench_options *o) {
    const int own_bands[] = { o->bands, 0 };
    int own_lights[CLI_NUMBERS_MAX + 1] = { 0 };
    const int *const bands = o->bands ? own_bands : all_bands;
    const int *const lights = o->lights.count ? own_lights : all_lights;
    memcpy(own_lights, o->lights.values, (size_t)o->lights.count * sizeof *own_lights);
    const int sizes = o->full && !o->size[0] ? SIZES : 1;
    for (int s = 0; s < sizes; s++) {
        const int *const size = o->size[0] ? o->size : all_sizes[s];
        for (const int *b = bands; *b; b++)
            plan_setting(plan, o,
                         &(bench_setting) { .bands = *b, .lights = lights[0], .size = size });
        for (const int *b = bands; *b; b++)
            for (const int *l = lights + 1; *l; l++)
                plan_setting(plan, o, &(bench_setting) { .bands = *b, .lights = *l, .size = size });
    }
}

/* --- one row ---------------------------------------------------------------------------------- */

static bool find_lobes(bench_scene *s, int bands, base_error *error) {
    if (s->lobes[bands])
        return true;
    const double start = now_ms();
    if (!bake_lobes(bands, LMP_WINDOW_HANNING, &s->lobes[bands], error))
        return false;
    s->build_ms[bands] = now_ms() - start;
    return true;
}

/* Makes the field of the last row that reads one. */
static bool find_field(bench_scene *s, device_kind device, int bands, base_error *error) {
    const shade_field_options options = { .error = SHADE_FIELD_ERROR,
                                          .bytes_max =
                                              render_device_field_bytes(&s->devices[device]) };
    if (s->field && s->field_device == device &&
        shade_field_describe(s->field).info.desc.bands == bands)
        return true;
    s->field_device = device;
    shade_field_destroy(s->field);
    s->field = shade_field_create(&s->world, &options, bands, error);
    return s->field;
}

/* Returns the most bands of a case, which are fewer where a shader sums a material by its bands. */
static int bands_max(const bench_scene *s, const bench_case *c) {
    const int most = method_table[c->method].bands_max[c->device];
    for (int i = 0; i < s->materials.count && !device_table[c->device].on_cpu; i++)
        if (!s->materials.preintegrated[i] && most > METHOD_GPU_BANDS_MAX)
            return METHOD_GPU_BANDS_MAX;
    return most;
}

/* Checks before tables are made whether those of so many bands fit every method that supports
 * them. */
static bool fit_materials(const bench_scene *s, int bands, base_error *error) {
    for (int i = 0; i < s->plan->case_count; i++) {
        const bench_case *c = &s->plan->cases[i];
        if (is_chosen(s->options, c, bands) && bands <= bands_max(s, c) &&
            !override_fits(&s->materials, bands, c->method, s->renderers[c->device], error))
            return false;
    }
    return true;
}

/* Replaces the scene's materials by the requested ones, with so many bands. */
static bool find_materials(bench_scene *s, int bands, base_error *error) {
    override_set *all = &s->materials;
    const bench_options *o = s->options;
    const cli_list *list = &o->materials;
    if (!override_is_needed(list->count, &s->world) || s->material_bands == bands)
        return true;
    override_free(all);
    s->material_bands = bands;
    bool ok = override_open(list, &s->world, all, error) && fit_materials(s, bands, error);
    const double start = now_ms();
    ok = ok && override_bake(all, bands, LMP_WINDOW_HANNING, error) &&
         override_bake_sheen(all, &s->world, bands, LMP_WINDOW_HANNING, error);
    const double baked = now_ms();
    if (ok && s->plan->reads & METHOD_READS_PREINTEGRATED)
        ok = override_preintegrate(all, error);
    s->bake_ms = baked - start;
    s->integrate_ms = now_ms() - baked;
    for (int i = DEVICE_FIRST; i < DEVICES && ok; i++)
        ok = !s->renderers[i] || override_apply(all, &s->world, s->renderers[i], error);
    return ok;
}

/* Times one frame, in which all lights are new, including its tone curve. */
static bool time_frame(any_renderer *renderer, const render_frame *frame, unsigned char *rgb8,
                       render_times *times, base_error *error) {
    const image_display display = { .exposure = 1 };
    shade_field_forget(frame->field);
    return renderer_draw(renderer, frame, times, error) &&
           renderer_read_rgb8(renderer, &display, rgb8, times, error);
}

/* Draws untimed frames: a GPU that was idle, as while a shader is compiled, has a fraction of its
 * clock for a while. Does nothing if no more than one frame of `frame_ms` would fit. */
static bool warm_up(const bench_scene *s, const bench_row *c, const render_frame *frame,
                    double frame_ms, unsigned char *rgb8, base_error *error) {
    const device_kind device = c->by->device;
    const double end = now_ms() + WARM_MS;
    render_times times;
    bool ok = true;
    if (device_table[device].on_cpu || s->devices[device].gl.software)
        return true;
    while (ok && now_ms() + frame_ms < end)
        ok = time_frame(s->renderers[device], frame, rgb8, &times, error);
    return ok;
}

/* Times frames in the row's part of the remaining time, but at least one. Where the library shades,
 * which compiles nothing, that is the first frame if it takes as long. */
static bool time_frames(bench_scene *s, const bench_row *c, const render_frame *frame,
                        bench_result *result, base_error *error) {
    double shading[FRAMES], whole[FRAMES];
    int count = 0;
    any_renderer *const renderer = s->renderers[c->by->device];
    render_times times;
    const double start = now_ms(), end = start + (s->plan->end_ms - start) / s->plan->rows_ahead;
    unsigned char *rgb8 = malloc(3 * (size_t)c->width * (size_t)c->height);
    bool ok = (rgb8 || base_fail(error, NULL, "out of memory")) &&
              time_frame(renderer, frame, rgb8, &times, error);
    result->compile_ms = now_ms() - start - times.total;
    ok = ok && warm_up(s, c, frame, times.total, rgb8, error);
    const bool enough = device_table[c->by->device].on_cpu && now_ms() >= end;
    while (ok && (count == 0 || (count < FRAMES && now_ms() < end))) {
        ok = enough || time_frame(renderer, frame, rgb8, &times, error);
        shading[count] = times.shade + times.transfer;
        whole[count++] = times.total;
    }
    free(rgb8);
    if (!ok)
        return false;
    result->ms = timing_of(shading, count).median;
    result->frame_ms = timing_of(whole, count).median;
    result->frames = count;
    return true;
}

static bool time_row(bench_scene *s, const bench_row *c, bench_result *result, base_error *error) {
    render_frame frame = {
        .width = c->width,
        .height = c->height,
        .camera = scene_default_camera(&s->world, (float)c->width / (float)c->height),
        .method = c->by->method,
        .bands = c->bands,
        .window = LMP_WINDOW_HANNING,
        .lights = s->world.lights,
        .light_count = (size_t)c->lights,
    };
    if (method_table[c->by->method].reads & METHOD_READS_PREINTEGRATED) {
        if (!find_lobes(s, c->bands, error))
            return false;
        frame.lobes = s->lobes[c->bands];
    }
    if (method_table[c->by->method].reads & METHOD_READS_FIELD) {
        if (!find_field(s, c->by->device, c->bands, error))
            return false;
        shade_field_attach(s->field, &frame);
    }
    return time_frames(s, c, &frame, result, error);
}

/* --- all rows --------------------------------------------------------------------------------- */

/* Whether a case is timed later: with several numbers of lights, fields and what they are compared
 * with are of most interest. */
static bool is_later(const bench_options *o, const bench_case *c) {
    return o->lights.count > 1 && !(method_table[c->method].reads & METHOD_READS_FIELD) &&
           c->method != bench_compared();
}

/* Whether a row is skipped: no time is left, or less than the library's estimate. */
static bool is_skipped(const bench_plan *plan, const bench_row *c) {
    const method_work work = { (size_t)c->lights, c->bands, (double)c->width * c->height };
    const bool on_cpu = device_table[c->by->device].on_cpu;
    return now_ms() + (on_cpu ? method_estimate(c->by->method, &work) : 0) > plan->end_ms;
}

/* Records the name of a skipped row, as long as there is room. */
#define NAMES_END "; …"
static void skip(bench_plan *plan, const bench_row *c) {
    const size_t used = strlen(plan->skipped), size = sizeof plan->skipped;
    char text[96];
    snprintf(text, sizeof text, "%s%s %s, %d bands, %d lights", used ? "; " : "",
             device_table[c->by->device].name, method_table[c->by->method].name, c->bands,
             c->lights);
    if (used + strlen(text) + sizeof NAMES_END <= size)
        strcpy(plan->skipped + used, text);
    else if (!strstr(plan->skipped, NAMES_END))
        strcpy(plan->skipped + used, NAMES_END);
    plan->rows_skipped++;
}

static bool time_case(bench_scene *s, bench_setting *setting, int number, base_error *error) {
    bench_plan *plan = s->plan;
    const bench_row row = { &plan->cases[number], setting->bands, setting->lights, setting->size[0],
                            setting->size[1] };
    bench_result result;
    if (is_skipped(plan, &row)) {
        skip(plan, &row);
        return true;
    }
    if (!find_materials(s, row.bands, error))
        return false;
    if (row.bands > bands_max(s, row.by))
        return true;
    if (!time_row(s, &row, &result, error))
        return false;
    setting->frame_ms[number] = result.frame_ms;
    if (method_table[row.by->method].baseline)
        setting->paper_ms = result.ms;
    bench_print_row(s, &row, &result, setting->paper_ms);
    return true;
}

/* Times the chosen cases of one setting: the later ones, or the others. */
static bool time_setting(bench_scene *s, bench_setting *setting, bool later, base_error *error) {
    bench_plan *plan = s->plan;
    for (int i = 0; i < plan->case_count; i++) {
        const bench_case *by = &plan->cases[i];
        if (!is_chosen(s->options, by, setting->bands) || is_later(s->options, by) != later)
            continue;
        if (!time_case(s, setting, i, error))
            return false;
        plan->rows_ahead--;
    }
    return true;
}

static bool time_all(bench_scene *s, base_error *error) {
    bench_plan *plan = s->plan;
    for (int i = 0; i < plan->setting_count; i++) {
        plan->settings[i].paper_ms = 0;
        memset(plan->settings[i].frame_ms, 0, sizeof plan->settings[i].frame_ms);
    }
    for (int later = 0; later < 2; later++)
        for (int i = 0; i < plan->setting_count; i++)
            if (!time_setting(s, &plan->settings[i], later == 1, error))
                return false;
    if (s->options->lights.count > 1 && !s->options->json)
        bench_print_frames(s);
    return true;
}

/* Returns the most lights that rows ask for; random lights are smaller the more there are. */
static int most_lights(const bench_options *o) {
    int most = LIGHTS_MADE;
    for (int i = 0; i < o->lights.count; i++)
        most = o->lights.values[i] > most ? o->lights.values[i] : most;
    return most;
}

/* Opens the devices of the cases. */
static bool open_devices(bench_scene *s, base_error *error) {
    for (int i = 0; i < s->plan->case_count; i++) {
        const device_kind kind = s->plan->cases[i].device;
        if (s->renderers[kind])
            continue;
        if (!render_device_open(kind, s->options->gl_device, &s->world, &s->devices[kind], error) ||
            !(s->renderers[kind] = renderer_create(&s->devices[kind], error)))
            return false;
    }
    return true;
}

static bool open_scene(bench_scene *s, base_error *error) {
    return scene_load(s->name, &(scene_options) { 0 }, &s->world, error) &&
           scene_add_random_lights(&s->world, most_lights(s->options) - (int)s->world.light_count,
                                   SEED, error) &&
           override_open(&s->options->materials, &s->world, &s->materials, error) &&
           open_devices(s, error);
}

static void close_scene(bench_scene *s) {
    for (int i = DEVICE_FIRST; i < DEVICES; i++)
        renderer_destroy(s->renderers[i]);
    override_free(&s->materials);
    for (int i = DEVICE_FIRST; i < DEVICES; i++)
        render_device_close(&s->devices[i]);
    scene_free(&s->world);
    shade_field_destroy(s->field);
    for (int n = 0; n <= LMP_BANDS_MAX; n++)
        lmp_preintegrated_lobe_destroy(s->lobes[n]);
}

/* Checks what the table of options cannot express. */
static int check_options(const cli_command *command, const bench_options *o,
                         const bench_plan *plan) {
    if (plan->case_count == 0)
        return cli_usage(command, "nothing runs by --method %s --device %s --bands %d%s",
                         bench_methods()[o->method], bench_devices()[o->device], o->bands,
                         o->materials.count ? " with --material" : "");
    if (o->materials.count && o->full && !o->scene)
        return cli_usage(command, "--material is of one scene: name it by --scene");
    return BASE_OK;
}

int bench_gpu(const cli_command *command, const bench_options *o) {
    base_error error = { "" };
    const int scenes = o->full && !o->scene ? SCENES : 1;
    bench_plan plan = { .end_ms = (double)INFINITY };
    plan_cases(&plan, o);
    const int status = check_options(command, o, &plan);
    if (status != BASE_OK)
        return status;
    plan_rows(&plan, o);
    plan.rows_ahead *= scenes;
    if (o->seconds || !o->full)
        plan.end_ms = now_ms() + 1e3 * (o->seconds ? o->seconds : SECONDS);
    bool ok = true, first = true;
    for (int i = 0; i < scenes && ok; i++) {
        bench_scene s = {
            .options = o, .plan = &plan, .name = o->scene ? o->scene : all_scenes[i], .first = first
        };
        ok = open_scene(&s, &error);
        if (ok && i == 0)
            bench_print_header(&s);
        ok = ok && time_all(&s, &error);
        first = s.first;
        close_scene(&s);
    }
    if (o->json && ok)
        printf("\n  ]\n}\n");
    if (plan.rows_skipped)
        base_note(NULL, "%d rows left out for want of time (--time): %s", plan.rows_skipped,
                  plan.skipped);
    return ok ? BASE_OK : base_report(&error);
}
