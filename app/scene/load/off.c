/* SPDX-License-Identifier: MIT */
#include "app/scene/load/off.h"

#include "app/base/sandbox.h"
#include "app/scene/load/words.h"
#include "app/scene/mesh.h"
#include "app/scene/sides.h"
#include "app/scene/vector.h"

#include <stdlib.h>
#include <string.h>

typedef struct off_reader {
    const char *at, *end;
    size_t line;
    char word[64]; /* the word read last */
    scene_builder *builder;
    mesh_draft draft;
    size_t corner_capacity;
    base_error *error;
} off_reader;

static bool fail(const off_reader *r, const char *wrong) {
    return base_fail(r->error, r->draft.subject, "is not valid OFF: line %zu %s", r->line, wrong);
}

static bool fail_memory(const off_reader *r) {
    return base_fail(r->error, r->draft.subject, "does not fit into memory");
}

/* --- words ------------------------------------------------------------------------------------ */

static bool is_end_of_line(char c) {
    return c == '\n' || c == '\r';
}

static void skip_line(off_reader *r) {
    while (r->at < r->end && !is_end_of_line(*r->at))
        r->at++;
}

/* Reads the next word, on any line; comments are skipped. */
static bool next_word(off_reader *r) {
    size_t length = 0;
    for (; r->at < r->end && (strchr(" \t\r\n#", *r->at) && *r->at); r->at++) {
        if (*r->at == '#')
            skip_line(r);
        if (r->at == r->end)
            break;
        r->line += *r->at == '\n';
    }
    while (r->at < r->end && length + 1 < sizeof r->word && *r->at && !strchr(" \t\r\n#", *r->at))
        r->word[length++] = *r->at++;
    r->word[length] = 0;
    return length > 0 ||
           fail(r, r->at < r->end ? "is no text" : "is the last, before its elements");
}

static bool next_count(off_reader *r, size_t *count) {
    *count = 0;
    if (!next_word(r))
        return false;
    if (r->word[strspn(r->word, "0123456789")] || strlen(r->word) > 10)
        return fail(r, "has no whole number where one belongs");
    *count = (size_t)strtoull(r->word, NULL, 10);
    return true;
}

static bool next_coordinate(off_reader *r, double origin, float *coordinate) {
    return next_word(r) && (words_coordinate(r->word, origin, coordinate) ||
                            fail(r, "has no finite number where one belongs"));
}

/* --- elements --------------------------------------------------------------------------------- */

/* Reads the keyword. Vertices have normals if an N stands before OFF; what a C or ST adds follows
 * them on the line and is skipped. */
static bool read_head(off_reader *r, bool *normals) {
    if (!next_word(r))
        return false;
    const char *at = r->word;
    at += strncmp(at, "ST", 2) == 0 ? 2 : 0;
    at += *at == 'C';
    *normals = *at == 'N';
    at += *normals;
    if (strncmp(at, "OFF", 3) != 0 || at[3 + strspn(at + 3, "0123456789")])
        return fail(r, "does not begin with OFF, or is of 4 dimensions");
    r->at -= strlen(at + 3); /* the first number may follow immediately */
    return true;
}

static bool read_vertices(off_reader *r, size_t count, bool normals) {
    if (count > (size_t)(r->end - r->at) || count >= UINT32_MAX)
        return fail(r, "counts more vertices than bytes");
    r->draft.vertices = calloc(count + 1, sizeof *r->draft.vertices);
    if (!r->draft.vertices)
        return fail_memory(r);
    r->draft.vertex_count = count;
    r->draft.has_normals = normals;
    for (size_t i = 0; i < count; i++) {
        scene_vertex *const v = &r->draft.vertices[i];
        for (int k = 0; k < 3; k++)
            if (!next_coordinate(r, r->builder->origin[k], &v->position[k]))
                return false;
        for (int k = 0; normals && k < 3; k++)
            if (!next_coordinate(r, 0.0, &v->normal[k]))
                return false;
        vec_store(vec_normalize(vec_load(v->normal), vec(0.0f, 0.0f, 0.0f)), v->normal);
        skip_line(r);
    }
    return true;
}

static bool add_corner(off_reader *r, size_t index) {
    mesh_draft *const d = &r->draft;
    if (d->corner_count == r->corner_capacity) {
        const size_t capacity = 2 * r->corner_capacity + 1024;
        uint32_t *const corners = realloc(d->corners, capacity * sizeof *corners);
        if (!corners)
            return fail_memory(r);
        d->corners = corners;
        r->corner_capacity = capacity;
    }
    d->corners[d->corner_count++] = (uint32_t)index;
    return true;
}

/* Reads a face as a fan; the color after it on the line is skipped. */
static bool read_face(off_reader *r) {
    size_t count, first = 0, last = 0, index;
    if (!next_count(r, &count))
        return false;
    for (size_t i = 0; i < count; i++) {
        if (!next_count(r, &index))
            return false;
        if (index >= r->draft.vertex_count)
            return fail(r, "has a face with a vertex that does not exist");
        if (i == 0)
            first = index;
        if (i >= 2 && !(add_corner(r, first) && add_corner(r, last) && add_corner(r, index)))
            return false;
        last = index;
    }
    skip_line(r);
    return true;
}

static bool read_all(off_reader *r) {
    size_t vertices, faces, edges;
    bool normals;
    if (!read_head(r, &normals) || !next_count(r, &vertices) || !next_count(r, &faces) ||
        !next_count(r, &edges) || !read_vertices(r, vertices, normals))
        return false;
    const char *const start = r->at;
    const double size = (double)(r->end - start) + 1.0;
    for (size_t i = 0; i < faces; i++) {
        if (i % 65536 == 0)
            sandbox_progress((double)(r->at - start) / size);
        if (!read_face(r))
            return false;
    }
    return true;
}

static bool add_all(off_reader *r) {
    if (!read_all(r))
        return false;
    scene_material *const material = builder_material(r->builder, "DefaultMaterial");
    if (!material)
        return fail_memory(r);
    for (int k = 0; k < 3; k++)
        material->base_color[k] = 0.6f;
    material->flags |= SCENE_DOUBLE_SIDED | SCENE_SIDES_UNSAID;
    if (!mesh_add(&r->draft, r->builder, r->error))
        return false;
    builder_instances(r->builder, 0);
    const size_t meshes = builder_count(r->builder, BLOB_MESHES);
    return r->draft.sided || sides_turn_outwards(r->builder, (const uint32_t[]) { 0 }, meshes) ||
           fail_memory(r);
}

bool off_add(const void *data, size_t size, source_set *sources, scene_builder *builder,
             base_error *error) {
    off_reader r = { .at = data,
                     .end = (const char *)data + size,
                     .line = 1,
                     .builder = builder,
                     .draft = { .subject = sources->subject,
                                .name = "defaultobject",
                                .unsided = true,
                                .crease_cos = MESH_CREASE_60 },
                     .error = error };
    const bool ok = add_all(&r);
    mesh_free(&r.draft);
    return ok;
}
