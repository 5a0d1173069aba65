/* SPDX-License-Identifier: MIT */
/* load.c - loads a scene by its name: built in, or a file. */
#include "app/base/choice.h"
#include "app/scene/builtin/builtin.h"
#include "app/scene/load/import.h"
#include "app/scene/load/leaves.h"
#include "app/scene/load/texels.h"
#include "app/scene/load/up.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define BUILTIN_PREFIX "builtin:"

static bool load_builtin(const char *name, int up, scene *s, base_error *error) {
    scene_builder builder = { 0 };
    void *block = NULL;
    size_t size = 0;
    bool ok = builtin_make(name + strlen(BUILTIN_PREFIX), &builder, error);
    up_stand(&builder, up);
    if (ok && !builder_pack(&builder, &block, &size))
        ok = base_fail(error, name, "does not fit into memory (ask for fewer tiles)");
    builder_free(&builder);
    ok = ok && blob_validate(block, size, false, name, error) &&
         blob_open(block, size, name, s, error);
    if (!ok)
        free(block);
    return ok;
}

/* Suggests a built-in scene for names such as "atrium" and "bultin:atrium", which are not files.
 * Returns false. */
static bool hint_builtin(const char *name, base_error *error) {
    const char *const colon = strchr(name, ':'), *const word = colon ? colon + 1 : name;
    for (size_t i = 0; scene_builtin_name(i) && access(name, F_OK) != 0; i++) {
        const char *const known = scene_builtin_name(i);
        if (strncmp(word, known, strcspn(word, ":")) == 0 && strcspn(word, ":") == strlen(known))
            return base_fail(error, name, "does not exist (did you mean " BUILTIN_PREFIX "%s?)",
                             word);
    }
    return false;
}

/* Reports unsupported features in one line: on stderr, or as the error of a strict load. */
static bool tell_unsupported(const scene *s, bool strict, base_error *error) {
    char line[sizeof error->text] = "";
    size_t used = 0;
    for (size_t i = 0; i < s->unsupported_count; i++) {
        char text[2 * SCENE_NAME_SIZE + 32];
        scene_unsupported_text(&s->unsupported[i], text, sizeof text);
        const int length =
            snprintf(line + used, sizeof line - used, "%s%s", used ? ", " : "", text);
        if ((size_t)length >= sizeof line - used)
            break;
        used += (size_t)length;
    }
    if (!used)
        return true;
    if (strict)
        return base_fail(error, s->name, "left out: %s (not allowed by --strict)", line);
    base_note(s->name, "left out: %s", line);
    return true;
}

/* Says that a file was rotated because of its format. */
static void tell_up(const scene *s, int asked) {
    if (asked == SCENE_UP_AUTO && s->up == SCENE_UP_Z)
        base_note(s->name,
                  "z is up in this kind of file, so it was rotated (--up y leaves it as it is)");
}

/* Marks leaves as translucent and reports that on stderr. */
static bool let_leaves_through(scene *s, const scene_options *chosen, base_error *error) {
    size_t count = 0;
    if (chosen->leaves == SCENE_LEAVES_OPAQUE)
        return true;
    if (!scene_find_leaves(s, &count, error))
        return false;
    if (count > 0)
        base_note(s->name,
                  "light comes through the leaves of %zu material%s (--leaves opaque: none)", count,
                  count == 1 ? "" : "s");
    return true;
}

bool scene_is_file(const char *name) {
    return strncmp(name, BUILTIN_PREFIX, strlen(BUILTIN_PREFIX)) != 0;
}

static bool load(const char *name, const scene_options *chosen, scene *s, base_error *error) {
    if (!scene_is_file(name))
        return chosen->variant
                   ? choice_fail_member(error, name, "variant", chosen->variant, NULL, 0, 0)
                   : load_builtin(name, chosen->up, s, error);
    if (!import_scene(name, chosen, s, error))
        return hint_builtin(name, error);
    tell_up(s, chosen->up);
    if ((chosen->no_texels || scene_decode_images(s, error)) &&
        tell_unsupported(s, chosen->strict, error) && let_leaves_through(s, chosen, error))
        return true;
    scene_free(s);
    return false;
}

bool scene_load(const char *name, const scene_options *options, scene *s, base_error *error) {
    const scene_options chosen = options ? *options : (scene_options) { 0 };
    memset(s, 0, sizeof *s);
    if (!load(name, &chosen, s, error))
        return false;
    s->frame->wanted = (scene_framing)chosen.framing;
    return true;
}
