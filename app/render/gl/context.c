/* SPDX-License-Identifier: MIT */
#include "app/render/gl/crash.h"
#include "app/render/gl/gpu.h"

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { DEVICES_MAX = 32 };
static const char packages[] =
    "install libegl1, libgl1 and libgl1-mesa-dri, or the GPU vendor's driver";

/* --- complaints of OpenGL --------------------------------------------------------------------- */

static void GLAPIENTRY on_message(GLenum source, GLenum type, GLuint id, GLenum severity,
                                  GLsizei length, const GLchar *message, const void *user) {
    (void)source;
    (void)id;
    (void)length;
    if (strstr(message, "GL_OUT_OF_MEMORY"))
        return; /* the code that asked for the memory reports it */
    if (type != GL_DEBUG_TYPE_ERROR && type != GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR &&
        severity != GL_DEBUG_SEVERITY_HIGH)
        return;
    fprintf(stderr, "lampion: OpenGL: %s\n", message);
    if (user)
        abort();
}

static bool debug_is_fatal(void) {
    const char *mode = getenv("LAMPION_GL_DEBUG");
    return mode && strcmp(mode, "fatal") == 0;
}

static void listen_to_messages(void) {
    static const char fatal = 1;
    glEnable(GL_DEBUG_OUTPUT);
    if (debug_is_fatal())
        glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(on_message, debug_is_fatal() ? &fatal : NULL);
}

/* --- the current context ---------------------------------------------------------------------- */

bool gpu_context_adopt(gpu_context *context, base_error *error) {
    const char *renderer = (const char *)glGetString(GL_RENDERER);
    const char *version = (const char *)glGetString(GL_VERSION);
    snprintf(context->device, sizeof context->device, "%s", renderer ? renderer : "unknown");
    snprintf(context->driver, sizeof context->driver, "%s", version ? version : "unknown");
    if (epoxy_gl_version() < 45)
        return base_fail(error, NULL, "%s offers OpenGL %s; 4.5 is needed (%s)", context->device,
                         context->driver, packages);
    context->software = strstr(context->device, "llvmpipe") || strstr(context->device, "softpipe");
    context->computes_fields = !context->software;

    GLint blocks = 0, side = 0;
    GLint64 storage = 0;
    glGetIntegerv(GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS, &blocks);
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &side);
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &storage);
    context->size_max = side < GPU_SIZE_MAX ? side : GPU_SIZE_MAX;
    context->storage_max = (size_t)storage;
    if (blocks == 0)
        return base_fail(error, NULL, "%s has no storage blocks in vertex shaders",
                         context->device);
    listen_to_messages();
    return true;
}

bool gpu_context_lost(void) {
    return glGetGraphicsResetStatus() != GL_NO_ERROR;
}

/* --- EGL -------------------------------------------------------------------------------------- */

static bool open_display(EGLDisplay display, gpu_context *context, base_error *error) {
    const EGLint attributes[] = { EGL_CONTEXT_MAJOR_VERSION,
                                  4,
                                  EGL_CONTEXT_MINOR_VERSION,
                                  5,
                                  EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                  EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                  EGL_CONTEXT_OPENGL_DEBUG,
                                  debug_is_fatal() ? EGL_TRUE : EGL_FALSE,
                                  EGL_NONE };
    if (display == EGL_NO_DISPLAY || !eglInitialize(display, NULL, NULL))
        return base_fail(error, NULL, "the EGL display does not open (%s)", packages);
    context->display = display;
    EGLContext egl = EGL_NO_CONTEXT;
    if (eglBindAPI(EGL_OPENGL_API))
        egl = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
    context->context = egl;
    bool ok = egl != EGL_NO_CONTEXT && eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, egl);
    if (ok)
        ok = gpu_context_adopt(context, error);
    else
        base_fail(error, NULL, "the EGL driver \"%s\" has no OpenGL 4.5 core context (%s)",
                  eglQueryString(display, EGL_VENDOR), packages);
    if (!ok)
        gpu_context_destroy(context);
    return ok;
}

void gpu_context_destroy(gpu_context *context) {
    if (context->display) {
        eglMakeCurrent(context->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (context->context)
            eglDestroyContext(context->display, context->context);
        eglTerminate(context->display);
    }
    memset(context, 0, sizeof *context);
}

/* Lists EGL's devices; none is not an error, because Mesa's surfaceless platform may still work. */
static int list_devices(const char *client, EGLDeviceEXT *devices) {
    EGLint count = 0;
    if (!strstr(client, "EGL_EXT_device_enumeration") && !strstr(client, "EGL_EXT_device_base"))
        return 0;
    if (!strstr(client, "EGL_EXT_platform_device") ||
        !eglQueryDevicesEXT(DEVICES_MAX, devices, &count))
        return 0;
    return count;
}

static bool is_software(EGLDeviceEXT device) {
    const char *extensions = eglQueryDeviceStringEXT(device, EGL_EXTENSIONS);
    return extensions && strstr(extensions, "EGL_MESA_device_software");
}

static bool open_device(EGLDeviceEXT device, gpu_context *context, base_error *error) {
    return open_display(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, NULL), context,
                        error);
}

static bool open_software(const char *client, const EGLDeviceEXT *devices, int count,
                          gpu_context *context, base_error *error) {
    for (int i = 0; i < count; i++)
        if (is_software(devices[i]) && open_device(devices[i], context, error))
            return true;
    if (!strstr(client, "EGL_MESA_platform_surfaceless"))
        return base_fail(error, NULL, "no OpenGL device: EGL lists %d and no software one (%s)",
                         count, packages);
    return open_display(
        eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL), context,
        error);
}

/* Opens the device whose name contains `name`; the names tried go into the message. */
static bool open_named(const char *name, const EGLDeviceEXT *devices, int count,
                       gpu_context *context, base_error *error) {
    char found[512] = "";
    for (int i = 0; i < count; i++) {
        if (!open_device(devices[i], context, error))
            continue;
        if (strcasestr(context->device, name))
            return true;
        size_t used = strlen(found);
        snprintf(found + used, sizeof found - used, "%s%d = %s", used ? ", " : "", i,
                 context->device);
        gpu_context_destroy(context);
    }
    return base_fail(error, name, "no such OpenGL device (found: %s)", found[0] ? found : "none");
}

bool gpu_context_create(const char *device, gpu_context *context, base_error *error) {
    memset(context, 0, sizeof *context);
    setenv("EGL_LOG_LEVEL", "fatal", 0); /* failures are reported here, in one line */
    gpu_expect_crashes();
    /* epoxy would end the program if one of the libraries were missing */
    if (!dlopen("libEGL.so.1", RTLD_LAZY | RTLD_GLOBAL))
        return base_fail(error, NULL, "no libEGL.so.1 on this machine (%s)", packages);
    if (!dlopen("libGL.so.1", RTLD_LAZY) && !dlopen("libOpenGL.so.0", RTLD_LAZY))
        return base_fail(error, NULL, "no libGL.so.1 on this machine (%s)", packages);
    const char *client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (!client || !strstr(client, "EGL_EXT_platform_base"))
        return base_fail(error, NULL, "EGL has no driver, or is too old (%s)", packages);
    EGLDeviceEXT devices[DEVICES_MAX];
    const int count = list_devices(client, devices);

    if (device && strcmp(device, "software") == 0)
        return open_software(client, devices, count, context, error);
    if (device && device[0]) {
        char *end = NULL;
        const long index = strtol(device, &end, 10);
        if (*end)
            return open_named(device, devices, count, context, error);
        if (index < 0 || index >= count)
            return base_fail(error, device, "no such OpenGL device: EGL lists %d, numbered from 0",
                             count);
        return open_device(devices[index], context, error);
    }
    for (int i = 0; i < count; i++) {
        if (!is_software(devices[i]) && open_device(devices[i], context, error) &&
            !context->software)
            return true;
        gpu_context_destroy(context);
    }
    error->text[0] = '\0';
    return open_software(client, devices, count, context, error);
}
