/* SPDX-License-Identifier: MIT */
/* shade.h - frames shaded on the CPU: the G-buffer's pixels through the library, on all cores. */
#ifndef LAMPION_SHADE_FRAME_H
#define LAMPION_SHADE_FRAME_H

#include "app/device/device.h"
#include "app/render/gl/gpu.h"

/* render_frame.host of a frame that is shaded there: shade_frame, or NULL for a shader. */
render_shader shade_on(device_kind device);

/* Shades by the frame's method, bands, window, lights and lobes. */
bool shade_frame(const render_frame *frame, const gpu_gbuffer *gbuffer, float *rgba,
                 cli_error *error);

#endif
