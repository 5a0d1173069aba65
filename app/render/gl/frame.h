/* SPDX-License-Identifier: MIT */
/* frame.h - the shaders' block of a frame: its camera and sample. */
#ifndef LAMPION_RENDER_GL_FRAME_H
#define LAMPION_RENDER_GL_FRAME_H

#include "app/render/camera.h"
#include "app/render/gl/environment.h"
#include "app/render/gl/light_buffer.h"
#include "shaders/program/shared.h"

/* Returns the distance that depths are relative to (camera.glsl): that of the near plane or, for
 * parallel rays, that of the farthest corner of the scene's bounds, which is above 0. */
float gpu_depth_reach(const scene *bounds, const render_camera *camera);

/* Fills the block for one sample, with lights that were uploaded. */
void gpu_fill_frame(const scene *bounds, const gpu_environment *around, const gpu_lights *lights,
                    const render_frame *frame, const render_camera *camera, shared_frame *block);

/* Returns the depth at a distance from the camera; 0 for a distance of 0, which means infinity. */
float gpu_depth_of(const shared_frame *block, float distance);

#endif
