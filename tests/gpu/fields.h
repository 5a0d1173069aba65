/* SPDX-License-Identifier: MIT */
/* fields.h - a scene under many lights, and its images by a field. */
#ifndef LAMPION_TESTS_GPU_FIELDS_H
#define LAMPION_TESTS_GPU_FIELDS_H

#include "app/render/shade.h"
#include "app/render/shade_field.h"
#include "tests/gpu/difference.h"
#include "tests/oracle/kinds.h"

enum { WIDTH = 240, HEIGHT = 136 };

static scene world;

static inline void open_world(const char *name, int lights) {
    base_error error = { "" };
    expect(scene_load(name, &(scene_options) { .no_cache = true }, &world, &error), &error);
    expect(scene_apply_lights(
               &world, &(scene_lights_options) { .random_count = lights, .seed = 7, .hide = true },
               &error),
           &error);
    stand_within(&world, 0);
}

static inline shade_field *open_field_within(int bands, bool moves, size_t bytes_max) {
    base_error error = { "" };
    const shade_field_options options = { .error = SHADE_FIELD_ERROR,
                                          .moves = moves,
                                          .bytes_max = bytes_max };
    shade_field *field = shade_field_create(&world, &options, bands, &error);
    expect(field != NULL, &error);
    return field;
}

static inline shade_field *open_field(int bands, bool moves) {
    return open_field_within(bands, moves, 0);
}

static inline image render_by(gpu_renderer *renderer, render_frame *frame, method_kind method,
                              shade_field *field) {
    frame->method = method;
    shade_field_attach(field, frame);
    return render_image(renderer, frame);
}

/* Opens balls under lights of every kind: one is the same from everywhere, one also ambient, one a
 * spot. */
static inline void open_every_kind(void) {
    open_world("builtin:balls", 20);
    for (int i = 0; i < KINDS; i++)
        world.lights[world.light_count++].emitter = one_of_each_kind[i];
}

/* The library's image and the shader's by one field, which has but the nodes that the camera sees
 * before all of them are wanted. */
static inline difference devices_differ(gpu_renderer *renderer, render_frame *frame,
                                        shade_field *field) {
    frame->cpu_shader = shade_frame;
    image on_cpu = render_by(renderer, frame, METHOD_FIELD, field);
    frame->cpu_shader = NULL;
    image on_device = render_by(renderer, frame, METHOD_FIELD, field);
    const difference d = differ(&on_device, &on_cpu);
    image_free(&on_cpu);
    image_free(&on_device);
    return d;
}

#endif
