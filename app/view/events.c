/* SPDX-License-Identifier: MIT */
/* events.c - what the pointer, the keys, dropped files and time do to the state. */
#include "app/view/aim.h"
#include "app/view/handles.h"
#include "app/view/lights.h"
#include "app/view/panel.h"

#include "app/scene/vector.h"

#include <math.h>
#include <string.h>

#define RADIANS_A_HEIGHT 3.0   /* of rotation, when the pointer crosses the image's height */
#define ZOOM_STEP        0.88f /* of the distance, per step of the wheel */
#define PICK_PIXELS      4.0f  /* by which a light may be missed */
#define DIVIDER_PIXELS   8.0
#define FLY_SPEED        0.15f /* diagonals of the scene per second */
#define FLY_FAST         4.0f
#define HELP_STEP        60.0  /* pixels of the help, per step of the wheel */
#define WALK_STEP        0.02f /* of the diagonal, per step of the wheel */

/* --- the pointer ------------------------------------------------------------------------------ */

static int light_at_pointer(const view_state *s) {
    static view_settings shown;
    const view_ray ray = view_pointer_ray(s);
    float light_distance = 0;
    view_shown(s, &shown);
    const int light =
        view_pick_light(&ray, shown.lights, shown.light_count, PICK_PIXELS, &light_distance);
    if (light < 0)
        return -1;
    const view_hit hit = view_pick_surface(&ray, s->tree);
    return hit.mesh >= 0 &&
                   hit.distance < light_distance - scene_light_extent(&shown.lights[light].emitter)
               ? -1
               : light;
}

static void grab_light(view_state *s, int index) {
    const scene_light shown = view_shown_light(s, index);
    double x, y, scale;
    if (!view_project(&s->now.camera, s->now.width, s->now.height, shown.emitter.position, &x, &y,
                      &scale))
        return;
    s->drag = VIEW_DRAG_LIGHT;
    s->selected = index;
    const view_ray middle = view_ray_at(s, 0.5 * s->now.width, 0.5 * s->now.height);
    s->grab_depth = vec_dot(vec_sub(shown.emitter.position, middle.from), middle.direction);
    s->grab_x = s->x - x;
    s->grab_y = s->y - y;
    s->grab = vec_sub(s->now.lights[index].emitter.position, shown.emitter.position);
}

/* Moves the light to the pointer, in the plane across the view where it was grabbed. Returns false,
 * without moving it, beyond the range of positions in files. */
static bool drag_light(view_state *s) {
    const view_ray ray = view_ray_at(s, s->x - s->grab_x, s->y - s->grab_y);
    const view_ray middle = view_ray_at(s, 0.5 * s->now.width, 0.5 * s->now.height);
    const float along = vec_dot(ray.direction, middle.direction);
    const lmp_vec3 to = vec_add(ray.from, vec_scale(ray.direction, s->grab_depth / along));
    scene_light moved = s->now.lights[s->selected];
    moved.emitter.position = vec_add(to, s->grab);
    return view_change_light(s, &moved);
}

static bool on_divider(const view_state *s) {
    return s->now.split == GPU_SPLIT_DIVIDED &&
           fabs(s->x - (double)s->now.divider * s->now.width) <= DIVIDER_PIXELS;
}

static void press(view_state *s, const view_event *event) {
    if (s->help) { /* it covers the button that closes it */
        s->help = false;
        return;
    }
    if (event->button == VIEW_MIDDLE || (event->button == VIEW_LEFT && event->shift)) {
        s->drag = VIEW_DRAG_PAN;
        return;
    }
    if (event->button == VIEW_RIGHT) {
        s->drag = VIEW_DRAG_LOOK;
        return;
    }
    if (view_handle_begin(s))
        return;
    if (on_divider(s)) {
        s->drag = VIEW_DRAG_DIVIDER;
        return;
    }
    if (view_aim_begin(s))
        return;
    s->drag = s->walking ? VIEW_DRAG_LOOK : VIEW_DRAG_ORBIT;
    if (s->aim != VIEW_AIM_OFF && s->selected >= 0)
        return; /* the light stays selected while the camera moves between two drags */
    const int light = light_at_pointer(s);
    s->selected = -1;
    if (light >= 0)
        grab_light(s, light);
}

static void move(view_state *s, double x, double y) {
    const double right = (x - s->x) / s->now.height, down = (y - s->y) / s->now.height;
    const float yaw = (float)(RADIANS_A_HEIGHT * right), pitch = (float)(RADIANS_A_HEIGHT * down);
    s->x = x;
    s->y = y;
    switch (s->drag) {
    case VIEW_DRAG_NONE:
    case VIEW_DRAG_SIDEBAR:
        break;
    case VIEW_DRAG_ORBIT:
        view_orbit(&s->now.camera, -yaw, pitch);
        break;
    case VIEW_DRAG_PAN:
        view_pan(&s->now.camera, (float)-right, (float)down);
        break;
    case VIEW_DRAG_LOOK:
        view_look_round(&s->now.camera, yaw, -pitch);
        break;
    case VIEW_DRAG_LIGHT:
        if (s->selected >= 0)
            drag_light(s);
        break;
    case VIEW_DRAG_AIM:
        if (s->selected >= 0)
            view_aim_follow(s);
        break;
    case VIEW_DRAG_HANDLE:
        view_handle_follow(s);
        break;
    case VIEW_DRAG_DIVIDER:
        s->now.divider = fminf(fmaxf((float)(x / s->now.width), 0.02f), 0.98f);
        break;
    }
}

/* Scrolls the help, zooms, walks, or moves a dragged light nearer and farther, an aimed one to its
 * surface. */
static void scroll(view_state *s, double steps) {
    const float factor = powf(ZOOM_STEP, (float)steps);
    if (s->help) {
        s->help_scroll -= HELP_STEP * s->scale * steps;
    } else if (s->drag == VIEW_DRAG_LIGHT && s->selected >= 0) {
        const float depth = s->grab_depth;
        s->grab_depth /= factor;
        if (!drag_light(s))
            s->grab_depth = depth;
    } else if (s->drag == VIEW_DRAG_AIM && s->selected >= 0) {
        s->aim_distance = fminf(s->aim_distance / factor, LMP_LENGTH_MAX);
        view_aim_follow(s);
    } else if (s->walking && s->now.camera.height == 0) {
        view_fly(&s->now.camera, 0, 0, (float)steps * WALK_STEP * view_scene_diagonal(s->world));
    } else {
        view_dolly(&s->now.camera, factor, 0.01f * view_scene_diagonal(s->world));
    }
}

/* --- keys and files --------------------------------------------------------------------------- */

static void act(view_state *s, const view_key *row) {
    if (row)
        row->act(s, row->argument);
}

static void press_key(view_state *s, const char *name) {
    if (!view_panel_take_key(s, name))
        act(s, view_find_key(name));
}

static void hold(view_state *s, char letter, bool down, bool fast) {
    static const char letters[] = "wasdqec";
    const char *at = letter ? strchr(letters, letter) : NULL;
    s->fast = fast;
    if (at)
        s->held[at - letters] = down && s->panel.kind == VIEW_PANEL_CLOSED;
    else if (!letter)
        memset(s->held, 0, sizeof s->held);
    if (s->drag == VIEW_DRAG_HANDLE) /* by steps from now on, or no longer */
        view_handle_follow(s);
}

static void type(view_state *s, const char *text) {
    for (; *text; text++) {
        const char letter[2] = { *text, '\0' };
        press_key(s, *text == ' ' ? "space" : letter);
    }
}

static void drop(view_state *s, const char *file) {
    base_error error;
    if (!view_take_file(s, file, &error))
        view_say(s, "%s", error.text);
}

/* Lets a dragged light stay as a key, an action or a value has changed it; a handle lets go. */
static void keep_dragged(view_state *s) {
    if (s->drag == VIEW_DRAG_AIM && s->selected >= 0)
        s->grabbed = s->now.lights[s->selected];
    if (s->drag == VIEW_DRAG_HANDLE)
        s->drag = VIEW_DRAG_NONE;
}

static void resize(view_state *s, int width, int height) {
    if (width < 1 || height < 1)
        return;
    s->now.width = width;
    s->now.height = height;
}

static void take_event(view_state *s, const view_event *event) {
    switch (event->kind) {
    case VIEW_MOVE:
        move(s, event->x, event->y);
        break;
    case VIEW_PRESS:
        press(s, event);
        break;
    case VIEW_RELEASE:
        s->drag = VIEW_DRAG_NONE;
        break;
    case VIEW_SCROLL:
        scroll(s, event->y);
        break;
    case VIEW_KEY:
        press_key(s, event->text);
        keep_dragged(s);
        break;
    case VIEW_HOLD:
    case VIEW_FREE:
        hold(s, event->letter, event->kind == VIEW_HOLD, event->shift);
        break;
    case VIEW_DROP:
        drop(s, event->text);
        break;
    case VIEW_TYPE:
        type(s, event->text);
        break;
    case VIEW_ACT:
        act(s, view_find_action(event->text));
        keep_dragged(s);
        break;
    case VIEW_SET:
        view_set_by_line(s, event->text);
        keep_dragged(s);
        break;
    case VIEW_DAMAGE:
        s->requests.redraw = true;
        break;
    case VIEW_SIZE:
        resize(s, (int)event->x, (int)event->y);
        break;
    }
}

void view_handle(view_state *s, const view_event *event) {
    const scene_camera before = s->now.camera;
    take_event(s, event);
    if (!view_camera_is_valid(&s->now.camera))
        s->now.camera = before;
    if (event->kind != VIEW_MOVE && event->kind != VIEW_SIZE)
        view_keep(s);
}

void view_keep(view_state *s) {
    if (s->drag == VIEW_DRAG_NONE)
        view_history_keep(&s->history, &s->now, s->numbers);
}

void view_advance(view_state *s, double seconds) {
    s->clock += seconds;
    if (s->playing)
        s->seconds += seconds;
    const float step =
        (float)seconds * FLY_SPEED * view_scene_diagonal(s->world) * (s->fast ? FLY_FAST : 1);
    const float right = (float)(s->held[3] - s->held[1]), up = (float)(s->held[5] - s->held[4]);
    const float forward = (float)(s->held[0] - s->held[2]);
    const scene_camera before = s->now.camera;
    if (right != 0 || up != 0 || forward != 0)
        view_fly(&s->now.camera, right * step, up * step, forward * step);
    if (!view_camera_is_valid(&s->now.camera))
        s->now.camera = before;
    if (s->clock >= s->message_until)
        s->message[0] = '\0';
}
