/* SPDX-License-Identifier: MIT */
/* device.h - shading on the CPU: the G-buffer's pixels through the library's batch kernels, on all
 * cores; and the responses both devices read, cached on disk. */
#ifndef LAMPION_DEVICE_H
#define LAMPION_DEVICE_H

#include "app/gpu/gpu.h"
#include "app/material/material.h"

/* Where the shading of a frame runs. */
typedef enum device_kind { DEVICE_AUTO, DEVICE_GPU, DEVICE_CPU, DEVICES } device_kind;
extern const char *const device_names[DEVICES + 1]; /* NULL-terminated */

/* The names of lmp_window by its values, NULL-terminated. */
extern const char *const device_window_names[];

/* The most bands a method takes there; 0 where it does not run: the CPU has zonal and
 * preintegrated.
 */
int device_bands_max(device_kind device, gpu_method method);

/* AUTO: the GPU; but the CPU, if it has the method, where OpenGL is software or the bands are too
 * many for a shader. */
device_kind device_choose(device_kind wanted, const gpu_context *context, gpu_method method,
                          int bands);

/* Images ask more of lobes than the default: beside a highlight of ten times white, half a
 * percent of it shows. */
#define DEVICE_LOBES_ERROR 0.002f

/* The response of so many bands from the cache, or computed on all cores with a progress bar and
 * cached. Free with lmp_preintegrated_lobe_destroy. */
bool device_preintegrated_lobe(int bands, lmp_window window, lmp_preintegrated_lobe **response,
                               cli_error *error);

/* The same of a material's table: NULL where it has none that fits (an anisotropic one has a
 * dimension more), which it says on stderr. Free with lmp_preintegrated_brdf_destroy. */
bool device_preintegrated_brdf(const material *material, const lmp_brdf_table *table,
                               lmp_preintegrated_brdf **response, cli_error *error);

/* gpu_frame.host: shades the frame by its method, bands, window, lights and response. */
bool device_shade(const gpu_frame *frame, const gpu_gbuffer *gbuffer, float *rgba,
                  cli_error *error);

#endif
