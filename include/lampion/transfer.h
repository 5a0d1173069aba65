/* SPDX-License-Identifier: MIT */
/* lampion/transfer.h - light that bounces between surfaces that rest, under lights that move.
 *
 * What a bounce depends on is geometry: which surface a ray from another one hits. Your own rays
 * find that once. A transfer keeps what they found, and every frame it turns the light that
 * surfaces receive directly into the light that they receive from each other: no ray is cast, and
 * nothing is noisy.
 *
 * Surfels are samples of the surfaces. From each start `ray_count` rays, and each ray hits a
 * source: a surfel, a patch of the sky, or nothing. The indirect irradiance of surfel i is
 *
 *     E_i = mean of B_s over the sources s that its rays hit,
 *     B_s = albedo (direct + E_s) + pi emission of a surfel, pi radiance of the sky,
 *
 * with rays distributed as the cosine around the normal (the radiosity equation, its form factors
 * by sampling). An update iterates it, each iteration one bounce more, beginning with the last
 * update's E: while the lights rest it converges, and while they move it stays close.
 *
 * Diffuse surfaces that rest read the surfels near them; specular lobes, and what moves, read
 * probes. docs/transfer.md says how to place surfels and rays, what it costs and how far it errs.
 *
 * Many threads may read a transfer at once, as long as none updates it. All arguments but those of
 * the functions that only read are checked, also in a release build. */
#ifndef LAMPION_TRANSFER_H
#define LAMPION_TRANSFER_H

#include <lampion/sh.h>

#ifdef __cplusplus
extern "C" {
#endif

#define LMP_TRANSFER_SOURCES_MAX    16777216 /* surfels and patches of the sky together */
#define LMP_TRANSFER_PROBES_MAX     16777216
#define LMP_TRANSFER_RAYS_MAX       4096
#define LMP_TRANSFER_LINKS_MAX      64
#define LMP_TRANSFER_BANDS_MAX      8
#define LMP_TRANSFER_ITERATIONS_MAX 1000

/* What a ray hits that finds no light, and what a link is that is not used. */
#define LMP_TRANSFER_NONE UINT32_MAX

typedef struct lmp_transfer lmp_transfer;

/* A sample of a surface. Two-sided surfaces take two. */
typedef struct lmp_transfer_surfel {
    lmp_vec3 position, normal; /* finite; unit */
    lmp_rgb albedo;            /* the fraction of light that is reflected, 0 … 1 each */
    float radius;              /* of the points that read it, > 0; about 1.5 times the spacing */
} lmp_transfer_surfel;

/* What the rays found. Arrays are copied. Sources are counted from 0: first the surfels, then the
 * patches of the sky, any division of the sphere of directions, such as the texels of a cube map. A
 * ray hits the nearest surfel of the surface that it meets, or the patch in its direction. */
typedef struct lmp_transfer_desc {
    const lmp_transfer_surfel *surfels;
    size_t surfel_count; /* at least 1 */
    size_t sky_count;
    /* Sources, `ray_count` for each surfel, those of surfel 0 first. The density of the rays'
     * directions is proportional to the cosine with the normal. ray_count is at least 1. */
    const uint32_t *hits;
    size_t ray_count;
    /* Surfels, `link_count` for each surfel: those near it, on the same surface, that are seen from
     * it. A point reads the surfel nearest to it, and the links of that surfel. */
    const uint32_t *links;
    size_t link_count;
    /* Sources, `probe_ray_count` for each probe, those of probe 0 first. The directions, which are
     * unit, are uniform on the sphere and the same for all probes. */
    const lmp_vec3 *probe_directions;
    const uint32_t *probe_hits;
    size_t probe_count, probe_ray_count;
    int bands; /* of probes: 1 … LMP_TRANSFER_BANDS_MAX; 3 */
} lmp_transfer_desc;

typedef struct lmp_transfer_info {
    size_t surfel_count, sky_count, ray_count, link_count, probe_count, probe_ray_count;
    int bands;
    size_t bytes;   /* of all memory that the transfer holds */
    int iterations; /* that the last update took */
    /* No surfel's E is further from its limit than this, relative to the largest E, as far as the
     * last iteration over all surfels can tell; INFINITY if there was none, or if no limit is known
     * because surfels reflect all light. */
    float remainder;
} lmp_transfer_info;

/* Creates a transfer without light. Below, nothing allocates memory. host may be NULL; on failure
 * *transfer is NULL (LMP_ERROR_ARGUMENT: a member of desc is outside its range, an array is
 * missing, or something hits or links to what does not exist). */
LMP_EXPERIMENTAL LMP_API lmp_result lmp_transfer_create(const lmp_host *host,
                                                        const lmp_transfer_desc *desc,
                                                        lmp_transfer **transfer);
LMP_EXPERIMENTAL LMP_API void lmp_transfer_destroy(lmp_transfer *transfer);
LMP_EXPERIMENTAL LMP_API lmp_transfer_info lmp_transfer_describe(const lmp_transfer *transfer);

/* --- every frame ------------------------------------------------------------------------------ */

/* The light of a frame. Every value is within 1e28 of 0; NULL means that there is none. */
typedef struct lmp_transfer_lighting {
    /* Irradiance of each surfel by lights, W·m⁻², with their shadows: lmp_light_irradiance for
     * example. Light that comes from a patch of the sky, or from a surfel that emits, is not
     * direct. */
    const lmp_rgb *direct;
    const lmp_rgb *emission; /* radiance that each surfel emits on its own */
    const lmp_rgb *sky;      /* radiance of each patch */
} lmp_transfer_lighting;

/* How far to iterate; zero-initialize it. */
typedef struct lmp_transfer_settings {
    int iterations; /* at most: 1 … LMP_TRANSFER_ITERATIONS_MAX; 4 */
    /* Stops as soon as lmp_transfer_info has a remainder of at most this; 0 … 1, 0 never stops. */
    float remainder;
    /* The number of surfels that an iteration computes, the next ones in turn; 0 means all. The
     * others keep their E, but reflect the direct light of this frame. */
    size_t budget;
} lmp_transfer_settings;

/* Computes the indirect irradiance of surfels, on the threads of the host. host and settings may be
 * NULL. LMP_ERROR_ARGUMENT: a value is outside its range; nothing has changed. After
 * LMP_ERROR_CANCELLED some surfels have the light of an earlier iteration; the next update
 * continues from there. */
LMP_EXPERIMENTAL LMP_API lmp_result lmp_transfer_update(const lmp_host *host,
                                                        lmp_transfer *transfer,
                                                        const lmp_transfer_settings *settings,
                                                        const lmp_transfer_lighting *lighting);

/* Forgets all light: the next update begins in darkness, as the first one does. */
LMP_EXPERIMENTAL LMP_API void lmp_transfer_reset(lmp_transfer *transfer);

/* --- reading ---------------------------------------------------------------------------------- */

/* Returns the indirect irradiance, W·m⁻², at a point of a surface: a mean of E over the surfel
 * nearest to the point and its links, with weights
 *
 *     (1 - d²/radius²)² n·n',   0 beyond the radius or a right angle,
 *
 * where d is the distance from the point and n' the normal of a surfel. The nearest surfel counts a
 * little in any case, so a point that no radius reaches has its E.
 *
 * surfel < surfel_count; normal must be unit */
LMP_EXPERIMENTAL LMP_API lmp_rgb lmp_transfer_irradiance(const lmp_transfer *transfer,
                                                         size_t surfel, lmp_vec3 point,
                                                         lmp_vec3 normal);

/* Copies E of the surfels first … first + count - 1, for shaders that read them by links. */
LMP_EXPERIMENTAL LMP_API void lmp_transfer_copy_irradiance_n(const lmp_transfer *transfer,
                                                             size_t first, size_t count,
                                                             lmp_rgb_array rgb);

/* Evaluates the coefficients of the light that the probes first … first + count - 1 receive from
 * surfels and the sky, as of the last update: 3 * LMP_SH_COUNT(bands) values per probe, red, green,
 * blue. Threads may share the probes. */
LMP_EXPERIMENTAL LMP_API void lmp_transfer_eval_probe_n(const lmp_transfer *transfer, size_t first,
                                                        size_t count, lmp_sh_array sh);

#ifdef __cplusplus
}
#endif
#endif
