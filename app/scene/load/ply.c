/* SPDX-License-Identifier: MIT */
#include "app/scene/load/ply.h"

#include "app/base/sandbox.h"
#include "app/scene/load/ply_header.h"
#include "app/scene/mesh.h"
#include "app/scene/sides.h"
#include "app/scene/texture_file.h"
#include "app/scene/vector.h"
#include "app/scene/world.h"

#include <stdlib.h>
#include <string.h>

/* A growing array; zero-initialize. */
typedef struct numbers {
    double *items;
    size_t count, capacity;
} numbers;

typedef struct ply_reader {
    ply_header header;
    const unsigned char *at, *end;
    scene_builder *builder;
    mesh_draft draft;
    size_t corner_capacity;
    numbers corners, coordinates; /* of the current face */
    float *uvs;                   /* two per corner; NULL: none */
    bool has_colors;
    bool at_end; /* whether a file ended with fewer faces than it announces */
    base_error *error;
} ply_reader;

static bool fail(const ply_reader *r, const char *wrong) {
    return base_fail(r->error, r->draft.subject, "is not valid PLY: it %s", wrong);
}

static bool fail_memory(const ply_reader *r) {
    return base_fail(r->error, r->draft.subject, "does not fit into memory");
}

/* --- numbers ---------------------------------------------------------------------------------- */

static bool is_blank(unsigned char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

static bool read_word(ply_reader *r, double *number) {
    char word[64], *end;
    size_t length = 0;
    while (r->at < r->end && is_blank(*r->at))
        r->at++;
    for (; r->at < r->end && !is_blank(*r->at) && length + 1 < sizeof word; r->at++)
        word[length++] = (char)*r->at;
    word[length] = 0;
    *number = strtod(word, &end);
    return (length > 0 && !*end) || fail(r, length > 0 ? "has a word where a number belongs"
                                                       : "ends before its elements do");
}

/* Ends a text element: the rest of its line is skipped, as in other readers, because exporters
 * write more than they declare. */
static void end_row(ply_reader *r) {
    while (r->header.ascii && r->at < r->end && *r->at != '\n' && *r->at != '\r')
        r->at++;
}

static bool read_number(ply_reader *r, ply_type type, double *number) {
    const size_t size = ply_type_size(type);
    if (r->header.ascii)
        return read_word(r, number);
    if ((size_t)(r->end - r->at) < size)
        return fail(r, "ends before its elements do");
    uint64_t bits = 0;
    for (size_t i = 0; i < size; i++)
        bits |= (uint64_t)r->at[r->header.big_endian ? size - 1 - i : i] << 8 * i;
    r->at += size;
    const uint32_t low = (uint32_t)bits;
    float single;
    memcpy(&single, &low, sizeof single);
    switch (type) {
    case PLY_INT8:
        *number = (int8_t)bits;
        break;
    case PLY_INT16:
        *number = (int16_t)bits;
        break;
    case PLY_INT32:
        *number = (int32_t)low;
        break;
    case PLY_FLOAT:
        *number = (double)single;
        break;
    case PLY_DOUBLE:
        memcpy(number, &bits, sizeof *number);
        break;
    default:
        *number = (double)bits;
    }
    return true;
}

/* Reads a list of numbers, no longer than the file. */
static bool read_list(ply_reader *r, const ply_property *p, numbers *list) {
    double count;
    if (!read_number(r, p->count_type, &count))
        return false;
    if (!(count >= 0.0 && count <= (double)(r->end - r->at)))
        return fail(r, "has a list that is longer than the file");
    list->count = (size_t)count;
    if (list->count > list->capacity) {
        double *const items = realloc(list->items, list->count * sizeof *items);
        if (!items)
            return fail_memory(r);
        list->items = items;
        list->capacity = list->count;
    }
    for (size_t i = 0; i < list->count; i++)
        if (!read_number(r, p->type, &list->items[i]))
            return false;
    return true;
}

/* --- vertices --------------------------------------------------------------------------------- */

/* Converts a stored channel to a linear color; the full value is 1, or the largest integer of the
 * type. */
static uint16_t as_color(double number, ply_type type) {
    const double full = type >= PLY_FLOAT ? 1.0 : type == PLY_UINT8 ? 255.0 : 65535.0;
    return mesh_color_from_srgb(number / full);
}

static void set_property(ply_reader *r, const ply_property *p, double number, scene_vertex *v) {
    const double *const origin = r->builder->origin;
    const float single = isfinite((float)number) ? (float)number : 0.0f;
    if (p->role <= PLY_Z)
        v->position[p->role] =
            origin[p->role] != 0.0 ? scene_from_world(origin[p->role], number) : (float)number;
    else if (p->role <= PLY_NZ)
        v->normal[p->role - PLY_NX] = single;
    else if (p->role <= PLY_V)
        v->uv[0][p->role - PLY_U] = p->role == PLY_V ? 1.0f - single : single;
    else if (p->role <= PLY_BLUE)
        v->color[p->role - PLY_RED] = as_color(number, p->type);
}

static bool read_vertex(ply_reader *r, const ply_element *e, scene_vertex *v) {
    numbers skipped = { NULL, 0, 0 };
    bool ok = true;
    v->color[3] = 65535;
    for (size_t i = 0; ok && i < e->property_count; i++) {
        const ply_property *const p = &r->header.properties[e->first_property + i];
        double number = 0.0;
        ok = p->is_list ? read_list(r, p, &skipped) : read_number(r, p->type, &number);
        if (ok && !p->is_list && p->role < PLY_CORNERS)
            set_property(r, p, number, v);
    }
    free(skipped.items);
    vec_store(vec_normalize(vec_load(v->normal), vec(0.0f, 0.0f, 0.0f)), v->normal);
    return ok;
}

static bool read_vertices(ply_reader *r, const ply_element *e) {
    if (e->count > (size_t)(r->end - r->at) || e->count >= UINT32_MAX)
        return fail(r, "has more vertices than bytes");
    for (size_t i = 0; i < e->property_count; i++) {
        const ply_role role = r->header.properties[e->first_property + i].role;
        r->draft.has_normals |= role == PLY_NX;
        r->has_colors |= role == PLY_RED;
    }
    r->draft.vertices = calloc(e->count + 1, sizeof *r->draft.vertices);
    if (!r->draft.vertices)
        return fail_memory(r);
    r->draft.vertex_count = e->count;
    for (size_t i = 0; i < e->count; i++) {
        if (!read_vertex(r, e, &r->draft.vertices[i]))
            return false;
        end_row(r);
    }
    return true;
}

/* --- faces ------------------------------------------------------------------------------------ */

/* Makes room for that many more corners. */
static bool reserve(ply_reader *r, size_t more) {
    mesh_draft *const d = &r->draft;
    if (d->corner_count + more <= r->corner_capacity)
        return true;
    const size_t capacity = 2 * (d->corner_count + more) + 1024;
    uint32_t *const corners = realloc(d->corners, capacity * sizeof *corners);
    if (!corners)
        return fail_memory(r);
    d->corners = corners;
    float *const uvs = realloc(r->uvs, 2 * capacity * sizeof *uvs);
    if (!uvs)
        return fail_memory(r);
    r->uvs = uvs;
    r->corner_capacity = capacity;
    return true;
}

/* Appends a triangle of three of the list's corners. */
static bool add_triangle(ply_reader *r, const size_t of[3]) {
    mesh_draft *const d = &r->draft;
    for (int k = 0; k < 3; k++) {
        const double index = r->corners.items[of[k]];
        if (!(index >= 0.0 && index < (double)d->vertex_count))
            return fail(r, "has a face with a vertex that does not exist");
        const size_t at = d->corner_count + (size_t)k;
        d->corners[at] = (uint32_t)index;
        for (size_t i = 0; i < 2; i++) {
            const size_t coordinate = 2 * of[k] + i;
            const float given =
                coordinate < r->coordinates.count ? (float)r->coordinates.items[coordinate] : 0.0f;
            r->uvs[2 * at + i] = isfinite(given) ? given : 0.0f;
        }
    }
    d->corner_count += 3;
    return true;
}

static bool add_polygon(ply_reader *r) {
    if (r->corners.count < 3)
        return true;
    if (!reserve(r, 3 * r->corners.count))
        return false;
    for (size_t i = 2; i < r->corners.count; i++)
        if (!add_triangle(r, (const size_t[]) { 0, i - 1, i }))
            return false;
    return true;
}

/* Appends triangle strips, separated by -1; every second triangle is reversed. */
static bool add_strips(ply_reader *r) {
    const double *const c = r->corners.items;
    size_t run = 0;
    if (!reserve(r, 3 * r->corners.count))
        return false;
    for (size_t i = 0; i < r->corners.count; i++) {
        run = c[i] < 0.0 ? 0 : run + 1;
        if (run < 3 || c[i] == c[i - 1] || c[i] == c[i - 2] || c[i - 1] == c[i - 2])
            continue;
        const bool odd = run % 2 == 0;
        if (!add_triangle(r, (const size_t[]) { i - 2, odd ? i : i - 1, odd ? i - 1 : i }))
            return false;
    }
    return true;
}

static bool read_row(ply_reader *r, const ply_element *e) {
    r->corners.count = r->coordinates.count = 0;
    for (size_t i = 0; i < e->property_count; i++) {
        const ply_property *const p = &r->header.properties[e->first_property + i];
        numbers skipped = { NULL, 0, 0 };
        double number;
        const bool ok = !p->is_list ? read_number(r, p->type, &number)
                                    : read_list(r, p,
                                                p->role == PLY_CORNERS          ? &r->corners
                                                : p->role == PLY_CORNERS_COORDS ? &r->coordinates
                                                                                : &skipped);
        free(skipped.items);
        if (!ok)
            return false;
    }
    end_row(r);
    return e->kind == PLY_STRIPS ? add_strips(r) : e->kind != PLY_FACES || add_polygon(r);
}

static bool read_rows(ply_reader *r, const ply_element *e) {
    const double size = (double)(r->end - r->at) + 1.0;
    const unsigned char *const start = r->at;
    for (size_t i = 0; e->property_count > 0 && i < e->count; i++) {
        if (i % 65536 == 0)
            sandbox_progress((double)(r->at - start) / size);
        while (r->header.ascii && r->at < r->end && is_blank(*r->at))
            r->at++;
        if (r->at == r->end && e->kind == PLY_FACES) {
            builder_unsupported(r->builder, NULL, "missing face", e->count - i);
            r->at_end = true;
            return true;
        }
        if (!read_row(r, e))
            return false;
    }
    return true;
}

static bool read_elements(ply_reader *r) {
    for (size_t i = 0; i < r->header.element_count && !r->at_end; i++) {
        const ply_element *const e = &r->header.elements[i];
        if (!(e->kind == PLY_VERTICES ? read_vertices(r, e) : read_rows(r, e)))
            return false;
    }
    return true;
}

/* --- into the scene --------------------------------------------------------------------------- */

static bool has_face_coordinates(const ply_header *h) {
    for (size_t i = 0; i < h->property_count; i++)
        if (h->properties[i].role == PLY_CORNERS_COORDS)
            return true;
    return false;
}

/* Gives corners their own texture coordinates. */
static bool place_coordinates(ply_reader *r) {
    mesh_draft *const d = &r->draft;
    if (!mesh_split_corners(d, r->error))
        return false;
    for (size_t i = 0; i < d->corner_count; i++) {
        d->vertices[i].uv[0][0] = r->uvs[2 * i];
        d->vertices[i].uv[0][1] = 1.0f - r->uvs[2 * i + 1];
    }
    d->weld = true;
    return true;
}

static bool add_material(ply_reader *r, source_set *sources) {
    texture_files files = { .sources = sources, .images.builder = r->builder };
    scene_material *const material = builder_material(r->builder, "DefaultMaterial");
    if (!material)
        return fail_memory(r);
    material->flags |= SCENE_DOUBLE_SIDED | SCENE_SIDES_UNSAID;
    const bool ok = !r->header.texture[0] ||
                    texture_file_use(&files, r->header.texture, 1, SCENE_WRAP_REPEAT,
                                     SCENE_WRAP_REPEAT, &material->base_color_map, r->error);
    free(files.images.items);
    const bool textured = material->base_color_map.texture >= 0;
    if (r->has_colors && !textured)
        material->flags |= SCENE_VERTEX_COLORS;
    for (int k = 0; k < 3 && !textured && !r->has_colors; k++)
        material->base_color[k] = 0.6f;
    return ok;
}

static bool add_all(ply_reader *r, source_set *sources) {
    if (!read_elements(r))
        return false;
    if (r->draft.corner_count == 0)
        return base_fail(r->error, r->draft.subject, "has no triangles%s",
                         r->draft.vertex_count > 0 ? ", only points" : "");
    if ((has_face_coordinates(&r->header) && !place_coordinates(r)) ||
        !mesh_add(&r->draft, r->builder, r->error) || !add_material(r, sources))
        return false;
    builder_instances(r->builder, 0);
    return r->draft.sided || sides_turn_outwards(r->builder, (const uint32_t[]) { 0 }, 1) ||
           fail_memory(r);
}

bool ply_add(const void *data, size_t size, source_set *sources, scene_builder *builder,
             base_error *error) {
    ply_reader r = { .builder = builder,
                     .end = (const unsigned char *)data + size,
                     .draft = { .subject = sources->subject,
                                .name = "defaultobject",
                                .unsided = true,
                                .crease_cos = MESH_CREASE_60 },
                     .error = error };
    const bool ok = ply_header_parse(data, size, sources->subject, &r.header, error);
    r.at = (const unsigned char *)data + r.header.size;
    const bool added = ok && add_all(&r, sources);
    mesh_free(&r.draft);
    free(r.corners.items);
    free(r.coordinates.items);
    free(r.uvs);
    return added;
}
