/* SPDX-License-Identifier: MIT */
/* What the shaders are told of a frame: its camera, sample and lights. */
#include "app/render/gl/block.h"
#include "app/render/gl/internal.h"

#include <math.h>
#include <string.h>

static void subtract(const float a[3], const float b[3], float difference[3]) {
    for (int i = 0; i < 3; i++)
        difference[i] = a[i] - b[i];
}

static void cross(const float a[3], const float b[3], float product[3]) {
    product[0] = a[1] * b[2] - a[2] * b[1];
    product[1] = a[2] * b[0] - a[0] * b[2];
    product[2] = a[0] * b[1] - a[1] * b[0];
}

static float dot(const float a[3], const float b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static bool scale_to(float v[3], float length) {
    const float current = sqrtf(dot(v, v));
    if (!(current > 0))
        return false;
    for (int i = 0; i < 3; i++)
        v[i] *= length / current;
    return true;
}

/* Sample `index` of `count` in its pixel, -0.5 … 0.5, by the two-dimensional golden ratio (Roberts
 * 2018). */
static void sample_offset(int index, int count, float offset[2]) {
    static const double steps[2] = { 0.7548776662466927, 0.5698402909980532 };
    for (int i = 0; i < 2; i++) {
        const double at = count > 1 ? 0.5 + steps[i] * index : 0.5;
        offset[i] = (float)(at - floor(at) - 0.5);
    }
}

/* Of the farthest triangle along the view; above 0. */
static float farthest(const gpu_renderer *r, const shared_frame *block) {
    float reach = r->near;
    for (int corner = 0; corner < 8; corner++) {
        float at[3];
        for (int i = 0; i < 3; i++)
            at[i] = (corner >> i & 1 ? r->maximum : r->minimum)[i] - block->eye[i];
        reach = fmaxf(reach, dot(at, block->forward));
    }
    return reach;
}

/* Rows of the clip matrix: x right, y down (row 0 of an image is its top), depth = near /
 * distance, w = distance; of parallel rays depth = 1 - distance / (2 farthest), w = 1. */
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

bool gpu_fill_frame(const gpu_renderer *r, const render_frame *frame, int index,
                    shared_frame *block, cli_error *error) {
    float offset[2];
    sample_offset(index, frame->samples, offset);
    const scene_camera *camera = &frame->camera;
    const float half_height = 0.5f * scene_camera_height(camera, 1);
    const float half_width = half_height * (float)frame->width / (float)frame->height;
    memset(block, 0, sizeof *block);
    memcpy(block->eye, camera->eye, sizeof camera->eye);
    block->eye[3] = r->near;
    subtract(camera->target, camera->eye, block->forward);
    cross(block->forward, camera->up, block->right);
    cross(block->forward, block->right, block->down);
    if (!scale_to(block->forward, 1) || !scale_to(block->right, half_width) ||
        !scale_to(block->down, half_height))
        return cli_fail(error, "camera", "it looks along its up direction, or at itself");
    if (camera->height > 0) {
        block->eye[3] = farthest(r, block);
        block->forward[3] = 1;
    }
    memcpy(block->background, frame->background, sizeof frame->background);
    gpu_describe_environment(r, frame, block->surroundings);
    block->size_lights[0] = (float)frame->width;
    block->size_lights[1] = (float)frame->height;
    block->size_lights[2] = (float)r->shaded_lights;

    block->jitter[0] = 2 * offset[0] / (float)frame->width;
    block->jitter[1] = 2 * offset[1] / (float)frame->height;
    block->jitter[2] = (float)index;
    block->jitter[3] = (float)(frame->samples > 1 ? frame->samples : 1);
    fill_clip(block, half_width, half_height);
    return true;
}

void gpu_upload_lights(gpu_renderer *r, const render_frame *frame) {
    r->shaded_lights = gpu_take_lights(frame->lights, frame->light_count, r->lights);
    if (r->shaded_lights)
        glNamedBufferSubData(r->lights_block, 0, (GLsizeiptr)(r->shaded_lights * sizeof *r->lights),
                             r->lights);
}
