/* SPDX-License-Identifier: MIT */
/* shade.h - kernels that shade surfaces. */
#ifndef LAMPION_KERNELS_SHADE_H
#define LAMPION_KERNELS_SHADE_H

#include "src/kernels/flat.h"
#include "src/kernels/lobe.h"

/* Surfaces to shade. Those with lobes have a diffuse lobe around the normal, and 1, 3 or 5 Phong
 * lobes, or none of these by `zonal`; a BRDF uses `view` instead. */
typedef struct lmpi_kernel_surfaces {
    lmpi_kernel_vec3 point, normal, view;
    int lobe_count;
    lmpi_kernel_lobe lobe[LMPI_KERNEL_LOBES_MAX];
} lmpi_kernel_surfaces;

/* The most lights that one call of a shading kernel takes. */
#define LMPI_KERNEL_LIGHTS_MAX 32

/* What the lobes receive, in planes of red, green, blue to which kernels add. */
typedef struct lmpi_kernel_accumulated {
    float *diffuse[3], *specular[LMPI_KERNEL_LOBES_MAX][3];
} lmpi_kernel_accumulated;

/* A preintegrated lobe (lampion/preintegrated.h), and where lobes lie in it
 * (src/preintegrated/lobe_eval.h): one array per member, readable like planes. */
typedef struct lmpi_kernel_preintegrated_lobe {
    const int16_t *pairs;
} lmpi_kernel_preintegrated_lobe;

typedef struct lmpi_kernel_lobe_positions {
    const uint32_t *first, *columns; /* of the cell; first counts pairs */
    const float *fraction, *density, *lobe_angle;
} lmpi_kernel_lobe_positions;

/* A slice of a preintegrated BRDF, and the rest of it, with the members of lampion/preintegrated.h,
 * except that LMPI_KERNEL_TEXELS_SPARE texels past the last one must be readable, too. */
typedef struct lmpi_kernel_slice {
    uint32_t first, rows, columns;
    float row_density, row_origin, column_density, unit;
} lmpi_kernel_slice;
#define LMPI_KERNEL_TEXELS_SPARE 2

typedef struct lmpi_kernel_preintegrated_brdf {
    int mirrored;
    float width, radius, reach, slope, lobe_angle;
    uint32_t view_count, cap_count, view_steps, cap_steps;
    const float *view_remap, *cap_remap;
    const lmp_rgb *ambient;
    const void *slices; /* of lmpi_kernel_slice */
    const int16_t *texels;
} lmpi_kernel_preintegrated_brdf;

typedef struct lmpi_shade_kernels {
    /* Adds what lobes reflect of the lights without their ambient light: the diffuse lobe of
     * integral 1, exactly, and Phong lobes truncated to `bands` bands with window[l]. */
    void (*zonal)(int bands, const float *window, const lmpi_kernel_surfaces *surfaces,
                  const lmpi_packed_light *lights, size_t light_count, size_t count,
                  const lmpi_kernel_accumulated *accumulated);
    /* Does `zonal` with flat lights that have corners. */
    void (*polygons)(int bands, const float *window, const lmpi_kernel_surfaces *surfaces,
                     const lmpi_kernel_polygon *lights, size_t light_count, size_t count,
                     const lmpi_kernel_accumulated *accumulated);
    /* Does `zonal` with a disk where its edge has the nodes for it, and where the horizon does not
     * cut it; left[i] says what else of it surface i sees, a sum of LMPI_LEFT_. */
    void (*disk)(int bands, const float *window, const lmpi_kernel_surfaces *surfaces,
                 const lmpi_kernel_disk *light, size_t count,
                 const lmpi_kernel_accumulated *accumulated, float *left);
    /* Does `zonal` with a tube from beside it, where the ends look small enough for the lobes, and
     * the horizon does not cut it; left[i] as of disks. */
    void (*tube)(int bands, const float *window, const lmpi_kernel_surfaces *surfaces,
                 const lmpi_kernel_tube *light, size_t count,
                 const lmpi_kernel_accumulated *accumulated, float *left);
    /* Adds what the lobes reflect of light given by its coefficients at each surface, 3 bands^2
     * values, planar and readable like planes; diffuse[l] are the factors of the diffuse lobe. */
    void (*field)(int bands, const float *window, const float *diffuse,
                  const lmpi_kernel_surfaces *surfaces, const lmpi_kernel_in *sh, size_t count,
                  const lmpi_kernel_accumulated *accumulated);
    /* Does `zonal` with Phong lobes read from a preintegrated lobe; `specular` holds the positions
     * of each. */
    void (*preintegrated_lobe)(const lmpi_kernel_preintegrated_lobe *lobe,
                               const lmpi_kernel_lobe_positions *specular,
                               const lmpi_kernel_surfaces *surfaces,
                               const lmpi_packed_light *lights, size_t light_count, size_t count,
                               const lmpi_kernel_accumulated *accumulated);
    /* Adds what a BRDF reflects of the lights and of ambient radiance, in planes of red, green,
     * blue. Lobes are not read. */
    void (*preintegrated_brdf)(const lmpi_kernel_preintegrated_brdf *material,
                               const lmpi_kernel_surfaces *surfaces,
                               const lmpi_packed_light *lights, size_t light_count, lmp_rgb ambient,
                               size_t count, float *const rgb[3]);
} lmpi_shade_kernels;

#endif
