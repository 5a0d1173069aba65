/* SPDX-License-Identifier: MIT */
#include "app/render/cpu/shared.h"

#include "app/scene/vector.h"

/* A packed normal has ten bits per axis, 1 … 1023 for -1 … 1. */
enum { BITS = 10, MASK = (1 << BITS) - 1, MIDDLE = 1 << (BITS - 1) };
#define UNLIKE (1u << 31)

static uint32_t pack(float x) {
    const float held = x > -1 ? (x < 1 ? x : 1) : -1;
    return (uint32_t)(held * (MIDDLE - 1) + (MIDDLE + 0.5f));
}

static float unpack(uint32_t packed, int axis) {
    return ((float)(int)(packed >> (BITS * axis) & MASK) - MIDDLE) * (1.0f / (MIDDLE - 1));
}

void cpu_shared_keep(const render_surfaces *s, size_t at, lmp_vec3 n) {
    s->smooth[at] = pack(n.x) | pack(n.y) << BITS | pack(n.z) << 2 * BITS;
}

/* --- pixels like their neighbors -------------------------------------------------------------- */

/* How much two neighboring pixels may differ, relative to their largest component. */
static const float contrast = 0.25f;

static inline float larger(float a, float b) {
    return a > b ? a : b;
}

static bool differ(const float *a, const float *b) {
    const float brightest =
        larger(larger(larger(a[0], a[1]), a[2]), larger(larger(b[0], b[1]), b[2]));
    const float most = contrast * brightest;
    return !(fabsf(a[0] - b[0]) <= most && fabsf(a[1] - b[1]) <= most &&
             fabsf(a[2] - b[2]) <= most);
}

/* Marks two neighbors if they differ. Where no normal is kept, nothing needs a mark. */
static void compare(const render_surfaces *s, const float *rgba, size_t a, size_t b) {
    if (!(s->smooth[a] | s->smooth[b]))
        return;
    const uint32_t mark = differ(rgba + 4 * a, rgba + 4 * b) ? UNLIKE : 0;
    s->smooth[a] |= mark;
    s->smooth[b] |= mark;
}

void cpu_shared_mark(const render_surfaces *s, const float *rgba, const render_rectangle *pixels) {
    const size_t below = (size_t)s->width;
    for (int j = 0; j < pixels->height; j++) {
        const size_t first = render_surfaces_at(s, pixels->x, pixels->y + j);
        for (int i = 0; i < pixels->width; i++)
            s->smooth[first + (size_t)i] &= ~UNLIKE;
    }
    for (int j = 0; j < pixels->height; j++)
        for (int i = 0; i < pixels->width; i++) {
            const size_t at = render_surfaces_at(s, pixels->x + i, pixels->y + j);
            if (i + 1 < pixels->width)
                compare(s, rgba, at, at + 1);
            if (j + 1 < pixels->height)
                compare(s, rgba, at, at + below);
        }
}

/* --- samples ---------------------------------------------------------------------------------- */

static void copy(float *const from[3], float *const to[3], size_t at) {
    for (int c = 0; c < 3; c++)
        to[c][at] = from[c][at];
}

static void copy_layers(const render_surfaces *from, size_t at, const render_surfaces *to) {
    copy(from->coat_normal, to->coat_normal, at);
    copy(from->tint, to->tint, at);
    copy(from->sheen, to->sheen, at);
    to->coat[at] = from->coat[at];
    to->coat_roughness[at] = from->coat_roughness[at];
    to->sheen_roughness[at] = from->sheen_roughness[at];
}

static bool is_same(const cpu_first *f, lmp_vec3 position, lmp_vec3 smooth, size_t at,
                    const render_camera *camera) {
    float *const *const other = f->surfaces->position;
    const uint32_t packed = f->surfaces->smooth[at];
    const lmp_vec3 away = vec_sub(position, vec_load(camera->eye));
    const lmp_vec3 moved = vec_sub(position, vec(other[0][at], other[1][at], other[2][at]));
    const lmp_vec3 tilted =
        vec_sub(smooth, vec(unpack(packed, 0), unpack(packed, 1), unpack(packed, 2)));
    return !(packed & UNLIKE) &&
           vec_dot(moved, moved) <= f->near.constant + f->near.spread * vec_dot(away, away) &&
           vec_dot(tilted, tilted) <= RENDER_NORMAL_STEP * RENDER_NORMAL_STEP;
}

bool cpu_shared_take(const cpu_first *f, uint32_t number, lmp_vec3 position, lmp_vec3 smooth,
                     size_t at, const render_surfaces *s) {
    const render_surfaces *first = f->surfaces;
    if (first->seen[at] != number || !is_same(f, position, smooth, at, &s->camera))
        return false;
    s->seen[at] = number;
    if (s->same) {
        s->same[at] = 1;
        return true;
    }
    if (s->taken)
        s->taken[at] = 1;
    copy(first->normal, s->normal, at);
    copy(first->base, s->base, at);
    copy(first->emission, s->emission, at);
    s->metallic[at] = first->metallic[at];
    s->roughness[at] = first->roughness[at];
    s->specular[at] = first->specular[at];
    s->ambient[at] = first->ambient[at];
    if (s->layered && render_material_is_layered(s->materials, number))
        copy_layers(first, at, s);
    if (s->translucent)
        copy(first->transmitted, s->transmitted, at);
    return true;
}
