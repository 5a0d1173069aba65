/* SPDX-License-Identifier: MIT */
#include "app/render/renderer/renderer.h"
#include "app/view/compositor.h"
#include "app/view/nodes.h"
#include "app/view/view.h"

/* Opens OpenGL if a side requires it; otherwise *context stays zero, and the CPU draws. */
static bool open_context(const view_settings *settings, const char *device, gpu_context *context,
                         base_error *error) {
    if (!device && !render_finds_gpu() && view_compositor_does_without(settings))
        return true;
    return gpu_context_create(device, context, error);
}

bool view_render(view_settings *settings, const char *device, const char *path, base_error *error) {
    scene world, *part = NULL;
    gpu_context context = { .display = NULL };
    view_compositor *compositor = NULL;
    view_statistics statistics;
    const scene_options load = { .up = settings->up,
                                 .leaves = settings->leaves,
                                 .variant = view_variant(settings) };
    if (!image_check_path(path, error) || !scene_load(settings->scene, &load, &world, error))
        return false;
    view_settings_rebase(settings, world.origin);
    const bool ok = (part = view_part_make(&world, settings, error)) &&
                    open_context(settings, device, &context, error) &&
                    (compositor = view_compositor_create(context.display ? &context : NULL, part,
                                                         NULL, NULL, error)) &&
                    view_compositor_draw(compositor, settings, 1, -1, &statistics, error) &&
                    view_images_write(view_compositor_images(compositor), settings, path, error);
    view_compositor_destroy(compositor);
    gpu_context_destroy(&context);
    view_part_free(part);
    scene_free(&world);
    return ok;
}
