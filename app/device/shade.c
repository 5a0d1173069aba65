/* SPDX-License-Identifier: MIT */
#include "app/device/device.h"

#include <stdlib.h>

const char *const device_names[DEVICES + 1] = { "auto", "gpu", "cpu", NULL };

int device_bands_max(device_kind device, gpu_method method) {
    if (device != DEVICE_CPU)
        return gpu_bands_max(method);
    return method == GPU_METHOD_ZONAL || method == GPU_METHOD_PREINTEGRATED ? LMP_BANDS_MAX : 0;
}

device_kind device_choose(device_kind wanted, const gpu_context *context, gpu_method method,
                          int bands) {
    if (wanted != DEVICE_AUTO)
        return wanted;
    const bool needs_cpu = context->software || bands > gpu_bands_max(method);
    return needs_cpu && device_bands_max(DEVICE_CPU, method) >= bands ? DEVICE_CPU : DEVICE_GPU;
}

/* A run of surfaces in a row. */
static void shade_run(const gpu_frame *frame, const lmp_light *lights, const gpu_pixel *pixels,
                      size_t count, float *rgb) {
    const lmp_surface *s = &pixels->surface;
    const lmp_material *m = &pixels->material;
    const size_t stride = sizeof *pixels;
    const lmp_surfaces surfaces = {
        .position = { &s->position.x, &s->position.y, &s->position.z, stride },
        .normal = { &s->normal.x, &s->normal.y, &s->normal.z, stride },
        .view = { &s->view.x, &s->view.y, &s->view.z, stride },
        .diffuse = { &m->diffuse.r, &m->diffuse.g, &m->diffuse.b, stride },
        .specular = { &m->specular.r, &m->specular.g, &m->specular.b, stride },
        .exponent = { &m->exponent, stride },
        .table = &m->table,
        .table_stride = stride,
    };
    const lmp_shade_settings settings = { .bands = frame->bands, .window = frame->window };
    if (frame->method == GPU_METHOD_PREINTEGRATED)
        lmp_shade_preintegrated_n(frame->response, &surfaces, count, lights, frame->light_count, 3,
                                  rgb);
    else
        lmp_shade_n(&settings, &surfaces, count, lights, frame->light_count, 3, rgb);
}

static void shade_row(const gpu_frame *frame, const lmp_light *lights, const gpu_pixel *pixels,
                      float *rgb) {
    const size_t width = (size_t)frame->width;
    for (size_t i = 0; i < width;) {
        size_t end = i;
        while (end < width && pixels[end].kind == GPU_KIND_SURFACE)
            end++;
        if (end > i)
            shade_run(frame, lights, pixels + i, end - i, rgb + 3 * i);
        for (; i < end; i++) {
            rgb[3 * i] += pixels[i].emission.r;
            rgb[3 * i + 1] += pixels[i].emission.g;
            rgb[3 * i + 2] += pixels[i].emission.b;
        }
        for (; i < width && pixels[i].kind != GPU_KIND_SURFACE; i++) {
            rgb[3 * i] = pixels[i].emission.r;
            rgb[3 * i + 1] = pixels[i].emission.g;
            rgb[3 * i + 2] = pixels[i].emission.b;
        }
    }
}

bool device_shade(const gpu_frame *frame, const gpu_pixel *pixels, float *rgb, cli_error *error) {
    lmp_light *lights = calloc(frame->light_count + 1, sizeof *lights);
    if (!lights)
        return cli_fail(error, NULL, "out of memory");
    for (size_t i = 0; i < frame->light_count; i++)
        lights[i] = scene_light_as_sphere(&frame->lights[i]);
    const size_t width = (size_t)frame->width;
#pragma omp parallel for schedule(dynamic, 4)
    for (int y = 0; y < frame->height; y++)
        shade_row(frame, lights, pixels + (size_t)y * width, rgb + 3 * (size_t)y * width);
    free(lights);
    return true;
}
