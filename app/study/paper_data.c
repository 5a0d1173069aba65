/* SPDX-License-Identifier: MIT */
#include "app/study/paper_data.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

bool paper_quote(const char *text, char *word, size_t size) {
    static const char plain[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789"
                                "_-./:=,+@%";
    const bool quoted = text[strspn(text, plain)] || !*text;
    size_t used = 0;
    if (4 * strlen(text) + 3 > size)
        return false;
    if (quoted)
        word[used++] = '\'';
    for (; *text; text++) {
        const char *const written = *text == '\'' ? "'\\''" : (const char[]) { *text, 0 };
        memcpy(word + used, written, strlen(written));
        used += strlen(written);
    }
    if (quoted)
        word[used++] = '\'';
    word[used] = 0;
    return true;
}

/* --- files ------------------------------------------------------------------------------------ */

static bool is_folder(const char *path, base_error *error) {
    struct stat info;
    if (stat(path, &info) != 0)
        return base_fail(error, path, "cannot be looked into: %s", strerror(errno));
    return S_ISDIR(info.st_mode) || base_fail(error, path, "is no folder");
}

/* Finds the first of FOLDER/NAME, FOLDER/BELOW/NAME and both in FOLDER/data that is a file; path is
 * "" if there is none. Returns false if such a path is too long. */
static bool find(const cli_list *folders, const char *below, const char *name, char path[1024],
                 base_error *error) {
    const char *const between[][2] = {
        { "", "" }, { below, "/" }, { "data", "/" }, { "data/", below }
    };
    for (int i = 0; i < folders->count; i++)
        for (int k = 0; k < 4; k++) {
            struct stat info;
            if (snprintf(path, 1024, "%s/%s%s%s%s", folders->items[i], between[k][0], between[k][1],
                         k == 3 ? "/" : "", name) >= 1024)
                return base_fail(error, folders->items[i], "is too long a name");
            if (stat(path, &info) == 0 && S_ISREG(info.st_mode))
                return true;
        }
    path[0] = 0;
    return true;
}

/* --- scenes ----------------------------------------------------------------------------------- */

/* A scene of the paper to look for, and its stand-in. */
typedef struct wanted_scene {
    const char *name, *credit, *folder, *file, *lights, *stand_in;
    int light_count; /* the paper's; 0: the stand-in has its own */
} wanted_scene;

static bool join_words(paper_scene *s, base_error *error) {
    char file[4200], lights[4200], chosen[4300] = "";
    if (!paper_quote(s->file, file, sizeof file) || !paper_quote(s->lights, lights, sizeof lights))
        return base_fail(error, s->file, "is too long a name");
    if (s->lights[0])
        snprintf(chosen, sizeof chosen, " --lights %s", lights);
    else if (s->random_lights > 0)
        snprintf(chosen, sizeof chosen, " --random-lights %d --seed 1", s->random_lights);
    snprintf(s->words, sizeof s->words, "%s%s", file, chosen);
    return true;
}

static bool find_scene(const cli_list *folders, const wanted_scene *wanted, paper_scene *s,
                       base_error *error) {
    static const char *const endings[] = { ".gltf", ".glb", ".obj" };
    *s = (paper_scene) {
        .name = wanted->name, .credit = wanted->credit, .camera = "", .overview = ""
    };
    for (size_t i = 0; i < sizeof endings / sizeof *endings && !s->file[0]; i++) {
        char file[64];
        snprintf(file, sizeof file, "%s%s", wanted->file, endings[i]);
        if (!find(folders, wanted->folder, file, s->file, error))
            return false;
    }
    s->real = s->file[0];
    if (!s->real) {
        s->name = wanted->stand_in;
        s->credit = "";
        snprintf(s->file, sizeof s->file, "%s", wanted->stand_in);
    } else if (!find(folders, wanted->folder, wanted->lights, s->lights, error))
        return false;
    s->random_lights = s->lights[0] ? 0 : wanted->light_count;
    return join_words(s, error);
}

bool paper_scene_load(const paper_scene *from, scene *world, base_error *error) {
    const scene_lights_options lights = { .file = from->lights[0] ? from->lights : NULL,
                                          .random_count = from->random_lights,
                                          .seed = from->random_lights > 0,
                                          .hide = from->hide_lights };
    if (!scene_load(from->file, &(scene_options) { .leaves = SCENE_LEAVES_OPAQUE }, world, error))
        return false;
    if (scene_apply_lights(world, &lights, error))
        return true;
    scene_free(world);
    return false;
}

/* Sets the camera near the ball, whose lights stand around it, and the overview from which they are
 * visible. */
static void aim_at_ball(paper_scene *s) {
    s->view = (scene_camera_options) { .eye = { 0.17, 0.13, 0.22 },
                                       .target = { 0, 0.042, 0 },
                                       .fov = 26,
                                       .eye_given = true,
                                       .target_given = true,
                                       .fov_given = true };
    s->hide_lights = true;
    s->camera = "--hide-lights --eye 0.17,0.13,0.22 --target 0,0.042,0 --fov 26";
    s->overview = "--eye 0.31,0.24,0.4 --target 0,0.07,0 --fov 44";
}

/* --- materials -------------------------------------------------------------------------------- */

static const struct {
    const char *letter, *name, *stand_in;
} wanted_materials[PAPER_MATERIALS] = {
    { "a", "paper_white", "white-paint" },
    { "b", "ilm_solo_millennium_falcon", "silver-metallic-paint" },
    { "c", "acrylic_felt_orange", "orange-paint" },
    { "d", "ilm_solo_m_68", "nickel" },
    { "e", "cc_amber_citrine", "specular-yellow-phenolic" },
};

static bool find_material(const cli_list *folders, int index, paper_material *m,
                          base_error *error) {
    static const char *const endings[] = {
        [PAPER_MEASURED] = "_rgb.bsdf", [PAPER_FIT] = ".binary"
    };
    const char *const name = wanted_materials[index].name;
    char path[1024] = "", file[96];
    *m = (paper_material) { .letter = wanted_materials[index].letter, .name = name };
    for (m->source = PAPER_MEASURED; m->source < PAPER_STAND_IN; m->source++) {
        snprintf(file, sizeof file, "%s%s", name, endings[m->source]);
        if (!find(folders, "rgl_neural", file, path, error))
            return false;
        if (path[0])
            break;
    }
    if (m->source == PAPER_STAND_IN) {
        snprintf(m->value, sizeof m->value, "test_material=sgd:%s",
                 wanted_materials[index].stand_in);
        snprintf(m->label, sizeof m->label, "%s (stand-in)", wanted_materials[index].stand_in);
    } else {
        snprintf(m->value, sizeof m->value, "test_material=%s", path);
        snprintf(m->label, sizeof m->label, "%s%s", name,
                 m->source == PAPER_FIT ? " (fit)" : " (measured)");
    }
    return paper_quote(m->value, m->word, sizeof m->word) ||
           base_fail(error, path, "is too long a name");
}

void paper_name_materials(const paper_data *data, int first, int last, char *names, size_t size) {
    static const char *const texts[] = { [PAPER_MEASURED] = "measurements",
                                         [PAPER_FIT] = "neural fits",
                                         [PAPER_STAND_IN] = "stand-ins" };
    int used = 0;
    names[0] = 0;
    for (int source = 0; source <= PAPER_STAND_IN; source++)
        for (int i = first; i <= last; i++)
            if ((int)data->materials[i].source == source) {
                used += snprintf(names + used, size - (size_t)used, "%s%s", used ? ", " : "",
                                 texts[source]);
                break;
            }
    snprintf(names + used, size - (size_t)used, " on %s", data->ball.name);
}

/* --- all of it -------------------------------------------------------------------------------- */

static const wanted_scene san_miguel = {
    .name = "San Miguel",
    .credit = "San Miguel © Guillermo M. Leal LLaguno (www.evvisual.com), CC BY 3.0, converted and "
              "changed.",
    .folder = "san_miguel",
    .file = "san_miguel",
    .lights = "san_miguel_lights.json",
    .stand_in = "builtin:atrium",
    .light_count = 10,
};

static const wanted_scene sponza = {
    .name = "Sponza",
    .credit = "Crytek Sponza © 2010 Frank Meinl, Crytek, after Marko Dabrovic. Its sources "
              "contradict each other about its license: do not publish these images.",
    .folder = "sponza",
    .file = "sponza",
    .lights = "sponza_lights.json",
    .stand_in = "builtin:atrium",
    .light_count = 30,
};

static const wanted_scene ball = {
    .name = "the shader ball",
    .credit = "StandardShaderBall © Chris Rydalch, André Mazzone, Thomas Anagnostou / ASWF USD-WG, "
              "CC BY 4.0, converted.",
    .folder = "shaderball",
    .file = "shaderball_scene",
    .lights = "ball_lights.json",
    .stand_in = "builtin:ball",
};

/* Finds the ball and its lights, which lie beside the materials. The stand-in is the built-in ball,
 * which has its own lights. */
static bool find_ball(const cli_list *folders, paper_scene *s, base_error *error) {
    static const cli_list nowhere = { .count = 0 };
    if (!find_scene(folders, &ball, s, error))
        return false;
    if (s->real && find(folders, "rgl_neural", ball.lights, s->lights, error) && s->lights[0]) {
        aim_at_ball(s);
        return join_words(s, error);
    }
    return find_scene(&nowhere, &ball, s, error);
}

bool paper_data_find(const cli_list *folders, paper_data *data, base_error *error) {
    for (int i = 0; i < folders->count; i++)
        if (!is_folder(folders->items[i], error))
            return false;
    for (int i = 0; i < PAPER_MATERIALS; i++)
        if (!find_material(folders, i, &data->materials[i], error))
            return false;
    return find_scene(folders, &san_miguel, &data->san_miguel, error) &&
           find_scene(folders, &sponza, &data->sponza, error) &&
           find_ball(folders, &data->ball, error);
}
