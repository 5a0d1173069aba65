/* SPDX-License-Identifier: MIT */
#include "app/scene/material.h"

#include "app/base/choice.h"
#include "app/base/number.h"
#include "app/scene/material_file.h"
#include "app/scene/vector.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#define GGX_ALPHA_LEAST 0.001f

void material_close(material *m) {
    lmp_brdf_destroy(m->brdf);
    lmp_brdf_table_destroy(m->table);
    memset(m, 0, sizeof *m);
}

/* --- parametric names ------------------------------------------------------------------------- */

/* Reads 1 to `count` numbers divided by `separator`, up to ':' or the end, and moves past them.
 * Returns how many there were, or 0 if the text is not numbers. */
static int take_numbers(const char **text, char separator, int count, float *values) {
    const char *at = *text;
    int taken = 0;
    while (taken < count) {
        size_t length = 0;
        while (at[length] && at[length] != ':' && at[length] != separator)
            length++;
        double value;
        if (!number_read(at, length, &value))
            return 0;
        values[taken++] = (float)value;
        at += length;
        if (*at != separator)
            break;
        at++;
    }
    if (*at == ':')
        at++;
    else if (*at)
        return 0;
    *text = at;
    return taken;
}

/* Reads a color if text remains, else leaves *color alone. */
static bool take_color(const char **text, lmp_rgb *color) {
    float v[3];
    if (!**text)
        return true;
    const int count = take_numbers(text, ',', 3, v);
    if (count != 1 && count != 3)
        return false;
    *color = count == 1 ? (lmp_rgb) { v[0], v[0], v[0] } : (lmp_rgb) { v[0], v[1], v[2] };
    return true;
}

/* The range of a parameter; the library rejects others without saying which. */
typedef struct parameter_range {
    const char *argument;
    float least, most; /* most may be INFINITY */
} parameter_range;

static bool within(const char *name, const parameter_range *range, const float *values, int count,
                   base_error *error) {
    for (int i = 0; i < count; i++)
        if (!(values[i] >= range->least && values[i] <= range->most))
            return isinf(range->most)
                       ? base_fail(error, name, "%s is %g, out of range (at least %g)",
                                   range->argument, (double)values[i], (double)range->least)
                       : base_fail(error, name, "%s is %g, out of range (%g to %g)",
                                   range->argument, (double)values[i], (double)range->least,
                                   (double)range->most);
    return true;
}

static bool color_within(const char *name, const char *argument, lmp_rgb color, float most,
                         base_error *error) {
    return within(name, &(parameter_range) { argument, 0, most },
                  (const float[]) { color.r, color.g, color.b }, 3, error);
}

static bool finish(const char *name, const char *rest, lmp_result result, base_error *error) {
    if (*rest)
        return base_fail(error, name, "too much after its last number");
    if (result != LMP_OK)
        return base_fail(error, name, "%s", lmp_result_text(result));
    return true;
}

static bool open_lambert(const char *name, const char *text, material *m, base_error *error) {
    lmp_rgb albedo;
    if (!*text || !take_color(&text, &albedo))
        return base_fail(error, name, "is not lambert:COLOR (one number or R,G,B)");
    return color_within(name, "COLOR", albedo, INFINITY, error) &&
           finish(name, text, lmp_brdf_create_lambert(NULL, albedo, &m->brdf), error);
}

static bool open_phong(const char *name, const char *text, material *m, base_error *error) {
    static const parameter_range exponents = { "EXPONENT", 0, 1e6f };
    lmp_rgb reflectance = { 1, 1, 1 };
    float exponent;
    if (take_numbers(&text, ',', 1, &exponent) != 1 || !take_color(&text, &reflectance))
        return base_fail(error, name, "is not phong:EXPONENT[:COLOR]");
    return within(name, &exponents, &exponent, 1, error) &&
           color_within(name, "COLOR", reflectance, INFINITY, error) &&
           finish(name, text, lmp_brdf_create_phong(NULL, reflectance, exponent, &m->brdf), error);
}

static bool open_ggx(const char *name, const char *text, material *m, base_error *error) {
    static const parameter_range alphas = { "ALPHA", GGX_ALPHA_LEAST, 1 };
    lmp_ggx ggx = { .f0 = { 0.04f, 0.04f, 0.04f } };
    float alpha[2] = { 0, 0 };
    const int alpha_count = take_numbers(&text, 'x', 2, alpha);
    if (!alpha_count || !take_color(&text, &ggx.f0) || !take_color(&text, &ggx.diffuse))
        return base_fail(error, name, "is not ggx:ALPHA[xALPHA_Y][:F0[:DIFFUSE]]");
    ggx.alpha_x = alpha[0];
    ggx.alpha_y = alpha[1];
    return within(name, &alphas, alpha, alpha_count, error) &&
           color_within(name, "F0", ggx.f0, 1, error) &&
           color_within(name, "DIFFUSE", ggx.diffuse, INFINITY, error) &&
           finish(name, text, lmp_brdf_create_ggx(NULL, &ggx, &m->brdf), error);
}

/* Makes a GGX of what glTF's metallic-roughness says: alpha is the square of the roughness. */
static bool open_gltf(const char *name, const char *text, material *m, base_error *error) {
    static const parameter_range factors = { "ROUGHNESS or METALLIC", 0, 1 };
    float color[3], factor[2];
    lmp_rgb base;
    if (!*text || !take_color(&text, &base) || take_numbers(&text, ',', 1, &factor[0]) != 1 ||
        take_numbers(&text, ',', 1, &factor[1]) != 1)
        return base_fail(error, name, "is not gltf:COLOR:ROUGHNESS:METALLIC");
    if (!within(name, &factors, factor, 2, error) || !color_within(name, "COLOR", base, 1, error))
        return false;
    rgb_store(base, color);
    float f0[3], diffuse[3];
    for (int k = 0; k < 3; k++) {
        f0[k] = 0.04f * (1 - factor[1]) + color[k] * factor[1];
        diffuse[k] = color[k] * (1 - factor[1]);
    }
    const float alpha = fmaxf(factor[0] * factor[0], GGX_ALPHA_LEAST);
    const lmp_ggx ggx = { .alpha_x = alpha, .f0 = rgb_load(f0), .diffuse = rgb_load(diffuse) };
    return finish(name, text, lmp_brdf_create_ggx(NULL, &ggx, &m->brdf), error);
}

static bool open_sheen(const char *name, const char *text, material *m, base_error *error) {
    static const parameter_range roughnesses = { "ROUGHNESS", 0.07f, 1 };
    lmp_sheen sheen = { .color = { 1, 1, 1 } };
    if (take_numbers(&text, ',', 1, &sheen.roughness) != 1 || !take_color(&text, &sheen.color) ||
        !take_color(&text, &sheen.diffuse))
        return base_fail(error, name, "is not sheen:ROUGHNESS[:COLOR[:DIFFUSE]]");
    return within(name, &roughnesses, &sheen.roughness, 1, error) &&
           color_within(name, "COLOR", sheen.color, 1, error) &&
           color_within(name, "DIFFUSE", sheen.diffuse, INFINITY, error) &&
           finish(name, text, lmp_brdf_create_sheen(NULL, &sheen, &m->brdf), error);
}

/* --- SGD -------------------------------------------------------------------------------------- */

/* Returns the SGD material of that name, or of one close to it, or NULL. */
static const char *nearest_sgd(const char *text) {
    const char *names[128] = { NULL };
    for (size_t i = 0; i < 127 && lmp_brdf_sgd_name(i); i++)
        names[i] = lmp_brdf_sgd_name(i);
    return choice_nearest(text, names);
}

static bool find_sgd(const char *name, const char *text, lmp_sgd *sgd, base_error *error) {
    size_t length;
    const char *const file = material_file_named(name, &length);
    if (file) {
        char path[4096];
        if (length >= sizeof path)
            return base_fail(error, name, "the name is too long");
        memcpy(path, file, length);
        path[length] = '\0';
        return material_read_sgd(path, file + length + 1, sgd, error);
    }
    if (lmp_brdf_find_sgd(text, sgd) == LMP_OK)
        return true;
    const char *nearest = nearest_sgd(text);
    return nearest ? base_fail(error, name, "no such SGD material (is it sgd:%s?)", nearest)
                   : base_fail(error, name, "no such SGD material (lampion brdf list names them)");
}

static bool open_sgd(const char *name, const char *text, material *m, base_error *error) {
    lmp_sgd sgd;
    if (!find_sgd(name, text, &sgd, error))
        return false;
    file_hash_add(&m->hash, &sgd, sizeof sgd);
    return finish(name, "", lmp_brdf_create_sgd(NULL, &sgd, &m->brdf), error);
}

/* --- by name ---------------------------------------------------------------------------------- */

static const struct {
    const char *name;
    bool (*open)(const char *name, const char *parameters, material *m, base_error *error);
} kinds[] = {
    { "lambert", open_lambert }, { "phong", open_phong }, { "ggx", open_ggx },
    { "gltf", open_gltf },       { "sheen", open_sheen }, { "sgd", open_sgd },
};
enum { KINDS = sizeof kinds / sizeof *kinds };

static bool open_file(const char *path, material *m, base_error *error) {
    material_file file;
    const bool ok = material_read_file(path, &file, error);
    m->brdf = file.brdf;
    m->table = file.table;
    m->file_size = file.size;
    m->hash = file.hash;
    return ok;
}

/* Suggests what a name such as gxx:0.3 or nickel, which is not a file, may mean. Returns false. */
static bool hint_kind(const char *name, base_error *error) {
    const char *names[KINDS + 1];
    char word[16];
    const size_t length = strcspn(name, ":");
    if (access(name, F_OK) == 0)
        return false;
    if (name[length] != ':') {
        const char *const sgd = nearest_sgd(name);
        return sgd && base_fail(error, name, "does not exist (is it sgd:%s?)", sgd);
    }
    if (length >= sizeof word)
        return false;
    snprintf(word, sizeof word, "%.*s", (int)length, name);
    choice_names(&kinds[0].name, sizeof *kinds, KINDS, names);
    return choice_fail(error, name, word, names);
}

/* Returns the kind whose prefix a name begins with, or KINDS for the name of a file. */
static int kind_of(const char *name) {
    const size_t length = strcspn(name, ":");
    int kind = 0;
    while (kind < KINDS && (name[length] != ':' || strlen(kinds[kind].name) != length ||
                            strncmp(name, kinds[kind].name, length) != 0))
        kind++;
    return kind;
}

const char *material_file_named(const char *name, size_t *length) {
    const int kind = kind_of(name);
    *length = strlen(name);
    if (kind == KINDS)
        return name;
    const char *const text = strchr(name, ':') + 1, *const colon = strrchr(text, ':');
    if (kinds[kind].open != open_sgd || !colon)
        return NULL;
    *length = (size_t)(colon - text);
    return text;
}

bool material_open(const char *name, material *m, base_error *error) {
    const int kind = kind_of(name);
    memset(m, 0, sizeof *m);
    m->name = name;
    if (kind < KINDS)
        file_hash_add(&m->hash, name, strlen(name));
    const bool ok = kind < KINDS ? kinds[kind].open(name, strchr(name, ':') + 1, m, error)
                                 : open_file(name, m, error) || hint_kind(name, error);
    if (!ok)
        material_close(m);
    return ok;
}
