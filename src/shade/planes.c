/* SPDX-License-Identifier: MIT */
#include "src/shade/planes.h"

#include "src/kernels/dispatch.h"

#include <assert.h>

static_assert(LMPI_KERNEL_LOBES_MAX == LMP_GGX_LOBES, "the kernels take all lobes of GGX");
static float *take_plane(size_t stride, float **memory) {
    float *plane = *memory;
    *memory += stride;
    return plane;
}

static lmpi_batch_vec3 take_vectors(size_t stride, float **memory) {
    float *x = take_plane(stride, memory), *y = take_plane(stride, memory);
    return (lmpi_batch_vec3) { x, y, take_plane(stride, memory) };
}

void lmpi_shade_divide(int lobes, shade_planes *planes) {
    const size_t stride = lmpi_shade_capacity(lobes);
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

static float *plane_of(lmpi_batch_vec3 planes, size_t c) {
    return c == 0 ? planes.x : c == 1 ? planes.y : planes.z;
}

lmpi_kernel_vec3 lmpi_shade_vectors(const lmp_vec3_array *array, const size_t *at, size_t count,
                                    bool in_a_row, lmpi_batch_vec3 planes) {
    if (in_a_row)
        return lmpi_batch_vectors(array, at[0], count, planes);
    for (size_t i = 0; i < count; i++)
        lmpi_batch_load(array, at[i], planes, i);
    lmpi_batch_fill(planes, count);
    return lmpi_batch_planes(planes);
}

static_assert(offsetof(lmp_material, specular) == offsetof(lmp_material, diffuse) + 12 &&
                  offsetof(lmp_material, exponent) == offsetof(lmp_material, diffuse) + 24,
              "a lobe of its own is seven floats of a material");

/* Computes the axes of materials' own lobes. The arrays must not overlap, so that compilers
 * vectorize. */
static void mirror(const lmpi_kernel_vec3 *normal, const lmpi_kernel_vec3 *view, size_t count,
                   float *restrict x, float *restrict y, float *restrict z) {
    for (size_t i = 0; i < count; i++) {
        const lmp_vec3 axis =
            lmpi_shade_mirrored(lmpi_batch_get(normal, i), lmpi_batch_get(view, i));
        x[i] = axis.x;
        y[i] = axis.y;
        z[i] = axis.z;
    }
}

/* Loads the Phong lobe of materials that have one of their own. */
static void load_phong(const lmp_surfaces *surfaces, const size_t *at, size_t count,
                       const lmpi_kernel_vec3 *normal, const lmpi_kernel_vec3 *view,
                       shade_planes *planes) {
    shade_lobe_planes *lobe = &planes->lobe[0];
    float *const to[7] = { planes->diffuse.x, planes->diffuse.y, planes->diffuse.z, lobe->weight.x,
                           lobe->weight.y,    lobe->weight.z,    lobe->exponent };
    const lmpi_kernel_rows rows = { at, surfaces->material_stride };
    lmpi_kernels_get()->convert.load_rows(7, &surfaces->material->diffuse.r, &rows, count, to);
    mirror(normal, view, count, lobe->axis.x, lobe->axis.y, lobe->axis.z);
}

/* The parameters of metallic-roughness (shade_reflectance), in planes. */
typedef struct ggx_planes {
    float base[3][SHADE_SURFACES_GGX], unread[3][SHADE_SURFACES_GGX];
    float metallic[SHADE_SURFACES_GGX], roughness[SHADE_SURFACES_GGX];
    float dielectric_f0[3][SHADE_SURFACES_GGX], dielectric_f90[SHADE_SURFACES_GGX];
    float f0[3][SHADE_SURFACES_GGX], f90[SHADE_SURFACES_GGX], passed[SHADE_SURFACES_GGX];
    float f0_part[LMP_GGX_LOBES][SHADE_SURFACES_GGX], f90_part[LMP_GGX_LOBES][SHADE_SURFACES_GGX];
} ggx_planes;

static_assert(offsetof(lmp_material, metallic) == offsetof(lmp_material, base_color) + 24 &&
                  offsetof(lmp_material, roughness) == offsetof(lmp_material, base_color) + 28,
              "metallic-roughness is eight floats of a material");

static void read_materials(const lmp_surfaces *surfaces, const size_t *at, size_t count,
                           ggx_planes *ggx) {
    float *const to[8] = { ggx->base[0],   ggx->base[1],   ggx->base[2],  ggx->unread[0],
                           ggx->unread[1], ggx->unread[2], ggx->metallic, ggx->roughness };
    const lmpi_kernel_rows rows = { at, surfaces->material_stride };
    lmpi_kernels_get()->convert.load_rows(8, &surfaces->material->base_color.r, &rows, count, to);
    for (size_t i = 0; i < count; i++) {
        const lmp_dielectric *from = &lmpi_material_at(surfaces, at[i])->dielectric;
        const float common = LMP_DIELECTRIC_F0;
        ggx->dielectric_f0[0][i] = from->given ? from->f0.r : common;
        ggx->dielectric_f0[1][i] = from->given ? from->f0.g : common;
        ggx->dielectric_f0[2][i] = from->given ? from->f0.b : common;
        ggx->dielectric_f90[i] = from->given ? from->f90 : 1;
    }
}

/* Does the operations of lmpi_shade_reflectance_of in planes. */
static void mix(size_t count, ggx_planes *ggx, lmpi_batch_vec3 diffuse) {
    for (size_t i = 0; i < count; i++)
        ggx->metallic[i] = lmpi_shade_saturate(ggx->metallic[i]);
    for (size_t c = 0; c < 3; c++) {
        float *restrict albedo = plane_of(diffuse, c);
        for (size_t i = 0; i < count; i++) {
            const float metal = ggx->metallic[i], dielectric = 1 - metal;
            albedo[i] = ggx->base[c][i] * dielectric;
            ggx->f0[c][i] = ggx->base[c][i] * metal + ggx->dielectric_f0[c][i] * dielectric;
        }
    }
    for (size_t i = 0; i < count; i++) {
        const float f90 = ggx->dielectric_f90[i];
        ggx->f90[i] = f90 + (1 - f90) * ggx->metallic[i];
    }
}

/* Computes what passes the dielectric: `passed` holds diffuse_f90 (lobe.h) before, the fraction
 * after.
 */
static void pass(size_t count, ggx_planes *ggx, lmpi_batch_vec3 diffuse) {
    for (size_t i = 0; i < count; i++) {
        const float *red = ggx->dielectric_f0[0], *green = ggx->dielectric_f0[1],
                    *blue = ggx->dielectric_f0[2];
        const float most = green[i] > blue[i] ? green[i] : blue[i];
        const float f0 = red[i] > most ? red[i] : most, lost = ggx->passed[i];
        ggx->passed[i] = 1 - f0 * (1 - lost) - ggx->dielectric_f90[i] * lost;
    }
    for (size_t c = 0; c < 3; c++) {
        float *restrict albedo = plane_of(diffuse, c);
        for (size_t i = 0; i < count; i++)
            albedo[i] *= ggx->passed[i];
    }
}

static void weigh(size_t count, int k, ggx_planes *ggx, lmpi_batch_vec3 weight) {
    for (size_t i = 0; i < count; i++)
        ggx->f90_part[k][i] *= ggx->f90[i];
    for (size_t c = 0; c < 3; c++) {
        float *restrict to = plane_of(weight, c);
        for (size_t i = 0; i < count; i++)
            to[i] = ggx->f0[c][i] * ggx->f0_part[k][i] + ggx->f90_part[k][i];
    }
}

static void load_ggx(const lmp_surfaces *surfaces, const size_t *at, size_t count, int lobe_count,
                     const lmpi_kernel_vec3 *normal, const lmpi_kernel_vec3 *view,
                     shade_planes *planes) {
    ggx_planes ggx;
    lmpi_kernel_ggx_lobe lobes[LMP_GGX_LOBES];
    read_materials(surfaces, at, count, &ggx);
    for (int k = 0; k < lobe_count; k++) {
        shade_lobe_planes *to = &planes->lobe[k];
        lobes[k] = (lmpi_kernel_ggx_lobe) {
            { to->axis.x, to->axis.y, to->axis.z }, to->exponent, ggx.f0_part[k], ggx.f90_part[k]
        };
    }
    lmpi_lobe_ggx_n(normal, view, ggx.roughness, count, lobe_count, lobes, ggx.passed);
    mix(count, &ggx, planes->diffuse);
    pass(count, &ggx, planes->diffuse);
    for (int k = 0; k < lobe_count; k++)
        weigh(count, k, &ggx, planes->lobe[k].weight);
}

void lmpi_shade_load(const lmp_surfaces *surfaces, const size_t *at, size_t count, int lobes,
                     const lmpi_kernel_vec3 *normal, const lmpi_kernel_vec3 *view,
                     shade_planes *planes) {
    if (lobes == 1)
        load_phong(surfaces, at, count, normal, view, planes);
    else
        load_ggx(surfaces, at, count, lobes, normal, view, planes);
    for (int k = 0; k < lobes; k++) {
        lmpi_batch_fill(planes->lobe[k].axis, count);
        lmpi_batch_fill_plane(planes->lobe[k].exponent, count);
    }
}

void lmpi_shade_sum_planes(size_t count, int lobes, const float ambient[3], shade_planes *planes) {
    for (size_t c = 0; c < 3; c++) {
        const float *albedo = plane_of(planes->diffuse, c);
        float *restrict sum = planes->accumulated[c];
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

void lmpi_shade_store(const shade_planes *planes, const size_t *at, size_t count, size_t stride,
                      float *rgb) {
    const float *const colors[3] = { planes->accumulated[0], planes->accumulated[1],
                                     planes->accumulated[2] };
    const lmpi_kernel_rows rows = { at, stride };
    lmpi_kernels_get()->convert.store_colors(colors, count, &rows, rgb);
}
