/* SPDX-License-Identifier: MIT */
#include "app/render/shadow/toward.h"

#include "app/render/shadow/turn.h"

/* The fraction of directions that are sampled by brightness. */
static const float by_brightness = 0.4f;

/* The probabilities of a point's sampling strategies: by brightness, by the cosine with its normal
 * and with the opposite one, and by lobes around the mirrored view, of the surface and of its
 * coat. */
typedef struct mixture {
    float bright, diffuse, behind, lobe, coat;
} mixture;

static mixture mixture_of(const shadow_points *p, int lane) {
    const float diffuse = p->albedo[lane], behind = p->through[lane], lobe = p->shine[lane];
    const float coat = p->coated ? p->coat[lane] : 0, sum = diffuse + behind + lobe + coat;
    const float scale = sum > 0 ? (1 - by_brightness) / sum : 0;
    return (mixture) { sum > 0 ? by_brightness : 1, scale * diffuse, scale * behind, scale * lobe,
                       scale * coat };
}

static float cosine_density(lmp_vec3 normal, lmp_vec3 w) {
    const float along = vec_dot(normal, w);
    return along > 0 ? along / PI : 0;
}

/* Returns the density (1 + a²) a² / (4 pi (a² + t / 2)²), t = 1 - cosine with the axis: as wide as
 * GGX's lobe of this a², and its integral has an inverse. */
static float lobe_density(lmp_vec3 axis, float a2, lmp_vec3 w) {
    const float off = a2 + 0.5f * fmaxf(1 - vec_dot(axis, w), 0);
    return (1 + a2) * a2 / (4 * PI * off * off);
}

static lmp_vec3 draw_lobe(lmp_vec3 axis, float a2, float u, float v) {
    return shadow_leave(axis, 2 * u * a2 / (1 + a2 - u), v);
}

static lmp_vec3 draw_cosine(lmp_vec3 normal, float u, float v) {
    return shadow_leave(normal, 1 - sqrtf(1 - u), v);
}

/* Whether u falls on a strategy of probability `part`, within which it becomes uniform again; else
 * u is reduced by `part`. */
static bool falls_on(float part, float *u) {
    const bool falls = *u < part;
    *u = falls ? *u / part : *u - part;
    return falls;
}

static lmp_vec3 draw(const mixture *part, const shadow_around *around, const shadow_points *p,
                     int lane, float u, float v, shadow_arrival *arrival) {
    const lmp_vec3 normal = shadow_lane(&p->normal, lane);
    lmp_vec3 w;
    if (falls_on(part->bright, &u))
        return shadow_around_draw(around, u, v, arrival);
    if (falls_on(part->diffuse, &u))
        w = draw_cosine(normal, u, v);
    else if (falls_on(part->behind, &u))
        w = draw_cosine(vec_scale(normal, -1), u, v);
    else if (falls_on(part->lobe, &u) || !(part->coat > 0))
        w = draw_lobe(shadow_lane(&p->mirror, lane), p->alpha2[lane], fminf(u, 1), v);
    else
        w = draw_lobe(shadow_lane(&p->coat_mirror, lane), p->coat_alpha2[lane],
                      fminf(u / part->coat, 1), v);
    *arrival = shadow_around_look(around, w);
    return w;
}

lmp_vec3 shadow_draw_toward(const shadow_around *around, const shadow_points *p, int lane, float u,
                            float v, shadow_arrival *arrival) {
    const mixture part = mixture_of(p, lane);
    const lmp_vec3 w = draw(&part, around, p, lane, u, v, arrival);
    float density = part.bright * arrival->density;
    const lmp_vec3 normal = shadow_lane(&p->normal, lane);
    density += part.diffuse * cosine_density(normal, w);
    density += part.behind * cosine_density(vec_scale(normal, -1), w);
    density += part.lobe * lobe_density(shadow_lane(&p->mirror, lane), p->alpha2[lane], w);
    if (part.coat > 0)
        density +=
            part.coat * lobe_density(shadow_lane(&p->coat_mirror, lane), p->coat_alpha2[lane], w);
    arrival->density = density;
    return w;
}
