/* SPDX-License-Identifier: MIT */
#include "app/scene/load/ply_header.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define LINE_MAX_LENGTH 1024

typedef struct header_reader {
    const char *at, *end;
    size_t line;
    char words[LINE_MAX_LENGTH]; /* the current line */
    char *rest;
    const char *subject;
    ply_header *header;
    base_error *error;
} header_reader;

static bool fail(const header_reader *r, const char *wrong) {
    return base_fail(r->error, r->subject, "is not valid PLY: line %zu %s", r->line, wrong);
}

/* Reads a line, which ends with a line feed, a carriage return, or both in that order. */
static bool next_line(header_reader *r) {
    size_t length = 0;
    r->line++;
    while (r->at + length < r->end && r->at[length] != '\n' && r->at[length] != '\r')
        length++;
    if (r->at + length == r->end || length >= sizeof r->words)
        return fail(r, "does not end, before the header does");
    memcpy(r->words, r->at, length);
    r->words[length] = 0;
    r->rest = r->words;
    r->at +=
        length +
        (r->at[length] == '\r' && r->at + length + 1 < r->end && r->at[length + 1] == '\n' ? 2 : 1);
    return true;
}

static char *next_word(header_reader *r) {
    char *const word = r->rest + strspn(r->rest, " \t");
    r->rest = word + strcspn(word, " \t");
    if (*r->rest)
        *r->rest++ = 0;
    return word;
}

/* --- properties ------------------------------------------------------------------------------- */

size_t ply_type_size(ply_type type) {
    static const size_t sizes[PLY_TYPES] = { 1, 1, 2, 2, 4, 4, 4, 8 };
    return sizes[type];
}

static bool read_type(header_reader *r, ply_type *type) {
    static const char *const names[PLY_TYPES][2] = {
        { "char", "int8" }, { "uchar", "uint8" }, { "short", "int16" },   { "ushort", "uint16" },
        { "int", "int32" }, { "uint", "uint32" }, { "float", "float32" }, { "double", "float64" }
    };
    const char *const word = next_word(r);
    for (int i = 0; i < PLY_TYPES; i++)
        if (strcmp(word, names[i][0]) == 0 || strcmp(word, names[i][1]) == 0) {
            *type = (ply_type)i;
            return true;
        }
    return fail(r, "names an unknown type");
}

static ply_role role_of(ply_kind kind, bool is_list, const char *name) {
    static const struct {
        const char *name;
        ply_role role;
    } vertex[] = { { "x", PLY_X },
                   { "y", PLY_Y },
                   { "z", PLY_Z },
                   { "nx", PLY_NX },
                   { "ny", PLY_NY },
                   { "nz", PLY_NZ },
                   { "u", PLY_U },
                   { "v", PLY_V },
                   { "s", PLY_U },
                   { "t", PLY_V },
                   { "texture_u", PLY_U },
                   { "texture_v", PLY_V },
                   { "red", PLY_RED },
                   { "green", PLY_GREEN },
                   { "blue", PLY_BLUE },
                   { "r", PLY_RED },
                   { "g", PLY_GREEN },
                   { "b", PLY_BLUE },
                   { "diffuse_red", PLY_RED },
                   { "diffuse_green", PLY_GREEN },
                   { "diffuse_blue", PLY_BLUE } },
      face[] = { { "vertex_indices", PLY_CORNERS },
                 { "vertex_index", PLY_CORNERS },
                 { "texcoord", PLY_CORNERS_COORDS } };
    if (kind == PLY_VERTICES && !is_list)
        for (size_t i = 0; i < sizeof vertex / sizeof *vertex; i++)
            if (strcmp(name, vertex[i].name) == 0)
                return vertex[i].role;
    if ((kind == PLY_FACES || kind == PLY_STRIPS) && is_list)
        for (size_t i = 0; i < sizeof face / sizeof *face; i++)
            if (strcmp(name, face[i].name) == 0)
                return face[i].role;
    return PLY_OTHER;
}

static bool read_property(header_reader *r) {
    ply_header *const h = r->header;
    if (h->element_count == 0)
        return fail(r, "has a property of no element");
    if (h->property_count == PLY_PROPERTIES_MAX)
        return fail(r, "has one property too many");
    ply_property *const p = &h->properties[h->property_count];
    *p = (ply_property) { .is_list = strncmp(r->rest + strspn(r->rest, " \t"), "list", 4) == 0 };
    if (p->is_list) {
        next_word(r);
        if (!read_type(r, &p->count_type))
            return false;
        if (p->count_type >= PLY_FLOAT)
            return fail(r, "counts by no whole numbers");
    }
    if (!read_type(r, &p->type))
        return false;
    ply_element *const element = &h->elements[h->element_count - 1];
    p->role = role_of(element->kind, p->is_list, next_word(r));
    element->property_count++;
    h->property_count++;
    return true;
}

/* --- statements ------------------------------------------------------------------------------- */

static bool read_element(header_reader *r) {
    static const char *const kinds[] = { "vertex", "face", "tristrips" };
    ply_header *const h = r->header;
    if (h->element_count == PLY_ELEMENTS_MAX)
        return fail(r, "has one element too many");
    const char *const name = next_word(r), *const number = next_word(r);
    char *end;
    ply_element *const element = &h->elements[h->element_count++];
    *element = (ply_element) { .kind = PLY_SKIPPED, .first_property = h->property_count };
    for (int i = 0; i < PLY_SKIPPED; i++)
        if (strcmp(name, kinds[i]) == 0)
            element->kind = (ply_kind)i;
    for (size_t i = 0; i + 1 < h->element_count; i++)
        if (element->kind == PLY_VERTICES && h->elements[i].kind == PLY_VERTICES)
            return fail(r, "has vertices once more");
    if (!*number || number[strspn(number, "0123456789")] || strlen(number) > 18)
        return fail(r, "has no number of elements");
    element->count = strtoull(number, &end, 10);
    return true;
}

static bool read_format(header_reader *r) {
    const char *const word = next_word(r);
    r->header->ascii = strcmp(word, "ascii") == 0;
    r->header->big_endian = strcmp(word, "binary_big_endian") == 0;
    return r->header->ascii || r->header->big_endian || strcmp(word, "binary_little_endian") == 0 ||
           fail(r, "names an unknown format");
}

/* Reads the texture from a comment; the first of several is used. */
static void read_comment(header_reader *r) {
    if (strcmp(next_word(r), "TextureFile") != 0 || r->header->texture[0])
        return;
    const char *const name = r->rest + strspn(r->rest, " \t");
    size_t length = strlen(name);
    while (length > 0 && strchr(" \t", name[length - 1]))
        length--;
    snprintf(r->header->texture, sizeof r->header->texture, "%.*s", (int)length, name);
}

bool ply_header_parse(const char *text, size_t size, const char *subject, ply_header *header,
                      base_error *error) {
    header_reader r = {
        .at = text, .end = text + size, .subject = subject, .header = header, .error = error
    };
    bool formatted = false;
    *header = (ply_header) { .size = 0 };
    if (!next_line(&r))
        return false;
    if (strcmp(next_word(&r), "ply") != 0 && strcmp(r.words, "PLY") != 0)
        return base_fail(error, subject, "is not a PLY file: its first line is not \"ply\"");
    for (;;) {
        bool ok = next_line(&r);
        const char *const keyword = ok ? next_word(&r) : "";
        if (ok && strcmp(keyword, "end_header") == 0)
            break;
        if (strcmp(keyword, "format") == 0)
            formatted = ok = read_format(&r);
        else if (strcmp(keyword, "element") == 0)
            ok = read_element(&r);
        else if (strcmp(keyword, "property") == 0)
            ok = read_property(&r);
        else if (strcmp(keyword, "comment") == 0)
            read_comment(&r);
        if (!ok)
            return false;
    }
    header->size = (size_t)(r.at - text);
    return formatted || base_fail(error, subject, "is not valid PLY: it names no format");
}
