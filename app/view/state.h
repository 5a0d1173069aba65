/* SPDX-License-Identifier: MIT */
/* state.h - the viewer without its window: events and time in, what to show out. */
#ifndef LAMPION_VIEW_STATE_H
#define LAMPION_VIEW_STATE_H

#include "app/animation/animation.h"
#include "app/view/camera.h"
#include "app/view/history.h"
#include "app/view/settings.h"

/* --- events ----------------------------------------------------------------------------------- */

typedef enum view_event_kind {
    VIEW_MOVE,    /* the pointer, to x, y in pixels */
    VIEW_PRESS,   /* a button */
    VIEW_RELEASE, /* a button */
    VIEW_SCROLL,  /* by y steps, forward > 0 */
    VIEW_KEY,     /* a key of view_keys, by its name, or a letter for the panel */
    VIEW_HOLD,    /* one of the letters wasdqe, by its position on a US keyboard */
    VIEW_FREE,    /* the same, let go; 0: all of them */
    VIEW_DROP,    /* a file, onto where the pointer is */
    VIEW_TYPE,    /* the letters of a text, one after the other, as keys */
    VIEW_SIZE     /* the image has x times y pixels; none: it cannot be seen */
} view_event_kind;

typedef enum view_button { VIEW_LEFT, VIEW_MIDDLE, VIEW_RIGHT } view_button;

typedef struct view_event {
    view_event_kind kind;
    double x, y;
    view_button button;
    bool shift;       /* with a button or a held letter */
    char letter;      /* of VIEW_HOLD and VIEW_FREE */
    const char *text; /* the key, the file, or what is typed */
} view_event;

/* --- the state -------------------------------------------------------------------------------- */

/* What the window has to do; the state machine sets them, who does it clears them. */
typedef struct view_wishes {
    bool quit, shot, record, reload, restart, fullscreen, expose, redraw, save;
} view_wishes;

typedef enum view_drag {
    VIEW_DRAG_NONE,
    VIEW_DRAG_ORBIT,
    VIEW_DRAG_PAN,
    VIEW_DRAG_LOOK,
    VIEW_DRAG_LIGHT,
    VIEW_DRAG_DIVIDER
} view_drag;

/* Which panel of values is open (app/view/panel.h), and what is typed into it. */
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
    int row;     /* the one that is chosen */
    bool typing; /* its value is what has been typed so far */
    char typed[VIEW_TYPED_SIZE];
} view_panel;

enum { VIEW_PATHS_MAX = 4, VIEW_MESSAGE_SIZE = 256 };

typedef struct view_state {
    view_settings now; /* lights at rest, before they move */
    const scene *world;
    animation *paths[VIEW_PATHS_MAX]; /* owned */
    const char *path_names[VIEW_PATHS_MAX];
    int path_count, path;
    bool playing;
    double seconds;                                /* of the animation */
    size_t numbers[SCENE_LIGHTS_MAX], next_number; /* of each light, for animation_move */
    bool lights_edited;
    view_history history;
    int selected; /* a light, or -1 */
    view_drag drag;
    lmp_vec3 grab;         /* from the dragged light's shown position to that at rest */
    float grab_depth;      /* of the dragged light's center */
    double grab_x, grab_y; /* from its center in the image to the pointer */
    double x, y;           /* the pointer */
    bool held[6], fast;    /* wasdqe; shift with them */
    bool walking;          /* inside a building: the left button looks around */
    view_panel panel;
    bool help, overlay, recording;
    int camera;                   /* the scene's camera last taken */
    char dropped[VIEW_PATH_SIZE]; /* the last material dropped */
    char other[VIEW_PATH_SIZE];   /* another scene to be opened, or empty */
    char message[VIEW_MESSAGE_SIZE];
    double message_until, clock; /* seconds */
    view_wishes wishes;
} view_state;

/* Starts with `settings`, whose lights become the scene's. Takes ownership of nothing but opens the
 * paths orbit and bounce, that of the scene if it has one, and `animate` (a name of
 * animation_open, or NULL: then nothing plays). */
bool view_state_open(const scene *world, const view_settings *settings, const char *animate,
                     view_state *state, cli_error *error);
void view_state_close(view_state *state);

/* These in place of all lights. */
void view_put_lights(view_state *state, const scene_light *lights, size_t count);

/* Puts another version of the scene in place of the one before, whose lights stay if they were
 * edited. Of another scene nothing stays but the shading. */
bool view_state_replace_scene(view_state *state, const scene *world, cli_error *error);

void view_handle(view_state *state, const view_event *event);

/* Time passes: flight, the animation, messages. */
void view_advance(view_state *state, double seconds);

/* What is to be drawn now: settings with all lights where they are at this time. */
void view_shown(const view_state *state, view_settings *settings);

/* The side that keys act on: where the pointer is. */
int view_side(const view_state *state);

/* --- files.c: what files do --------------------------------------------------------------------
 */

/* A scene, lights or a material: dropped, or by its name in the panel. */
bool view_take_file(view_state *state, const char *file, cli_error *error);

/* Has the scene's material of that name replaced, or with NULL be itself again. */
bool view_replace_material(view_state *state, const char *name, const char *replacement,
                           cli_error *error);

/* The index of the material pointed at, or 0. */
int view_material_at_pointer(const view_state *state);

/* --- messages --------------------------------------------------------------------------------- */

/* Shows a line for some seconds. */
void view_say(view_state *state, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Back by -1, forward by 1. */
void view_undo(view_state *state, int step);

/* --- keys ------------------------------------------------------------------------------------- */

/* A row of the help: keys by the character that they type, or by name. */
typedef struct view_key {
    const char *key;   /* "m", "F1", "Shift+Tab"; NULL: a heading, or a gesture of the mouse */
    const char *shown; /* for the help: "m  M"; NULL: not shown, a second key of the row before */
    const char *help;
    void (*act)(view_state *state, int argument);
    int argument;
} view_key;
extern const view_key view_keys[]; /* ended by a row of NULLs */

#endif
