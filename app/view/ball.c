/* SPDX-License-Identifier: MIT */
#include "app/view/ball.h"
#include "app/scene/material.h"
#include "app/scene/vector.h"

#include <stdio.h>
#include <string.h>

/* Light comes from directions in rings around the mirrored eye, the narrower the nearer to it,
 * where smooth materials reflect. */
enum { RINGS = 28, IN_RING = 20 };
#define BOX    3.0f /* the radiance of the soft box */
#define SKY    0.45f
#define GROUND 0.15f

static float radiance_from(lmp_vec3 direction) {
    const lmp_vec3 box = vec_normalize(vec(-1, 1.3f, 1.2f), vec(0, 1, 0));
    const float inside = fminf(fmaxf((vec_dot(direction, box) - 0.82f) / 0.12f, 0), 1);
    const float above = fminf(fmaxf(0.5f + 2 * direction.y, 0), 1);
    return GROUND + (SKY - GROUND) * above + BOX * inside * inside * (3 - 2 * inside);
}

static float ring_angle(float ring) {
    const float part = ring / RINGS;
    return PI * part * part * part;
}

/* A direction of light, along the mirrored eye and two axes across it, and its solid angle. */
typedef struct beam {
    float u, w, mirror, solid_angle;
} beam;

static void find_beams(beam beams[RINGS * IN_RING]) {
    for (int i = 0; i < RINGS * IN_RING; i++) {
        const int ring = i / IN_RING;
        const float inner = ring_angle((float)ring), outer = ring_angle((float)ring + 1);
        const float angle = 0.5f * (inner + outer), across = sinf(angle);
        const float around = 2 * PI * (float)i / IN_RING + 2.3999632f * (float)ring;
        beams[i] = (beam) { across * cosf(around), across * sinf(around), cosf(angle),
                            2 * PI * across * (outer - inner) / IN_RING };
    }
}

/* Returns what the ball reflects to the eye, which is far along z, where it faces `normal`. */
static lmp_rgb reflect(const lmp_brdf *brdf, const beam *beams, lmp_vec3 normal) {
    const lmp_vec3 x = vec_across(normal), y = vec_cross(normal, x);
    const lmp_vec3 eye = vec(x.z, y.z, normal.z);
    const lmp_vec3 mirror = vec_sub(vec_scale(normal, 2 * normal.z), vec(0, 0, 1));
    const lmp_vec3 u = vec_across(mirror), w = vec_cross(mirror, u);
    lmp_rgb sum = { 0, 0, 0 };
    for (int i = 0; i < RINGS * IN_RING; i++) {
        const beam *const b = &beams[i];
        const lmp_vec3 from =
            vec_add(vec_scale(mirror, b->mirror), vec_add(vec_scale(u, b->u), vec_scale(w, b->w)));
        const lmp_vec3 in = vec(vec_dot(from, x), vec_dot(from, y), vec_dot(from, normal));
        if (in.z <= 0)
            continue;
        const lmp_rgb f = lmp_brdf_eval(brdf, in, eye);
        const float weight = b->solid_angle * in.z * radiance_from(from);
        sum = (lmp_rgb) { sum.r + weight * f.r, sum.g + weight * f.g, sum.b + weight * f.b };
    }
    return sum;
}

static void draw(const lmp_brdf *brdf, float *rgb) {
    beam beams[RINGS * IN_RING];
    find_beams(beams);
    for (int i = 0; i < VIEW_BALL_SIZE * VIEW_BALL_SIZE; i++, rgb += 3) {
        const float x = 2 * ((float)(i % VIEW_BALL_SIZE) + 0.5f) / VIEW_BALL_SIZE - 1;
        const float y = 1 - 2 * ((float)(i / VIEW_BALL_SIZE) + 0.5f) / VIEW_BALL_SIZE;
        const float z2 = 1 - x * x - y * y;
        rgb[0] = -1;
        if (z2 > 0)
            rgb_store(reflect(brdf, beams, vec(x, y, sqrtf(z2))), rgb);
        for (int k = 0; k < 3 && z2 > 0; k++)
            rgb[k] = fminf(rgb[k], 1);
    }
}

bool view_ball_draw(view_ball *ball, const char *name) {
    material opened;
    base_error ignored;
    if (strcmp(ball->material, name) == 0)
        return ball->drawn;
    snprintf(ball->material, sizeof ball->material, "%s", name);
    ball->drawn = material_open(name, &opened, &ignored);
    if (!ball->drawn)
        return false;
    ball->drawn = opened.brdf;
    if (ball->drawn)
        draw(opened.brdf, ball->rgb);
    material_close(&opened);
    return ball->drawn;
}
