/* SPDX-License-Identifier: MIT */
#include "app/command/render.h"
#include "app/base/progress.h"
#include "app/command/command.h"
#include "app/image/sequence.h"
#include "app/scene/bake.h"
#include "app/view/view.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SAMPLES_MAX = 1024, FRAME_MAX = 99999, PATH_SIZE = 4096 };

static void name_frame(const render_options *o, int index, char path[PATH_SIZE]) {
    if (o->frames_given)
        image_sequence_name(o->output, index, path, PATH_SIZE);
    else
        snprintf(path, PATH_SIZE, "%s", o->output);
}

/* --- one image -------------------------------------------------------------------------------- */

/* Writes linear radiance, or what the format makes of it. */
static bool write_radiance(const render_job *j, const char *path, base_error *error) {
    image pixels;
    if (!renderer_read_image(j->renderer, &pixels, error))
        return false;
    image_make_finite(&pixels, path);
    const bool ok = image_write(&pixels, path, &j->display, error);
    image_free(&pixels);
    return ok;
}

static bool write_png(const render_job *j, const char *path, base_error *error) {
    const int width = j->frame.width, height = j->frame.height;
    unsigned char *rgb8 = malloc(3 * (size_t)width * (size_t)height);
    if (!rgb8)
        return base_fail(error, path, "out of memory");
    const bool ok = renderer_read_rgb8(j->renderer, &j->display, rgb8, NULL, error) &&
                    image_write_png8(rgb8, width, height, path, error);
    free(rgb8);
    return ok;
}

/* Moves the lights to their positions at the time of a sequence's frame. */
static void move_lights(render_job *j, int index) {
    if (!j->options->frames_given)
        return;
    animation_move_all(j->path, &j->world, (double)index / (double)j->options->fps, j->moved);
    j->frame.lights = j->moved;
}

static void set_exposure(render_job *j, float factor) {
    j->display.exposure = factor * image_exposure_of_stops(j->options->stops);
    if (image_format_of(j->options->output) == IMAGE_PNG)
        j->frame.samples_exposure = j->display.exposure;
}

static float expose(void *job, const image *pixels) {
    render_job *j = job;
    j->lit = image_measure_lit(pixels);
    set_exposure(j, image_auto_exposure(pixels));
    return j->frame.samples_exposure;
}

/* Determines the exposure. That of frame 0 is used for all, whichever are rendered here, so that a
 * sequence does not flicker; if frame 0 is drawn, it is found on the way. The studio has an
 * exposure of its own. */
static bool choose_exposure(render_job *j, int first, base_error *error) {
    const render_options *o = j->options;
    const float factor =
        o->exposure_given ? o->exposure : environment_exposure(&j->around, j->world.light_count);
    j->display.tone = o->tone;
    if (factor > 0)
        set_exposure(j, factor);
    else if (first == 0)
        renderer_set_meter(j->renderer, (render_meter) { expose, j });
    else {
        image pixels;
        move_lights(j, 0);
        if (!renderer_meter(j->renderer, &j->frame, &pixels, error))
            return false;
        expose(j, &pixels);
        image_free(&pixels);
    }
    return true;
}

static bool draw_frame(render_job *j, int index, base_error *error) {
    char path[PATH_SIZE];
    name_frame(j->options, index, path);
    move_lights(j, index);
    if (!renderer_draw(j->renderer, &j->frame, NULL, error))
        return false;
    renderer_set_meter(j->renderer, (render_meter) { NULL, NULL });
    return image_format_of(path) == IMAGE_PNG ? write_png(j, path, error)
                                              : write_radiance(j, path, error);
}

/* Finds the frames of a shard, first <= frame < end: consecutive runs whose lengths differ by at
 * most one. */
static void split_frames(const render_options *o, int *first, int *end) {
    const int64_t count = o->frames[1] - o->frames[0] + 1;
    *first = o->frames[0] + (int)(count * (o->shard[0] - 1) / o->shard[1]);
    *end = o->frames[0] + (int)(count * o->shard[0] / o->shard[1]);
}

/* Notes the names of the frames if FILE has no place for the number: users would look for another
 * name. */
static void tell_names(const render_options *o, int first, int end) {
    char names[2][PATH_SIZE];
    if (!o->frames_given || first == end || image_sequence_has_number(o->output))
        return;
    image_sequence_name(o->output, first, names[0], sizeof names[0]);
    image_sequence_name(o->output, end - 1, names[1], sizeof names[1]);
    const bool several = end - first > 1;
    base_note(NULL, "writing %s%s%s (%%04d in -o says where the number goes)", names[0],
              several ? " … " : "", several ? names[1] : "");
}

static bool render_frames(render_job *j, base_error *error) {
    int first, end;
    split_frames(j->options, &first, &end);
    tell_names(j->options, first, end);
    bool ok = choose_exposure(j, first, error);
    for (int i = first; i < end && ok; i++) {
        progress_show("rendering", (double)(i - first) / (double)(end - first));
        ok = draw_frame(j, i, error);
    }
    progress_end();
    return ok;
}

/* --- the command ------------------------------------------------------------------------------ */

/* Whether the frame is drawn, or timed, by a method that reads such data. */
static bool reads(const render_job *j, unsigned what) {
    return j->options->compare || method_table[j->method].reads & what;
}

/* Prepares the lobes and the field that the method reads. */
static bool prepare_tables(render_job *j, base_error *error) {
    const render_options *o = j->options;
    if (reads(j, METHOD_READS_PREINTEGRATED) &&
        !bake_lobes(o->bands, (lmp_window)o->window, &j->lobes, error))
        return false;
    if (reads(j, METHOD_READS_FIELD) && o->bands <= LMP_FIELD_BANDS_MAX) {
        shade_field_options options = o->field;
        options.bytes_max = render_device_field_bytes(&j->device);
        j->field = shade_field_create(&j->world, &options, o->bands, error);
        if (!j->field)
            return false;
    }
    j->frame.lobes = j->lobes;
    shade_field_attach(j->field, &j->frame);
    return true;
}

static bool is_layered(const scene *world) {
    for (size_t i = 0; i < world->material_count; i++)
        if (scene_is_layered(&world->materials[i]))
            return true;
    return false;
}

/* Chooses the method with the least cost for so many lights. A field is not considered for tables
 * and layers, at which it sums all lights; it holds no areas. */
static void choose_method(render_job *j) {
    const render_options *o = j->options;
    const bool by_lobes = o->materials.count == 0 && !is_layered(&j->world);
    const size_t held =
        j->world.light_count - scene_count_areas(j->world.lights, j->world.light_count);
    j->work = (method_work) { held, o->bands, (double)o->size[0] * o->size[1] };
    if (o->method_choice == 0 && j->device.kind == DEVICE_CPU && by_lobes)
        j->method = method_for_lights(j->method, &j->work);
    j->frame.method = j->method;
}

static bool has_areas(const render_job *j) {
    return scene_find_area(j->world.lights, j->world.light_count);
}

/* Chooses the device for a method, assuming that OpenGL is `software`. Methods are compared on a
 * device that runs all of them. */
static device_kind choose_device(const render_job *j, bool software) {
    const render_options *o = j->options;
    const method_needs needs = { .bands = o->bands,
                                 .tables = o->materials.count > 0 && environment_shines(&j->around),
                                 .areas = has_areas(j),
                                 .software = software && !o->compare };
    return method_device(j->method, (device_kind)o->device_kind, &needs);
}

static bool runs_on_cpu(const render_job *j) {
    return j->options->bands <= method_table[j->method].bands_max[DEVICE_CPU];
}

/* Opens the device. Without a GPU, no OpenGL is loaded if the CPU draws the method. */
static bool open_device(render_job *j, base_error *error) {
    const render_options *o = j->options;
    device_kind kind = choose_device(j, !o->device && !render_finds_gpu());
    if (render_device_open(kind, o->device, &j->world, &j->device, error)) {
        if (kind == DEVICE_CPU || choose_device(j, j->device.gl.software) == kind)
            return true;
    } else if (kind == DEVICE_CPU || o->device_kind != DEVICE_AUTO || o->device || !runs_on_cpu(j))
        return false;
    render_device_close(&j->device);
    return render_device_open(DEVICE_CPU, NULL, &j->world, &j->device, error);
}

/* Chooses the device, and then the method and its tables. */
static bool prepare_device(render_job *j, base_error *error) {
    const render_options *o = j->options;
    j->method = o->method;
    if (!open_device(j, error))
        return false;
    if (o->bands > method_table[j->method].bands_max[j->device.kind])
        return base_fail(error, NULL, "%d bands are too many for %s on the GPU (take --device cpu)",
                         o->bands, method_table[j->method].name);
    choose_method(j);
    return prepare_tables(j, error);
}

static bool cast_shadows(render_job *j, base_error *error) {
    if (!shadow_wanted(&j->options->shadow, &j->around, &j->world))
        return true;
    j->shadow = render_device_shadow(&j->device, &j->around, &j->options->shadow.settings, error);
    j->frame.shadow = shadow_pass(j->shadow);
    return j->shadow != NULL;
}

static bool bounce_light(render_job *j, base_error *error) {
    if (j->options->bounces == 0)
        return true;
    const transfer_settings settings = { .bounces = j->options->bounces,
                                         .shadows = j->shadow != NULL,
                                         .around = &j->around };
    j->bounces = render_device_transfer(&j->device, &j->materials, &settings, error);
    if (j->bounces)
        j->frame.bounces = transfer_bounces(j->bounces);
    return j->bounces != NULL;
}

static int default_samples(const render_options *o) {
    return image_format_of(o->output) == IMAGE_EXR ? 1 : 8;
}

static bool open_job(const char *name, render_job *j, base_error *error) {
    const render_options *o = j->options;
    char path[PATH_SIZE];
    name_frame(o, 0, path);
    if (!image_check_path(path, error) || !scene_load(name, &o->load, &j->world, error) ||
        !scene_apply_lights(&j->world, &o->lights, error) ||
        !environment_open(&o->environment, &j->world, &j->around, error) ||
        !environment_extract_suns(&j->around, error) ||
        !environment_project(&j->around, o->bands, error) ||
        !animation_open(o->animate, &j->world, &j->path, error) ||
        !scene_place_camera(&j->world, &o->camera, o->size, &j->frame.camera, error) ||
        !prepare_device(j, error))
        return false;
    /* Suns come after the scene's own lights, because paths refer to these by their numbers. */
    j->world.light_count = environment_add_suns(&j->around, j->world.lights, j->world.light_count);
    j->renderer = renderer_create(&j->device, error);
    if (j->renderer)
        renderer_set_environment(j->renderer, &j->around);
    j->frame.hide_backdrop = o->background_given;
    j->moved = calloc(SCENE_LIGHTS_MAX, sizeof *j->moved);
    j->frame.width = o->size[0];
    j->frame.height = o->size[1];
    j->frame.bands = o->bands;
    j->frame.window = (lmp_window)o->window;
    j->frame.samples = o->samples_given ? o->samples : default_samples(o);
    j->frame.lights = j->world.lights;
    j->frame.light_count = j->world.light_count;
    memcpy(j->frame.background, o->background, sizeof j->frame.background);
    if (j->renderer && !j->moved)
        return base_fail(error, NULL, "out of memory");
    return j->renderer && cast_shadows(j, error) &&
           override_prepare(&o->materials, &j->world, &j->frame, j->renderer, &j->materials,
                            error) &&
           bounce_light(j, error);
}

static void close_job(render_job *j) {
    transfer_destroy(j->bounces);
    shadow_destroy(j->shadow);
    renderer_destroy(j->renderer);
    override_free(&j->materials);
    render_device_close(&j->device);
    environment_free(&j->around);
    scene_free(&j->world);
    lmp_preintegrated_lobe_destroy(j->lobes);
    shade_field_destroy(j->field);
    free(j->moved);
    animation_close(j->path);
}

/* Chooses the method, and rejects what the table of options cannot. */
static int resolve_options(const cli_command *command, render_options *o, int operand_count) {
    o->method = method_chosen(o->method_choice, o->bands);
    const method_row *method = &method_table[o->method];
    const int bands_max = method->bands_max[o->device_kind];
    if (operand_count != 1 && !(o->from && operand_count == 0))
        return cli_usage(command, "one SCENE is needed, %d given", operand_count);
    if (!o->output)
        return cli_usage_output(command, "FILE");
    if (o->shard_given && !o->frames_given)
        return cli_usage(command, "--shard splits --frames, which is not there");
    if (image_format_of(o->output) == IMAGE_UNKNOWN)
        return cli_usage(command, "%s: unknown kind of image (name it .png or .exr)", o->output);
    if (strlen(o->output) > PATH_SIZE - 16)
        return cli_usage(command, "the name of the image is too long");
    if ((long)o->size[0] * o->size[1] > IMAGE_PIXELS_MAX)
        return cli_usage(command, "--size %dx%d: more than %d pixels", o->size[0], o->size[1],
                         IMAGE_PIXELS_MAX);
    if (o->from && image_format_of(o->output) != IMAGE_PNG)
        return cli_usage(command, "%s: --from makes a .png, as the screenshot is", o->output);
    if (o->animate && !o->frames_given)
        return cli_usage(command, "--animate moves lights from frame to frame: it needs --frames");
    if (bands_max == 0)
        return cli_usage(command, "--method %s does not run on the %s", method->name,
                         device_table[o->device_kind].text);
    if (o->bands > bands_max)
        return cli_usage(command, "--bands %d: %s takes 1 to %d", o->bands, method->name,
                         bands_max);
    return BASE_OK;
}

static int render(const render_options *o, const char *name) {
    base_error error = { "" };
    render_job all = { .options = o };
    const bool ok = open_job(name, &all, &error) && render_frames(&all, &error) &&
                    (!(o->stats || o->compare) || render_print_stats(&all, &error));
    close_job(&all);
    return ok ? BASE_OK : base_report(&error);
}

/* Renders a screenshot of the viewer again, of the same scene or another. */
static int repeat_shot(const render_options *o, const char *name) {
    base_error error = { "" };
    view_settings *settings = malloc(sizeof *settings);
    view_shot_options allowed = o->shot;
    allowed.scene = name;
    bool ok = (settings || base_fail(&error, NULL, "out of memory")) &&
              view_read_shot(o->from, &allowed, settings, &error);
    if (ok && name && strlen(name) >= sizeof settings->scene)
        ok = base_fail(&error, name, "is too long a name");
    if (ok && name)
        strcpy(settings->scene, name);
    ok = ok && view_render(settings, o->device, o->output, &error);
    free(settings);
    return ok ? BASE_OK : base_report(&error);
}

static const render_options defaults = { .size = { 1280, 720 },
                                         .bands = LMP_SHADE_BANDS_DEFAULT,
                                         .window = LMP_WINDOW_HANNING,
                                         .environment = ENVIRONMENT_DEFAULTS,
                                         .field = SHADE_FIELD_DEFAULTS,
                                         .shot.pixels_max = IMAGE_READ_PIXELS,
                                         .shard = { 1, 1 },
                                         .repeat = 5,
                                         .fps = 24 };

static int run(const cli_command *command, int argc, char **argv) {
    render_options o = defaults;
    const cli_option options[] = {
        { "output", 'o', CLI_TEXT, &o.output, "FILE",
          "the image: .png (tone-mapped) or .exr (linear)", 0, 0, NULL, NULL },
        { "size", 's', CLI_SIZE, o.size, "WxH", "pixels", 1, IMAGE_SIZE_MAX, NULL, NULL },
        { "bands", 'n', CLI_INT, &o.bands, "N",
          "number of bands: more of them show narrower highlights", 1, LMP_BANDS_MAX, NULL, NULL },
        METHOD_OPTION_ROW(o.method_choice),
        { "device", 0, CLI_CHOICE, &o.device_kind, "DEVICE", device_help(), 0, 0, device_names(),
          NULL },
        { "window", 0, CLI_CHOICE, &o.window, "WINDOW",
          "windowing filter: damps the ringing of a series of few bands", 0, 0,
          method_window_names(), NULL },
        SCENE_LIGHTS_OPTION_ROWS(o.lights),
        ENVIRONMENT_OPTION_ROWS(o.environment),
        ENVIRONMENT_GROUND_ROW(o.environment),
        SCENE_CAMERA_OPTION_ROWS(o.camera, o.load),
        SCENE_LOAD_OPTION_ROWS(o.load),
        OVERRIDE_OPTION_ROW(o.materials),
        IMAGE_DISPLAY_OPTION_ROWS(o.exposure, o.exposure_given, o.stops, o.tone),
        { "from", 0, CLI_TEXT, &o.from, "FILE",
          "repeat a screenshot of lampion view, with all its settings: only -o, --gl-device, "
          "--max-pixels and --allow-paths may be given beside it; without SCENE, its scene",
          0, 0, NULL, NULL },
        VIEW_SHOT_OPTION_ROWS(o.shot),
        { "background", 0, CLI_VEC3, o.background, "R,G,B",
          "radiance of the background, where no surface is", 0, 1e30, NULL, &o.background_given },
        { "frames", 0, CLI_RANGE, o.frames, "N|A-B",
          "render a sequence of images while the lights move: the first N frames, or A to B; %04d "
          "in FILE stands for the number, which otherwise follows the name: out_0000.png",
          0, FRAME_MAX, NULL, &o.frames_given },
        { "shard", 0, CLI_PART, o.shard, "I/N",
          "render part I of N of --frames alone, to split them among machines", 1, FRAME_MAX, NULL,
          &o.shard_given },
        ANIMATION_OPTION_ROWS(o.animate, o.fps),
        { "samples", 0, CLI_INT, &o.samples, "N",
          "samples per pixel; without it 8, or one in the center for a .exr, as in reference", 1,
          SAMPLES_MAX, NULL, &o.samples_given },
        SHADE_FIELD_OPTION_ROWS(o.field),
        SHADOW_OPTION_ROWS(o.shadow),
        BOUNCES_OPTION_ROW(o.bounces),
        { "stats", 0, CLI_FLAG, &o.stats, NULL,
          "print what was drawn and the time of each pass, of one sample or those of --samples, as "
          "JSON",
          0, 0, NULL, NULL },
        { "repeat", 0, CLI_INT, &o.repeat, "N", "frames whose median --stats takes", 1,
          RENDER_REPEAT_MAX, NULL, NULL },
        { "compare-methods", 0, CLI_FLAG, &o.compare, NULL,
          "let --stats measure every method in turn", 0, 0, NULL, NULL },
        { "gl-device", 0, CLI_TEXT, &o.device, "DEVICE",
          "the OpenGL device: a number, part of its name, or software", 0, 0, NULL, NULL },
        { .name = NULL },
    };
    int operand_count, status;
    char **operands;
    if (!cli_parse(command, options, argc, argv, &operand_count, &operands, &status))
        return status;
    status = resolve_options(command, &o, operand_count);
    if (status != BASE_OK)
        return status;
    return o.from ? repeat_shot(&o, operand_count ? operands[0] : NULL) : render(&o, operands[0]);
}

const cli_command command_render = {
    .name = "render",
    .operands = "SCENE",
    .summary = "draw a scene lit by sphere lights to an image",
    .examples =
        "lampion render builtin:atrium --random-lights 30 --seed 7 --bands 8 -o atrium.png\n"
        "lampion render scene.gltf --eye 0,2,5 --target 0,1,0 --size 1920x1080 -o scene.exr\n"
        "lampion render builtin:balls --frames 48 -o balls_%04d.png\n"
        "lampion render builtin:balls --frames 0-99 --shard 3/8 -o balls_%04d.png\n"
        "lampion render builtin:atrium --frames 192 --animate bounce -o bounce_%04d.png\n"
        "lampion render builtin:balls --bands 100 --method preintegrated -o balls.png\n"
        "lampion render builtin:atrium --stats --compare-methods -o atrium.png\n",
    .run = run,
    .kernels = true,
};
