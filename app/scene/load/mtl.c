/* SPDX-License-Identifier: MIT */
#include "app/scene/load/mtl.h"

#include "app/scene/load/words.h"
#include "app/scene/phong.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* The state of reading one material. */
typedef struct mtl_reader {
    texture_files *files;
    mtl_names *names;
    word_reader words;
    bool open; /* whether there was a newmtl */
    phong factors;
    int illumination;
    bool dissolves;            /* whether there was a d, after which Tr is ignored */
    bool filters;              /* whether Tf makes the material transparent with colored light */
    float roughness, metallic; /* below 0: not given */
    size_t material;
    base_error *error;
} mtl_reader;

/* Notes a statement that cannot be read; the rest of the material is used. */
static bool skip(const mtl_reader *r, const char *keyword) {
    char line[SCENE_NAME_SIZE];
    snprintf(line, sizeof line, "MTL line %zu, %.20s", r->words.line, keyword);
    builder_unsupported(r->files->images.builder, line, "unreadable statement", 1);
    return true;
}

static scene_material *material_of(const mtl_reader *r) {
    return (scene_material *)builder_items(r->files->images.builder, BLOB_MATERIALS) + r->material;
}

static void finish_material(mtl_reader *r) {
    if (!r->open)
        return;
    if (r->illumination < 2)
        memset(r->factors.specular, 0, sizeof r->factors.specular);
    scene_material *material = material_of(r);
    phong_apply(&r->factors, material);
    if (r->filters && material->base_color[3] < 1.0f)
        builder_unsupported(r->files->images.builder, "Tf", "material", 1);
    if (r->roughness >= 0.0f)
        material->roughness = fminf(r->roughness, 1.0f);
    if (r->metallic >= 0.0f)
        material->metallic = fminf(r->metallic, 1.0f);
}

static bool new_material(mtl_reader *r) {
    finish_material(r);
    const char *name = words_rest(&r->words);
    if (r->names->count == r->names->capacity) {
        const size_t capacity = r->names->capacity ? 2 * r->names->capacity : 16;
        mtl_name *items = realloc(r->names->items, capacity * sizeof *items);
        if (!items)
            return base_fail(r->error, r->files->sources->subject, "does not fit into memory");
        r->names->items = items;
        r->names->capacity = capacity;
    }
    r->material = builder_count(r->files->images.builder, BLOB_MATERIALS);
    mtl_name *own = &r->names->items[r->names->count];
    *own = (mtl_name) { .name = strdup(name), .material = (uint32_t)r->material };
    if (!own->name || !builder_material(r->files->images.builder, name)) {
        free(own->name);
        return base_fail(r->error, r->files->sources->subject, "does not fit into memory");
    }
    r->names->count++;
    r->open = true;
    r->factors = (phong) { .diffuse = { 0.6f, 0.6f, 0.6f }, .opacity = 1.0f };
    r->illumination = 2;
    r->dissolves = r->filters = false;
    r->roughness = r->metallic = -1.0f;
    return true;
}

/* --- factors ---------------------------------------------------------------------------------- */

static bool read_number(mtl_reader *r, float *number) {
    float given;
    if (!words_number(words_next(&r->words), &given))
        return false;
    *number = given;
    return true;
}

/* Reads a color; one number stands for three. */
static bool read_color(mtl_reader *r, float color[3]) {
    float given[3];
    if (!read_number(r, &given[0]))
        return false;
    for (int k = 1; k < 3; k++) {
        const char *word = words_next(&r->words);
        given[k] = given[0];
        if (word && !words_number(word, &given[k]))
            return false;
    }
    memcpy(color, given, sizeof given);
    return true;
}

/* Returns the opacity of Tr. Exporters that write 1 mean opaque, because nobody writes down what is
 * invisible. */
static float opacity_of(float transparency) {
    return transparency == 1.0f ? 1.0f : 1.0f - transparency;
}

/* Reads a factor. Returns whether the keyword is one; *valid is then whether its value can be
 * read. */
static bool read_factor(mtl_reader *r, const char *keyword, bool *valid) {
    float number = 0.0f;
    bool ok = true, known = true;
    if (strcasecmp(keyword, "Kd") == 0) {
        ok = read_color(r, r->factors.diffuse);
    } else if (strcasecmp(keyword, "Ks") == 0) {
        ok = read_color(r, r->factors.specular);
    } else if (strcasecmp(keyword, "Ke") == 0) {
        ok = read_color(r, r->factors.emission);
    } else if (strcasecmp(keyword, "Tf") == 0) {
        float filter[3];
        ok = read_color(r, filter);
        r->filters = ok && !(filter[0] == 1.0f && filter[1] == 1.0f && filter[2] == 1.0f);
    } else if (strcasecmp(keyword, "Ns") == 0) {
        ok = read_number(r, &r->factors.exponent);
    } else if (strcasecmp(keyword, "Pr") == 0) {
        ok = read_number(r, &r->roughness);
    } else if (strcasecmp(keyword, "Pm") == 0) {
        ok = read_number(r, &r->metallic);
    } else if (strcasecmp(keyword, "illum") == 0) {
        ok = read_number(r, &number);
        r->illumination = ok && number < 2.0f ? 0 : 2;
    } else if (strcasecmp(keyword, "d") == 0) {
        ok = read_number(r, &r->factors.opacity);
        r->dissolves |= ok;
    } else if (strcasecmp(keyword, "Tr") == 0) {
        ok = read_number(r, &number);
        if (ok && !r->dissolves)
            r->factors.opacity = opacity_of(number);
    } else {
        known = false;
    }
    *valid = ok;
    return known;
}

/* --- maps ------------------------------------------------------------------------------------- */

/* Skips the options before the name of a map's file; -clamp is obeyed, and options that would move
 * or recolor the map are noted. */
static void skip_options(mtl_reader *r, scene_wrap *wrap) {
    static const struct {
        const char *name;
        int arguments;
        bool changes;
    } options[] = { { "-blendu", 1, false }, { "-blendv", 1, false }, { "-cc", 1, false },
                    { "-clamp", 1, false },  { "-bm", 1, false },     { "-boost", 1, false },
                    { "-texres", 1, false }, { "-imfchan", 1, true }, { "-type", 1, true },
                    { "-mm", 2, true },      { "-o", 3, true },       { "-s", 3, true },
                    { "-t", 3, true } };
    for (;;) {
        char *start = r->words.words + strspn(r->words.words, " \t");
        const size_t length = strcspn(start, " \t");
        size_t i = 0;
        while (i < sizeof options / sizeof *options &&
               (strlen(options[i].name) != length || strncmp(options[i].name, start, length) != 0))
            i++;
        if (i == sizeof options / sizeof *options)
            return;
        words_next(&r->words);
        if (options[i].changes)
            builder_unsupported(r->files->images.builder, options[i].name, "map", 1);
        for (int k = 0; k < options[i].arguments; k++) {
            /* three numbers, of which the last two may be missing */
            char *at = r->words.words + strspn(r->words.words, " \t");
            if (k > 0 && options[i].arguments == 3 && !strchr("0123456789+-.", *at))
                break;
            const char *argument = words_next(&r->words);
            if (strcmp(options[i].name, "-clamp") == 0 && argument && strcmp(argument, "on") == 0)
                *wrap = SCENE_WRAP_CLAMP;
        }
    }
}

static bool read_map(mtl_reader *r, const char *keyword) {
    static const struct {
        const char *keyword;
        size_t use;
        uint32_t srgb;
    } maps[] = { { "map_Kd", offsetof(scene_material, base_color_map), 1 },
                 { "map_Ke", offsetof(scene_material, emission_map), 1 },
                 { "map_emissive", offsetof(scene_material, emission_map), 1 },
                 { "norm", offsetof(scene_material, normal_map), 0 },
                 { "map_Kn", offsetof(scene_material, normal_map), 0 } };
    size_t i = 0;
    while (i < sizeof maps / sizeof *maps && strcasecmp(maps[i].keyword, keyword) != 0)
        i++;
    if (i == sizeof maps / sizeof *maps) {
        builder_unsupported(r->files->images.builder, keyword, "material", 1);
        return true;
    }
    scene_wrap wrap = SCENE_WRAP_REPEAT;
    skip_options(r, &wrap);
    const char *path = words_rest(&r->words);
    scene_texture_use *use = (scene_texture_use *)(void *)((char *)material_of(r) + maps[i].use);
    return !*path ? skip(r, keyword)
                  : texture_file_use(r->files, path, maps[i].srgb, wrap, wrap, use, r->error);
}

/* --- statements ------------------------------------------------------------------------------- */

/* Whether a statement has no effect on the appearance of a surface here. */
static bool is_ignored(const char *keyword) {
    static const char *const ignored[] = { "Ka", "map_Ka", "Ni", "sharpness", "map_aat", NULL };
    size_t i = 0;
    while (ignored[i] && strcasecmp(ignored[i], keyword) != 0)
        i++;
    return ignored[i] != NULL;
}

static bool read_statement(mtl_reader *r) {
    const char *keyword = words_next(&r->words);
    bool valid;
    if (!keyword)
        return true;
    if (strcasecmp(keyword, "newmtl") == 0)
        return new_material(r);
    if (!r->open || is_ignored(keyword))
        return true;
    if (!read_factor(r, keyword, &valid))
        return read_map(r, keyword);
    return valid || skip(r, keyword);
}

bool mtl_add(const char *text, size_t size, texture_files *files, mtl_names *names,
             base_error *error) {
    mtl_reader r = {
        .files = files, .names = names, .words = { .at = text, .end = text + size }, .error = error
    };
    bool ok = true;
    error->text[0] = 0;
    while (ok && words_next_line(&r.words, files->sources->subject, error))
        ok = read_statement(&r);
    finish_material(&r);
    free(r.words.buffer);
    return ok && !error->text[0];
}

static int compare_names(const void *a, const void *b) {
    const mtl_name *x = a, *y = b;
    const int order = strcmp(x->name, y->name);
    return order ? order : (x->material > y->material) - (x->material < y->material);
}

void mtl_sort(mtl_names *names) {
    if (names->count > 0)
        qsort(names->items, names->count, sizeof *names->items, compare_names);
}

const mtl_name *mtl_find(const mtl_names *names, const char *name) {
    size_t low = 0, high = names->count;
    while (low < high) {
        const size_t middle = (low + high) / 2;
        if (strcmp(names->items[middle].name, name) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    return low < names->count && strcmp(names->items[low].name, name) == 0 ? &names->items[low]
                                                                           : NULL;
}

void mtl_names_free(mtl_names *names) {
    for (size_t i = 0; i < names->count; i++)
        free(names->items[i].name);
    free(names->items);
}
