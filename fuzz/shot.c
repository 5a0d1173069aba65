/* SPDX-License-Identifier: MIT */
/* Settings of screenshots: what is accepted is in range, and reads back unchanged from its own
 * JSON. */
#include "app/base/error.h"
#include "app/base/file_json.h"
#include "app/view/settings.h"
#include "fuzz/file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void check(const view_settings *s) {
    if (s->width < 1 || s->height < 1 || s->samples < 1 || s->light_count > SCENE_LIGHTS_MAX ||
        s->materials.count > RENDER_TABLES_MAX || !(s->exposure > 0) || s->split >= GPU_SPLITS)
        abort();
    for (int i = 0; i < 2; i++)
        if (s->shading[i].bands < 1 ||
            s->shading[i].bands > method_table[s->shading[i].method].bands_max[DEVICE_AUTO])
            abort();
    for (size_t i = 0; i < s->light_count; i++)
        for (int k = 0; k < 3; k++)
            if (!isfinite((&s->lights[i].emitter.position.x)[k]) ||
                !((&s->lights[i].emitter.radiance.r)[k] >= 0))
                abort();
}

/* Checks that settings written as JSON read back unchanged. */
static void expect_same_again(const view_settings *settings) {
    static view_settings again;
    base_error error;
    char *text = file_json_text(view_settings_to_json(settings), false, "again", &error);
    json_t *read = text ? file_parse_json("again", text, strlen(text), &error) : NULL;
    if (!read || !view_settings_from_json(read, "again", &again, &error) ||
        memcmp(settings, &again, sizeof again) != 0)
        abort();
    json_decref(read);
    free(text);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static view_settings first;
    base_error error;
    char *text = malloc(size + 1);
    if (!text)
        return 0;
    memcpy(text, data, size);
    text[size] = '\0';
    json_t *root = file_parse_json("input", text, size, &error);
    if (root && view_settings_from_json(root, "input", &first, &error)) {
        check(&first);
        expect_same_again(&first);
    }
    json_decref(root);
    free(text);
    return 0;
}
