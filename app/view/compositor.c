/* SPDX-License-Identifier: MIT */
#include "app/view/compositor.h"
#include "app/override/override.h"
#include "app/render/shade/field.h"
#include "app/render/shadow/shadow.h"
#include "app/view/compose.h"
#include "app/view/draft.h"
#include "app/view/lobes.h"
#include "app/view/surroundings.h"

#include <stdlib.h>
#include <string.h>

/* From so many triangles on a software device draws a coarser scene while things move. */
enum { DRAFT_TRIANGLES = 50000, DRAFT_CELLS = 300 };

/* In full; coarse while the camera rests; coarse and of fewer triangles while it moves. */
typedef enum quality { FINE, RESTING, MOVING, QUALITIES } quality;

/* One side's renderers and field, and the materials that they have been given. */
typedef struct side {
    any_renderer *renderers[QUALITIES],
        *cpu;           /* on the GPU; on the CPU, which draws all qualities */
    shade_field *field; /* of its method, or NULL */
    override_set materials;
    char (*names)[VIEW_MATERIAL_SIZE]; /* of them, RENDER_TABLES_MAX allocated */
    int count, bands;
    lmp_window window;
    bool preintegrated;
} side;

struct view_compositor {
    render_device gpu, cpu; /* the second once something is drawn there; without OpenGL, not the
                               first */
    const scene *world;
    scene draft; /* without vertices: the scene itself serves */
    gpu_screen *screen;
    view_side shown[2]; /* of the sides, without a screen */
    side sides[2];
    shadow *shadows;
    view_surroundings surroundings;
    scene_light *lit; /* the settings' lights and the environment's suns, or NULL */
    view_lobes lobes;
    scene_camera camera; /* of the last draft */
};

view_compositor *view_compositor_create(const gpu_context *context, const scene *world,
                                        cli_error *error) {
    view_compositor *s = calloc(1, sizeof *s);
    if (!s) {
        cli_fail(error, NULL, "out of memory");
        return NULL;
    }
    s->world = world;
    if (!context)
        return s;
    render_device_adopt(context, world, &s->gpu);
    s->screen = gpu_screen_create(error);
    if (!s->screen) {
        view_compositor_destroy(s);
        return NULL;
    }
    return s;
}

static void close_side(side *own) {
    for (int i = 0; i < QUALITIES; i++)
        renderer_destroy(own->renderers[i]);
    renderer_destroy(own->cpu);
    shade_field_destroy(own->field);
    override_free(&own->materials);
    free(own->names);
    memset(own, 0, sizeof *own);
}

void view_compositor_destroy(view_compositor *s) {
    if (!s)
        return;
    close_side(&s->sides[0]);
    close_side(&s->sides[1]);
    view_lobes_free(&s->lobes);
    shadow_destroy(s->shadows);
    environment_free(&s->surroundings.around);
    free(s->lit);
    gpu_screen_destroy(s->screen);
    free(s->shown[0].rgb8);
    free(s->shown[1].rgb8);
    render_device_close(&s->gpu);
    render_device_close(&s->cpu);
    view_draft_free(&s->draft);
    free(s);
}

gpu_screen *view_compositor_screen(view_compositor *s) {
    return s->screen;
}

/* --- fields ----------------------------------------------------------------------------------- */

/* One for so many bands, or NULL where the method reads none. */
static bool settle_field(view_compositor *s, side *own, const view_shading *shading,
                         render_frame *frame, cli_error *error) {
    const shade_field_options options = { .error = SHADE_FIELD_ERROR,
                                          .moves = true,
                                          .bytes_max = s->screen ? s->gpu.gl.storage_max : 0 };
    const bool read = method_table[shading->method].reads & METHOD_READS_FIELD;
    if (own->field &&
        !(read && shade_field_describe(own->field).info.desc.bands == shading->bands)) {
        shade_field_destroy(own->field);
        own->field = NULL;
    }
    if (read && !own->field)
        own->field = shade_field_create(s->world, &options, shading->bands, error);
    shade_field_attach(own->field, frame);
    return own->field || !read;
}

/* --- materials -------------------------------------------------------------------------------- */

static bool is_preintegrated(const view_shading *shading) {
    return method_table[shading->method].reads & METHOD_READS_PREINTEGRATED;
}

static bool has_materials(const view_compositor *s, const side *own, const view_settings *settings,
                          const view_shading *shading) {
    return own->count == settings->material_count &&
           (!override_is_needed(own->count, s->world) ||
            (own->bands == shading->bands && own->window == shading->window &&
             own->preintegrated == is_preintegrated(shading) &&
             memcmp(own->names, settings->materials, (size_t)own->count * sizeof *own->names) ==
                 0));
}

static bool apply_materials(view_compositor *s, side *own, const override_set *materials,
                            cli_error *error) {
    bool ok = !own->cpu || override_apply(materials, s->world, own->cpu, error);
    for (int i = 0; i < QUALITIES && ok; i++)
        ok = !own->renderers[i] || override_apply(materials, s->world, own->renderers[i], error);
    return ok;
}

static bool settle_materials(view_compositor *s, side *own, const view_settings *settings,
                             const view_shading *shading, cli_error *error) {
    override_set fresh = { .count = 0 };
    cli_list list = { .count = settings->material_count };
    if (has_materials(s, own, settings, shading))
        return true;
    if (!own->names && !(own->names = calloc(RENDER_TABLES_MAX, sizeof *own->names)))
        return cli_fail(error, NULL, "out of memory");
    for (int i = 0; i < list.count; i++)
        list.items[i] = settings->materials[i];
    bool ok =
        override_open(&list, s->world, &fresh, error) &&
        override_fits(&fresh, shading->bands, shading->method, own->renderers, QUALITIES, error) &&
        override_bake(&fresh, shading->bands, shading->window, error) &&
        override_bake_fibers(&fresh, s->world, shading->bands, shading->window, error) &&
        (!is_preintegrated(shading) || override_preintegrate(&fresh, error));
    ok = ok && apply_materials(s, own, &fresh, error);
    if (!ok) { /* as before, for what is drawn next */
        cli_error ignored;
        apply_materials(s, own, &own->materials, &ignored);
        override_free(&fresh);
        return false;
    }
    override_free(&own->materials);
    own->materials = fresh;
    own->count = settings->material_count;
    own->bands = shading->bands;
    own->window = shading->window;
    own->preintegrated = is_preintegrated(shading);
    memcpy(own->names, settings->materials, (size_t)own->count * sizeof *own->names);
    return true;
}

const char *view_compositor_pending(view_compositor *s, const view_settings *settings) {
    const int sides = settings->split == GPU_SPLIT_NONE ? 1 : 2;
    for (int i = 0; i < sides; i++) {
        const view_shading *shading = &settings->shading[i];
        if (!has_materials(s, &s->sides[i], settings, shading))
            return "projecting the materials …";
        if (is_preintegrated(shading) && !view_lobes_have(&s->lobes, shading))
            return "integrating the lobes …";
    }
    if (settings->shadows && !s->shadows)
        return "sorting the triangles for shadows …";
    return NULL;
}

/* --- drawing ---------------------------------------------------------------------------------- */

static bool has_draft(const view_compositor *s) {
    return s->gpu.gl.software && s->world->index_count / 3 > DRAFT_TRIANGLES;
}

/* Of a draft. Triangles that stand for many would hide light from each other. */
static quality choose_quality(const view_compositor *s, const view_settings *settings, bool rests) {
    return rests || settings->shadows || !has_draft(s) ? RESTING : MOVING;
}

/* What a renderer is told that its side has been given before. */
static bool prepare_renderer(view_compositor *s, side *own, any_renderer *renderer,
                             cli_error *error) {
    if (!renderer)
        return false;
    renderer_set_environment(renderer, &s->surroundings.around);
    return !override_is_needed(own->count, s->world) ||
           override_apply(&own->materials, s->world, renderer, error);
}

static bool open_cpu(view_compositor *s, side *own, cli_error *error) {
    if (own->cpu)
        return true;
    if (!s->cpu.cpu && !render_device_open(DEVICE_CPU, NULL, s->world, &s->cpu, error))
        return false;
    own->cpu = renderer_create(&s->cpu, error);
    return prepare_renderer(s, own, own->cpu, error);
}

static bool open_gpu(view_compositor *s, side *own, quality fineness, cli_error *error) {
    any_renderer **const renderer = &own->renderers[fineness];
    render_device device = s->gpu;
    if (*renderer)
        return true;
    const bool simplify = fineness == MOVING;
    if (simplify && !s->draft.vertices && !view_draft_make(s->world, DRAFT_CELLS, &s->draft, error))
        return false;
    if (simplify)
        device.scene = &s->draft;
    *renderer = renderer_create(&device, error);
    return prepare_renderer(s, own, *renderer, error);
}

static device_kind device_of(const view_settings *settings, const view_shading *shading,
                             bool shines, bool software) {
    const bool tables = settings->material_count > 0 && shines;
    return method_device(shading->method, DEVICE_AUTO, tables, software, shading->bands);
}

bool view_compositor_does_without(const view_settings *settings) {
    const int sides = settings->split == GPU_SPLIT_NONE ? 1 : 2;
    bool without = true;
    for (int i = 0; i < sides; i++)
        without = without && device_of(settings, &settings->shading[i], true, true) == DEVICE_CPU;
    return without;
}

/* The renderer that draws a side, by the settings' method. */
static any_renderer *open_side(view_compositor *s, side *own, const view_settings *settings,
                               const view_shading *shading, quality fineness, cli_error *error) {
    const bool shines = environment_shines(&s->surroundings.around);
    if (!s->screen || device_of(settings, shading, shines, s->gpu.gl.software) == DEVICE_CPU)
        return open_cpu(s, own, error) ? own->cpu : NULL;
    return open_gpu(s, own, fineness, error) ? own->renderers[fineness] : NULL;
}

/* Opens the environment of the settings, with the coefficients of both sides. */
static bool settle_environment(view_compositor *s, const view_settings *settings,
                               cli_error *error) {
    const int first = settings->shading[0].bands, second = settings->shading[1].bands;
    const int bands = first > second ? first : second;
    environment *around = &s->surroundings.around;
    const bool same = view_surroundings_match(&s->surroundings, settings);
    if (same && (!environment_shines(around) || around->bands >= bands))
        return true;
    for (int i = 0; i < 2; i++) {
        const side *own = &s->sides[i];
        if (own->cpu)
            renderer_set_environment(own->cpu, around);
        for (int k = 0; k < QUALITIES; k++)
            if (own->renderers[k])
                renderer_set_environment(own->renderers[k], around);
    }
    if (!same && (!view_surroundings_open(&s->surroundings, settings, s->world, error) ||
                  (s->shadows && !shadow_surround(s->shadows, around, error))))
        return false;
    return environment_project(around, bands, error);
}

static bool settle_shadows(view_compositor *s, const view_settings *settings, render_pass *pass,
                           cli_error *error) {
    static const shadow_settings quick = { .sparse = true, .apart = true };
    if (!settings->shadows)
        return true;
    if (!s->shadows)
        s->shadows = shadow_create(s->world, render_device_bvh(s->cpu.cpu ? &s->cpu : &s->gpu),
                                   &s->surroundings.around, &quick, error);
    *pass = (render_pass) { shadow_frame, s->shadows };
    return s->shadows;
}

static bool add_suns(view_compositor *s, render_frame *frame, cli_error *error) {
    if (!s->lit && !(s->lit = calloc(SCENE_LIGHTS_MAX, sizeof *s->lit)))
        return cli_fail(error, NULL, "out of memory");
    frame->lights = memcpy(s->lit, frame->lights, frame->light_count * sizeof *s->lit);
    frame->light_count = environment_add_suns(&s->surroundings.around, s->lit, frame->light_count);
    return true;
}

/* How to draw a side: how many samples come from what samples counts. */
static bool fill_frame(view_compositor *s, const view_settings *settings,
                       const view_shading *shading, int divisor, render_frame *frame,
                       cli_error *error) {
    *frame = (render_frame) {
        .width = settings->width > divisor ? settings->width / divisor : 1,
        .height = settings->height > divisor ? settings->height / divisor : 1,
        .camera = settings->camera,
        .method = shading->method,
        .bands = shading->bands,
        .window = shading->window,
        .lights = settings->lights,
        .light_count = settings->light_count,
        .samples = divisor > 1 ? 1 : settings->samples,
        .samples_exposure = settings->exposure,
    };
    memcpy(frame->background, settings->background, sizeof frame->background);
    if (is_preintegrated(shading))
        frame->lobes = view_lobes_get(&s->lobes, shading, error);
    return (!is_preintegrated(shading) || frame->lobes) &&
           (s->surroundings.around.sun_count == 0 || add_suns(s, frame, error));
}

/* Takes a side's image for the screen, or for a file without one. */
static bool show_side(view_compositor *s, const view_settings *settings, any_renderer *renderer,
                      const render_frame *frame, int number, cli_error *error) {
    const image_display display = { .exposure = settings->exposure, .tone = settings->tone };
    view_side *shown = &s->shown[number];
    if (s->screen)
        return renderer_show(renderer, s->screen, number, &display) ||
               cli_fail(error, NULL, "out of memory");
    free(shown->rgb8);
    *shown = (view_side) { frame->width, frame->height,
                           malloc(3 * (size_t)frame->width * (size_t)frame->height) };
    return shown->rgb8 ? renderer_read_rgb8(renderer, &display, shown->rgb8, NULL, error)
                       : cli_fail(error, NULL, "out of memory");
}

/* Sample `index`, or with -1 all. */
static bool draw(view_compositor *s, const view_settings *settings, int divisor, int index,
                 view_statistics *statistics, cli_error *error) {
    const int sides = settings->split == GPU_SPLIT_NONE ? 1 : 2;
    const bool rests = memcmp(&s->camera, &settings->camera, sizeof s->camera) == 0;
    const quality fineness = divisor > 1 ? choose_quality(s, settings, rests) : FINE;
    s->camera = settings->camera;
    memset(statistics, 0, sizeof *statistics);
    if (!settle_environment(s, settings, error))
        return false;
    for (int i = 0; i < sides; i++) {
        side *own = &s->sides[i];
        const view_shading *shading = &settings->shading[i];
        render_frame frame;
        render_times times;
        any_renderer *const renderer = open_side(s, own, settings, shading, fineness, error);
        if (!renderer || !settle_materials(s, own, settings, shading, error) ||
            !fill_frame(s, settings, shading, divisor, &frame, error) ||
            !settle_field(s, own, shading, &frame, error) ||
            !settle_shadows(s, settings, &frame.shadow, error))
            return false;
        frame.keep_geometry = renderer->cpu ? rests : fineness == RESTING && s->gpu.gl.software;
        if (index < 0 ? !renderer_draw(renderer, &frame, &times, error)
                      : !renderer_refine(renderer, &frame, index, &times, error))
            return false;
        if (!show_side(s, settings, renderer, &frame, i, error))
            return false;
        statistics->times.surfaces += times.surfaces;
        statistics->times.shade += times.shade;
        statistics->times.transfer += times.transfer;
        statistics->times.shadow += times.shadow;
        statistics->times.total += times.total;
        statistics->width = frame.width;
        statistics->height = frame.height;
        if (i == 0)
            statistics->device = renderer->cpu ? DEVICE_CPU : DEVICE_GPU;
    }
    return true;
}

bool view_compositor_draw(view_compositor *s, const view_settings *settings,
                          view_statistics *statistics, cli_error *error) {
    return draw(s, settings, 1, -1, statistics, error);
}

bool view_compositor_draft(view_compositor *s, const view_settings *settings, int divisor,
                           view_statistics *statistics, cli_error *error) {
    return draw(s, settings, divisor, 0, statistics, error);
}

bool view_compositor_refine(view_compositor *s, const view_settings *settings, int index,
                            view_statistics *statistics, cli_error *error) {
    return draw(s, settings, 1, index, statistics, error);
}

bool view_compositor_expose(view_compositor *s, const view_settings *settings, float *exposure,
                            cli_error *error) {
    const view_shading *shading = &settings->shading[0];
    render_frame frame;
    any_renderer *renderer;
    image pixels;
    side *own = &s->sides[0];
    if (!settle_environment(s, settings, error) ||
        !(renderer = open_side(s, own, settings, shading, FINE, error)) ||
        !settle_materials(s, own, settings, shading, error) ||
        !fill_frame(s, settings, shading, 1, &frame, error) ||
        !settle_field(s, own, shading, &frame, error))
        return false;
    *exposure = environment_exposure(&s->surroundings.around, settings->light_count);
    if (*exposure > 0)
        return true;
    if (!renderer_meter(renderer, &frame, &pixels, error))
        return false;
    *exposure = image_auto_exposure(&pixels);
    image_free(&pixels);
    return true;
}

static gpu_layout layout_of(const view_settings *settings, float line) {
    return (gpu_layout) { settings->width, settings->height, settings->split, settings->divider,
                          line };
}

void view_compositor_show(view_compositor *s, const view_settings *settings, float line) {
    const gpu_layout layout = layout_of(settings, line);
    gpu_screen_show(s->screen, &layout);
}

bool view_compositor_write(view_compositor *s, const view_settings *settings, const char *path,
                           cli_error *error) {
    const gpu_layout layout = layout_of(settings, 0);
    unsigned char *rgb8 = malloc(3 * (size_t)settings->width * (size_t)settings->height);
    if (!rgb8)
        return cli_fail(error, path, "out of memory");
    bool ok = true;
    if (s->screen)
        ok = gpu_screen_read(s->screen, &layout, rgb8, error);
    else
        view_compose(s->shown, &layout, rgb8);
    ok = ok && view_write_shot(settings, rgb8, path, error);
    free(rgb8);
    return ok;
}
