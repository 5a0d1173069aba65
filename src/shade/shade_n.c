/* SPDX-License-Identifier: MIT */
/* shade_n.c - shading many surfaces: chunks of planes, every light packed. */
#include "src/light/cap.h"
#include "src/shade/method.h"

/* Sums of coefficients: surface by surface. */
static void shade_each(const lmp_shade_settings *resolved, const lmp_surfaces *surfaces,
                       const size_t *at, size_t count, const lmp_light *lights, size_t light_count,
                       size_t stride, float *rgb) {
    for (size_t i = 0; i < count; i++) {
        const lmp_surface surface = lmp_surface_at(surfaces, at[i]);
        const lmp_rgb color = lmp_shade_sum(resolved, lmp_material_at(surfaces, at[i]), &surface,
                                            lights, light_count);
        memcpy((char *)rgb + at[i] * stride, &color, sizeof color);
    }
}

static_assert(sizeof(lmp_kernel_slice) == sizeof(lmp_preintegrated_brdf_slice) &&
                  offsetof(lmp_kernel_slice, unit) == offsetof(lmp_preintegrated_brdf_slice, unit),
              "the kernels' slices are those of preintegrated BRDFs");

static void shade_brdf_planes(const shade_chunk *chunk, const lmp_packed_light *lights,
                              size_t count, lmp_rgb ambient) {
    const lmp_preintegrated_brdf_info info =
        lmp_preintegrated_brdf_describe(chunk->source.preintegrated);
    const lmp_kernel_preintegrated_brdf material = { .mirrored = info.mirrored,
                                                     .width = info.width,
                                                     .radius = info.radius,
                                                     .reach = info.reach,
                                                     .slope = info.slope,
                                                     .lobe_angle = info.lobe_angle,
                                                     .view_count = info.view_count,
                                                     .cap_count = info.cap_count,
                                                     .view_steps = info.view_steps,
                                                     .cap_steps = info.cap_steps,
                                                     .view_remap = info.view_remap,
                                                     .cap_remap = info.cap_remap,
                                                     .ambient = info.ambient,
                                                     .slices = info.slices,
                                                     .texels = info.texels };
    lmp_kernels_get()->shade_preintegrated_brdf(&material, &chunk->surfaces, lights, count, ambient,
                                                chunk->count, chunk->sums.diffuse);
}

/* Takes as many lights as a kernel does; returns how many. */
static size_t take_lights(const lmp_light *lights, size_t count, lmp_packed_light *taken,
                          lmp_rgb *ambient) {
    size_t n = 0;
    for (; n < count && n < LMP_KERNEL_LIGHTS_MAX; n++)
        lmp_shade_take_light(&lights[n], &taken[n], ambient);
    return n;
}

/* By the kernels. */
static void shade_by_kernels(const shade_prepared *prepared, const lmp_surfaces *surfaces,
                             shade_chunk *chunk, const lmp_light *lights, size_t light_count,
                             size_t stride, float *rgb) {
    lmp_shade_load_chunk(surfaces, chunk);
    for (size_t light = 0, taken; light < light_count; light += taken) {
        lmp_packed_light some[LMP_KERNEL_LIGHTS_MAX];
        lmp_rgb ambient = { 0, 0, 0 };
        taken = take_lights(lights + light, light_count - light, some, &ambient);
        if (chunk->source.preintegrated)
            shade_brdf_planes(chunk, some, taken, ambient);
        else
            prepared->method->lobes_of_chunk(prepared, chunk, some, taken);
        chunk->ambient[0] += ambient.r;
        chunk->ambient[1] += ambient.g;
        chunk->ambient[2] += ambient.b;
    }
    if (chunk->phong_count)
        lmp_shade_sum_planes(chunk->count, chunk->phong_count, chunk->ambient, &chunk->planes);
    lmp_shade_store(&chunk->planes, chunk->at, chunk->count, stride, rgb);
}

unsigned lmp_shade_bare_n(const lmp_shade_settings *settings, const lmp_surfaces *surfaces,
                          size_t count, const lmp_light *lights, size_t light_count,
                          size_t rgb_stride, float *rgb) {
    const lmp_shade_settings resolved = lmp_shade_resolve(settings);
    const size_t stride = rgb_stride ? rgb_stride : sizeof(lmp_rgb);
    assert(lmp_are_surfaces(surfaces, count) && lmp_are_lights(lights, light_count));
    assert(stride >= sizeof(lmp_rgb) && stride % sizeof(float) == 0);
    const shade_method *method = lmp_shade_method_of(resolved.method);
    shade_prepared prepared = { .method = method, .settings = &resolved };
    shade_chunk chunk;
    if (method->prepare)
        method->prepare(&resolved, &prepared);
    shade_waiting waiting;
    waiting.overs = 0;
    waiting.count = 0;
    for (size_t next = 0; waiting.count > 0 || next < count;) {
        /* Full chunks of each kind, also where kinds alternate. */
        while (waiting.count < SHADE_SURFACES_MAX && next < count)
            lmp_shade_wait(surfaces, next++, &waiting);
        lmp_shade_take_alike(surfaces, method->preintegrated, &waiting, &chunk);
        const bool lobes = chunk.phong_count > 0;
        assert(!lobes || !method->preintegrated || resolved.lobe);
        if (chunk.source.table || (lobes && !method->lobes_of_chunk))
            shade_each(&resolved, surfaces, chunk.at, chunk.count, lights, light_count, stride,
                       rgb);
        else
            shade_by_kernels(&prepared, surfaces, &chunk, lights, light_count, stride, rgb);
    }
    return waiting.overs;
}
