/* SPDX-License-Identifier: MIT */
#include "app/view/handles.h"

#include "app/scene/vector.h"
#include "app/view/lights.h"

#include <math.h>

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

/* The selected light as it is seen. */
typedef struct seen_light {
    const view_state *state;
    scene_light light;
    bool moves;      /* whether it has a position */
    lmp_vec3 center; /* of the handles: its position, or else in the middle of the image */
    lmp_vec3 away;   /* unit, from the eye to there */
    float pixel;     /* the length of one at 96 per inch, there */
} seen_light;

static bool project(const view_state *s, lmp_vec3 point, double *x, double *y, double *scale) {
    return view_project(&s->now.camera, s->now.width, s->now.height, point, x, y, scale);
}

static view_ray pointer_ray(const view_state *s) {
    return view_ray_through(&s->now.camera, s->now.width, s->now.height, s->x, s->y);
}

static bool see_light(const view_state *s, seen_light *seen) {
    double x, y, scale;
    if (s->selected < 0)
        return false;
    *seen = (seen_light) { .state = s, .light = view_shown_light(s, s->selected) };
    seen->moves = scene_light_has(&seen->light, SCENE_LIGHT_POSITION);
    seen->center = seen->moves ? seen->light.emitter.position : vec_load(s->now.camera.target);
    if (!project(s, seen->center, &x, &y, &scale))
        return false;
    seen->away = view_ray_through(&s->now.camera, s->now.width, s->now.height, x, y).direction;
    seen->pixel = (float)(s->scale / scale);
    return true;
}

/* --- lengths and angles ----------------------------------------------------------------------- */

static bool is_move(view_handle_kind handle) {
    return handle >= VIEW_HANDLE_X && handle <= VIEW_HANDLE_XY;
}

static bool is_angle(view_handle_kind handle) {
    return handle >= VIEW_HANDLE_OUTER;
}

/* Returns what a handle changes: a length or an angle. */
static float value_of(const lmp_light *light, view_handle_kind handle) {
    switch (handle) {
    case VIEW_HANDLE_SIZE:
        return scene_light_extent(light);
    case VIEW_HANDLE_WIDTH:
    case VIEW_HANDLE_HEIGHT:
        return vec_length(light->half[handle - VIEW_HANDLE_WIDTH]);
    case VIEW_HANDLE_RADIUS:
        return light->radius;
    case VIEW_HANDLE_OUTER:
        return light->outer;
    case VIEW_HANDLE_INNER:
        return light->inner;
    case VIEW_HANDLE_ANGLE:
        return light->angle;
    default:
        return 0;
    }
}

/* Changes it. The power of an area stays, as that of all that is resized does. */
static void set_value(lmp_light *light, view_handle_kind handle, float value) {
    const lmp_light before = *light;
    const float by = value / value_of(light, handle);
    switch (handle) {
    case VIEW_HANDLE_SIZE:
        scene_light_resize(light, by);
        return;
    case VIEW_HANDLE_WIDTH:
    case VIEW_HANDLE_HEIGHT:
        light->half[handle - VIEW_HANDLE_WIDTH] =
            vec_scale(light->half[handle - VIEW_HANDLE_WIDTH], by);
        break;
    case VIEW_HANDLE_RADIUS:
        light->radius = value;
        break;
    case VIEW_HANDLE_OUTER:
        light->outer = fminf(value, PI);
        light->inner = fminf(light->inner, light->outer);
        return;
    case VIEW_HANDLE_INNER:
        light->inner = fminf(value, light->outer);
        return;
    case VIEW_HANDLE_ANGLE:
        light->angle = fminf(value, PI);
        return;
    default:
        return;
    }
    light->radiance = rgb_scale(light->radiance, lmp_light_radiance_from_power(light, 1) /
                                                     lmp_light_radiance_from_power(&before, 1));
}

/* Returns the length or angle at which a handle is: small ones are kept apart from the light. */
static float shown_value(const seen_light *seen, view_handle_kind handle) {
    return fmaxf(value_of(&seen->light.emitter, handle),
                 is_angle(handle) ? NEAREST / REACH : NEAREST * seen->pixel);
}

/* --- marks ------------------------------------------------------------------------------------ */

static view_mark *add_mark(view_marks *marks, view_handle_kind handle, ui_shape shape) {
    view_mark *mark = &marks->of[marks->count++];
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
static view_mark *add_path(const seen_light *seen, view_marks *marks, view_handle_kind handle,
                           ui_shape shape, const lmp_vec3 *points, int count) {
    view_mark *mark = add_mark(marks, handle, shape);
    double x, y, scale;
    for (int i = 0; i < count; i++) {
        if (!project(seen->state, points[i], &x, &y, &scale)) {
            marks->count--;
            return NULL;
        }
        add_pixel(mark, x, y);
    }
    return mark;
}

static void add_line(const seen_light *seen, view_marks *marks, view_handle_kind handle,
                     lmp_vec3 from, lmp_vec3 to) {
    add_path(seen, marks, handle, UI_OPEN, (const lmp_vec3[2]) { from, to }, 2);
}

/* Adds a circle around a unit axis, from its point along `first` on. */
static void add_circle(const seen_light *seen, view_marks *marks, view_handle_kind handle,
                       lmp_vec3 center, lmp_vec3 axis, lmp_vec3 first, float radius) {
    lmp_vec3 points[VIEW_MARK_POINTS];
    const lmp_vec3 across = vec_cross(axis, first);
    for (int i = 0; i < VIEW_MARK_POINTS; i++) {
        const float t = 2 * PI * (float)i / VIEW_MARK_POINTS;
        points[i] = vec_add(center, vec_add(vec_scale(first, radius * cosf(t)),
                                            vec_scale(across, radius * sinf(t))));
    }
    add_path(seen, marks, handle, UI_CLOSED, points, VIEW_MARK_POINTS);
}

static void add_knob(const seen_light *seen, view_marks *marks, view_handle_kind handle,
                     lmp_vec3 point) {
    double x, y, scale;
    if (!project(seen->state, point, &x, &y, &scale))
        return;
    view_mark *mark = add_mark(marks, handle, UI_FILLED);
    for (int i = 0; i < 16; i++)
        add_pixel(mark, x + (double)KNOB * seen->state->scale * cos(0.125 * i * (double)PI),
                  y + (double)KNOB * seen->state->scale * sin(0.125 * i * (double)PI));
}

/* Adds an arrow, whose head alone is a handle if its shaft is none. */
static void add_arrow(const seen_light *seen, view_marks *marks, view_handle_kind shaft,
                      view_handle_kind head, lmp_vec3 from, lmp_vec3 to) {
    const view_mark *line =
        add_path(seen, marks, shaft, UI_OPEN, (const lmp_vec3[2]) { from, to }, 2);
    if (!line)
        return;
    const double tip[2] = { (double)line->at[1][0], (double)line->at[1][1] };
    double x = tip[0] - (double)line->at[0][0], y = tip[1] - (double)line->at[0][1];
    const double length = hypot(x, y), size = seen->state->scale / (length > 0 ? length : 1);
    x *= size;
    y = length > 0 ? y * size : -size;
    const double half = 0.5 * (double)HEAD_LENGTH, wide = (double)HEAD_WIDTH;
    view_mark *mark = add_mark(marks, head, UI_FILLED);
    add_pixel(mark, tip[0] + half * x, tip[1] + half * y);
    add_pixel(mark, tip[0] - half * x - wide * y, tip[1] - half * y + wide * x);
    add_pixel(mark, tip[0] - half * x + wide * y, tip[1] - half * y - wide * x);
}

/* Returns the point from the center along a direction. */
static lmp_vec3 from_center(const seen_light *seen, lmp_vec3 direction, float length) {
    return vec_add(seen->center, vec_scale(direction, length));
}

static void add_moves(const seen_light *seen, view_marks *marks) {
    const float from = SQUARE * seen->pixel, to = SQUARE_END * seen->pixel;
    for (int k = 0; k < 3; k++) {
        const lmp_vec3 a = axes[(k + 1) % 3], b = axes[(k + 2) % 3];
        const lmp_vec3 near = from_center(seen, a, from), far = from_center(seen, a, to);
        const lmp_vec3 square[4] = { vec_add(near, vec_scale(b, from)),
                                     vec_add(far, vec_scale(b, from)),
                                     vec_add(far, vec_scale(b, to)),
                                     vec_add(near, vec_scale(b, to)) };
        const float along = fabsf(vec_dot(axes[k], seen->away));
        if (along > EDGE_ON)
            add_path(seen, marks, VIEW_HANDLE_YZ + (unsigned)k, UI_FILLED, square, 4);
        if (along < ALONG)
            add_arrow(seen, marks, VIEW_HANDLE_X + (unsigned)k, VIEW_HANDLE_X + (unsigned)k,
                      from_center(seen, axes[k], GAP * seen->pixel),
                      from_center(seen, axes[k], ARROW * seen->pixel));
    }
}

/* Adds the outline of the sphere around the light that has its size: exactly what is seen of a
 * sphere. */
static void add_ring(const seen_light *seen, view_marks *marks, view_handle_kind handle) {
    const scene_camera *camera = &seen->state->now.camera;
    const lmp_vec3 up = vec_reject(vec(0, 1, 0), seen->away);
    const lmp_vec3 first =
        vec_scale(vec_add(up, vec_cross(seen->away, up)), -sqrtf(0.5f)); /* lower left */
    const float radius = shown_value(seen, VIEW_HANDLE_SIZE);
    const float distance = vec_length(vec_sub(seen->center, vec_load(camera->eye)));
    const float sine = camera->height > 0 ? 0 : radius / distance;
    if (sine < 1)
        add_circle(seen, marks, handle, from_center(seen, seen->away, -radius * sine), seen->away,
                   first, radius * sqrtf(1 - sine * sine));
}

/* Adds knobs on both sides of the light along a unit direction. */
static void add_knobs(const seen_light *seen, view_marks *marks, view_handle_kind handle,
                      lmp_vec3 direction) {
    const float length = shown_value(seen, handle);
    if (fabsf(vec_dot(direction, seen->away)) > ALONG)
        return;
    add_knob(seen, marks, handle, from_center(seen, direction, length));
    add_knob(seen, marks, handle, from_center(seen, direction, -length));
}

/* Adds knobs where the outline of a tube is seen beside its middle. */
static void add_outline_knobs(const seen_light *seen, view_marks *marks, lmp_vec3 axis) {
    const scene_camera *camera = &seen->state->now.camera;
    const lmp_vec3 way = vec_sub(seen->center, vec_load(camera->eye));
    const lmp_vec3 away = vec_reject(seen->away, axis), across = vec_cross(axis, away);
    const float radius = shown_value(seen, VIEW_HANDLE_RADIUS);
    const float sine = camera->height > 0 ? 0 : radius / vec_dot(way, away);
    if (fabsf(vec_dot(axis, seen->away)) > ALONG || !(sine < 1))
        return;
    for (int side = -1; side <= 1; side += 2)
        add_knob(seen, marks, VIEW_HANDLE_RADIUS,
                 vec_add(from_center(seen, away, -radius * sine),
                         vec_scale(across, (float)side * radius * sqrtf(1 - sine * sine))));
}

/* Returns the unit direction of half of a rectangle's side or of a tube. */
static lmp_vec3 side_of(const lmp_light *light, view_handle_kind handle) {
    return vec_normalize(light->half[handle == VIEW_HANDLE_HEIGHT], axes[0]);
}

static void add_sizes(const seen_light *seen, view_marks *marks) {
    const lmp_light *light = &seen->light.emitter;
    const bool sized = scene_light_extent(light) > 0;
    if (seen->moves)
        add_ring(seen, marks, sized ? VIEW_HANDLE_SIZE : VIEW_HANDLE_NONE);
    if (light->kind == LMP_LIGHT_RECTANGLE || light->kind == LMP_LIGHT_TUBE)
        add_knobs(seen, marks, VIEW_HANDLE_WIDTH, side_of(light, VIEW_HANDLE_WIDTH));
    if (light->kind == LMP_LIGHT_RECTANGLE)
        add_knobs(seen, marks, VIEW_HANDLE_HEIGHT, side_of(light, VIEW_HANDLE_HEIGHT));
    if (light->kind == LMP_LIGHT_TUBE)
        add_outline_knobs(seen, marks, side_of(light, VIEW_HANDLE_WIDTH));
}

/* Adds the circle in which a cone around the direction meets a sphere. */
static void add_angle(const seen_light *seen, view_marks *marks, view_handle_kind handle) {
    const lmp_vec3 axis = scene_light_axis(&seen->light.emitter);
    const float angle = shown_value(seen, handle), reach = REACH * seen->pixel;
    const lmp_vec3 center = from_center(seen, axis, reach * cosf(angle));
    const lmp_vec3 across = vec_reject(vec_cross(axis, seen->away), axis);
    add_circle(seen, marks, handle, center, axis, across, reach * sinf(angle));
    if (handle != VIEW_HANDLE_OUTER)
        return;
    add_line(seen, marks, VIEW_HANDLE_NONE, seen->center,
             vec_add(center, vec_scale(across, reach * sinf(angle))));
    add_line(seen, marks, VIEW_HANDLE_NONE, seen->center,
             vec_add(center, vec_scale(across, -reach * sinf(angle))));
}

static void add_direction(const seen_light *seen, view_marks *marks) {
    const lmp_light *light = &seen->light.emitter;
    const lmp_vec3 axis = scene_light_axis(light);
    const lmp_vec3 tip = from_center(seen, axis, REACH * seen->pixel);
    if (light->kind == LMP_LIGHT_SPOT) {
        add_angle(seen, marks, VIEW_HANDLE_OUTER);
        add_angle(seen, marks, VIEW_HANDLE_INNER);
    }
    if (light->kind == LMP_LIGHT_CAP)
        add_angle(seen, marks, VIEW_HANDLE_ANGLE);
    if (!seen->moves) { /* it shines from there */
        add_line(seen, marks, VIEW_HANDLE_NONE, seen->center, tip);
        add_knob(seen, marks, VIEW_HANDLE_DIRECTION, tip);
    } else if (vec_dot(axis, axis) > 0) {
        add_arrow(seen, marks, VIEW_HANDLE_NONE, VIEW_HANDLE_DIRECTION,
                  from_center(seen, axis, GAP * seen->pixel), tip);
    }
}

/* Adds the line from the light down to a surface, and a cross there. */
static void add_plumb_line(const seen_light *seen, view_marks *marks) {
    const view_ray down = { .from = seen->center, .direction = { 0, -1, 0 }, .far = INFINITY };
    const view_hit hit = view_pick_surface(&down, seen->state->tree);
    double x, y, scale;
    if (hit.mesh < 0)
        return;
    const lmp_vec3 foot = from_center(seen, down.direction, hit.distance);
    if (!project(seen->state, foot, &x, &y, &scale))
        return;
    const float size = (float)(seen->state->scale / scale) * KNOB;
    add_line(seen, marks, VIEW_HANDLE_NONE, seen->center, foot);
    for (int k = 0; k < 3; k += 2)
        add_line(seen, marks, VIEW_HANDLE_NONE, vec_add(foot, vec_scale(axes[k], size)),
                 vec_sub(foot, vec_scale(axes[k], size)));
}

/* Whether a surface lies between the eye and the light. */
static bool is_hidden(const seen_light *seen) {
    const view_state *s = seen->state;
    double x, y, scale;
    if (!seen->moves || !project(s, seen->center, &x, &y, &scale))
        return false;
    const view_ray ray = view_ray_through(&s->now.camera, s->now.width, s->now.height, x, y);
    const float distance = vec_length(vec_sub(seen->center, ray.from));
    const view_hit hit = view_pick_surface(&ray, s->tree);
    return hit.mesh >= 0 && hit.distance < distance - scene_light_extent(&seen->light.emitter);
}

void view_find_marks(const view_state *s, view_marks *marks) {
    seen_light seen;
    marks->count = 0;
    marks->hidden = false;
    if (!see_light(s, &seen))
        return;
    if (!s->handles || s->aim != VIEW_AIM_OFF) {
        if (seen.moves)
            add_ring(&seen, marks, VIEW_HANDLE_NONE);
        return;
    }
    if (view_tree_is_built(s->tree)) {
        marks->hidden = is_hidden(&seen);
        if (seen.moves)
            add_plumb_line(&seen, marks);
    }
    if (seen.moves)
        add_moves(&seen, marks);
    add_direction(&seen, marks);
    add_sizes(&seen, marks);
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
    double nearest = INFINITY;
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
    seen_light seen;
    view_find_marks(s, &marks);
    const view_handle_kind handle = view_handle_at_pointer(s, &marks);
    if (handle == VIEW_HANDLE_NONE || !see_light(s, &seen))
        return false;
    const lmp_light *light = &seen.light.emitter;
    const view_ray ray = pointer_ray(s);
    view_grip *g = &s->grip;
    *g = (view_grip) {
        .handle = handle,
        .center = seen.center,
        .axis = is_move(handle) ? axes[(handle - VIEW_HANDLE_X) % 3]
                : handle == VIEW_HANDLE_DIRECTION || is_angle(handle) ? scene_light_axis(light)
                                                                      : side_of(light, handle),
        .reach = REACH * seen.pixel,
        .shown = shown_value(&seen, handle),
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

/* Rounds coordinates of the world, of those that the handle moves along. */
static void round_position(const view_state *s, lmp_vec3 *position) {
    const view_handle_kind handle = s->grip.handle;
    const double step = view_handle_step(s);
    for (int k = 0; k < 3; k++) {
        const bool moves = handle < VIEW_HANDLE_YZ ? handle == VIEW_HANDLE_X + (unsigned)k
                                                   : handle != VIEW_HANDLE_YZ + (unsigned)k;
        const double world = s->now.origin[k] + (double)(&position->x)[k];
        if (moves)
            (&position->x)[k] = (float)(step * round(world / step) - s->now.origin[k]);
    }
}

/* Rounds a direction's angles above the horizon and around it. */
static lmp_vec3 round_direction(lmp_vec3 d) {
    const float up = rounded(asinf(fminf(fmaxf(d.y, -1), 1)), STEP_ANGLE);
    const float around = rounded(atan2f(d.z, d.x), STEP_ANGLE);
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
    const view_ray ray = pointer_ray(s);
    const bool steps = s->held[6];
    scene_light changed = s->grabbed;
    lmp_light *light = &changed.emitter;
    scene_light_error wrong;
    if (is_move(g->handle)) {
        if (!move_light(s, &ray, steps, light))
            return;
    } else if (g->handle == VIEW_HANDLE_DIRECTION) {
        const lmp_vec3 to = direction_at(g, &ray);
        scene_light_rotate_between(light, g->axis, steps ? round_direction(to) : to);
    } else {
        resize_light(s, &ray, steps, light);
    }
    if (!scene_light_check(&changed, &wrong))
        return;
    s->now.lights[s->selected] = changed;
    s->lights_edited = true;
}
