/* SPDX-License-Identifier: MIT */
/* state.h - the viewer without its window: events and time in, what to show out. */
#ifndef LAMPION_VIEW_STATE_H
#define LAMPION_VIEW_STATE_H

#include "app/animation/animation.h"
#include "app/view/camera.h"
#include "app/view/settings.h"

/* --- events ----------------------------------------------------------------------------------- */

typedef enum view_event_kind {
    VIEW_MOVE,    /* the pointer, to x, y in pixels */
    VIEW_PRESS,   /* a button */
    VIEW_RELEASE, /* a button */
    VIEW_SCROLL,  /* by y steps, forward > 0 */
    VIEW_KEY,     /* a key of view_keys, by its name */
    VIEW_HOLD,    /* one of the letters wasdqe, by its position on a US keyboard */
    VIEW_FREE,    /* the same, let go; 0: all of them */
    VIEW_DROP,    /* a file, onto where the pointer is */
    VIEW_SIZE     /* the image has x times y pixels; none: it cannot be seen */
} view_event_kind;

typedef enum view_button { VIEW_LEFT, VIEW_MIDDLE, VIEW_RIGHT } view_button;

typedef struct view_event {
    view_event_kind kind;
    double x, y;
    view_button button;
    bool shift;       /* with a button or a held letter */
    char letter;      /* of VIEW_HOLD and VIEW_FREE */
    const char *text; /* the key, or the file */
} view_event;

/* --- the state -------------------------------------------------------------------------------- */

/* What the window has to do; the state machine sets them, who does it clears them. */
typedef struct view_wishes {
    bool quit, shot, record, reload, restart, fullscreen, expose, redraw;
} view_wishes;

typedef enum view_drag {
    VIEW_DRAG_NONE,
    VIEW_DRAG_ORBIT,
    VIEW_DRAG_PAN,
    VIEW_DRAG_LOOK,
    VIEW_DRAG_LIGHT,
    VIEW_DRAG_DIVIDER
} view_drag;

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
    int selected; /* a light, or -1 */
    view_drag drag;
    lmp_vec3 grab;         /* from the dragged light's shown position to that at rest */
    float grab_depth;      /* of the dragged light's center */
    double grab_x, grab_y; /* from its center in the image to the pointer */
    double x, y;           /* the pointer */
    bool held[6], fast;    /* wasdqe; shift with them */
    bool help, overlay, recording;
    int camera;                   /* the scene's camera last taken */
    char dropped[VIEW_PATH_SIZE]; /* the last material dropped */
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

/* Puts another version of the scene in place of the one before, whose lights stay if they were
 * edited. */
bool view_state_replace_scene(view_state *state, const scene *world, cli_error *error);

void view_handle(view_state *state, const view_event *event);

/* Time passes: flight, the animation, messages. */
void view_advance(view_state *state, double seconds);

/* What is to be drawn now: settings with all lights where they are at this time. */
void view_shown(const view_state *state, view_settings *settings);

/* The side that keys act on: where the pointer is. */
int view_side(const view_state *state);

/* Shows a line for some seconds. */
void view_say(view_state *state, const char *format, ...) __attribute__((format(printf, 2, 3)));

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
