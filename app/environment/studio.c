/* SPDX-License-Identifier: MIT */
/* studio.c - a room for a first image: a hemisphere that brightens upward and three soft boxes, of
 * radiances for an exposure of 1. */
#include "app/environment/environment.h"

#include <math.h>

enum { WIDTH = 256, HEIGHT = WIDTH / 2 };
static const float pi = 3.14159265f;
#define PAPER_UP 4.0f /* where the paper is brightest, degrees */

/* A lamp: where its middle is, from the front to the right and up, its half sizes and the width of
 * its soft edge, in degrees. */
typedef struct soft_box {
    float right, up, width, height, edge;
    lmp_rgb radiance;
} soft_box;

static const soft_box boxes[] = {
    { -42, 38, 20, 15, 6, { 4.6f, 4.3f, 3.8f } },    /* key */
    { 62, 12, 16, 32, 10, { 1.05f, 1.12f, 1.25f } }, /* fill */
    { 152, 42, 22, 12, 6, { 3.3f, 3.4f, 3.6f } },    /* rim */
};

static float between(float a, float b, float t) {
    return a + (b - a) * t;
}

/* 1 inside, 0 outside, and smooth over the edge. */
static float inside(float off, float half, float edge) {
    const float t = fminf(fmaxf((half + edge - fabsf(off)) / edge, 0), 1);
    return t * t * (3 - 2 * t);
}

/* The hemisphere and its floor: sine of the elevation, -1 … 1. */
static float hemisphere(float sine) {
    return sine < 0 ? between(0.27f, 0.1f, sqrtf(-sine)) : between(0.27f, 0.6f, sine);
}

static lmp_rgb radiance_at(float right, float up) {
    const float base = hemisphere(sinf(up * pi / 180));
    lmp_rgb sum = { base, base, base };
    for (size_t i = 0; i < sizeof boxes / sizeof *boxes; i++) {
        const soft_box *box = &boxes[i];
        const float around = remainderf(right - box->right, 360) * cosf(up * pi / 180);
        const float part =
            inside(around, box->width, box->edge) * inside(up - box->up, box->height, box->edge);
        sum.r += part * box->radiance.r;
        sum.g += part * box->radiance.g;
        sum.b += part * box->radiance.b;
    }
    return sum;
}

static float bell(float off, float width) {
    const double part = (double)(off / width);
    return (float)exp(-part * part);
}

/* What is seen is no lamp, but a photographer's roll of gray paper, lit behind the subject: darker
 * toward the floor before it, the ceiling and the sides. */
static lmp_rgb paper_at(float right, float up) {
    const float behind = remainderf(right - 180, 360);
    const float level = up < PAPER_UP ? 0.07f + 0.36f * bell(up - PAPER_UP, 30)
                                      : 0.2f + 0.23f * bell(up - PAPER_UP, 45);
    const float gray = level * (0.5f + 0.5f * bell(behind, 50));
    return (lmp_rgb) { 0.98f * gray, gray, 1.03f * gray };
}

/* What radiance_at or paper_at has of every direction. */
static void paint(lmp_rgb (*radiance_of)(float right, float up), image *map) {
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            /* Columns run from +x toward +z: who faces the front has that at the left. */
            const float right = 180 - 360 * ((float)x + 0.5f) / WIDTH;
            const float up = 90 - 180 * ((float)y + 0.5f) / HEIGHT;
            const lmp_rgb radiance = radiance_of(right, up);
            float *pixel = map->rgb + 3 * (y * WIDTH + x);
            pixel[0] = radiance.r, pixel[1] = radiance.g, pixel[2] = radiance.b;
        }
}

bool environment_make_studio(environment *e, cli_error *error) {
    if (!image_create(&e->light, WIDTH, HEIGHT, error) ||
        !image_create(&e->backdrop, WIDTH, HEIGHT, error))
        return false;
    paint(radiance_at, &e->light);
    paint(paper_at, &e->backdrop);
    return true;
}
