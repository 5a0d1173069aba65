/* SPDX-License-Identifier: MIT */
/* compose.h - the images of one side or two, and what is made of them: one image, two side by side,
 * or their difference (shaders/program/compose.frag does the same in a window). */
#ifndef LAMPION_VIEW_COMPOSE_H
#define LAMPION_VIEW_COMPOSE_H

#include "app/render/renderer/renderer.h"
#include "app/view/settings.h"

typedef struct view_side_image {
    int width, height;
    unsigned char *rgb8; /* rows from the top */
} view_side_image;

/* The images of the sides; zero: none. */
typedef struct view_images {
    gpu_screen *screen; /* owned; NULL: nothing can be shown */
    view_side_image
        sides[2]; /* those of the CPU, until they are put on the screen, if there is one */
} view_images;

void view_images_free(view_images *images);

/* Takes a side's image from a renderer, whose frame is drawn; if that is a GPU's, puts it on the
 * screen. */
bool view_images_take(view_images *images, int side, any_renderer *renderer,
                      const render_frame *frame, const image_display *display, base_error *error);

/* Puts the images of the CPU on the screen, or drops them unless they are `good`. */
void view_images_put(view_images *images, bool good);

/* Show so many columns of the composed image, 0: all, with a line of that width at the divider, or
 * write it to a file. */
void view_images_show(const view_images *images, const view_settings *settings, float line,
                      int seen);
bool view_images_write(const view_images *images, const view_settings *settings, const char *path,
                       base_error *error);

#endif
