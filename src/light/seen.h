/* SPDX-License-Identifier: MIT */
/* seen.h - what a light of any kind is from a point: a cap, whose size is 0 for a Dirac, or a loop.
 */
#ifndef LAMPION_LIGHT_SEEN_H
#define LAMPION_LIGHT_SEEN_H

#include "src/kernels/flat.h"
#include "src/light/cap.h"
#include "src/light/loop.h"
#include "src/light/packed.h"
#include "src/light/valid.h"

/* An area is a Dirac if its size is below this part of its distance: what it lacks then is smaller
 * than float32 tells, at any number of bands. */
#define LMPI_SEEN_DIRAC 1e-6

typedef struct lmpi_seen {
    bool is_loop;
    lmp_cap cap;      /* unless it is a loop */
    lmp_rgb radiance; /* of the loop */
    lmpi_loop loop;
} lmpi_seen;

/* An area as it is from everywhere: a disk, which has no corners, or a polygon, relative to its
 * position; of a tube only the axis and half of its length. */
typedef struct lmpi_area {
    const lmp_light *light;
    lmpi_vector axis; /* unit: the normal of a flat area, the axis of a tube */
    double half;
    int count;
    lmpi_vector corner[LMP_LIGHT_CORNERS_MAX];
    lmpi_vector area, centroid; /* the area is along the normal */
    double radius;              /* the distance of the farthest point */
} lmpi_area;

void lmpi_area_prepare(const lmp_light *light, lmpi_area *area);

/* Pack for the kernels an area with corners, a disk, and a tube. */
void lmpi_area_pack_polygon(const lmpi_area *area, lmpi_kernel_polygon *polygon);
void lmpi_area_pack_disk(const lmpi_area *area, lmpi_kernel_disk *disk);
void lmpi_area_pack_tube(const lmpi_area *area, lmpi_kernel_tube *tube);

/* Sees an area. A loop is not closed (loop.h), because irradiance does not need it. */
void lmpi_area_see(const lmpi_area *area, lmp_vec3 point, lmpi_seen *seen);

static inline void lmpi_seen_close(lmpi_seen *seen) {
    if (seen->is_loop)
        lmpi_loop_close(&seen->loop);
}

/* Sees a light and closes a loop. Inline, because most lights are no areas. */
static inline void lmpi_light_see(const lmp_light *light, lmp_vec3 point, lmpi_seen *seen) {
    if (lmpi_light_is_area(light)) {
        lmpi_area area;
        lmpi_area_prepare(light, &area);
        lmpi_area_see(&area, point, seen);
        lmpi_seen_close(seen);
        return;
    }
    seen->is_loop = false;
    lmp_light_find_cap(light, point, &seen->cap);
}

/* Rotates what is seen into a frame of three perpendicular axes. */
void lmpi_seen_rotate(const lmp_vec3 frame[3], lmpi_seen *seen);

/* Adds the coefficients of bands low … high-1 to each of the planes red, green, blue that is not
 * NULL; a plane holds only those bands. */
void lmpi_seen_add(int low, int high, const lmpi_seen *seen, float *const planes[3]);

/* Add the irradiance on a surface that faces `normal`: from an area, from any light. */
void lmpi_seen_add_loop_irradiance(const lmpi_seen *seen, lmp_vec3 normal, lmp_rgb *sum);
static inline void lmpi_seen_add_irradiance(const lmpi_seen *seen, lmp_vec3 normal, lmp_rgb *sum) {
    if (seen->is_loop)
        lmpi_seen_add_loop_irradiance(seen, normal, sum);
    else
        lmpi_cap_add_irradiance(&seen->cap, normal, sum);
}

#endif
