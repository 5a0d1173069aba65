/* SPDX-License-Identifier: MIT */
#include "app/scene/load/obj.h"

#include "app/base/sandbox.h"
#include "app/scene/load/mtl.h"
#include "app/scene/load/words.h"
#include "app/scene/mesh.h"
#include "app/scene/phong.h"
#include "app/scene/sides.h"
#include "app/scene/vector.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

/* The indices of a corner, from 0; NONE: absent. */
#define NONE UINT32_MAX
typedef struct corner {
    uint32_t position, uv, normal;
} corner;

/* Triangles of one group and material, up to the first triangle of the next run. */
typedef struct run {
    char name[SCENE_NAME_SIZE];
    char *material; /* owned; NULL: none */
    size_t first_corner;
} run;

/* A growing array; zero-initialize. */
typedef struct list {
    void *items;
    size_t count, capacity;
} list;

typedef struct obj_reader {
    scene_builder *builder;
    source_set *sources;
    word_reader words;
    list positions, uvs, normals; /* of 3, 2 and 3 floats */
    list corners;                 /* 3 per triangle */
    list runs;
    list unsided; /* the numbers of meshes that do not tell which side is their front */
    list polygon; /* corners of the polygon being read */
    mtl_names materials;
    texture_files textures;
    base_error *error;
} obj_reader;

static bool fail(const obj_reader *r, const char *wrong) {
    return base_fail(r->error, r->sources->subject, "is not valid OBJ: line %zu %s", r->words.line,
                     wrong);
}

static void *append(const obj_reader *r, list *l, size_t item) {
    if (l->count == l->capacity) {
        const size_t capacity = l->capacity ? 2 * l->capacity : 64;
        void *items = realloc(l->items, capacity * item);
        if (!items) {
            base_fail(r->error, r->sources->subject, "does not fit into memory");
            return NULL;
        }
        l->items = items;
        l->capacity = capacity;
    }
    return (char *)l->items + item * l->count++;
}

/* --- vertices --------------------------------------------------------------------------------- */

/* Reads a statement's numbers, at least `least` and at most `most`, the first three relative to the
 * origin; returns how many there are, -1 on failure. */
static int read_numbers(obj_reader *r, int least, int most, const double origin[3],
                        float *numbers) {
    int count = 0;
    for (const char *word; (word = words_next(&r->words)); count++) {
        if (count >= 3 && most > 3 && count < most) /* a weight or a color: neither is supported */
            continue;
        if (count == most ||
            !words_coordinate(word, count < 3 ? origin[count] : 0.0, &numbers[count])) {
            fail(r, "has no finite number where one belongs, or too many");
            return -1;
        }
    }
    if (count < least)
        fail(r, "has too few numbers");
    return count < least ? -1 : count;
}

static bool read_vertex(obj_reader *r, list *l, int least, int most, size_t width) {
    static const double none[3] = { 0.0, 0.0, 0.0 };
    float numbers[8] = { 0.0f };
    const bool position = l == &r->positions;
    const int count = read_numbers(r, least, most, position ? r->builder->origin : none, numbers);
    float *item = count < 0 ? NULL : append(r, l, width * sizeof *item);
    if (!item)
        return false;
    memcpy(item, numbers, width * sizeof *item);
    if (position && count > 4)
        builder_unsupported(r->builder, NULL, "vertex color", 1);
    return true;
}

/* --- polygons --------------------------------------------------------------------------------- */

/* Reads a corner's index: from 1, or backwards from -1. *index is NONE if it is absent or out of
 * range. Returns false if the text is not an index. */
static bool read_reference(const char **text, size_t count, uint32_t *index) {
    char *end;
    *index = NONE;
    if (**text == '/' || !**text)
        return true;
    if (!strchr("-0123456789", **text))
        return false;
    errno = 0;
    const long number = strtol(*text, &end, 10);
    *text = end;
    const long from_start = number > 0 ? number - 1 : (long)count + number;
    if (!errno && number != 0 && from_start >= 0 && (size_t)from_start < count)
        *index = (uint32_t)from_start;
    return true;
}

/* Reads a corner. An index that refers to nothing, other than the position's, is treated as
 * absent. */
static bool read_corner(const obj_reader *r, const char *word, corner *c) {
    static const char *const lacking[3] = { NULL, "missing texture coordinates", "missing normal" };
    const size_t counts[3] = { r->positions.count, r->uvs.count, r->normals.count };
    uint32_t *const indices[3] = { &c->position, &c->uv, &c->normal };
    c->uv = c->normal = NONE;
    for (int i = 0; i < 3; i++) {
        const char *const given = word;
        if (!read_reference(&word, counts[i], indices[i]))
            return false;
        if (i > 0 && word != given && *indices[i] == NONE)
            builder_unsupported(r->builder, lacking[i], "corner", 1);
        if (!*word)
            return c->position != NONE;
        if (*word++ != '/')
            return false;
    }
    return false;
}

static bool read_polygon(obj_reader *r) {
    r->polygon.count = 0;
    for (const char *word; (word = words_next(&r->words));) {
        corner *c = append(r, &r->polygon, sizeof *c);
        if (!c)
            return false;
        if (!read_corner(r, word, c))
            return fail(r, "refers to a vertex that does not exist");
    }
    if (r->polygon.count < 3)
        builder_unsupported(r->builder, "fewer than 3 vertices", "face", 1);
    for (size_t i = 2; i < r->polygon.count; i++) {
        const size_t fan[3] = { 0, i - 1, i };
        for (int k = 0; k < 3; k++) {
            corner *c = append(r, &r->corners, sizeof *c);
            if (!c)
                return false;
            *c = ((const corner *)r->polygon.items)[fan[k]];
        }
    }
    return true;
}

/* --- groups and materials --------------------------------------------------------------------- */

/* Begins a run like the last one, or reuses the last one if it has no triangles yet. */
static run *begin_run(obj_reader *r) {
    run *last = r->runs.count ? (run *)r->runs.items + r->runs.count - 1 : NULL;
    if (last && last->first_corner == r->corners.count)
        return last;
    char *material = last && last->material ? strdup(last->material) : NULL;
    run *next = append(r, &r->runs, sizeof *next);
    if (!next) {
        free(material);
        return NULL;
    }
    *next = (run) { .material = material, .first_corner = r->corners.count };
    scene_clean_name(next->name, r->runs.count > 1 ? (next - 1)->name : "defaultobject");
    return next;
}

static bool read_group(obj_reader *r) {
    run *next = begin_run(r);
    if (next)
        scene_clean_name(next->name, words_rest(&r->words));
    return next != NULL;
}

static bool read_material_use(obj_reader *r) {
    run *next = begin_run(r);
    if (!next)
        return false;
    free(next->material);
    next->material = strdup(words_rest(&r->words));
    return next->material || base_fail(r->error, r->sources->subject, "does not fit into memory");
}

/* Reads an MTL file; *state says why it could not be read. */
static bool read_library(obj_reader *r, const char *name, source_state *state) {
    const source *found;
    if (!sources_read_optional(r->sources, name, &found, state, r->error))
        return false;
    return !found || mtl_add(found->data, found->size, &r->textures, &r->materials, r->error);
}

/* Reads the MTL files of a statement: one file, perhaps with spaces in its name, or several. */
static bool read_libraries(obj_reader *r) {
    source_state state;
    char *names = words_rest(&r->words);
    if (!*names)
        return fail(r, "names no file");
    if (!read_library(r, names, &state))
        return false;
    if (state == SOURCE_READ)
        return true;
    r->words.words = names;
    for (const char *name; (name = words_next(&r->words));) {
        if (!read_library(r, name, &state))
            return false;
        if (state != SOURCE_READ)
            builder_unsupported_file(r->builder, name, source_state_nouns[state]);
    }
    return true;
}

/* --- statements ------------------------------------------------------------------------------- */

static bool is_one_of(const char *keyword, const char *const *names) {
    while (*names && strcmp(*names, keyword) != 0)
        names++;
    return *names != NULL;
}

static bool read_statement(obj_reader *r) {
    /* Statements that control display or smoothing, and control points of unsupported curves and
     * surfaces. */
    static const char *const silent[] = {
        "s",     "mg",       "vp",       "deg",  "bmat",       "step",      "cstype",
        "parm",  "trim",     "hole",     "scrv", "sp",         "end",       "con",
        "bevel", "c_interp", "d_interp", "lod",  "shadow_obj", "trace_obj", "ctech",
        "stech", "maplib",   "usemap",   NULL
    };
    static const char *const curved[] = { "curv", "curv2", "surf", NULL };
    const char *keyword = words_next(&r->words);
    if (!keyword)
        return true;
    if (strcmp(keyword, "v") == 0)
        return read_vertex(r, &r->positions, 3, 8, 3);
    if (strcmp(keyword, "vt") == 0)
        return read_vertex(r, &r->uvs, 1, 3, 2);
    if (strcmp(keyword, "vn") == 0)
        return read_vertex(r, &r->normals, 3, 3, 3);
    if (strcmp(keyword, "f") == 0 || strcmp(keyword, "fo") == 0)
        return read_polygon(r);
    if (strcmp(keyword, "o") == 0 || strcmp(keyword, "g") == 0)
        return read_group(r);
    if (strcmp(keyword, "usemtl") == 0)
        return read_material_use(r);
    if (strcmp(keyword, "mtllib") == 0)
        return read_libraries(r);
    if (strcmp(keyword, "p") == 0 || strcmp(keyword, "l") == 0)
        builder_unsupported(r->builder, "points and lines", "element", 1);
    else if (is_one_of(keyword, curved))
        builder_unsupported(r->builder, NULL, "free-form curve", 1);
    else if (!is_one_of(keyword, silent))
        builder_unsupported(r->builder, NULL, "unknown statement", 1);
    return true;
}

/* --- into the scene --------------------------------------------------------------------------- */

static uint32_t material_of(const obj_reader *r, const run *from) {
    const mtl_name *found = from->material ? mtl_find(&r->materials, from->material) : NULL;
    if (from->material && !found)
        builder_unsupported(r->builder, from->material, "missing material", 1);
    return found ? found->material : 0;
}

/* Notes the last mesh as one without sides. */
static bool note_unsided(obj_reader *r) {
    uint32_t *const item = append(r, &r->unsided, sizeof *item);
    if (item)
        *item = (uint32_t)builder_count(r->builder, BLOB_MESHES) - 1;
    return item != NULL;
}

static bool add_run(obj_reader *r, const run *from, size_t end) {
    const float *positions = r->positions.items, *uvs = r->uvs.items, *normals = r->normals.items;
    const size_t count = end - from->first_corner;
    if (count == 0)
        return true;
    const corner *corners = (const corner *)r->corners.items + from->first_corner;
    mesh_draft draft = { .subject = r->sources->subject,
                         .name = from->name,
                         .material = material_of(r, from),
                         .vertices = calloc(count, sizeof *draft.vertices),
                         .vertex_count = count,
                         .corners = malloc(count * sizeof *draft.corners),
                         .corner_count = count,
                         .weld = true,
                         .unsided = true,
                         .crease_cos = MESH_CREASE_60 };
    bool ok = (draft.vertices && draft.corners) ||
              base_fail(r->error, draft.subject, "does not fit into memory");
    for (size_t i = 0; ok && i < count; i++) {
        scene_vertex *vertex = &draft.vertices[i];
        draft.corners[i] = (uint32_t)i;
        memcpy(vertex->position, positions + 3 * (size_t)corners[i].position,
               sizeof vertex->position);
        if (corners[i].uv != NONE) {
            vertex->uv[0][0] = uvs[2 * (size_t)corners[i].uv];
            vertex->uv[0][1] = 1.0f - uvs[2 * (size_t)corners[i].uv + 1];
        }
        if (corners[i].normal != NONE) {
            const float *n = normals + 3 * (size_t)corners[i].normal;
            vec_store(vec_normalize(vec_load(n), vec(0.0f, 0.0f, 0.0f)), vertex->normal);
            draft.has_normals = true;
        }
    }
    ok = ok && mesh_add(&draft, r->builder, r->error);
    mesh_free(&draft);
    return ok && (draft.sided || note_unsided(r));
}

static bool read_all(obj_reader *r) {
    if (!builder_material(r->builder, "DefaultMaterial"))
        return base_fail(r->error, r->sources->subject, "does not fit into memory");
    scene_material *fallback = builder_items(r->builder, BLOB_MATERIALS);
    for (int k = 0; k < 3; k++)
        fallback->base_color[k] = 0.6f;
    fallback->flags |= SCENE_DOUBLE_SIDED | SCENE_SIDES_UNSAID;
    if (!begin_run(r))
        return false;
    r->error->text[0] = 0;
    const char *const text = r->words.at;
    const double size = (double)(r->words.end - text) + 1;
    while (words_next_line(&r->words, r->sources->subject, r->error)) {
        sandbox_progress((double)(r->words.at - text) / size);
        if (!read_statement(r))
            return false;
    }
    if (r->error->text[0])
        return false;
    mtl_sort(&r->materials);
    const run *runs = r->runs.items;
    for (size_t i = 0; i < r->runs.count; i++)
        if (!add_run(r, &runs[i],
                     i + 1 < r->runs.count ? runs[i + 1].first_corner : r->corners.count))
            return false;
    builder_instances(r->builder, 0);
    return (sides_turn_outwards(r->builder, r->unsided.items, r->unsided.count) &&
            phong_tell_invisible(r->builder, "invisible by d 0")) ||
           base_fail(r->error, r->sources->subject, "does not fit into memory");
}

bool obj_add(const void *data, size_t size, source_set *sources, scene_builder *builder,
             base_error *error) {
    const char *const text = data;
    obj_reader r = { .builder = builder,
                     .sources = sources,
                     .words = { .at = text, .end = text + size },
                     .textures = { .sources = sources, .images.builder = builder },
                     .error = error };
    const bool ok = read_all(&r);
    run *runs = r.runs.items;
    for (size_t i = 0; i < r.runs.count; i++)
        free(runs[i].material);
    const list *lists[] = { &r.positions, &r.uvs,     &r.normals, &r.corners,
                            &r.runs,      &r.unsided, &r.polygon };
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++)
        free(lists[i]->items);
    mtl_names_free(&r.materials);
    free(r.textures.images.items);
    free(r.words.buffer);
    return ok;
}
