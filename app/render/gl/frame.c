/* SPDX-License-Identifier: MIT */
/* Fills the shaders' block of a frame: its camera and sample. */
#include "app/render/gl/frame.h"

#include <math.h>
#include <string.h>

static float dot(const float a[3], const float b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

float gpu_depth_reach(const scene *bounds, const render_camera *camera) {
    float reach = camera->near;
    for (int corner = 0; camera->parallel && corner < 8; corner++) {
        float at[3];
        for (int i = 0; i < 3; i++)
            at[i] = (corner >> i & 1 ? bounds->maximum : bounds->minimum)[i] - camera->eye[i];
        reach = fmaxf(reach, dot(at, camera->forward));
    }
    return reach;
}

/* Computes the rows of the clip matrix: x right, y down (row 0 of an image is its top), depth =
 * near / distance, w = distance; for parallel rays depth = 1 - distance / (2 farthest), w = 1. */
static void fill_clip(shared_frame *b, float half_width, float half_height) {
    const bool parallel = b->forward[3] > 0;
    float rows[4][4] = { { 0 } };
    for (int i = 0; i < 3; i++) {
        rows[2][i] = parallel ? -0.5f / b->eye[3] * b->forward[i] : 0;
        rows[3][i] = parallel ? 0 : b->forward[i];
        rows[0][i] = b->right[i] / (half_width * half_width) - b->jitter[0] * rows[3][i];
        rows[1][i] = b->down[i] / (half_height * half_height) - b->jitter[1] * rows[3][i];
    }
    const float constant[4] = { parallel ? -b->jitter[0] : 0, parallel ? -b->jitter[1] : 0,
                                parallel ? 1 : b->eye[3], parallel ? 1 : 0 };
    for (int row = 0; row < 4; row++) {
        rows[row][3] = constant[row] - dot(rows[row], b->eye);
        for (int column = 0; column < 4; column++)
            b->clip_from_world[4 * column + row] = rows[row][column];
    }
}

void gpu_fill_frame(const scene *bounds, const gpu_environment *around, const gpu_lights *lights,
                    const render_frame *frame, const render_camera *camera, shared_frame *block) {
    const float half_height = 0.5f * scene_camera_height(&frame->camera, 1);
    const float half_width = half_height * (float)frame->width / (float)frame->height;
    memset(block, 0, sizeof *block);
    memcpy(block->eye, camera->eye, sizeof camera->eye);
    memcpy(block->forward, camera->forward, sizeof camera->forward);
    memcpy(block->right, camera->right, sizeof camera->right);
    memcpy(block->down, camera->down, sizeof camera->down);
    block->eye[3] = gpu_depth_reach(bounds, camera);
    block->forward[3] = camera->parallel ? 1 : 0;
    memcpy(block->background, frame->background, sizeof frame->background);
    block->background[3] = camera->far < INFINITY ? camera->far : 0;
    gpu_environment_describe(around, frame, block->surroundings);
    block->size_lights[0] = (float)frame->width;
    block->size_lights[1] = (float)frame->height;
    block->size_lights[2] = (float)lights->shaded;
    block->size_lights[3] = (float)lights->area_count;
    block->jitter[0] = camera->jitter[0];
    block->jitter[1] = camera->jitter[1];
    block->jitter[2] = (float)camera->sample;
    block->jitter[3] = (float)camera->samples;
    fill_clip(block, half_width, half_height);
}

/* Computes a depth as camera.glsl does. */
float gpu_depth_of(const shared_frame *block, float distance) {
    const float reach = block->eye[3];
    if (!(distance > 0))
        return 0;
    return block->forward[3] == 0 ? reach / distance
           : distance < reach     ? 1 - 0.5f * distance / reach
                                  : 0.5f * reach / distance;
}
