/* SPDX-License-Identifier: MIT */
#define GLFW_INCLUDE_NONE
#include "app/view/window.h"

#include "app/base/shared_library.h"

#include <GLFW/glfw3.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What is used of GLFW, which only the viewer opens. */
/* clang-format off */
#define GLFW_FUNCTIONS(X)                                                                          \
    X(glfwCreateWindow) X(glfwDestroyWindow) X(glfwGetClipboardString) X(glfwGetCursorPos)         \
    X(glfwGetFramebufferSize) X(glfwSetClipboardString)                                            \
    X(glfwGetKeyName) X(glfwGetPrimaryMonitor) X(glfwGetTime) X(glfwGetVersion)                    \
    X(glfwGetVideoMode) X(glfwGetWindowAttrib) X(glfwGetWindowContentScale)                        \
    X(glfwGetWindowMonitor) X(glfwGetWindowPos) X(glfwGetWindowSize)                               \
    X(glfwGetWindowUserPointer) X(glfwInit) X(glfwMakeContextCurrent) X(glfwPollEvents)            \
    X(glfwSetCharCallback) X(glfwSetCursorPosCallback) X(glfwSetDropCallback)                      \
    X(glfwSetErrorCallback) X(glfwSetKeyCallback) X(glfwSetMouseButtonCallback)                    \
    X(glfwSetScrollCallback) X(glfwSetWindowCloseCallback) X(glfwSetWindowFocusCallback)           \
    X(glfwSetWindowMonitor) X(glfwSetWindowRefreshCallback) X(glfwSetWindowSize)                   \
    X(glfwSetWindowTitle) X(glfwSetWindowUserPointer) X(glfwSwapBuffers) X(glfwSwapInterval)       \
    X(glfwTerminate) X(glfwWaitEventsTimeout) X(glfwWindowHint)
/* clang-format on */
static struct { GLFW_FUNCTIONS(SHARED_LIBRARY_POINTER) } lib;
static const char *const functions[] = { GLFW_FUNCTIONS(SHARED_LIBRARY_NAME) };

static bool open_library(base_error *error) {
    return shared_library_open(GLFW_SONAME, functions, sizeof functions / sizeof *functions, &lib,
                               error);
}

struct view_window {
    GLFWwindow *glfw;
    view_listener *listener;
    void *to;
    int windowed[4]; /* before it filled the screen: x, y, width, height */
};

static char last_complaint[256];

static void on_error(int code, const char *text) {
    (void)code;
    snprintf(last_complaint, sizeof last_complaint, "%s", text);
}

static void tell(GLFWwindow *glfw, view_event event) {
    const view_window *window = lib.glfwGetWindowUserPointer(glfw);
    window->listener(window->to, &event);
}

/* Returns pixels per unit of the pointer's coordinates. */
static double pixels_a_unit(GLFWwindow *glfw) {
    int units, pixels, ignored;
    lib.glfwGetWindowSize(glfw, &units, &ignored);
    lib.glfwGetFramebufferSize(glfw, &pixels, &ignored);
    return units > 0 && pixels > 0 ? (double)pixels / units : 1;
}

/* --- input ------------------------------------------------------------------------------------ */

static void on_move(GLFWwindow *glfw, double x, double y) {
    const double scale = pixels_a_unit(glfw);
    tell(glfw, (view_event) { .kind = VIEW_MOVE, .x = x * scale, .y = y * scale });
}

static void on_button(GLFWwindow *glfw, int button, int action, int modifiers) {
    if (button > GLFW_MOUSE_BUTTON_MIDDLE)
        return;
    const view_button which = button == GLFW_MOUSE_BUTTON_LEFT    ? VIEW_LEFT
                              : button == GLFW_MOUSE_BUTTON_RIGHT ? VIEW_RIGHT
                                                                  : VIEW_MIDDLE;
    tell(glfw, (view_event) { .kind = action == GLFW_PRESS ? VIEW_PRESS : VIEW_RELEASE,
                              .button = which,
                              .shift = modifiers & GLFW_MOD_SHIFT });
}

static void on_scroll(GLFWwindow *glfw, double x, double y) {
    (void)x;
    tell(glfw, (view_event) { .kind = VIEW_SCROLL, .y = y });
}

static bool write_utf8(unsigned character, char text[5]) {
    const int more = character < 0x80 ? 0 : character < 0x800 ? 1 : character < 0x10000 ? 2 : 3;
    static const unsigned char leads[] = { 0, 0xC0, 0xE0, 0xF0 };
    text[0] = (char)(leads[more] | character >> 6 * more);
    for (int i = 1; i <= more; i++)
        text[i] = (char)(0x80 | (character >> 6 * (more - i) & 0x3F));
    return character < 0x110000;
}

/* Handles typed characters, whatever the keyboard. */
static void on_character(GLFWwindow *glfw, unsigned character) {
    char text[5] = "";
    if (character > ' ' && write_utf8(character, text))
        tell(glfw, (view_event) { .kind = VIEW_KEY, .text = text });
}

/* Returns the flying key by its position on the keyboard, or c for Ctrl. */
static char held_letter(int key) {
    static const struct {
        int key;
        char letter;
    } letters[] = { { GLFW_KEY_W, 'w' },
                    { GLFW_KEY_A, 'a' },
                    { GLFW_KEY_S, 's' },
                    { GLFW_KEY_D, 'd' },
                    { GLFW_KEY_Q, 'q' },
                    { GLFW_KEY_E, 'e' },
                    { GLFW_KEY_LEFT_CONTROL, 'c' },
                    { GLFW_KEY_RIGHT_CONTROL, 'c' } };
    for (size_t i = 0; i < sizeof letters / sizeof *letters; i++)
        if (letters[i].key == key)
            return letters[i].letter;
    return '\0';
}

static const char *name_of(int key) {
    static const struct {
        int key;
        const char *name;
    } names[] = { { GLFW_KEY_F1, "F1" },
                  { GLFW_KEY_F5, "F5" },
                  { GLFW_KEY_F2, "F2" },
                  { GLFW_KEY_F3, "F3" },
                  { GLFW_KEY_ENTER, "Enter" },
                  { GLFW_KEY_KP_ENTER, "Enter" },
                  { GLFW_KEY_F11, "F11" },
                  { GLFW_KEY_F12, "F12" },
                  { GLFW_KEY_UP, "Up" },
                  { GLFW_KEY_DOWN, "Down" },
                  { GLFW_KEY_LEFT, "Left" },
                  { GLFW_KEY_RIGHT, "Right" },
                  { GLFW_KEY_PAGE_UP, "Page_Up" },
                  { GLFW_KEY_PAGE_DOWN, "Page_Down" },
                  { GLFW_KEY_HOME, "Home" },
                  { GLFW_KEY_END, "End" },
                  { GLFW_KEY_TAB, "Tab" },
                  { GLFW_KEY_DELETE, "Delete" },
                  { GLFW_KEY_BACKSPACE, "Backspace" },
                  { GLFW_KEY_ESCAPE, "Escape" },
                  { GLFW_KEY_SPACE, "space" } };
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (names[i].key == key)
            return names[i].name;
    return NULL;
}

static void on_key(GLFWwindow *glfw, int key, int position, int action, int modifiers) {
    (void)position;
    const bool shift = modifiers & GLFW_MOD_SHIFT, control = modifiers & GLFW_MOD_CONTROL;
    const char letter = held_letter(key);
    const char *typed = lib.glfwGetKeyName(key, 0);
    if (control && action == GLFW_PRESS && typed && typed[0] >= 'a' && typed[0] <= 'z') {
        const char text[] = { 'C', 't', 'r', 'l', '+', (char)(typed[0] - 'a' + 'A'), '\0' };
        tell(glfw, (view_event) { .kind = VIEW_KEY, .text = text });
        return;
    }
    if (letter && action != GLFW_REPEAT && (letter == 'c' || !control || action == GLFW_RELEASE))
        tell(glfw, (view_event) { .kind = action == GLFW_PRESS ? VIEW_HOLD : VIEW_FREE,
                                  .letter = letter,
                                  .shift = shift });
    const char *name = name_of(key);
    if (!name || action == GLFW_RELEASE)
        return;
    char text[32];
    snprintf(text, sizeof text, "%s%s", shift ? "Shift+" : "", name);
    tell(glfw, (view_event) { .kind = VIEW_KEY, .text = text });
}

/* Releases all keys when the focus is lost: their releases would go elsewhere, and the camera would
 * fly on. */
static void on_focus(GLFWwindow *glfw, int focused) {
    if (!focused) {
        tell(glfw, (view_event) { .kind = VIEW_FREE });
        tell(glfw, (view_event) { .kind = VIEW_RELEASE });
    }
}

static void on_drop(GLFWwindow *glfw, int count, const char **paths) {
    /* the pointer moved without events while the file was dragged */
    double x, y;
    lib.glfwGetCursorPos(glfw, &x, &y);
    on_move(glfw, x, y);
    for (int i = 0; i < count; i++)
        tell(glfw, (view_event) { .kind = VIEW_DROP, .text = paths[i] });
}

static void on_damage(GLFWwindow *glfw) {
    tell(glfw, (view_event) { .kind = VIEW_DAMAGE });
}

static void on_close(GLFWwindow *glfw) {
    tell(glfw, (view_event) { .kind = VIEW_ACT, .text = "Quit" });
}

static void listen(GLFWwindow *glfw) {
    lib.glfwSetCursorPosCallback(glfw, on_move);
    lib.glfwSetMouseButtonCallback(glfw, on_button);
    lib.glfwSetScrollCallback(glfw, on_scroll);
    lib.glfwSetCharCallback(glfw, on_character);
    lib.glfwSetKeyCallback(glfw, on_key);
    lib.glfwSetWindowFocusCallback(glfw, on_focus);
    lib.glfwSetDropCallback(glfw, on_drop);
    lib.glfwSetWindowCloseCallback(glfw, on_close);
    lib.glfwSetWindowRefreshCallback(glfw, on_damage);
}

/* --- the window ------------------------------------------------------------------------------- */

static GLFWwindow *create(const char *title, int width, int height) {
    const char *debug = getenv("LAMPION_GL_DEBUG");
    lib.glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    lib.glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    lib.glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    lib.glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, debug != NULL);
    lib.glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, GLFW_LOSE_CONTEXT_ON_RESET);
    lib.glfwWindowHint(GLFW_DEPTH_BITS, 0);
    lib.glfwWindowHint(GLFW_STENCIL_BITS, 0);
    GLFWwindow *glfw = lib.glfwCreateWindow(width, height, title, NULL, NULL);
    if (glfw)
        return glfw;
    lib.glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, GLFW_NO_ROBUSTNESS);
    return lib.glfwCreateWindow(width, height, title, NULL, NULL);
}

view_window *view_window_open(const char *title, int width, int height, view_listener *listener,
                              void *to, base_error *error) {
    if (!open_library(error))
        return NULL;
    view_window *window = calloc(1, sizeof *window);
    if (!window) {
        base_fail(error, NULL, "out of memory");
        return NULL;
    }
    lib.glfwSetErrorCallback(on_error);
    if (!lib.glfwInit()) {
        base_fail(error, NULL,
                  "no display to open a window on (%s): lampion render draws to a file",
                  last_complaint);
        free(window);
        return NULL;
    }
    window->listener = listener;
    window->to = to;
    window->glfw = create(title, width, height);
    if (!window->glfw) {
        base_fail(error, NULL, "no window with OpenGL 4.5 (%s): lampion render draws to a file",
                  last_complaint);
        free(window);
        return NULL;
    }
    lib.glfwSetWindowUserPointer(window->glfw, window);
    listen(window->glfw);
    lib.glfwMakeContextCurrent(window->glfw);
    lib.glfwSwapInterval(1);
    return window;
}

void view_window_close(view_window *window) {
    if (!window)
        return;
    lib.glfwDestroyWindow(window->glfw);
    free(window);
}

void view_window_end(void) {
    if (lib.glfwTerminate)
        lib.glfwTerminate();
}

void view_window_take_events(view_window *window, double seconds) {
    (void)window;
    if (seconds > 0)
        lib.glfwWaitEventsTimeout(seconds);
    else
        lib.glfwPollEvents();
}

bool view_window_size(const view_window *window, int *width, int *height) {
    lib.glfwGetFramebufferSize(window->glfw, width, height);
    return *width > 0 && *height > 0 && !lib.glfwGetWindowAttrib(window->glfw, GLFW_ICONIFIED);
}

double view_window_scale(const view_window *window) {
    float x = 1, y = 1;
    lib.glfwGetWindowContentScale(window->glfw, &x, &y);
    return x > 0.25f && x < 16 ? (double)x : 1;
}

void view_window_resize(view_window *window, int width, int height) {
    const double scale = pixels_a_unit(window->glfw);
    lib.glfwSetWindowSize(window->glfw, (int)(width / scale + 0.5), (int)(height / scale + 0.5));
}

void view_window_title(view_window *window, const char *title) {
    lib.glfwSetWindowTitle(window->glfw, title);
}

void view_window_toggle_fullscreen(view_window *window) {
    int *windowed = window->windowed;
    GLFWmonitor *monitor = lib.glfwGetPrimaryMonitor();
    const GLFWvidmode *mode = monitor ? lib.glfwGetVideoMode(monitor) : NULL;
    if (lib.glfwGetWindowMonitor(window->glfw)) {
        lib.glfwSetWindowMonitor(window->glfw, NULL, windowed[0], windowed[1], windowed[2],
                                 windowed[3], 0);
    } else if (mode) {
        lib.glfwGetWindowPos(window->glfw, &windowed[0], &windowed[1]);
        lib.glfwGetWindowSize(window->glfw, &windowed[2], &windowed[3]);
        lib.glfwSetWindowMonitor(window->glfw, monitor, 0, 0, mode->width, mode->height,
                                 mode->refreshRate);
    }
}

void view_window_swap(view_window *window) {
    lib.glfwSwapBuffers(window->glfw);
}

void view_window_copy(const char *text) {
    lib.glfwSetClipboardString(NULL, text);
}

const char *view_window_paste(void) {
    const char *text = lib.glfwGetClipboardString(NULL);
    return text ? text : "";
}

double view_window_clock(void) {
    return lib.glfwGetTime();
}

bool view_window_version(char *text, size_t size, base_error *error) {
    int major, minor, patch;
    if (!open_library(error))
        return false;
    lib.glfwGetVersion(&major, &minor, &patch);
    snprintf(text, size, "%d.%d.%d", major, minor, patch);
    return true;
}
