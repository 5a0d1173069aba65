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

static lmp_vec3_array vectors(float *const planes[3], size_t first) {
    return (lmp_vec3_array) { planes[0] + first, planes[1] + first, planes[2] + first,
                              sizeof(float) };
}

/* A run of surfaces in a row. */
static void shade_run(const gpu_frame *frame, const lmp_light *lights, const gpu_row *row,
                      size_t first, size_t count, float *rgba) {
    const lmp_surfaces surfaces = {
        .position = vectors(row->position, first),
        .normal = vectors(row->normal, first),
        .view = vectors(row->view, first),
        .material = row->material + first,
        .material_stride = sizeof *row->material,
    };
    const lmp_shade_settings settings = { .method = frame->method == GPU_METHOD_PREINTEGRATED
                                                        ? LMP_SHADE_PREINTEGRATED
                                                        : LMP_SHADE_ZONAL,
                                          .bands = frame->bands,
                                          .window = frame->window,
                                          .lobe = frame->response };
    lmp_shade_n(&settings, &surfaces, count, lights, frame->light_count, 4 * sizeof(float), rgba);
}

static void shade_row(const gpu_frame *frame, const lmp_light *lights, const gpu_row *row,
                      float *rgba) {
    const size_t width = (size_t)frame->width;
    for (size_t i = 0; i < width;) {
        size_t end = i;
        while (end < width && row->kind[end] == GPU_KIND_SURFACE)
            end++;
        if (end > i)
            shade_run(frame, lights, row, i, end - i, rgba + 4 * i);
        for (; i < end; i++)
            for (size_t c = 0; c < 3; c++)
                rgba[4 * i + c] += row->emission[c][i];
        for (; i < width && row->kind[i] != GPU_KIND_SURFACE; i++)
            for (size_t c = 0; c < 3; c++)
                rgba[4 * i + c] = row->emission[c][i];
    }
}

bool device_shade(const gpu_frame *frame, const gpu_gbuffer *gbuffer, float *rgba,
                  cli_error *error) {
    lmp_light *lights = calloc(frame->light_count + 1, sizeof *lights);
    bool ok = lights;
    for (size_t i = 0; ok && i < frame->light_count; i++)
        lights[i] = frame->lights[i].emitter;
    if (ok)
#pragma omp parallel reduction(&& : ok)
    {
        gpu_row row;
        const bool mine = gpu_row_create(frame->width, &row);
#pragma omp for schedule(dynamic, 4)
        for (int y = 0; y < frame->height; y++)
            if (mine) {
                gpu_gbuffer_row(gbuffer, y, &row);
                shade_row(frame, lights, &row, rgba + 4 * (size_t)y * (size_t)frame->width);
            }
        if (mine)
            gpu_row_free(&row);
        ok = mine;
    }
    free(lights);
    return ok || cli_fail(error, NULL, "out of memory");
}
