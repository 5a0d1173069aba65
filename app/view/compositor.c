/* SPDX-License-Identifier: MIT */
#include "app/view/compositor.h"
#include "app/render/renderer/bounces.h"
#include "app/render/renderer/shadows.h"
#include "app/render/shade_field.h"
#include "app/view/lobes.h"
#include "app/view/materials.h"
#include "app/view/preview.h"
#include "app/view/surroundings.h"

#include <stdlib.h>
#include <string.h>

/* From so many triangles on, a software device draws a coarser scene, with so many cells along its
 * diagonal, while things move. */
enum { PREVIEW_TRIANGLES = 50000, PREVIEW_CELLS = 300 };

/* The quality of an image: fine; coarse while the camera rests; coarse and with fewer triangles
 * while it moves. */
typedef enum quality { FINE, RESTING, MOVING, QUALITIES } quality;
enum { CPU = QUALITIES, RENDERERS };

/* The renderers and the field of one side, and the materials that its renderers have. */
typedef struct side {
    any_renderer *renderers[RENDERERS]; /* on the GPU; on the CPU, for all qualities */
    shade_field *field;                 /* for its method, or NULL */
    view_materials materials;
} side;

struct view_compositor {
    render_device gpu, cpu; /* cpu once something is drawn there; gpu not without OpenGL */
    const scene *world;
    view_tree *tree;           /* of the scene, or NULL */
    view_work *work;           /* or NULL */
    render_progress *progress; /* of what is being drawn by `work`, else NULL */
    scene preview;             /* without vertices, the scene itself is drawn instead */
    view_images images;
    side sides[2];
    shadow *shadows;
    transfer *bounces; /* once light bounces */
    view_surroundings surroundings;
    scene_light *lit; /* the settings' lights and the environment's suns, or NULL */
    view_lobes lobes;
    scene_camera camera; /* of the last preview */
};

view_compositor *view_compositor_create(const gpu_context *context, const scene *world,
                                        view_tree *tree, view_work *work, base_error *error) {
    view_compositor *s = calloc(1, sizeof *s);
    if (!s) {
        base_fail(error, NULL, "out of memory");
        return NULL;
    }
    s->world = world;
    s->tree = tree;
    s->work = work;
    if (!context)
        return s;
    render_device_adopt(context, world, &s->gpu);
    s->images.screen = gpu_screen_create(error);
    if (!s->images.screen) {
        view_compositor_destroy(s);
        return NULL;
    }
    return s;
}

static void close_side(side *own) {
    for (int i = 0; i < RENDERERS; i++)
        renderer_destroy(own->renderers[i]);
    shade_field_destroy(own->field);
    view_materials_free(&own->materials);
    memset(own, 0, sizeof *own);
}

void view_compositor_destroy(view_compositor *s) {
    if (!s)
        return;
    close_side(&s->sides[0]);
    close_side(&s->sides[1]);
    view_lobes_free(&s->lobes);
    shadow_destroy(s->shadows);
    transfer_destroy(s->bounces);
    environment_free(&s->surroundings.around);
    free(s->lit);
    view_images_free(&s->images);
    render_device_close(&s->gpu);
    render_device_close(&s->cpu);
    view_preview_free(&s->preview);
    free(s);
}

void view_compositor_inherit(view_compositor *s, view_compositor *before) {
    const view_images own = s->images;
    s->images = before->images;
    before->images = own;
}

/* --- fields ----------------------------------------------------------------------------------- */

/* Makes a field for so many bands, or frees it if the method reads none. */
static bool prepare_field(view_compositor *s, side *own, const view_shading *shading,
                          render_frame *frame, base_error *error) {
    const shade_field_options options = { .error = SHADE_FIELD_ERROR,
                                          .moves = true,
                                          .bytes_max =
                                              s->images.screen ? s->gpu.gl.storage_max : 0 };
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

static bool has_materials(const view_compositor *s, const side *own, const view_settings *settings,
                          const view_shading *shading) {
    return view_materials_match(&own->materials, s->world, settings, shading);
}

static bool apply_materials(view_compositor *s, side *own, const view_materials *materials,
                            base_error *error) {
    bool ok = true;
    for (int i = 0; i < RENDERERS && ok; i++)
        ok = !own->renderers[i] ||
             override_apply(&materials->made, s->world, own->renderers[i], error);
    return ok;
}

/* Makes the materials of a side, whose tables are known to fit its renderers. */
static bool prepare_materials(view_compositor *s, side *own, const view_settings *settings,
                              const view_shading *shading, base_error *error) {
    view_materials fresh;
    if (has_materials(s, own, settings, shading))
        return true;
    if (!view_materials_make(s->world, settings, shading, &fresh, error))
        return false;
    if (!apply_materials(s, own, &fresh, error)) { /* keep the earlier ones */
        base_error ignored;
        apply_materials(s, own, &own->materials, &ignored);
        view_materials_free(&fresh);
        return false;
    }
    view_materials_free(&own->materials);
    own->materials = fresh;
    if (own == s->sides) { /* by whose materials light bounces */
        transfer_destroy(s->bounces);
        s->bounces = NULL;
    }
    return true;
}

const char *view_compositor_pending(view_compositor *s, const view_settings *settings) {
    const int sides = view_sides(settings);
    for (int i = 0; i < sides; i++) {
        const view_shading *shading = &settings->shading[i];
        if (!has_materials(s, &s->sides[i], settings, shading))
            return "projecting the materials …";
        if (view_is_preintegrated(shading) && !view_lobes_have(&s->lobes, shading))
            return "integrating the lobes …";
    }
    if (settings->shadows && !s->shadows)
        return "sorting the triangles for shadows …";
    if (settings->bounces > 0 && !s->bounces)
        return "casting rays between surfaces …";
    return NULL;
}

/* --- drawing ---------------------------------------------------------------------------------- */

static bool has_preview(const view_compositor *s) {
    return s->gpu.gl.software && s->world->index_count / 3 > PREVIEW_TRIANGLES;
}

/* Chooses the quality of a preview. With shadows or bounces the scene is not simplified, because
 * triangles that stand for many would block light from each other. */
static quality choose_quality(const view_compositor *s, const view_settings *settings, bool rests) {
    return rests || settings->shadows || settings->bounces > 0 || !has_preview(s) ? RESTING
                                                                                  : MOVING;
}

/* Gives a renderer the materials and environment that its side already has. */
static bool prepare_renderer(view_compositor *s, side *own, any_renderer *renderer,
                             base_error *error) {
    if (!renderer)
        return false;
    renderer_set_environment(renderer, &s->surroundings.around);
    return !override_is_needed(own->materials.of.count, s->world) ||
           override_apply(&own->materials.made, s->world, renderer, error);
}

/* Returns the tree of the scene, or NULL: devices then build their own. */
static const trace_bvh *shared_tree(const view_compositor *s) {
    return s->tree ? view_tree_wait(s->tree) : NULL;
}

/* Opens one of a side's renderers: that of a quality on the GPU, or CPU. */
static any_renderer *open_renderer(view_compositor *s, side *own, int which, base_error *error) {
    any_renderer **const renderer = &own->renderers[which];
    if (*renderer)
        return *renderer;
    if (which == CPU && !s->cpu.cpu &&
        !render_device_open_cpu(s->world, shared_tree(s), &s->cpu, error))
        return NULL;
    if (which == MOVING && !s->preview.vertices &&
        !view_preview_make(s->world, PREVIEW_CELLS, &s->preview, error))
        return NULL;
    render_device device = which == CPU ? s->cpu : s->gpu;
    if (which == MOVING)
        device.scene = &s->preview;
    *renderer = renderer_create(&device, error);
    return prepare_renderer(s, own, *renderer, error) ? *renderer : NULL;
}

static bool has_areas(const view_settings *settings) {
    return scene_find_area(settings->lights, settings->light_count);
}

static device_kind device_of(const view_settings *settings, const view_shading *shading,
                             bool shines, bool software) {
    const method_needs needs = { .bands = shading->bands,
                                 .tables = settings->materials.count > 0 && shines,
                                 .areas = has_areas(settings),
                                 .software = software };
    return method_device(shading->method, DEVICE_AUTO, &needs);
}

bool view_compositor_does_without(const view_settings *settings) {
    const int sides = view_sides(settings);
    bool without = true;
    for (int i = 0; i < sides; i++)
        without = without && device_of(settings, &settings->shading[i], true, true) == DEVICE_CPU;
    return without;
}

/* Returns the renderer that draws a side by the settings' method. */
static any_renderer *open_side(view_compositor *s, side *own, const view_settings *settings,
                               const view_shading *shading, quality fineness, base_error *error) {
    const bool shines = environment_shines(&s->surroundings.around);
    const bool on_cpu =
        !s->images.screen || device_of(settings, shading, shines, s->gpu.gl.software) == DEVICE_CPU;
    return open_renderer(s, own, on_cpu ? CPU : (int)fineness, error);
}

/* Whether the tables of all sides' materials fit their renderers. */
static bool fit_materials(view_compositor *s, const view_settings *settings, quality fineness,
                          base_error *error) {
    const int sides = view_sides(settings);
    for (int i = 0; i < sides; i++) {
        const view_shading *shading = &settings->shading[i];
        if (has_materials(s, &s->sides[i], settings, shading))
            continue;
        any_renderer *renderer = open_side(s, &s->sides[i], settings, shading, fineness, error);
        if (!renderer || !view_materials_fit(s->world, settings, shading, renderer, error))
            return false;
    }
    return true;
}

bool view_compositor_fits(view_compositor *s, const view_settings *settings) {
    base_error ignored;
    return fit_materials(s, settings, FINE, &ignored);
}

static int bands_of(const view_settings *settings) {
    const int first = settings->shading[0].bands, second = settings->shading[1].bands;
    return first > second ? first : second;
}

static bool has_environment(const view_compositor *s, const view_settings *settings) {
    const environment *around = &s->surroundings.around;
    return view_surroundings_match(&s->surroundings, settings) &&
           (!environment_shines(around) || around->bands >= bands_of(settings));
}

/* Opens the environment of the settings, with coefficients for both sides. */
static bool prepare_environment(view_compositor *s, const view_settings *settings,
                                base_error *error) {
    environment *around = &s->surroundings.around;
    const bool same = view_surroundings_match(&s->surroundings, settings);
    if (has_environment(s, settings))
        return true;
    for (int i = 0; i < 2; i++) {
        const side *own = &s->sides[i];
        for (int k = 0; k < RENDERERS; k++)
            if (own->renderers[k])
                renderer_set_environment(own->renderers[k], around);
    }
    if (!same && (!view_surroundings_open(&s->surroundings, settings, s->world, error) ||
                  (s->shadows && !shadow_surround(s->shadows, around, error))))
        return false;
    if (!same && s->bounces)
        transfer_relight(s->bounces);
    return environment_project(around, bands_of(settings), error);
}

/* Returns the device whose tree rays are cast by. */
static render_device *tracing_device(view_compositor *s) {
    if (s->cpu.cpu)
        return &s->cpu;
    render_device_lend(&s->gpu, shared_tree(s));
    return &s->gpu;
}

static bool prepare_shadows(view_compositor *s, const view_settings *settings, render_pass *pass,
                            base_error *error) {
    static const shadow_settings quick = { .sparse = true, .apart = true };
    if (!settings->shadows)
        return true;
    if (!s->shadows)
        s->shadows =
            render_device_shadow(tracing_device(s), &s->surroundings.around, &quick, error);
    if (s->shadows)
        *pass = shadow_pass(s->shadows);
    return s->shadows;
}

static bool prepare_bounces(view_compositor *s, const view_settings *settings,
                            render_bounces *bounces, base_error *error) {
    const transfer_settings how = { .bounces = settings->bounces,
                                    .shadows = settings->shadows,
                                    .quick = true,
                                    .around = &s->surroundings.around };
    if (settings->bounces == 0)
        return true;
    if (!s->bounces)
        s->bounces =
            render_device_transfer(tracing_device(s), &s->sides[0].materials.made, &how, error);
    if (!s->bounces)
        return false;
    transfer_set(s->bounces, &how);
    *bounces = transfer_bounces(s->bounces);
    return true;
}

static bool add_suns(view_compositor *s, render_frame *frame, base_error *error) {
    if (!s->lit && !(s->lit = calloc(SCENE_LIGHTS_MAX, sizeof *s->lit)))
        return base_fail(error, NULL, "out of memory");
    frame->lights = memcpy(s->lit, frame->lights, frame->light_count * sizeof *s->lit);
    frame->light_count = environment_add_suns(&s->surroundings.around, s->lit, frame->light_count);
    return true;
}

/* Fills in the frame that draws a side; a preview, with divisor > 1, has one sample. */
static bool fill_frame(view_compositor *s, const view_settings *settings,
                       const view_shading *shading, int divisor, render_frame *frame,
                       base_error *error) {
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
        .progress = s->progress,
    };
    memcpy(frame->background, settings->background, sizeof frame->background);
    if (view_is_preintegrated(shading))
        frame->lobes = view_lobes_get(&s->lobes, shading, error);
    return (!view_is_preintegrated(shading) || frame->lobes) &&
           (s->surroundings.around.sun_count == 0 || add_suns(s, frame, error));
}

/* Prepares all that draws a side, whose tables are known to fit, but for its shadows. */
static bool prepare_side(view_compositor *s, int number, const view_settings *settings, int divisor,
                         render_frame *frame, base_error *error) {
    side *own = &s->sides[number];
    const view_shading *shading = &settings->shading[number];
    return prepare_materials(s, own, settings, shading, error) &&
           fill_frame(s, settings, shading, divisor, frame, error) &&
           prepare_field(s, own, shading, frame, error) &&
           prepare_bounces(s, settings, &frame->bounces, error);
}

/* --- beside the window ------------------------------------------------------------------------ */

static bool has_gpu_renderers(const side *own) {
    bool some = false;
    for (int i = 0; i < QUALITIES; i++)
        some = some || own->renderers[i];
    return some;
}

/* Whether these settings are drawn, whatever their environment is found to be, without OpenGL, for
 * which alone the window's thread is needed. */
static bool needs_no_window(const view_compositor *s, const view_settings *settings) {
    const int sides = view_sides(settings);
    bool without = has_environment(s, settings) ||
                   !(has_gpu_renderers(&s->sides[0]) || has_gpu_renderers(&s->sides[1]));
    for (int i = 0; i < sides && without; i++) {
        const side *own = &s->sides[i];
        const view_shading *shading = &settings->shading[i];
        const bool software = s->gpu.gl.software;
        without = device_of(settings, shading, false, software) == DEVICE_CPU &&
                  device_of(settings, shading, true, software) == DEVICE_CPU &&
                  (has_materials(s, own, settings, shading) || !has_gpu_renderers(own));
    }
    return without;
}

/* Runs a task, beside the window if it can. */
static bool run(view_compositor *s, const view_settings *settings, bool (*task)(void *of),
                void *of) {
    view_work *work = s->work && needs_no_window(s, settings) ? s->work : NULL;
    s->progress = work ? view_work_progress(work) : NULL;
    const bool ok = view_work_run(work, task, of);
    s->progress = NULL;
    return ok;
}

/* What to draw, as in view_compositor_draw. */
typedef struct drawing {
    view_compositor *compositor;
    const view_settings *settings;
    int divisor, index;
    view_statistics statistics;
    base_error *error;
} drawing;

static bool draw_sides(void *of) {
    drawing *d = of;
    view_compositor *s = d->compositor;
    const view_settings *settings = d->settings;
    const int divisor = d->divisor, index = d->index;
    view_statistics *statistics = &d->statistics;
    const image_display display = { .exposure = settings->exposure, .tone = settings->tone };
    base_error *error = d->error;
    const int sides = view_sides(settings);
    const bool rests = memcmp(&s->camera, &settings->camera, sizeof s->camera) == 0;
    const quality fineness = divisor > 1 ? choose_quality(s, settings, rests) : FINE;
    s->camera = settings->camera;
    if (!prepare_environment(s, settings, error) || !fit_materials(s, settings, fineness, error))
        return false;
    for (int i = 0; i < sides; i++) {
        render_frame frame;
        render_times times;
        any_renderer *const renderer =
            open_side(s, &s->sides[i], settings, &settings->shading[i], fineness, error);
        if (!renderer || !prepare_side(s, i, settings, divisor, &frame, error) ||
            !prepare_shadows(s, settings, &frame.shadow, error))
            return false;
        frame.keep_geometry = renderer->cpu ? rests : fineness == RESTING && s->gpu.gl.software;
        if (index < 0 ? !renderer_draw(renderer, &frame, &times, error)
                      : !renderer_refine(renderer, &frame, index, &times, error))
            return false;
        if (!view_images_take(&s->images, i, renderer, &frame, &display, error))
            return false;
        statistics->times.surfaces += times.surfaces;
        statistics->times.shade += times.shade;
        statistics->times.transfer += times.transfer;
        statistics->times.shadow += times.shadow;
        statistics->times.bounces += times.bounces;
        statistics->times.total += times.total;
        statistics->width = frame.width;
        statistics->height = frame.height;
        if (i == 0)
            statistics->device = renderer->cpu ? DEVICE_CPU : DEVICE_GPU;
    }
    return true;
}

bool view_compositor_draw(view_compositor *s, const view_settings *settings, int divisor, int index,
                          view_statistics *statistics, base_error *error) {
    drawing d = { s, settings, divisor, index, { .width = 0 }, error };
    const bool ok = run(s, settings, draw_sides, &d);
    view_images_put(&s->images, ok);
    if (ok)
        *statistics = d.statistics;
    return ok;
}

/* What to expose, and how. */
typedef struct exposing {
    view_compositor *compositor;
    const view_settings *settings;
    float exposure;
    base_error *error;
} exposing;

static bool find_exposure(void *of) {
    exposing *e = of;
    view_compositor *s = e->compositor;
    const view_settings *settings = e->settings;
    base_error *error = e->error;
    render_frame frame;
    any_renderer *renderer;
    image pixels;
    if (!prepare_environment(s, settings, error) || !fit_materials(s, settings, FINE, error) ||
        !(renderer = open_side(s, &s->sides[0], settings, settings->shading, FINE, error)) ||
        !prepare_side(s, 0, settings, 1, &frame, error))
        return false;
    e->exposure = environment_exposure(&s->surroundings.around, settings->light_count);
    if (e->exposure > 0)
        return true;
    if (!renderer_meter(renderer, &frame, &pixels, error))
        return false;
    e->exposure = image_auto_exposure(&pixels);
    image_free(&pixels);
    return true;
}

bool view_compositor_expose(view_compositor *s, const view_settings *settings, float *exposure,
                            base_error *error) {
    exposing e = { s, settings, 0, error };
    if (!run(s, settings, find_exposure, &e))
        return false;
    *exposure = e.exposure;
    return true;
}

/* Rays that tell how much of a light arrives at a point, and how many all lights may send. */
enum { SPLIT_RAYS = 1024, SPLIT_RAYS_ALL = 1 << 17 };

/* Makes the shadows of lights, and those of the environment alone. */
static bool open_split_shadows(view_compositor *s, size_t light_count, shadow *shadows[2],
                               base_error *error) {
    const size_t most = SPLIT_RAYS_ALL / (light_count + 1);
    const shadow_settings many = { .rays = most > SPLIT_RAYS ? SPLIT_RAYS
                                           : most > 1        ? (int)most
                                                             : 1,
                                   .raw = true,
                                   .apart = true };
    shadows[0] = render_device_shadow(&s->cpu, NULL, &many, error);
    shadows[1] = render_device_shadow(&s->cpu, &s->surroundings.around, &many, error);
    return shadows[0] && shadows[1];
}

bool view_compositor_split(view_compositor *s, const view_settings *settings, int number, int x,
                           int y, cpu_split *split, size_t *light_count, base_error *error) {
    side *own = &s->sides[number];
    shadow *shadows[2] = { NULL, NULL };
    render_frame frame;
    render_pass around = { .run = NULL };
    bool ok = prepare_environment(s, settings, error) && open_renderer(s, own, CPU, error) &&
              prepare_side(s, number, settings, 1, &frame, error);
    if (ok && settings->shadows &&
        (ok = open_split_shadows(s, frame.light_count, shadows, error))) {
        frame.shadow = shadow_pass(shadows[0]);
        around = shadow_pass(shadows[1]);
    }
    if (ok) {
        frame.samples = 1;
        *light_count = frame.light_count;
        ok = renderer_split(own->renderers[CPU], &frame, x, y, &around, split, error);
    }
    shadow_destroy(shadows[0]);
    shadow_destroy(shadows[1]);
    return ok;
}

const view_images *view_compositor_images(const view_compositor *s) {
    return &s->images;
}
