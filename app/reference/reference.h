/* SPDX-License-Identifier: MIT */
/* reference.h - ground truth: direct lighting by glowing spheres, by Monte Carlo in double.
 *
 * It judges the program, so it uses no kernel, shading method, light or table of the library: of
 * <lampion/…> it takes types, and lmp_brdf_eval_double of a source BRDF. */
#ifndef LAMPION_REFERENCE_H
#define LAMPION_REFERENCE_H

#include "app/environment/environment.h"
#include "app/image/image.h"
#include "app/reference/lobe.h"
#include "app/scene/scene.h"

typedef struct reference_settings {
    int width, height;
    scene_camera camera;
    int rays;      /* camera rays per pixel, spread over it; 0 or 1: one through its center */
    int samples;   /* light samples per camera ray; the most if error > 0 */
    int shard[2];  /* part I of N: every N-th sample of these, from I - 1 on; N 0: all of them */
    double error;  /* stop a ray when its standard error falls below this part of it; 0: off */
    uint64_t seed; /* of the noise: the same seed gives the same bits on any thread count */
    int threads;   /* 0 means all cores */
    bool shadows;  /* whether triangles hide lights from each other */
    const environment *environment;  /* or NULL: none */
    reference_band_limit band_limit; /* band limit of the lobes, as render has it; zero: none */
    const reference_material_source *materials; /* instead of the scene's, one for each of them;
                                                   NULL: none */
} reference_settings;

/* How many samples a camera ray takes: all, or those of the shard. */
int reference_samples(const reference_settings *settings);

/* Radiance through the center of every pixel, or the mean over its square, and the standard error
 * of the light samples. Triangles and the glowing spheres are seen; where there is neither, the
 * backdrop of the environment is, or nothing. Both images are created here; free them. Shows
 * progress. */
bool reference_render(const scene *scene, const reference_settings *settings, image *radiance,
                      image *standard_error, cli_error *error);

/* What an image's exposure is found by, as render finds it: light that surfaces reflect, without
 * shadows, lamps, what glows and the backdrop. *pixels is created. */
bool reference_meter(const scene *scene, const reference_settings *settings, image *pixels,
                     cli_error *error);

#endif
