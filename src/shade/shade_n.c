/* SPDX-License-Identifier: MIT */
/* shade_n.c - shades many surfaces in chunks of planes, with every light packed. */
#include "src/kernels/dispatch.h"
#include "src/light/valid.h"
#include "src/shade/method.h"

/* Sums coefficients surface by surface. */
static void shade_each(const lmp_shade_settings *resolved, const lmp_surfaces *surfaces,
                       const size_t *at, size_t count, const lmp_light *lights, size_t light_count,
                       size_t stride, float *rgb) {
    for (size_t i = 0; i < count; i++) {
        const lmp_surface surface = lmpi_surface_at(surfaces, at[i]);
        const lmp_rgb color = lmpi_shade_sum(resolved, lmpi_material_at(surfaces, at[i]), &surface,
                                             lights, light_count);
        memcpy((char *)rgb + at[i] * stride, &color, sizeof color);
    }
}

static_assert(sizeof(lmpi_kernel_slice) == sizeof(lmp_preintegrated_brdf_slice) &&
                  offsetof(lmpi_kernel_slice, unit) == offsetof(lmp_preintegrated_brdf_slice, unit),
              "the kernels' slices are those of preintegrated BRDFs");

static void shade_brdf_planes(const shade_chunk *chunk, const lmpi_packed_light *lights,
                              size_t count, lmp_rgb ambient) {
    const lmp_preintegrated_brdf_info info =
        lmp_preintegrated_brdf_describe(chunk->source.preintegrated);
    const lmpi_kernel_preintegrated_brdf material = { .mirrored = info.mirrored,
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
    lmpi_kernels_get()->shade.preintegrated_brdf(&material, &chunk->surfaces, lights, count,
                                                 ambient, chunk->count, chunk->sums.diffuse);
}

/* The lights of a call, and as many of them, packed, as a kernel takes at once. */
typedef struct kernel_lights {
    const lmp_light *all;
    size_t all_count;
    bool any_area;
    size_t first, next; /* those packed are from `first` up to `next`, without areas */
    size_t count;
    lmpi_packed_light light[LMPI_KERNEL_LIGHTS_MAX];
    lmp_rgb ambient;
} kernel_lights;

static void set_lights(const lmp_light *lights, size_t count, kernel_lights *to) {
    to->all = lights;
    to->all_count = count;
    to->any_area = lmpi_is_any_area(lights, count);
    to->first = to->next = 0;
}

/* Packs lights from `first` on, unless they still are: a chunk of surfaces often takes the lights
 * of the chunk before. */
static void take_lights(size_t first, kernel_lights *to) {
    if (to->first == first && to->next > first)
        return;
    to->first = first;
    to->count = 0;
    to->ambient = (lmp_rgb) { 0, 0, 0 };
    for (to->next = first; to->next < to->all_count && to->count < LMPI_KERNEL_LIGHTS_MAX;
         to->next++) {
        const lmp_light *light = &to->all[to->next];
        if (!to->any_area || !lmpi_light_is_area(light))
            lmpi_shade_take_light(light, &to->light[to->count++], &to->ambient);
    }
}

/* Shades by the kernels. */
static void shade_by_kernels(const shade_prepared *prepared, const lmp_surfaces *surfaces,
                             shade_chunk *chunk, kernel_lights *lights, size_t stride, float *rgb) {
    lmpi_shade_load_chunk(surfaces, chunk);
    for (size_t light = 0; light < lights->all_count; light = lights->next) {
        take_lights(light, lights);
        if (chunk->source.preintegrated)
            shade_brdf_planes(chunk, lights->light, lights->count, lights->ambient);
        else
            prepared->method->lobes_of_chunk(prepared, chunk, lights->light, lights->count);
        chunk->ambient[0] += lights->ambient.r;
        chunk->ambient[1] += lights->ambient.g;
        chunk->ambient[2] += lights->ambient.b;
    }
    if (!chunk->source.preintegrated && lights->any_area)
        lmpi_shade_add_areas(prepared, chunk, lights->all, lights->all_count);
    if (chunk->phong_count)
        lmpi_shade_sum_planes(chunk->count, chunk->phong_count, chunk->ambient, &chunk->planes);
    lmpi_shade_store(&chunk->planes, chunk->at, chunk->count, stride, rgb);
}

unsigned lmpi_shade_bare_n(const lmp_shade_settings *settings, const lmp_surfaces *surfaces,
                           size_t count, const lmp_light *lights, size_t light_count, size_t stride,
                           float *rgb) {
    const lmp_shade_settings resolved = lmpi_shade_resolve(settings);
    assert(lmpi_are_surfaces(surfaces, count) && lmpi_are_lights(lights, light_count));
    const shade_method *method = lmpi_shade_method_of(resolved.method);
    shade_prepared prepared = { .method = method, .settings = &resolved };
    shade_chunk chunk;
    kernel_lights taken;
    set_lights(lights, light_count, &taken);
    if (method->prepare)
        method->prepare(&resolved, &prepared);
    shade_waiting waiting;
    waiting.layer_mask = 0;
    waiting.count = 0;
    for (size_t next = 0; waiting.count > 0 || next < count;) {
        /* Chunks of each kind are filled, even where kinds alternate. */
        while (waiting.count < SHADE_SURFACES_MAX && next < count)
            lmpi_shade_wait(surfaces, next++, &waiting);
        lmpi_shade_take_alike(surfaces, method->preintegrated, &waiting, &chunk);
        const bool lobes = chunk.phong_count > 0;
        assert(!lobes || !method->preintegrated || resolved.lobe);
        assert(!chunk.source.preintegrated || !taken.any_area);
        if (chunk.source.table || (lobes && !method->lobes_of_chunk))
            shade_each(&resolved, surfaces, chunk.at, chunk.count, lights, light_count, stride,
                       rgb);
        else
            shade_by_kernels(&prepared, surfaces, &chunk, &taken, stride, rgb);
    }
    return waiting.layer_mask;
}
