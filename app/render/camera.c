/* SPDX-License-Identifier: MIT */
#include "app/render/camera.h"

#include <math.h>
#include <string.h>

/* The near plane's distance, as a fraction of the scene's extent and of how far the camera looks,
 * the lesser: of wide ground or a distant sky, a camera beside a small model has an extent that
 * says nothing. Depths are near / distance, which floats hold equally well whatever it is. */
static const float near_of_extent = 1e-4f, near_of_view = 1e-3f;

static void subtract(const float a[3], const float b[3], float difference[3]) {
    for (int i = 0; i < 3; i++)
        difference[i] = a[i] - b[i];
}

static void cross(const float a[3], const float b[3], float product[3]) {
    product[0] = a[1] * b[2] - a[2] * b[1];
    product[1] = a[2] * b[0] - a[0] * b[2];
    product[2] = a[0] * b[1] - a[1] * b[0];
}

static bool scale_to(float v[3], float length) {
    const float current = sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    if (!(current > 0))
        return false;
    for (int i = 0; i < 3; i++)
        v[i] *= length / current;
    return true;
}

/* Returns the offset of sample `index` of `count` in its pixel, -0.5 … 0.5, by the two-dimensional
 * golden ratio (Roberts 2018). The first sample is in the middle. */
static void sample_offset(int index, int count, float offset[2]) {
    static const double steps[2] = { 0.7548776662466927, 0.5698402909980532 };
    for (int i = 0; i < 2; i++) {
        const double at = count > 1 ? 0.5 + steps[i] * index : 0.5;
        offset[i] = (float)(at - floor(at) - 0.5);
    }
}

static float near_of(const scene *world, const scene_camera *from) {
    float extent = 0, view2 = 0;
    for (int i = 0; i < 3; i++) {
        extent = fmaxf(extent, world->maximum[i] - world->minimum[i]);
        view2 += (from->target[i] - from->eye[i]) * (from->target[i] - from->eye[i]);
    }
    const float of_view = near_of_view * sqrtf(view2);
    const float of_extent = near_of_extent * (extent > 0 ? extent : 1);
    return of_view > 0 && of_view < of_extent ? of_view : of_extent;
}

bool render_camera_set(const scene *world, const render_frame *frame, int sample, render_camera *c,
                       base_error *error) {
    const scene_camera *from = &frame->camera;
    const float half_height = 0.5f * scene_camera_height(from, 1);
    const float half_width = half_height * (float)frame->width / (float)frame->height;
    float offset[2];
    sample_offset(sample, frame->samples, offset);
    memset(c, 0, sizeof *c);
    c->width = frame->width;
    c->height = frame->height;
    c->parallel = from->height > 0;
    c->near = from->near > 0 ? from->near : near_of(world, from);
    c->far = from->far > 0 ? from->far : INFINITY;
    c->sample = sample;
    c->samples = frame->samples > 1 ? frame->samples : 1;
    memcpy(c->eye, from->eye, sizeof c->eye);
    subtract(from->target, from->eye, c->forward);
    cross(c->forward, from->up, c->right);
    cross(c->forward, c->right, c->down);
    c->jitter[0] = 2 * offset[0] / (float)frame->width;
    c->jitter[1] = 2 * offset[1] / (float)frame->height;
    c->step[0] = 2 / (float)frame->width;
    c->step[1] = 2 / (float)frame->height;
    for (int i = 0; i < 2; i++)
        c->first[i] = 0.5f * c->step[i] - 1 + c->jitter[i];
    if (!scale_to(c->forward, 1) || !scale_to(c->right, half_width) ||
        !scale_to(c->down, half_height))
        return base_fail(error, "camera", "it looks along its up direction, or at itself");
    /* parallel rays begin at the near plane */
    for (int i = 0; c->parallel && i < 3; i++)
        c->eye[i] += c->forward[i] * from->near;
    if (c->parallel)
        c->far -= from->near;
    return true;
}

void render_camera_rays(const render_camera *c, const int *x, const int *y, int count,
                        float *const origin[3], float *const direction[3]) {
    for (int k = 0; k < 3; k++) {
        const float eye = c->eye[k], forward = c->forward[k], right = c->right[k],
                    down = c->down[k];
        float *restrict from = origin[k], *restrict along = direction[k];
        for (int i = 0; i < count; i++) {
            const float u = (float)x[i] * c->step[0] + c->first[0];
            const float v = (float)y[i] * c->step[1] + c->first[1];
            const float aside = right * u + down * v;
            from[i] = eye + (c->parallel ? aside : 0);
            along[i] = forward + (c->parallel ? 0 : aside);
        }
    }
}

void render_camera_views(const render_camera *c, int first, int y, int count,
                         float *const view[3]) {
    const float spread = c->parallel ? 0 : 1;
    const float v = (float)y * c->step[1] + c->first[1];
    const float across = c->step[0], start = c->first[0];
    float left[3], right[3];
    for (int i = 0; i < 3; i++) {
        left[i] = c->forward[i] + c->down[i] * v * spread;
        right[i] = c->right[i] * spread;
    }
    float *restrict vx = view[0], *restrict vy = view[1], *restrict vz = view[2];
#pragma omp simd
    for (int x = 0; x < count; x++) {
        const float u = (float)(first + x) * across + start;
        const float rx = left[0] + right[0] * u, ry = left[1] + right[1] * u;
        const float rz = left[2] + right[2] * u;
        const float back = -1 / sqrtf(rx * rx + ry * ry + rz * rz);
        vx[x] = rx * back;
        vy[x] = ry * back;
        vz[x] = rz * back;
    }
}
