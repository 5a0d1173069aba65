/* SPDX-License-Identifier: MIT */
#include "src/shade/planes.h"

#include <assert.h>

static_assert(LMP_KERNEL_LOBES_MAX == LMP_GGX_LOBES, "the kernels take all lobes of GGX");
static float *take_plane(size_t stride, float **memory) {
    float *plane = *memory;
    *memory += stride;
    return plane;
}

static lmp_batch_vec3 take_vectors(size_t stride, float **memory) {
    float *x = take_plane(stride, memory), *y = take_plane(stride, memory);
    return (lmp_batch_vec3) { x, y, take_plane(stride, memory) };
}

void lmp_shade_divide(int lobes, shade_planes *planes) {
    const size_t stride = lmp_shade_capacity(lobes);
    float *memory = planes->memory;
    planes->stride = stride;
    planes->point = take_vectors(stride, &memory);
    planes->normal = take_vectors(stride, &memory);
    planes->view = take_vectors(stride, &memory);
    planes->diffuse = take_vectors(stride, &memory);
    for (int c = 0; c < 3; c++)
        planes->accumulated[c] = take_plane(stride, &memory);
    for (int k = 0; k < lobes; k++) {
        shade_lobe_planes *lobe = &planes->lobe[k];
        lobe->axis = take_vectors(stride, &memory);
        lobe->weight = take_vectors(stride, &memory);
        lobe->exponent = take_plane(stride, &memory);
        for (int c = 0; c < 3; c++)
            lobe->accumulated[c] = take_plane(stride, &memory);
    }
}

static float *plane_of(lmp_batch_vec3 planes, size_t c) {
    return c == 0 ? planes.x : c == 1 ? planes.y : planes.z;
}

lmp_kernel_vec3 lmp_shade_vectors(const lmp_vec3_array *array, const size_t *at, size_t count,
                                  bool in_a_row, lmp_batch_vec3 planes) {
    if (in_a_row)
        return lmp_batch_vectors(array, at[0], count, planes);
    for (size_t i = 0; i < count; i++)
        lmp_batch_load(array, at[i], planes, i);
    lmp_batch_fill(planes, count);
    return lmp_batch_planes(planes);
}

static_assert(offsetof(lmp_material, specular) == offsetof(lmp_material, diffuse) + 12 &&
                  offsetof(lmp_material, exponent) == offsetof(lmp_material, diffuse) + 24,
              "a lobe of its own is seven floats of a material");

/* The axes of materials' own lobes. Compilers make vectors of what does not overlap. */
static void mirror(const lmp_kernel_vec3 *normal, const lmp_kernel_vec3 *view, size_t count,
                   float *restrict x, float *restrict y, float *restrict z) {
    for (size_t i = 0; i < count; i++) {
        const lmp_vec3 axis = lmp_shade_mirrored(lmp_batch_get(normal, i), lmp_batch_get(view, i));
        x[i] = axis.x;
        y[i] = axis.y;
        z[i] = axis.z;
    }
}

/* Of a material that has one lobe, its own. */
static void load_phong(const lmp_surfaces *surfaces, const size_t *at, size_t count,
                       const lmp_kernel_vec3 *normal, const lmp_kernel_vec3 *view,
                       shade_planes *planes) {
    shade_lobe_planes *lobe = &planes->lobe[0];
    float *const to[7] = { planes->diffuse.x, planes->diffuse.y, planes->diffuse.z, lobe->weight.x,
                           lobe->weight.y,    lobe->weight.z,    lobe->exponent };
    const lmp_kernel_rows rows = { at, surfaces->material_stride };
    lmp_kernels_get()->load_rows(7, &surfaces->material->diffuse.r, &rows, count, to);
    mirror(normal, view, count, lobe->axis.x, lobe->axis.y, lobe->axis.z);
}

static void weigh(const float *f0, const float *f0_part, const float *f90_part, size_t count,
                  float *weight) {
    for (size_t i = 0; i < count; i++)
        weight[i] = f0[i] * f0_part[i] + f90_part[i];
}

static void scale(const float *factors, size_t count, float *values) {
    for (size_t i = 0; i < count; i++)
        values[i] *= factors[i];
}

static void load_ggx(const lmp_surfaces *surfaces, const size_t *at, size_t count, int lobe_count,
                     const lmp_kernel_vec3 *normal, const lmp_kernel_vec3 *view,
                     shade_planes *planes) {
    float roughness[LMP_GGX_RUN], passed[LMP_GGX_RUN], f90[LMP_GGX_RUN];
    float f0[3][LMP_GGX_RUN];
    float f0_part[LMP_GGX_LOBES][LMP_GGX_RUN], f90_part[LMP_GGX_LOBES][LMP_GGX_RUN];
    const lmp_batch_vec3 f0_planes = { f0[0], f0[1], f0[2] };
    shade_layers layers[LMP_GGX_RUN];
    lmp_ggx_lobe_planes lobes[LMP_GGX_LOBES];
    for (size_t i = 0; i < count; i++) {
        const lmp_material *material = lmp_material_at(surfaces, at[i]);
        const shade_layers *of = &layers[i];
        layers[i] = lmp_shade_layers(material);
        roughness[i] = material->roughness;
        f90[i] = of->f90;
        lmp_batch_set(of->diffuse.r, of->diffuse.g, of->diffuse.b, planes->diffuse, i);
        lmp_batch_set(of->f0.r, of->f0.g, of->f0.b, f0_planes, i);
    }
    for (int k = 0; k < lobe_count; k++) {
        shade_lobe_planes *to = &planes->lobe[k];
        lobes[k] = (lmp_ggx_lobe_planes) {
            { to->axis.x, to->axis.y, to->axis.z }, to->exponent, f0_part[k], f90_part[k]
        };
    }
    const float *const n[3] = { normal->x, normal->y, normal->z };
    const float *const v[3] = { view->x, view->y, view->z };
    lmp_lobe_ggx_n(n, v, roughness, count, lobe_count, lobes, passed);
    for (size_t i = 0; i < count; i++)
        passed[i] = lmp_shade_passed(&layers[i], passed[i]);
    for (int k = 0; k < lobe_count; k++)
        scale(f90, count, f90_part[k]);
    for (size_t c = 0; c < 3; c++) {
        scale(passed, count, plane_of(planes->diffuse, c));
        for (int k = 0; k < lobe_count; k++)
            weigh(f0[c], f0_part[k], f90_part[k], count, plane_of(planes->lobe[k].weight, c));
    }
}

void lmp_shade_load(const lmp_surfaces *surfaces, const size_t *at, size_t count, int lobes,
                    const lmp_kernel_vec3 *normal, const lmp_kernel_vec3 *view,
                    shade_planes *planes) {
    if (lobes == 1)
        load_phong(surfaces, at, count, normal, view, planes);
    else
        load_ggx(surfaces, at, count, lobes, normal, view, planes);
    for (int k = 0; k < lobes; k++) {
        lmp_batch_fill(planes->lobe[k].axis, count);
        for (size_t i = count; i % LMP_KERNEL_LANES_MAX; i++)
            planes->lobe[k].exponent[i] = 0;
    }
}

void lmp_shade_sum_planes(size_t count, int lobes, const float ambient[3], shade_planes *planes) {
    for (size_t c = 0; c < 3; c++) {
        const float *albedo = plane_of(planes->diffuse, c);
        float *sum = planes->accumulated[c];
        for (size_t i = 0; i < count; i++)
            sum[i] = albedo[i] * (sum[i] + ambient[c]);
        for (int k = 0; k < lobes; k++) {
            shade_lobe_planes *lobe = &planes->lobe[k];
            const float *weight = plane_of(lobe->weight, c);
            for (size_t i = 0; i < count; i++)
                sum[i] += weight[i] * (lobe->accumulated[c][i] + ambient[c]);
        }
    }
}

void lmp_shade_store(const shade_planes *planes, const size_t *at, size_t count, size_t stride,
                     float *rgb) {
    const float *const colors[3] = { planes->accumulated[0], planes->accumulated[1],
                                     planes->accumulated[2] };
    const lmp_kernel_rows rows = { at, stride };
    lmp_kernels_get()->store_colors(colors, count, &rows, rgb);
}
