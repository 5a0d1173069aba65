/* SPDX-License-Identifier: MIT */
/* state.h - the viewer without its window: takes events and time, tells what to show. */
#ifndef LAMPION_VIEW_STATE_H
#define LAMPION_VIEW_STATE_H

#include "app/scene/animation.h"
#include "app/view/history.h"
#include "app/view/settings.h"
#include "app/view/shares.h"
#include "app/view/tree.h"

/* --- events ----------------------------------------------------------------------------------- */

typedef enum view_event_kind {
    VIEW_MOVE,    /* the pointer, to x, y in pixels */
    VIEW_PRESS,   /* a button */
    VIEW_RELEASE, /* a button */
    VIEW_SCROLL,  /* by y steps, forward > 0 */
    VIEW_KEY,     /* a key of view_keys, by its name, or a character for the panel */
    VIEW_HOLD,    /* one of the keys wasdqe, by its position on a US keyboard; c: Ctrl */
    VIEW_FREE,    /* a held key is released; 0: all of them */
    VIEW_DROP,    /* a file, dropped at the pointer */
    VIEW_TYPE,    /* the characters of a text, one after the other, as keys */
    VIEW_ACT,     /* an action, by its name */
    VIEW_SET,     /* a value, by a line for view_set_by_line */
    VIEW_DAMAGE,  /* the window must be drawn again */
    VIEW_SIZE     /* the image has x times y pixels; none: it is not visible */
} view_event_kind;

typedef enum view_button { VIEW_LEFT, VIEW_MIDDLE, VIEW_RIGHT } view_button;

typedef struct view_event {
    view_event_kind kind;
    double x, y;
    view_button button;
    bool shift;       /* held, with a button or a held key */
    char letter;      /* of VIEW_HOLD and VIEW_FREE */
    const char *text; /* the key, the action, the file, the value, or what is typed */
} view_event;

/* --- the state -------------------------------------------------------------------------------- */

/* What the window is asked to do: the state machine sets requests, and whoever fulfills one clears
 * it. */
typedef struct view_requests {
    bool quit, shot, command, record, reload, restart, fullscreen, expose, redraw, save, copy,
        resume, nodes, shares, cancel;
} view_requests;

typedef enum view_drag {
    VIEW_DRAG_NONE,
    VIEW_DRAG_ORBIT,
    VIEW_DRAG_PAN,
    VIEW_DRAG_LOOK,
    VIEW_DRAG_LIGHT,
    VIEW_DRAG_AIM,
    VIEW_DRAG_HANDLE,
    VIEW_DRAG_DIVIDER,
    VIEW_DRAG_SIDEBAR /* something of the interface */
} view_drag;

/* How a drag over a surface aims the selected light (app/view/aim.h). */
typedef enum view_aim {
    VIEW_AIM_OFF,          /* not at all */
    VIEW_AIM_REFLECTION,   /* the eye sees its mirror image there */
    VIEW_AIM_ILLUMINATION, /* it faces the surface */
    VIEW_AIM_RIM,          /* it grazes the surface, from behind */
    VIEW_AIMS
} view_aim;

/* What a handle of the selected light changes (app/view/handles.h). */
typedef enum view_handle_kind {
    VIEW_HANDLE_NONE, /* nothing: it is only drawn */
    VIEW_HANDLE_X,    /* the position along an axis of the world, */
    VIEW_HANDLE_Y,
    VIEW_HANDLE_Z,
    VIEW_HANDLE_YZ, /* or in a plane */
    VIEW_HANDLE_ZX,
    VIEW_HANDLE_XY,
    VIEW_HANDLE_DIRECTION,
    VIEW_HANDLE_SIZE,  /* all lengths in proportion */
    VIEW_HANDLE_WIDTH, /* half[0] of a rectangle or a tube */
    VIEW_HANDLE_HEIGHT,
    VIEW_HANDLE_RADIUS, /* of a tube */
    VIEW_HANDLE_OUTER,
    VIEW_HANDLE_INNER,
    VIEW_HANDLE_ANGLE,
    VIEW_HANDLES
} view_handle_kind;

/* A dragged handle, by what was there when the drag began. */
typedef struct view_grip {
    view_handle_kind handle;
    lmp_vec3 center; /* of the handles */
    lmp_vec3 axis;   /* unit, that the handle moves or measures along */
    lmp_vec3 start;  /* where the axis or plane was grabbed */
    float reach;     /* of what shows directions and angles */
    float shown;     /* the length or angle at which the handle was */
    bool far;        /* whether it was behind the light, as one looks */
} view_grip;

/* The open panel of values (app/view/panel.h), and the text typed into it. */
enum { VIEW_TYPED_SIZE = 1024 };
typedef enum view_panel_kind {
    VIEW_PANEL_CLOSED,
    VIEW_PANEL_LIGHT,
    VIEW_PANEL_MATERIALS,
    VIEW_PANEL_OPEN,
    VIEW_PANELS
} view_panel_kind;

typedef struct view_panel {
    view_panel_kind kind;
    int row;     /* the selected one */
    bool typing; /* whether the row shows what has been typed */
    char typed[VIEW_TYPED_SIZE];
} view_panel;

/* The paths that lights can move along, and the one chosen. */
enum { VIEW_PATHS_MAX = 4, VIEW_MESSAGE_SIZE = 256 };
typedef struct view_paths {
    animation *animations[VIEW_PATHS_MAX]; /* owned */
    const char *names[VIEW_PATHS_MAX + 1]; /* ended by NULL */
    int count, at;
} view_paths;

typedef struct view_state {
    view_settings now; /* lights at rest, without animation */
    const scene *world;
    view_tree *tree; /* of what is not hidden of it */
    view_paths paths;
    bool playing;
    double seconds;                                /* of the animation */
    size_t numbers[SCENE_LIGHTS_MAX], next_number; /* for animation_move, one per light */
    bool muted[SCENE_LIGHTS_MAX], solo; /* solo: but for the selected one, all lights are muted */
    bool lights_edited;
    view_history history;
    int selected; /* a light, or -1 */
    long node;    /* the selected one of the scene, or -1 */
    view_drag drag;
    lmp_vec3 grab;         /* from the dragged light's animated position to its resting position */
    float grab_depth;      /* of the dragged light's center */
    double grab_x, grab_y; /* from the light's center in the image to the pointer */
    view_aim aim;
    scene_light grabbed; /* the dragged light as it was when the drag of an aim or handle began */
    float aim_distance;  /* of an aimed light from the surface */
    view_grip grip;      /* of the dragged handle */
    double x, y;         /* of the pointer */
    double scale;        /* of the display, relative to 96 pixels per inch */
    bool held[7], fast;  /* the keys wasdqe and Ctrl; shift with them */
    bool walking;        /* whether the left button looks around, as inside a building */
    view_panel panel;
    view_shares shares; /* those asked for last */
    bool help, overlay, sidebar, handles, recording;
    double help_scroll;           /* pixels by which the help is moved up */
    int camera;                   /* the scene's camera chosen last */
    char dropped[VIEW_PATH_SIZE]; /* the material dropped last */
    char other[VIEW_PATH_SIZE];   /* another scene to open, or empty */
    char message[VIEW_MESSAGE_SIZE];
    double message_until, clock; /* seconds */
    view_requests requests;
} view_state;

/* Starts with `settings`, whose lights become the scene's. Owns nothing but the paths that it
 * opens: orbit, bounce, that of the scene if it has one, and `animate` (a name of animation_open,
 * or NULL: nothing is animated at first). */
bool view_state_open(const scene *world, view_tree *tree, const view_settings *settings,
                     const char *animate, view_state *state, base_error *error);
void view_state_close(view_state *state);

/* Replaces all lights. */
void view_put_lights(view_state *state, const scene_light *lights, size_t count);

/* Replaces the scene by another version of it; edited lights are kept. For a different scene, only
 * the shading settings are kept. */
bool view_state_replace_scene(view_state *state, const scene *world, view_tree *tree,
                              base_error *error);

void view_handle(view_state *state, const view_event *event);

/* Makes the present a moment that undo goes back to, if it differs from the last one and nothing is
 * being dragged. */
void view_keep(view_state *state);

/* Advances time: flight, the animation, messages. */
void view_advance(view_state *state, double seconds);

/* Changes the selected light, unless it would not be valid; returns whether it is changed. */
bool view_change_light(view_state *state, const scene_light *light);

/* Moves the camera to where the scene wants it, or back until a box fits the image. */
void view_use_default_camera(view_state *state);
void view_frame_box(view_state *state, const float lo[3], const float hi[3]);

/* Returns what to draw now: settings with all lights at their animated positions. */
void view_shown(const view_state *state, view_settings *settings);

/* Returns a light at its animated position. */
scene_light view_shown_light(const view_state *state, int index);

/* Returns the side that keys act on: the one under the pointer. */
int view_side(const view_state *state);

/* Return the ray through a place in the image, that through the pointer, and the surface under it.
 */
view_ray view_ray_at(const view_state *state, double x, double y);
view_ray view_pointer_ray(const view_state *state);
view_hit view_hit_at_pointer(const view_state *state, view_ray *ray);

/* --- files.c: files that are opened ----------------------------------------------------------- */

/* Opens a scene, lights or a material, dropped or named in the panel. */
bool view_take_file(view_state *state, const char *file, base_error *error);

/* Replaces the scene's material of that name, or restores it if NULL. */
bool view_replace_material(view_state *state, const char *name, const char *replacement,
                           base_error *error);

/* Returns the index of the material under the pointer, or 0. */
int view_material_at_pointer(const view_state *state);

/* --- set.c ------------------------------------------------------------------------------------ */

/* Sets a value to what is typed, by its path in the state's JSON: "looks/0/bands",
 * "materials/NAME", "view/selected", "lights/0/radius". The value is checked as in a file. */
bool view_set(view_state *state, const char *path, const char *typed, base_error *error);
bool view_set_light(view_state *state, size_t index, const char *name, const char *typed,
                    base_error *error);

/* Does so by a line with the path and the value; shows a message if that cannot be. */
void view_set_by_line(view_state *state, const char *line);

/* Shows through one of the scene's cameras. */
void view_use_camera(view_state *state, int index);

/* --- messages --------------------------------------------------------------------------------- */

/* Shows a message for some seconds. */
void view_say(view_state *state, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Undoes with -1, redoes with 1. */
void view_undo(view_state *state, int step);

/* --- actions ---------------------------------------------------------------------------------- */

/* A row of the help, and a button of the sidebar: what a key does, by the character that it types
 * or by its name. */
typedef struct view_key {
    const char *key;   /* "m", "F1", "Shift+Tab"; NULL: a heading, or a gesture of the mouse */
    const char *shown; /* in the help: "m  M"; NULL: not shown, an alternative to the row before */
    const char *help;  /* and the button's tooltip */
    void (*act)(view_state *state, int argument);
    int argument;
    const char *name; /* on the button, and in scripts; NULL: that of an earlier row */
} view_key;
extern const view_key view_keys[]; /* ended by a row of NULLs */

/* Whether a row is a heading, which the rows after it belong to. */
bool view_is_heading(const view_key *row);

/* Whether an action quits or cancels, which is all there is to do while the first scene is read. */
bool view_is_end(const view_key *row);

/* Whether what the action of a row switches is on. */
bool view_is_on(const view_state *state, const view_key *row);

/* The materials of the key T: the scene's own, some others, then NULL. */
extern const char *const view_known_materials[];

/* Return the row of a key, or the action of a name, or NULL. */
const view_key *view_find_key(const char *key);
const view_key *view_find_action(const char *name);

#endif
