/* SPDX-License-Identifier: MIT */
#include "app/view/stage.h"
#include "app/view/view.h"

bool view_render(const view_settings *settings, const char *device, const char *path,
                 cli_error *error) {
    scene world;
    gpu_context context = { .display = NULL };
    view_stage *stage = NULL;
    view_figures figures;
    if (!image_check_path(path, error) ||
        !scene_load(settings->scene, &(scene_options) { 0 }, &world, error))
        return false;
    const bool ok = gpu_context_create(device, &context, error) &&
                    (stage = view_stage_create(&context, &world, error)) &&
                    view_stage_draw(stage, settings, &figures, error) &&
                    view_stage_write(stage, settings, path, error);
    view_stage_destroy(stage);
    gpu_context_destroy(&context);
    scene_free(&world);
    return ok;
}
