/* SPDX-License-Identifier: MIT */
#include "app/scene/grid.h"

#include "app/scene/instance.h"
#include "app/scene/vector.h"

#include <stdlib.h>

#define GRID_FINE  2.0f  /* samples of a triangle per cell */
#define GRID_FLAT  1e-3f /* of the longest extent: the least extent of any axis */
#define GRID_SIDE  0.5f  /* of the area facing away: a front beside it that is larger is seen */
#define GRID_LEVEL 0.8f  /* of the area along all axes, at least: along y, a slope of up to 14° */

/* --- filling ---------------------------------------------------------------------------------- */

static size_t cell_at(const int cell[3]) {
    return ((size_t)cell[2] * GRID_CELLS + (size_t)cell[1]) * GRID_CELLS + (size_t)cell[0];
}

static bool is_filled(const scene_grid *g, size_t cell) {
    return g->filled[cell / 8] >> cell % 8 & 1;
}

static int inside(float cells) {
    return !(cells > 0.0f) ? 0 : cells < GRID_CELLS ? (int)cells : GRID_CELLS - 1;
}

/* Returns the length of an edge in cells, along the axis where it is longest. */
static float span(const scene_grid *g, lmp_vec3 edge) {
    return fmaxf(fabsf(edge.x) / g->size[0],
                 fmaxf(fabsf(edge.y) / g->size[1], fabsf(edge.z) / g->size[2]));
}

/* Returns the samples along an edge. No edge is longer than the grid unless the scene's bounds are
 * wrong. */
static int steps(float span) {
    return span < GRID_CELLS ? 1 + (int)(GRID_FINE * span) : 1;
}

/* Adds a triangle's area to the cells that it covers, at samples along its shortest side and
 * another one. */
static void add(scene_grid *g, const float corners[3][3]) {
    lmp_vec3 corner[3];
    int apex = 0;
    float least = INFINITY;
    for (int i = 0; i < 3; i++)
        corner[i] = vec_load(corners[i]);
    for (int i = 0; i < 3; i++) {
        const float side = span(g, vec_sub(corner[(i + 1) % 3], corner[i]));
        if (side < least) {
            least = side;
            apex = i;
        }
    }
    const lmp_vec3 a = corner[apex], u = vec_sub(corner[(apex + 1) % 3], a),
                   v = vec_sub(corner[(apex + 2) % 3], a), normal = vec_cross(u, v);
    const int rows = steps(span(g, v)), columns = steps(span(g, u));
    const float part = 1.0f / (float)(rows * columns), twice[3] = { normal.x, normal.y, normal.z };
    for (int i = 0; i < rows; i++)
        for (int j = 0; j < columns; j++) {
            float s = ((float)j + 0.5f) / (float)columns, t = ((float)i + 0.5f) / (float)rows;
            if (s + t > 1.0f) {
                s = 1.0f - s;
                t = 1.0f - t;
            }
            const lmp_vec3 p = vec_add(a, vec_add(vec_scale(u, s), vec_scale(v, t)));
            const int cell[3] = { inside((p.x - g->low[0]) / g->size[0]),
                                  inside((p.y - g->low[1]) / g->size[1]),
                                  inside((p.z - g->low[2]) / g->size[2]) };
            const size_t at = cell_at(cell);
            float *facing = g->facing[at];
            g->filled[at / 8] |= (unsigned char)(1 << at % 8);
            for (int k = 0; k < 3; k++)
                facing[2 * k + (twice[k] > 0.0f)] += fabsf(twice[k]) * part;
        }
}

scene_grid *scene_grid_create(const scene *s) {
    scene_grid *g = calloc(1, sizeof *g);
    float longest = 0.0f;
    for (int k = 0; k < 3; k++)
        longest = fmaxf(longest, s->maximum[k] - s->minimum[k]);
    for (int k = 0; k < 3 && g; k++) {
        const float extent = fmaxf(s->maximum[k] - s->minimum[k], GRID_FLAT * longest);
        /* the bounds lie in the middle of cells: on a cell's side, rounding would scatter a wall
         * over both */
        g->size[k] = extent > 0.0f ? extent / (float)(GRID_CELLS - 3) : 1.0f;
        g->low[k] = 0.5f * (s->minimum[k] + s->maximum[k]) - 0.5f * (float)GRID_CELLS * g->size[k];
    }
    for (size_t i = 0; i < s->instance_count && g; i++)
        for (uint32_t n = 0; n < scene_instance_triangles(s, i); n++) {
            float corners[3][3];
            scene_triangle_positions(s, i, n, corners);
            add(g, (const float(*)[3])corners);
        }
    return g;
}

void scene_grid_destroy(scene_grid *g) {
    free(g);
}

/* --- looking ---------------------------------------------------------------------------------- */

static grid_hit hit_of(const float facing[6], const float way[3]) {
    float front = 0.0f, back = 0.0f;
    for (int k = 0; k < 3; k++) {
        const int ahead = way[k] > 0.0f;
        front += fabsf(way[k]) * facing[2 * k + !ahead];
        back += fabsf(way[k]) * facing[2 * k + ahead];
    }
    return front > 0.0f && front >= GRID_SIDE * back ? GRID_FRONT
           : back > 0.0f                             ? GRID_BACK
                                                     : GRID_NOTHING;
}

bool scene_grid_is_empty(const scene_grid *g, lmp_vec3 point) {
    const int cell[3] = { inside((point.x - g->low[0]) / g->size[0]),
                          inside((point.y - g->low[1]) / g->size[1]),
                          inside((point.z - g->low[2]) / g->size[2]) };
    const size_t at = cell_at(cell);
    float all = 0.0f;
    for (int i = 0; i < 6 && is_filled(g, at); i++)
        all += g->facing[at][i];
    return !(all > 0.0f);
}

/* A walk through the cells along a line, in order. */
typedef struct walk {
    int cell[3], step[3];
    float next[3], every[3]; /* distances to the next cell along each axis, and between cells */
} walk;

/* Finds where the line enters the grid; returns false if it misses. */
static bool begin(const scene_grid *g, const float from[3], const float way[3], float *start,
                  walk *w) {
    float enter = 0.0f, leave = INFINITY;
    for (int k = 0; k < 3; k++) {
        const float a = (g->low[k] - from[k]) / way[k],
                    b = (g->low[k] + (float)GRID_CELLS * g->size[k] - from[k]) / way[k];
        if (way[k] != 0.0f) {
            enter = fmaxf(enter, fminf(a, b));
            leave = fminf(leave, fmaxf(a, b));
        } else if (from[k] < g->low[k] || from[k] > g->low[k] + (float)GRID_CELLS * g->size[k]) {
            return false;
        }
    }
    for (int k = 0; k < 3; k++) {
        w->cell[k] = inside((from[k] + enter * way[k] - g->low[k]) / g->size[k]);
        w->step[k] = way[k] > 0.0f ? 1 : -1;
        w->every[k] = way[k] != 0.0f ? g->size[k] / fabsf(way[k]) : INFINITY;
        const float edge = g->low[k] + (float)(w->cell[k] + (way[k] > 0.0f)) * g->size[k];
        w->next[k] = way[k] != 0.0f ? (edge - from[k]) / way[k] : INFINITY;
    }
    *start = enter;
    return enter < leave;
}

/* Walks to the first surface and sets *facing to its cell's. */
static grid_hit look(const scene_grid *g, lmp_vec3 from, lmp_vec3 way, float *distance,
                     const float **facing) {
    const float p[3] = { from.x, from.y, from.z }, d[3] = { way.x, way.y, way.z };
    walk w;
    if (!begin(g, p, d, distance, &w))
        return GRID_NOTHING;
    for (;;) {
        const int axis = w.next[0] <= w.next[1] && w.next[0] <= w.next[2] ? 0
                         : w.next[1] <= w.next[2]                         ? 1
                                                                          : 2;
        *distance = w.next[axis];
        w.cell[axis] += w.step[axis];
        w.next[axis] += w.every[axis];
        if (w.cell[axis] < 0 || w.cell[axis] >= GRID_CELLS)
            return GRID_NOTHING;
        const size_t at = cell_at(w.cell);
        if (!is_filled(g, at))
            continue;
        *facing = g->facing[at];
        const grid_hit hit = hit_of(*facing, d);
        if (hit != GRID_NOTHING)
            return hit;
    }
}

grid_hit scene_grid_look(const scene_grid *g, lmp_vec3 from, lmp_vec3 way, float *distance) {
    const float *facing;
    return look(g, from, way, distance, &facing);
}

bool scene_grid_is_level_below(const scene_grid *g, lmp_vec3 point) {
    const float *facing;
    float distance, all = 0.0f;
    if (look(g, point, vec(0.0f, -1.0f, 0.0f), &distance, &facing) == GRID_NOTHING)
        return false;
    for (int i = 0; i < 6; i++)
        all += facing[i];
    return facing[2] + facing[3] >= GRID_LEVEL * all;
}
