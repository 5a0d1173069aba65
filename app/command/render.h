/* SPDX-License-Identifier: MIT */
/* render.h - the options and the state of `lampion render`, and its --stats. */
#ifndef LAMPION_COMMAND_RENDER_H
#define LAMPION_COMMAND_RENDER_H

#include "app/base/cli.h"
#include "app/render/renderer/bounces.h"
#include "app/render/renderer/override.h"
#include "app/render/renderer/renderer.h"
#include "app/render/renderer/shadows.h"
#include "app/render/shade_field.h"
#include "app/scene/animation.h"
#include "app/scene/environment.h"
#include "app/view/settings.h"

#define RENDER_REPEAT_MAX 1000

/* The options of the command line. */
typedef struct render_options {
    const char *output, *device, *animate, *from;
    int size[2], bands, method_choice, window, tone, device_kind, repeat, samples;
    view_shot_options shot;  /* for `from` */
    method_kind method;      /* by the choice and the bands, whatever the lights */
    int frames[2], shard[2]; /* first and last; part and number of parts */
    float exposure, stops, fps, background[3];
    int bounces;
    bool exposure_given, frames_given, shard_given, background_given, samples_given, stats, compare;
    shadow_options shadow;
    environment_options environment;
    shade_field_options field;
    scene_camera_options camera;
    scene_lights_options lights;
    cli_list materials;
    scene_options load;
} render_options;

/* The state of rendering. */
typedef struct render_job {
    const render_options *options;
    scene world;
    environment around;
    render_device device;
    any_renderer *renderer;
    render_frame frame;
    method_work work;              /* for estimates of the methods' cost */
    method_kind method;            /* for these lights on that device */
    lmp_preintegrated_lobe *lobes; /* for methods that read lobes */
    shade_field *field;            /* for methods that read a field */
    shadow *shadow;                /* NULL without shadows */
    transfer *bounces;             /* NULL without bounces */
    animation *path;               /* of the lights */
    scene_light *moved;
    override_set materials;
    image_display display;
    image_lit lit; /* from which the exposure was determined */
} render_job;

/* Measures the frame again and prints statistics of what was drawn, as JSON. */
bool render_print_stats(render_job *job, base_error *error);

#endif
