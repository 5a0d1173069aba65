/* SPDX-License-Identifier: MIT */
/* reference.h - ground truth: the light of lights of every kind, direct and after bounces, computed
 * by Monte Carlo integration in double precision.
 *
 * It judges the program, so it uses no kernel, shading method, light or table of the library: from
 * <lampion/…> it takes only types, and lmp_brdf_eval_double for source BRDFs. */
#ifndef LAMPION_TRUTH_REFERENCE_H
#define LAMPION_TRUTH_REFERENCE_H

#include "app/image/image.h"
#include "app/scene/environment.h"
#include "app/scene/scene.h"
#include "app/truth/reference_lobe.h"

typedef struct reference_settings {
    int width, height;
    scene_camera camera;
    int rays;      /* per pixel, spread over it; 0 or 1: one through its center */
    int samples;   /* light samples per camera ray; the maximum if error > 0 */
    int shard[2];  /* part I of N: every N-th sample from number I - 1 on; N = 0: all */
    double error;  /* stop when a ray's relative standard error falls below this; 0: off */
    uint64_t seed; /* of the noise: a seed gives the same bits for any number of threads */
    int threads;   /* 0 means all cores */
    bool shadows;  /* whether triangles block light */
    bool metering; /* whether they block only light that bounces, as reference_meter has it */
    int bounces;   /* how often light is reflected on its way to the seen surface; not with a band
                    * limit */
    const environment *environment;  /* NULL: none */
    reference_band_limit band_limit; /* band limit of the BRDF, as in render; zero: none */
    const reference_material_source *materials; /* one per scene material, to replace it; or NULL */
} reference_settings;

/* Returns the number of samples per camera ray: all, or those of the shard. */
int reference_samples(const reference_settings *settings);

/* Computes the radiance at the center of every pixel, or the mean over the pixel, and the standard
 * error of the light samples. The image shows triangles and visible lights and, behind them, the
 * backdrop of the environment or nothing. Both images are created here and freed by the caller.
 * Progress is shown. */
bool reference_render(const scene *scene, const reference_settings *settings, image *radiance,
                      image *standard_error, base_error *error);

/* Computes the image from which the exposure is determined, as `lampion render` does: the light
 * that surfaces reflect, after bounces as well, without shadows of direct light, visible lights,
 * emission or the backdrop. *pixels is created here. */
bool reference_meter(const scene *scene, const reference_settings *settings, image *pixels,
                     base_error *error);

#endif
