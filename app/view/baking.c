/* SPDX-License-Identifier: MIT */
#include "app/view/baking.h"
#include "app/base/file_cache.h"
#include "app/render/method.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

/* Starts the process that tabulates the materials of a side; returns 0 if it could not be
 * started. */
static pid_t start(view_baking *baking, const view_shading *shading) {
    enum { OPTIONS = 7 };
    static char program[] = "/proc/self/exe", name[] = "lampion", command[] = "brdf",
                action[] = "bake", too[] = "--preintegrated", names[] = "--";
    char bands[24], window[32], *arguments[OPTIONS + RENDER_TABLES_MAX + 1];
    int count = 0;
    snprintf(bands, sizeof bands, "--bands=%d", shading->bands);
    snprintf(window, sizeof window, "--window=%s", lmp_sh_window_name(shading->window));
    arguments[count++] = name;
    arguments[count++] = command;
    arguments[count++] = action;
    arguments[count++] = bands;
    arguments[count++] = window;
    if (view_is_preintegrated(shading))
        arguments[count++] = too;
    arguments[count++] = names;
    for (int i = 0; i < baking->materials.count; i++) {
        char *equals = strchr(baking->materials.texts[i], '=');
        if (equals)
            arguments[count++] = equals + 1;
    }
    arguments[count] = NULL;
    posix_spawn_file_actions_t files;
    pid_t process = 0;
    if (posix_spawn_file_actions_init(&files) != 0)
        return 0;
    for (int i = STDIN_FILENO; i <= STDERR_FILENO; i++)
        posix_spawn_file_actions_addopen(&files, i, "/dev/null", O_RDWR, 0);
    if (posix_spawn(&process, program, &files, NULL, arguments, environ) != 0)
        process = 0;
    posix_spawn_file_actions_destroy(&files);
    return process;
}

bool view_bakes(const view_baking *baking, const view_settings *settings) {
    const int sides = view_sides(settings);
    return baking->sides == sides &&
           memcmp(baking->shading, settings->shading, (size_t)sides * sizeof *baking->shading) ==
               0 &&
           memcmp(&baking->materials, &settings->materials, sizeof baking->materials) == 0;
}

/* Whether there is a cache, without which the other process's tables could not be read. */
static bool has_cache(void) {
    char path[4096];
    return file_cache_directory(path, sizeof path) && access(path, W_OK) == 0;
}

bool view_bake(view_baking *baking, const view_settings *settings) {
    const int sides = view_sides(settings);
    if (settings->materials.count == 0 || !has_cache())
        return false;
    if (!view_bakes(baking, settings)) {
        view_baking_stop(baking);
        baking->sides = sides;
        memcpy(baking->shading, settings->shading, sizeof baking->shading);
        baking->materials = settings->materials;
    }
    while (baking->process == 0 || waitpid(baking->process, NULL, WNOHANG) != 0) {
        baking->process = 0;
        if (baking->started == sides)
            return false;
        baking->process = start(baking, &settings->shading[baking->started++]);
    }
    return true;
}

void view_baking_stop(view_baking *baking) {
    if (baking->process > 0) {
        kill(baking->process, SIGTERM);
        kill(baking->process, SIGCONT); /* a stopped process ends only after this */
        waitpid(baking->process, NULL, 0);
    }
    memset(baking, 0, sizeof *baking);
}
