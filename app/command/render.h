/* SPDX-License-Identifier: MIT */
/* render.h - what `lampion render` is told and holds while it draws, and what its --stats prints.
 */
#ifndef LAMPION_COMMAND_RENDER_H
#define LAMPION_COMMAND_RENDER_H

#include "app/animation/animation.h"
#include "app/environment/environment.h"
#include "app/override/override.h"
#include "app/render/renderer.h"
#include "app/render/shade/field.h"
#include "app/render/shadow/shadow.h"
#include "app/view/settings.h"

#define RENDER_REPEAT_MAX 1000

/* Everything the command line says. */
typedef struct render_options {
    const char *output, *device, *animate, *from;
    int size[2], bands, method_choice, window, tone, device_kind, repeat, samples;
    view_shot_options shot;  /* of `from` */
    method_kind method;      /* what the choice and the bands come to, whatever the lights */
    int frames[2], shard[2]; /* first and last; part and number of parts */
    float exposure, stops, fps, background[3];
    bool exposure_given, frames_given, shard_given, background_given, samples_given, stats, compare;
    shadow_options shadow;
    environment_options environment;
    shade_field_options field;
    scene_camera_options camera;
    scene_lights_options lights;
    cli_list materials;
    scene_options load;
} render_options;

/* Everything that is open while rendering. */
typedef struct render_job {
    const render_options *options;
    scene world;
    environment around;
    render_device device;
    any_renderer *renderer;
    render_frame frame;
    method_work work;              /* by which methods are estimated */
    method_kind method;            /* of these lights, on that device */
    lmp_preintegrated_lobe *lobes; /* of methods that read them */
    shade_field *field;            /* of methods that read one */
    shadow *shadow;                /* with --shadows */
    animation *path;               /* of the lights */
    scene_light *moved;
    override_set materials;
    image_display display;
    image_lit lit; /* what the exposure was found by */
} render_job;

/* Measures the frame again and prints what was drawn, as JSON. */
bool render_print_stats(render_job *job, cli_error *error);

#endif
