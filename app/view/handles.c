/* SPDX-License-Identifier: MIT */
#include "app/view/handles.h"

#include "app/scene/vector.h"
#include "app/view/lights.h"

#include <math.h>
#include <stdio.h>

/* Lengths in pixels at 96 per inch. */
#define GAP         34.0f  /* from the light to its arrows, so that itself can be dragged, too */
#define ARROW       100.0f /* from the light to the tip of an arrow */
#define SQUARE      46.0f  /* to the near side of a square, */
#define SQUARE_END  64.0f  /* to its far side */
#define REACH       135.0f /* to the tip of its direction and the circles of its angles */
#define NEAREST     26.0f  /* of a handle for a size, however small that is */
#define HEAD_LENGTH 14.0f
#define HEAD_WIDTH  6.0f
#define KNOB        6.0f
#define HIT         7.0f /* by which a handle may be missed */
/* Axes nearer to the view than this, as a cosine, and planes as near to their edge have none. */
#define ALONG      0.985f
#define EDGE_ON    0.12f
#define STEP_ANGLE (PI / 36)

const char *const view_handle_names[VIEW_HANDLES] = {
    [VIEW_HANDLE_NONE] = "none",     [VIEW_HANDLE_X] = "x",
    [VIEW_HANDLE_Y] = "y",           [VIEW_HANDLE_Z] = "z",
    [VIEW_HANDLE_YZ] = "yz",         [VIEW_HANDLE_ZX] = "zx",
    [VIEW_HANDLE_XY] = "xy",         [VIEW_HANDLE_DIRECTION] = "direction",
    [VIEW_HANDLE_SIZE] = "size",     [VIEW_HANDLE_WIDTH] = "width",
    [VIEW_HANDLE_HEIGHT] = "height", [VIEW_HANDLE_RADIUS] = "radius",
    [VIEW_HANDLE_OUTER] = "outer",   [VIEW_HANDLE_INNER] = "inner",
    [VIEW_HANDLE_ANGLE] = "angle",
};

static const lmp_vec3 axes[3] = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };

/* The selected light as it is seen, and the marks to which its handles are added. */
typedef struct sketch {
    const view_state *state;
    view_marks *marks;
    scene_light light;
    bool moves;      /* whether it has a position */
    lmp_vec3 center; /* of the handles: its position, or else in the middle of the image */
    view_ray ray;    /* from the eye to there */
    float pixel;     /* the length of one at 96 per inch, there */
} sketch;

static bool project(const view_state *s, lmp_vec3 point, double *x, double *y, double *scale) {
    return view_project(&s->now.camera, s->now.width, s->now.height, point, x, y, scale);
}

static bool see_light(const view_state *s, sketch *k) {
    double x, y, scale;
    if (s->selected < 0)
        return false;
    *k = (sketch) { .state = s, .light = view_shown_light(s, s->selected) };
    k->moves = scene_light_has(&k->light, SCENE_LIGHT_POSITION);
    k->center = k->moves ? k->light.emitter.position : vec_load(s->now.camera.target);
    if (!project(s, k->center, &x, &y, &scale))
        return false;
    k->ray = view_ray_at(s, x, y);
    k->pixel = (float)(s->scale / scale);
    return true;
}

/* --- lengths and angles ----------------------------------------------------------------------- */

static bool is_move(view_handle_kind handle) {
    return handle >= VIEW_HANDLE_X && handle <= VIEW_HANDLE_XY;
}

static bool is_angle(view_handle_kind handle) {
    return handle >= VIEW_HANDLE_OUTER;
}

/* Returns half of a side, or of a tube's axis. */
static lmp_vec3 *half_of(lmp_light *light, view_handle_kind handle) {
    return &light->half[handle == VIEW_HANDLE_HEIGHT];
}

/* Returns the number that a handle changes, if it is one member. */
static float *member_of(lmp_light *light, view_handle_kind handle) {
    return handle == VIEW_HANDLE_OUTER   ? &light->outer
           : handle == VIEW_HANDLE_INNER ? &light->inner
           : handle == VIEW_HANDLE_ANGLE ? &light->angle
                                         : &light->radius;
}

/* Returns what a handle changes: a length or an angle. */
static float value_of(const lmp_light *light, view_handle_kind handle) {
    lmp_light copy = *light;
    if (handle == VIEW_HANDLE_SIZE)
        return scene_light_extent(light);
    return handle == VIEW_HANDLE_WIDTH || handle == VIEW_HANDLE_HEIGHT
               ? vec_length(*half_of(&copy, handle))
               : *member_of(&copy, handle);
}

/* Changes it. An area keeps its power, as all that is resized does. */
static void set_value(lmp_light *light, view_handle_kind handle, float value) {
    const lmp_light before = *light;
    if (is_angle(handle)) {
        *member_of(light, handle) = fminf(value, handle == VIEW_HANDLE_INNER ? light->outer : PI);
        light->inner = fminf(light->inner, light->outer);
        return;
    }
    const float by = value / value_of(light, handle);
    if (handle == VIEW_HANDLE_SIZE) {
        scene_light_resize(light, by);
        return;
    }
    if (handle == VIEW_HANDLE_RADIUS)
        light->radius = value;
    else
        *half_of(light, handle) = vec_scale(*half_of(light, handle), by);
    light->radiance = rgb_scale(light->radiance, lmp_light_radiance_from_power(light, 1) /
                                                     lmp_light_radiance_from_power(&before, 1));
}

/* Returns the length or angle at which a handle is: small ones are kept apart from the light. */
static float shown_value(const sketch *k, view_handle_kind handle) {
    return fmaxf(value_of(&k->light.emitter, handle),
                 is_angle(handle) ? NEAREST / REACH : NEAREST * k->pixel);
}

/* --- marks ------------------------------------------------------------------------------------ */

static view_mark *add_mark(const sketch *k, view_handle_kind handle, ui_shape shape) {
    view_mark *mark = &k->marks->of[k->marks->count++];
    mark->handle = handle;
    mark->shape = shape;
    mark->count = 0;
    return mark;
}

static void add_pixel(view_mark *mark, double x, double y) {
    mark->at[mark->count][0] = (float)x;
    mark->at[mark->count++][1] = (float)y;
}

/* Adds a path through points in the scene; returns NULL if one is behind the eye. */
static view_mark *add_path(const sketch *k, view_handle_kind handle, ui_shape shape,
                           const lmp_vec3 *points, int count) {
    view_mark *mark = add_mark(k, handle, shape);
    double x, y, scale;
    for (int i = 0; i < count; i++) {
        if (!project(k->state, points[i], &x, &y, &scale)) {
            k->marks->count--;
            return NULL;
        }
        add_pixel(mark, x, y);
    }
    return mark;
}

static view_mark *add_line(const sketch *k, view_handle_kind handle, lmp_vec3 from, lmp_vec3 to) {
    return add_path(k, handle, UI_OPEN, (const lmp_vec3[2]) { from, to }, 2);
}

/* Adds a circle around a unit axis, which begins where it is farthest along `first`. */
static void add_circle(const sketch *k, view_handle_kind handle, lmp_vec3 center, lmp_vec3 axis,
                       lmp_vec3 first, float radius) {
    lmp_vec3 points[VIEW_MARK_POINTS];
    const lmp_vec3 a = vec_scale(vec_reject(first, axis), radius), b = vec_cross(axis, a);
    for (int i = 0; i < VIEW_MARK_POINTS; i++) {
        const float t = 2 * PI * (float)i / VIEW_MARK_POINTS;
        points[i] = vec_add(center, vec_add(vec_scale(a, cosf(t)), vec_scale(b, sinf(t))));
    }
    add_path(k, handle, UI_CLOSED, points, VIEW_MARK_POINTS);
}

/* Returns the point from the center along a direction. */
static lmp_vec3 at(const sketch *k, lmp_vec3 direction, float length) {
    return vec_add(k->center, vec_scale(direction, length));
}

static void add_knob(const sketch *k, view_handle_kind handle, lmp_vec3 direction, float length) {
    const double size = (double)KNOB * k->state->scale;
    double x, y, scale;
    if (!project(k->state, at(k, direction, length), &x, &y, &scale))
        return;
    view_mark *mark = add_mark(k, handle, UI_FILLED);
    for (int i = 0; i < 16; i++)
        add_pixel(mark, x + size * cos(0.125 * i * (double)PI),
                  y + size * sin(0.125 * i * (double)PI));
}

/* Adds an arrow along a unit direction, whose shaft may be no handle. */
static void add_arrow(const sketch *k, view_handle_kind shaft, view_handle_kind head,
                      lmp_vec3 direction, float length) {
    const view_mark *line =
        add_line(k, shaft, at(k, direction, GAP * k->pixel), at(k, direction, length * k->pixel));
    if (!line)
        return;
    const double tip[2] = { (double)line->at[1][0], (double)line->at[1][1] };
    const double x = tip[0] - (double)line->at[0][0], y = tip[1] - (double)line->at[0][1];
    const double by = k->state->scale / fmax(hypot(x, y), 1e-3);
    const double half = 0.5 * (double)HEAD_LENGTH * by, wide = (double)HEAD_WIDTH * by;
    view_mark *mark = add_mark(k, head, UI_FILLED);
    add_pixel(mark, tip[0] + half * x, tip[1] + half * y);
    add_pixel(mark, tip[0] - half * x - wide * y, tip[1] - half * y + wide * x);
    add_pixel(mark, tip[0] - half * x + wide * y, tip[1] - half * y - wide * x);
}

static void add_moves(const sketch *k) {
    const float from = SQUARE * k->pixel, to = SQUARE_END * k->pixel;
    for (unsigned i = 0; i < 3; i++) {
        const lmp_vec3 a = axes[(i + 1) % 3], b = axes[(i + 2) % 3];
        const lmp_vec3 near = at(k, a, from), far = at(k, a, to);
        const lmp_vec3 square[4] = { vec_add(near, vec_scale(b, from)),
                                     vec_add(far, vec_scale(b, from)),
                                     vec_add(far, vec_scale(b, to)),
                                     vec_add(near, vec_scale(b, to)) };
        const float along = fabsf(vec_dot(axes[i], k->ray.direction));
        if (along > EDGE_ON)
            add_path(k, VIEW_HANDLE_YZ + i, UI_FILLED, square, 4);
        if (along < ALONG)
            add_arrow(k, VIEW_HANDLE_X + i, VIEW_HANDLE_X + i, axes[i], ARROW);
    }
}

/* Adds the outline of the sphere around the light that has its size: exactly what is seen of a
 * sphere. It begins opposite the arrows. */
static void add_ring(const sketch *k, view_handle_kind handle) {
    const scene_camera *camera = &k->state->now.camera;
    const lmp_vec3 away = k->ray.direction;
    const float radius = shown_value(k, VIEW_HANDLE_SIZE);
    const float distance = vec_length(vec_sub(k->center, vec_load(camera->eye)));
    const float sine = camera->height > 0 ? 0 : radius / distance;
    if (sine < 1)
        add_circle(k, handle, at(k, away, -radius * sine), away, vec(-1, -1, -1),
                   radius * sqrtf(1 - sine * sine));
}

/* Adds knobs on both sides of the light. */
static void add_knobs(const sketch *k, view_handle_kind handle, lmp_vec3 direction) {
    const float length = shown_value(k, handle);
    if (fabsf(vec_dot(direction, k->ray.direction)) > ALONG)
        return;
    add_knob(k, handle, direction, length);
    add_knob(k, handle, direction, -length);
}

/* Returns the unit direction that a handle moves or measures along. */
static lmp_vec3 axis_of(const sketch *k, view_handle_kind handle) {
    lmp_light light = k->light.emitter;
    return is_move(handle) ? axes[(handle - VIEW_HANDLE_X) % 3]
           : handle == VIEW_HANDLE_DIRECTION || is_angle(handle)
               ? scene_light_axis(&light)
               : vec_normalize(*half_of(&light, handle), axes[0]);
}

static void add_sizes(const sketch *k) {
    const lmp_light *light = &k->light.emitter;
    const lmp_vec3 axis = axis_of(k, VIEW_HANDLE_WIDTH);
    const int extents = scene_light_members_of(light, SCENE_LIGHT_EXTENT);
    add_ring(k, scene_light_extent(light) > 0 ? VIEW_HANDLE_SIZE : VIEW_HANDLE_NONE);
    if (extents > 0)
        add_knobs(k, VIEW_HANDLE_WIDTH, axis);
    if (extents > 1)
        add_knobs(k, VIEW_HANDLE_HEIGHT, axis_of(k, VIEW_HANDLE_HEIGHT));
    if (extents == 1) /* a tube's, beside it, as one looks */
        add_knobs(k, VIEW_HANDLE_RADIUS, vec_reject(vec_cross(axis, k->ray.direction), axis));
}

/* Adds the circle in which a cone around the direction meets a sphere, and the outline of the
 * larger cone. */
static void add_angle(const sketch *k, view_handle_kind handle) {
    const lmp_vec3 axis = axis_of(k, handle);
    const lmp_vec3 across = vec_reject(vec_cross(axis, k->ray.direction), axis);
    const float angle = shown_value(k, handle), reach = REACH * k->pixel;
    const float radius = reach * sinf(angle);
    const lmp_vec3 center = at(k, axis, reach * cosf(angle));
    add_circle(k, handle, center, axis, across, radius);
    for (int side = -1; handle == VIEW_HANDLE_OUTER && side <= 1; side += 2)
        add_line(k, VIEW_HANDLE_NONE, k->center,
                 vec_add(center, vec_scale(across, (float)side * radius)));
}

static void add_direction(const sketch *k) {
    const lmp_light *light = &k->light.emitter;
    const lmp_vec3 axis = scene_light_axis(light);
    const int angles = scene_light_members_of(light, SCENE_LIGHT_ANGLE);
    if (angles > 1) {
        add_angle(k, VIEW_HANDLE_OUTER);
        add_angle(k, VIEW_HANDLE_INNER);
    } else if (angles > 0) {
        add_angle(k, VIEW_HANDLE_ANGLE);
    }
    if (!k->moves) { /* it shines from there */
        add_line(k, VIEW_HANDLE_NONE, k->center, at(k, axis, REACH * k->pixel));
        add_knob(k, VIEW_HANDLE_DIRECTION, axis, REACH * k->pixel);
    } else if (vec_dot(axis, axis) > 0) {
        add_arrow(k, VIEW_HANDLE_NONE, VIEW_HANDLE_DIRECTION, axis, REACH);
    }
}

/* Adds the line from the light down to a surface, and a circle there. */
static void add_plumb_line(const sketch *k) {
    const view_ray down = { .from = k->center, .direction = { 0, -1, 0 }, .far = INFINITY };
    const view_hit hit = view_pick_surface(&down, k->state->tree);
    if (hit.mesh < 0)
        return;
    add_line(k, VIEW_HANDLE_NONE, k->center, hit.point);
    add_circle(k, VIEW_HANDLE_NONE, hit.point, down.direction, axes[0], KNOB * k->pixel);
}

/* Whether a surface lies between the eye and the light. */
static bool is_hidden(const sketch *k) {
    const view_hit hit = view_pick_surface(&k->ray, k->state->tree);
    const float distance = vec_length(vec_sub(k->center, k->ray.from));
    return hit.mesh >= 0 && hit.distance < distance - scene_light_extent(&k->light.emitter);
}

void view_find_marks(const view_state *s, view_marks *marks) {
    sketch k;
    marks->count = 0;
    marks->hidden = false;
    const bool on = s->handles && s->aim == VIEW_AIM_OFF;
    if (!see_light(s, &k) || (!on && !k.moves))
        return;
    k.marks = marks;
    if (!on) {
        add_ring(&k, VIEW_HANDLE_NONE);
        return;
    }
    if (k.moves && view_tree_is_built(s->tree)) {
        marks->hidden = is_hidden(&k);
        add_plumb_line(&k);
    }
    if (k.moves)
        add_moves(&k);
    add_direction(&k);
    if (k.moves)
        add_sizes(&k);
}

/* --- the pointer ------------------------------------------------------------------------------ */

static double distance_to_line(const float *a, const float *b, double x, double y) {
    const double right = (double)(b[0] - a[0]), down = (double)(b[1] - a[1]);
    const double px = x - (double)a[0], py = y - (double)a[1];
    const double square = right * right + down * down;
    const double t = square > 0 ? fmin(fmax((px * right + py * down) / square, 0), 1) : 0;
    return hypot(px - t * right, py - t * down);
}

/* Returns the distance of a place from a mark: 0 within a filled one. */
static double distance_to(const view_mark *mark, double x, double y) {
    double nearest = HUGE_VAL;
    int left = 0;
    for (int i = mark->shape == UI_OPEN; i < mark->count; i++) {
        const float *a = mark->at[(i + mark->count - 1) % mark->count], *b = mark->at[i];
        nearest = fmin(nearest, distance_to_line(a, b, x, y));
        left +=
            (double)(b[0] - a[0]) * (y - (double)a[1]) > (double)(b[1] - a[1]) * (x - (double)a[0]);
    }
    return mark->shape == UI_FILLED && (left == 0 || left == mark->count) ? 0 : nearest;
}

view_handle_kind view_handle_at_pointer(const view_state *s, const view_marks *marks) {
    view_handle_kind handle = VIEW_HANDLE_NONE;
    double nearest = (double)HIT * s->scale;
    for (int i = 0; i < marks->count; i++) {
        const double distance = distance_to(&marks->of[i], s->x, s->y);
        if (marks->of[i].handle != VIEW_HANDLE_NONE && distance < nearest) {
            nearest = distance;
            handle = marks->of[i].handle;
        }
    }
    return handle;
}

/* --- dragging --------------------------------------------------------------------------------- */

/* Returns the square of the sine between a ray and an axis, and how far along the axis they are
 * nearest; *along receives how far along the ray. */
static float nearest_on_axis(const view_grip *g, const view_ray *ray, float *sine2, float *along) {
    const lmp_vec3 way = vec_sub(g->center, ray->from);
    const float cosine = vec_dot(g->axis, ray->direction);
    const float by = vec_dot(way, ray->direction);
    *sine2 = 1 - cosine * cosine;
    const float t = (cosine * by - vec_dot(way, g->axis)) / fmaxf(*sine2, 1e-6f);
    *along = by + t * cosine;
    return t;
}

/* Finds the point of the grip's axis that is nearest to a ray, or where the ray meets its plane.
 * Returns false if that is behind the eye. */
static bool find_point(const view_grip *g, const view_ray *ray, lmp_vec3 *point) {
    float along, sine2;
    if (g->handle < VIEW_HANDLE_YZ) {
        const float t = nearest_on_axis(g, ray, &sine2, &along);
        *point = vec_add(g->center, vec_scale(g->axis, t));
        return along > 0;
    }
    along = vec_dot(vec_sub(g->center, ray->from), g->axis) / vec_dot(ray->direction, g->axis);
    *point = vec_add(ray->from, vec_scale(ray->direction, along));
    return along > 0 && isfinite(along);
}

/* Returns the direction from the center to where a ray meets the sphere of the grip's reach. Beyond
 * its outline angles are measured at the outline, and a tip goes around to the other side. */
static lmp_vec3 direction_at(const view_grip *g, const view_ray *ray) {
    const lmp_vec3 way = vec_sub(g->center, ray->from);
    const lmp_vec3 miss = vec_sub(vec_scale(ray->direction, vec_dot(way, ray->direction)), way);
    const float off = vec_length(miss);
    const bool beyond = off > g->reach;
    const float outside = is_angle(g->handle) ? g->reach : fmaxf(2 * g->reach - off, 0);
    const float across = beyond ? outside : off;
    const float deep = sqrtf(g->reach * g->reach - across * across);
    return vec_normalize(vec_add(vec_scale(miss, off > 0 ? across / off : 0),
                                 vec_scale(ray->direction, g->far != beyond ? deep : -deep)),
                         g->axis);
}

/* Returns the length or angle at which the handle would be under a ray. */
static float measure(const view_grip *g, const view_ray *ray) {
    const lmp_vec3 way = vec_sub(g->center, ray->from);
    float sine2, along;
    if (is_angle(g->handle)) {
        const lmp_vec3 to = direction_at(g, ray);
        return atan2f(vec_length(vec_cross(g->axis, to)), vec_dot(g->axis, to));
    }
    if (g->handle == VIEW_HANDLE_SIZE)
        return vec_length(vec_cross(way, ray->direction));
    const float t = nearest_on_axis(g, ray, &sine2, &along);
    return g->handle == VIEW_HANDLE_RADIUS
               ? fabsf(vec_dot(way, vec_cross(g->axis, ray->direction))) / sqrtf(sine2)
               : fabsf(t);
}

/* Returns how far a handle would be from where it is, if the grip's `far` were this. */
static float miss_by(view_grip g, bool far, const view_ray *ray) {
    g.far = far;
    return g.handle == VIEW_HANDLE_DIRECTION ? vec_length(vec_sub(direction_at(&g, ray), g.axis))
                                             : fabsf(measure(&g, ray) - g.shown);
}

bool view_handle_begin(view_state *s) {
    view_marks marks;
    sketch k;
    view_find_marks(s, &marks);
    const view_handle_kind handle = view_handle_at_pointer(s, &marks);
    if (handle == VIEW_HANDLE_NONE || !see_light(s, &k))
        return false;
    const view_ray ray = view_pointer_ray(s);
    view_grip *g = &s->grip;
    *g = (view_grip) {
        .handle = handle,
        .center = k.center,
        .axis = axis_of(&k, handle),
        .reach = REACH * k.pixel,
        .shown = shown_value(&k, handle),
    };
    if (is_move(handle) && !find_point(g, &ray, &g->start))
        return false;
    g->far = miss_by(*g, true, &ray) < miss_by(*g, false, &ray);
    s->grabbed = s->now.lights[s->selected];
    s->drag = VIEW_DRAG_HANDLE;
    return true;
}

/* --- steps ------------------------------------------------------------------------------------ */

double view_handle_step(const view_state *s) {
    return pow(10, round(log10((double)view_scene_diagonal(s->world) / 10)) - 1);
}

static float rounded(float value, float step) {
    return step * roundf(value / step);
}

/* Whether a handle moves along an axis of the world. */
static bool moves_along(view_handle_kind handle, unsigned axis) {
    return handle < VIEW_HANDLE_YZ ? handle == VIEW_HANDLE_X + axis
                                   : handle != VIEW_HANDLE_YZ + axis;
}

/* Rounds coordinates of the world, of those that the handle moves along. */
static void round_position(const view_state *s, lmp_vec3 *position) {
    const double step = view_handle_step(s);
    for (unsigned k = 0; k < 3; k++) {
        const double world = s->now.origin[k] + (double)(&position->x)[k];
        if (moves_along(s->grip.handle, k))
            (&position->x)[k] = (float)(step * round(world / step) - s->now.origin[k]);
    }
}

/* Finds a direction's angles above the horizon and around it. */
static void find_angles(lmp_vec3 d, float *up, float *around) {
    *up = asinf(fminf(fmaxf(d.y, -1), 1));
    *around = atan2f(d.z, d.x);
}

static lmp_vec3 round_direction(lmp_vec3 d) {
    float up, around;
    find_angles(d, &up, &around);
    up = rounded(up, STEP_ANGLE);
    around = rounded(around, STEP_ANGLE);
    return vec(cosf(up) * cosf(around), sinf(up), cosf(up) * sinf(around));
}

/* --- what a drag does ------------------------------------------------------------------------- */

static bool move_light(const view_state *s, const view_ray *ray, bool steps, lmp_light *light) {
    lmp_vec3 point;
    if (!find_point(&s->grip, ray, &point))
        return false;
    light->position = vec_add(light->position, vec_sub(point, s->grip.start));
    if (steps)
        round_position(s, &light->position);
    return true;
}

/* Small sizes change in proportion to their handle, which is farther out, and small angles as much
 * as it. */
static void resize_light(const view_state *s, const view_ray *ray, bool steps, lmp_light *light) {
    const view_handle_kind handle = s->grip.handle;
    const float now = measure(&s->grip, ray), before = value_of(light, handle);
    const float step = is_angle(handle) ? STEP_ANGLE : (float)view_handle_step(s);
    float value =
        is_angle(handle) ? fmaxf(before + now - s->grip.shown, 0) : before * now / s->grip.shown;
    if (steps)
        value = fmaxf(rounded(value, step), is_angle(handle) ? 0 : step);
    set_value(light, handle, value);
}

void view_handle_follow(view_state *s) {
    const view_grip *g = &s->grip;
    const view_ray ray = view_pointer_ray(s);
    const bool steps = s->held[6];
    scene_light changed = s->grabbed;
    lmp_light *light = &changed.emitter;
    if (is_move(g->handle)) {
        if (!move_light(s, &ray, steps, light))
            return;
    } else if (g->handle == VIEW_HANDLE_DIRECTION) {
        const lmp_vec3 to = direction_at(g, &ray);
        scene_light_rotate_between(light, g->axis, steps ? round_direction(to) : to);
    } else {
        resize_light(s, &ray, steps, light);
    }
    view_change_light(s, &changed);
}

/* --- what it tells ---------------------------------------------------------------------------- */

static double degrees(float radians) {
    return (double)radians * 180 / (double)PI;
}

/* Describes how far the light was moved, along each axis: "x +0.25". */
static void describe_move(const view_state *s, const lmp_light *light, char *text, size_t size) {
    const lmp_vec3 by = vec_sub(light->position, s->grabbed.emitter.position);
    size_t used = 0;
    for (unsigned k = 0; k < 3; k++)
        if (moves_along(s->grip.handle, k))
            used += (size_t)snprintf(text + used, size - used, "%s%c %+.3g", used ? ", " : "",
                                     "xyz"[k], (double)(&by.x)[k]);
}

void view_handle_describe(const view_state *s, char *text, size_t size) {
    const lmp_light *light = &s->now.lights[s->selected].emitter;
    const view_handle_kind handle = s->grip.handle;
    const bool is_round = scene_light_members_of(light, SCENE_LIGHT_RADIUS) > 0;
    const bool is_long = scene_light_members_of(light, SCENE_LIGHT_EXTENT) > 0;
    const float value = value_of(light, handle);
    float up, around;
    if (is_move(handle)) {
        describe_move(s, light, text, size);
    } else if (handle == VIEW_HANDLE_DIRECTION) {
        find_angles(scene_light_axis(light), &up, &around);
        snprintf(text, size, "elevation %.1f°, azimuth %.1f°", degrees(up), degrees(around));
    } else if (is_angle(handle)) {
        snprintf(text, size, "%s %.1f°", view_handle_names[handle], degrees(value));
    } else if (handle == VIEW_HANDLE_RADIUS ||
               (handle == VIEW_HANDLE_SIZE && is_round && !is_long)) {
        snprintf(text, size, "radius %.3g", (double)value);
    } else if (handle == VIEW_HANDLE_SIZE) {
        snprintf(text, size, "size × %.3g",
                 (double)(value / value_of(&s->grabbed.emitter, handle)));
    } else {
        snprintf(text, size, "%s %.3g", is_round ? "length" : view_handle_names[handle],
                 2 * (double)value);
    }
}
