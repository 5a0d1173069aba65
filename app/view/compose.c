/* SPDX-License-Identifier: MIT */
#include "app/view/compose.h"

#include <stdlib.h>
#include <string.h>

static unsigned char difference(unsigned char a, unsigned char b) {
    const int gained = abs(a - b) * GPU_DIFFERENCE_GAIN;
    return (unsigned char)(gained < 255 ? gained : 255);
}

/* Composes the sides into rgb8, which has the layout's size, as the sides have. */
static void compose(const view_side_image sides[2], const gpu_layout *layout, unsigned char *rgb8) {
    const size_t width = (size_t)layout->width, count = width * (size_t)layout->height;
    const unsigned char *first = sides[0].rgb8, *second = sides[1].rgb8;
    if (layout->split == GPU_SPLIT_NONE || !second) {
        memcpy(rgb8, first, 3 * count);
        return;
    }
    for (size_t i = 0; i < 3 * count; i++) {
        const bool right = (float)(i / 3 % width) + 0.5f >= layout->divider * (float)layout->width;
        rgb8[i] = layout->split == GPU_SPLIT_DIFFERENCE ? difference(first[i], second[i])
                  : right                               ? second[i]
                                                        : first[i];
    }
}

void view_images_free(view_images *images) {
    gpu_screen_destroy(images->screen);
    free(images->sides[0].rgb8);
    free(images->sides[1].rgb8);
}

bool view_images_take(view_images *images, int number, any_renderer *renderer,
                      const render_frame *frame, const image_display *display, base_error *error) {
    view_side_image *side = &images->sides[number];
    if (images->screen && renderer->gl) {
        gpu_screen_take(images->screen, renderer->gl, number, display);
        return true;
    }
    free(side->rgb8);
    *side = (view_side_image) { frame->width, frame->height,
                                malloc(3 * (size_t)frame->width * (size_t)frame->height) };
    return side->rgb8 ? renderer_read_rgb8(renderer, display, side->rgb8, NULL, error)
                      : base_fail(error, NULL, "out of memory");
}

void view_images_put(view_images *images, bool good) {
    for (int i = 0; i < 2 && images->screen; i++) {
        view_side_image *side = &images->sides[i];
        if (good && side->rgb8)
            gpu_screen_put(images->screen, i, side->width, side->height, side->rgb8);
        free(side->rgb8);
        side->rgb8 = NULL;
    }
}

static gpu_layout layout_of(const view_settings *settings, float line, int seen) {
    return (gpu_layout) {
        settings->width, settings->height, settings->split, settings->divider, line, seen
    };
}

void view_images_show(const view_images *images, const view_settings *settings, float line,
                      int seen) {
    const gpu_layout layout = layout_of(settings, line, seen);
    gpu_screen_show(images->screen, &layout);
}

bool view_images_write(const view_images *images, const view_settings *settings, const char *path,
                       base_error *error) {
    const gpu_layout layout = layout_of(settings, 0, 0);
    unsigned char *rgb8 = malloc(3 * (size_t)settings->width * (size_t)settings->height);
    if (!rgb8)
        return base_fail(error, path, "out of memory");
    bool ok = true;
    if (images->screen)
        ok = gpu_screen_read(images->screen, &layout, rgb8, error);
    else
        compose(images->sides, &layout, rgb8);
    ok = ok && view_write_shot(settings, rgb8, path, error);
    free(rgb8);
    return ok;
}
