/* SPDX-License-Identifier: MIT */
#include "app/scene/interior.h"

#include "app/scene/vector.h"

#define MOST_ABOVE   0.5f  /* of the directions above a point in a room, at least: end at fronts */
#define MOST_BELOW   0.8f  /* of the directions below it, at least: end at fronts */
#define BACKS_ABOVE  0.25f /* of the directions above it, at most: end at backs */
#define OPEN_ANGLE   50.0f /* degrees of a room's horizon without walls, at most */
#define POINTS       16    /* of a room, at least: more than a nook, or an object inside out */
#define LEVEL        0.7f  /* of these, at least: over a level floor, which pipes and rings lack */
#define OUTSIDE_BACK 0.5f  /* of what is seen from outside, at least: fronts, if worth seeing */
#define FURNISHED    1.5f  /* cells seen inside per cell outside: shells and bottles have 1 */
#define SPACIOUS     0.4f  /* of the lattice, at least: room, if the outside is worth seeing */
#define SLOPE        0.15f /* of directions above and below the horizon */
enum {
    DIRECTIONS = 192, /* of a hemisphere */
    AROUND = 72,      /* of a horizon */
    LATTICE = 8,
    LEVELS = 3,
    BLOCK = 2,        /* cells along a side of a block that counts as one */
    AZIMUTHS = 8,     /* views from outside */
    ABOVE = 4,        /* views from outside, steep from above */
    PIXELS = 24,      /* along a side of an image from outside */
    FINE_PIXELS = 96, /* along a side of an image whose cells are counted */
};

/* Returns direction i of a set spread evenly over the upper hemisphere. */
static lmp_vec3 direction(int i) {
    const double y = (i + 0.5) / DIRECTIONS, angle = 2.39996322972865332 * i,
                 across = sqrt(1.0 - y * y);
    return vec((float)(across * cos(angle)), (float)y, (float)(across * sin(angle)));
}

/* --- a point ---------------------------------------------------------------------------------- */

typedef struct look {
    float above, backs, below; /* fractions */
    float depth;               /* mean distance in the directions above */
} look;

static look look_from(const scene_grid *g, lmp_vec3 point) {
    look sum = { 0 };
    int below = 0;
    for (int i = 0; i < DIRECTIONS; i++) {
        const lmp_vec3 up = direction(i);
        float distance;
        const grid_hit hit = scene_grid_look(g, point, up, &distance);
        sum.above += hit == GRID_FRONT;
        sum.backs += hit == GRID_BACK;
        sum.depth += distance / DIRECTIONS;
        if (2 * i < DIRECTIONS) /* skip the foot of walls, which is no floor */
            continue;
        below++;
        sum.below += scene_grid_look(g, point, vec(up.x, -up.y, up.z), &distance) == GRID_FRONT;
    }
    sum.above /= DIRECTIONS;
    sum.backs /= DIRECTIONS;
    sum.below /= (float)below;
    return sum;
}

static bool closes(const look *seen) {
    return seen->above >= MOST_ABOVE && seen->below >= MOST_BELOW && seen->backs <= BACKS_ABOVE;
}

/* Whether surfaces enclose a point. Backs count as well as fronts: leaves and the like show their
 * backs. */
bool scene_interior_closes(const scene_grid *g, lmp_vec3 point) {
    const look around = look_from(g, point);
    return around.above + around.backs >= MOST_ABOVE && around.below > 0.0f;
}

/* Returns the widest part of the horizon that no front closes, in degrees. */
static float widest_opening(const scene_grid *g, lmp_vec3 point) {
    int widest = 0, run = 0;
    for (int i = 0; i < 2 * AROUND && run < AROUND; i++) {
        const double angle = 2.0 * (double)PI * i / AROUND;
        int closed = 0;
        for (int up = -1; up <= 1; up++) {
            const lmp_vec3 way = vec((float)cos(angle), SLOPE * (float)up, (float)sin(angle));
            float distance;
            closed += scene_grid_look(g, point, way, &distance) == GRID_FRONT;
        }
        run = closed < 2 ? run + 1 : 0;
        widest = run > widest ? run : widest;
    }
    return 360.0f * (float)widest / AROUND;
}

/* --- cells seen ------------------------------------------------------------------------------- */

/* A set of blocks of cells, each counted once. */
typedef struct cells {
    unsigned char bits[GRID_ALL / 8];
    int count;
} cells;

static void note(const scene_grid *g, lmp_vec3 from, lmp_vec3 way, float distance, cells *seen) {
    const lmp_vec3 p = vec_add(from, vec_scale(way, distance));
    const float at[3] = { p.x, p.y, p.z }, along[3] = { way.x, way.y, way.z };
    size_t number = 0;
    for (int k = 2; k >= 0; k--) { /* a bit past the hit, which is on a cell's side */
        const float cell = (at[k] - g->low[k]) / g->size[k] + (along[k] > 0.0f ? 1e-2f : -1e-2f);
        const int whole = cell < 0.0f ? 0 : cell < GRID_CELLS ? (int)cell : GRID_CELLS - 1;
        number = number * GRID_CELLS + (size_t)(whole / BLOCK);
    }
    seen->count += !(seen->bits[number / 8] >> number % 8 & 1);
    seen->bits[number / 8] |= (unsigned char)(1 << number % 8);
}

static void note_around(const scene_grid *g, lmp_vec3 point, cells *seen) {
    for (int i = 0; i < 2 * DIRECTIONS; i++) {
        lmp_vec3 way = direction(i / 2);
        float distance;
        way.y = i % 2 ? -way.y : way.y;
        if (scene_grid_look(g, point, way, &distance) == GRID_FRONT)
            note(g, point, way, distance, seen);
    }
}

/* --- from outside ----------------------------------------------------------------------------- */

/* Parallel rays that start before the scene. */
typedef struct beam {
    lmp_vec3 way, start; /* start: of the middle one */
    lmp_vec3 right, up;  /* to the beam's sides, which enclose the scene's box */
} beam;

/* Returns half the extent of a box along a direction. */
static float half_extent(lmp_vec3 size, lmp_vec3 way) {
    return 0.5f * (size.x * fabsf(way.x) + size.y * fabsf(way.y) + size.z * fabsf(way.z));
}

static beam beam_along(const scene_grid *g, lmp_vec3 way) {
    const lmp_vec3 size = vec_scale(vec_load(g->size), GRID_CELLS),
                   middle = vec_add(vec_load(g->low), vec_scale(size, 0.5f)),
                   right = vec_across(way), up = vec_cross(way, right);
    return (beam) { way, vec_add(middle, vec_scale(way, -vec_length(size))),
                    vec_scale(right, half_extent(size, right)),
                    vec_scale(up, half_extent(size, up)) };
}

/* Returns where ray `i` of pixels * pixels starts. */
static lmp_vec3 beam_start(const beam *b, int i, int pixels) {
    const float x = 2.0f * ((float)(i % pixels) + 0.5f) / (float)pixels - 1.0f,
                y = 2.0f * ((float)(i / pixels) + 0.5f) / (float)pixels - 1.0f;
    return vec_add(b->start, vec_add(vec_scale(b->right, x), vec_scale(b->up, y)));
}

/* Returns the fraction of hits of parallel rays along `way` that are fronts. */
static float fronts_along(const scene_grid *g, lmp_vec3 way, int pixels, cells *seen) {
    const beam rays = beam_along(g, way);
    int fronts = 0, all = 0;
    for (int i = 0; i < pixels * pixels; i++) {
        const lmp_vec3 from = beam_start(&rays, i, pixels);
        float distance;
        const grid_hit hit = scene_grid_look(g, from, way, &distance);
        all += hit != GRID_NOTHING;
        fronts += hit == GRID_FRONT;
        if (hit == GRID_FRONT && seen)
            note(g, from, way, distance, seen);
    }
    return all ? (float)fronts / (float)all : 1.0f;
}

/* Returns the view direction of a camera before the model, rotated by part / parts of a circle. */
static lmp_vec3 way_of(int part, int parts, float down) {
    const lmp_vec3 first = vec_normalize(vec(-0.45f, -down, -1.0f), vec(0.0f, 0.0f, -1.0f));
    const double angle = 2.0 * (double)PI * part / parts;
    const float c = (float)cos(angle), s = (float)sin(angle);
    return vec(c * first.x + s * first.z, first.y, c * first.z - s * first.x);
}

float scene_interior_sky(const scene_grid *g, int quarter, bool backs_drawn) {
    enum { UPWARD = 24 };
    const beam rays = beam_along(g, way_of(quarter, 4, 0.35f));
    const lmp_vec3 way = rays.way, size = vec_load(g->size);
    const float before = 2.0f * fmaxf(fmaxf(size.x, size.y), size.z);
    int open = 0, all = 0;
    for (int i = 0; i < PIXELS * PIXELS; i++) {
        float distance;
        lmp_vec3 from = beam_start(&rays, i, PIXELS);
        grid_hit hit = scene_grid_look(g, from, way, &distance);
        for (int k = 0; hit == GRID_BACK && !backs_drawn && k < GRID_CELLS; k++) {
            from = vec_add(from, vec_scale(way, distance + 0.1f * before));
            hit = scene_grid_look(g, from, way, &distance);
        }
        if (hit == GRID_NOTHING || (hit == GRID_BACK && !backs_drawn))
            continue;
        const lmp_vec3 point = vec_add(from, vec_scale(way, distance - before));
        for (int k = 0; k < UPWARD; k++, all++) {
            float far;
            open +=
                scene_grid_look(g, point, direction(k * DIRECTIONS / UPWARD), &far) == GRID_NOTHING;
        }
    }
    return all ? (float)open / (float)all : 1.0f;
}

static void look_from_outside(const scene_grid *g, scene_interior *found) {
    found->fronts = 0.0f;
    for (int i = 0; i < AZIMUTHS; i++) {
        const float fronts = fronts_along(g, way_of(i, AZIMUTHS, 0.35f), PIXELS, NULL);
        found->fronts += fronts / AZIMUTHS;
        if (i % 2 == 0)
            found->fronts_before[i / 2] = fronts;
    }
}

/* Returns how many cells the points of the room see per cell seen from outside. */
static float count_within(const scene_grid *g, const lmp_vec3 *points, int count) {
    static const cells none;
    cells within = none, outside = none;
    for (int i = 0; i < AZIMUTHS; i++)
        fronts_along(g, way_of(i, AZIMUTHS, 0.35f), FINE_PIXELS, &outside);
    for (int i = 0; i < ABOVE; i++)
        fronts_along(g, way_of(i, ABOVE, 1.5f), FINE_PIXELS, &outside);
    for (int i = 0; i < count; i++)
        note_around(g, points[i], &within);
    return (float)within.count / fmaxf((float)outside.count, 1.0f);
}

/* --- the decision ----------------------------------------------------------------------------- */

static lmp_vec3 at(const scene_grid *g, float x, float y, float z) {
    const lmp_vec3 size = vec_load(g->size);
    const float inner = GRID_CELLS - 3;
    return vec_add(vec_load(g->low), vec(size.x * (1.5f + inner * x), size.y * (1.5f + inner * y),
                                         size.z * (1.5f + inner * z)));
}

/* Examines a lattice of points and chooses the room's middle: the scene's middle if a room is
 * around it, else the point of a room from which the view is deepest. */
static void find_middle(const scene_grid *g, scene_interior *found, lmp_vec3 *points) {
    const lmp_vec3 center = at(g, 0.5f, 0.5f, 0.5f);
    const look here = look_from(g, center);
    const bool central = scene_grid_is_empty(g, center) && closes(&here);
    float best = -1.0f;
    found->middle = center;
    for (int i = 0; i < LATTICE * LATTICE * LEVELS; i++) {
        const lmp_vec3 point = at(g, ((float)(i % LATTICE) + 0.5f) / LATTICE,
                                  ((float)(i / (LATTICE * LATTICE)) + 0.75f) / (LEVELS + 1),
                                  ((float)(i / LATTICE % LATTICE) + 0.5f) / LATTICE);
        if (!scene_grid_is_empty(g, point))
            continue;
        const look around = look_from(g, point);
        const bool closed = closes(&around);
        if (closed) {
            points[found->points++] = point;
            found->level += scene_grid_is_level_below(g, point);
        }
        const float worth = closed ? 1.0f + around.depth : around.above * around.below * MOST_ABOVE;
        if (!central && worth > best) {
            best = worth;
            found->middle = point;
        }
    }
}

scene_interior scene_interior_find(const scene_grid *g) {
    scene_interior found = { .inside = false };
    lmp_vec3 points[LATTICE * LATTICE * LEVELS];
    look_from_outside(g, &found);
    find_middle(g, &found, points);
    found.open = widest_opening(g, found.middle);
    found.inside = found.points >= POINTS && found.open <= OPEN_ANGLE &&
                   (float)found.level >= LEVEL * (float)found.points;
    if (found.inside && found.fronts >= OUTSIDE_BACK) {
        found.within = count_within(g, points, found.points);
        found.inside = found.within >= FURNISHED &&
                       (float)found.points >= SPACIOUS * LATTICE * LATTICE * LEVELS;
    }
    return found;
}
