/* SPDX-License-Identifier: MIT */
#include "app/view/compositor.h"
#include "app/view/view.h"

bool view_render(const view_settings *settings, const char *device, const char *path,
                 cli_error *error) {
    scene world;
    gpu_context context = { .display = NULL };
    view_compositor *compositor = NULL;
    view_statistics statistics;
    if (!image_check_path(path, error) ||
        !scene_load(settings->scene, &(scene_options) { .up = settings->up }, &world, error))
        return false;
    const bool ok = gpu_context_create(device, &context, error) &&
                    (compositor = view_compositor_create(&context, &world, error)) &&
                    view_compositor_draw(compositor, settings, &statistics, error) &&
                    view_compositor_write(compositor, settings, path, error);
    view_compositor_destroy(compositor);
    gpu_context_destroy(&context);
    scene_free(&world);
    return ok;
}
