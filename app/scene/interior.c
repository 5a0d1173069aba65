/* SPDX-License-Identifier: MIT */
#include "app/scene/interior.h"

#include "app/scene/vector.h"

#define MOST_ABOVE   0.5f  /* of the directions above a point in a room that end at a front */
#define MOST_BELOW   0.8f  /* of those below it */
#define BACKS_ABOVE  0.25f /* of those above it that end at a back, at most */
#define OPEN_ANGLE   50.0f /* of a room's horizon, at most: where a wall is missing one looks in */
#define POINTS       4     /* of a room: more than a nook */
#define OUTSIDE_BACK 0.5f  /* of what is seen from outside shows fronts, or nobody is to see it */
#define FURNISHED    1.5f  /* cells seen within for one outside: shells and bottles have as many */
#define SPACIOUS     0.4f  /* of the lattice that is room, where the outside is one to see */
#define SLOPE        0.15f /* above and below the horizon */
enum {
    DIRECTIONS = 192, /* of a hemisphere */
    AROUND = 72,      /* of a horizon */
    LATTICE = 8,
    LEVELS = 3,
    BLOCK = 2,        /* cells along a side of what is counted */
    AZIMUTHS = 8,     /* from outside */
    ABOVE = 4,        /* the same, from high above */
    PIXELS = 24,      /* along a side of an image from outside */
    FINE_PIXELS = 96, /* of one that counts cells */
};

/* Spread evenly over the upper hemisphere. */
static lmp_vec3 direction(int i) {
    const double y = (i + 0.5) / DIRECTIONS, angle = 2.39996322972865332 * i,
                 across = sqrt(1.0 - y * y);
    return vec((float)(across * cos(angle)), (float)y, (float)(across * sin(angle)));
}

/* --- a point ---------------------------------------------------------------------------------- */

typedef struct look {
    float above, backs, below; /* fractions */
    float depth;               /* mean distance of what is above */
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
        if (2 * i < DIRECTIONS) /* a floor, not the foot of walls */
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

/* Leaves and the like show their backs. */
bool scene_interior_closes(const scene_grid *g, lmp_vec3 point) {
    const look around = look_from(g, point);
    return around.above + around.backs >= MOST_ABOVE && around.below > 0.0f;
}

/* The widest part of the horizon that no front closes, in degrees. */
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

/* Blocks of cells, counted once. */
enum { CELLS = GRID_CELLS * GRID_CELLS * GRID_CELLS };
typedef struct cells {
    unsigned char bits[CELLS / 8];
    int count;
} cells;

static void note(const scene_grid *g, lmp_vec3 from, lmp_vec3 way, float distance, cells *seen) {
    const lmp_vec3 p = vec_add(from, vec_scale(way, distance));
    const float at[3] = { p.x, p.y, p.z }, along[3] = { way.x, way.y, way.z };
    size_t number = 0;
    for (int k = 2; k >= 0; k--) { /* a bit farther on: distances are those of a cell's side */
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

/* The part of fronts in what parallel rays along `way` see. */
static float fronts_along(const scene_grid *g, lmp_vec3 way, int pixels, cells *seen) {
    const lmp_vec3 size = vec_scale(vec_load(g->size), GRID_CELLS),
                   middle = vec_add(vec_load(g->low), vec_scale(size, 0.5f)),
                   right = vec_across(way), up = vec_cross(way, right);
    const float radius = 0.5f * vec_length(size);
    int fronts = 0, all = 0;
    for (int i = 0; i < pixels * pixels; i++) {
        const float x = 2.0f * ((float)(i % pixels) + 0.5f) / (float)pixels - 1.0f,
                    y = 2.0f * ((float)(i / pixels) + 0.5f) / (float)pixels - 1.0f;
        const lmp_vec3 from =
            vec_add(vec_add(middle, vec_scale(way, -2.0f * radius)),
                    vec_add(vec_scale(right, x * radius), vec_scale(up, y * radius)));
        float distance;
        const grid_hit hit = scene_grid_look(g, from, way, &distance);
        all += hit != GRID_NOTHING;
        fronts += hit == GRID_FRONT;
        if (hit == GRID_FRONT && seen)
            note(g, from, way, distance, seen);
    }
    return all ? (float)fronts / (float)all : 1.0f;
}

/* Where the camera before a model looks, some parts of a circle on. */
static lmp_vec3 way_of(int part, int parts, float down) {
    const lmp_vec3 first = vec_normalize(vec(-0.45f, -down, -1.0f), vec(0.0f, 0.0f, -1.0f));
    const double angle = 2.0 * (double)PI * part / parts;
    const float c = (float)cos(angle), s = (float)sin(angle);
    return vec(c * first.x + s * first.z, first.y, c * first.z - s * first.x);
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

/* How many cells the points of the room see for each that is seen from outside. */
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

/* Looks around at a lattice of points and takes as the middle the scene's own, if a room is around
 * it, else the point of a room from which one sees farthest. */
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
        if (closed)
            points[found->points++] = point;
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
    found.inside = found.points >= POINTS && found.open <= OPEN_ANGLE;
    if (found.inside && found.fronts >= OUTSIDE_BACK) {
        found.within = count_within(g, points, found.points);
        found.inside = found.within >= FURNISHED &&
                       (float)found.points >= SPACIOUS * LATTICE * LATTICE * LEVELS;
    }
    return found;
}
