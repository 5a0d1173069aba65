/* SPDX-License-Identifier: MIT */
/* ply_header.h - the header of a PLY file, which describes its elements. */
#ifndef LAMPION_SCENE_LOAD_PLY_HEADER_H
#define LAMPION_SCENE_LOAD_PLY_HEADER_H

#include "app/scene/scene.h"

enum { PLY_ELEMENTS_MAX = 16, PLY_PROPERTIES_MAX = 128, PLY_PATH_SIZE = 256 };

typedef enum ply_type {
    PLY_INT8,
    PLY_UINT8,
    PLY_INT16,
    PLY_UINT16,
    PLY_INT32,
    PLY_UINT32,
    PLY_FLOAT,
    PLY_DOUBLE,
    PLY_TYPES
} ply_type;

/* The meaning of a property, if it is used. */
typedef enum ply_role {
    PLY_X, /* x, y and z of each vector are consecutive */
    PLY_Y,
    PLY_Z,
    PLY_NX,
    PLY_NY,
    PLY_NZ,
    PLY_U,
    PLY_V,
    PLY_RED,
    PLY_GREEN,
    PLY_BLUE,
    PLY_CORNERS,        /* a list: a polygon, or strips */
    PLY_CORNERS_COORDS, /* a list: u and v of each corner */
    PLY_OTHER
} ply_role;

typedef struct ply_property {
    ply_type type;
    ply_type count_type; /* of a list */
    bool is_list;
    ply_role role;
} ply_property;

typedef enum ply_kind { PLY_VERTICES, PLY_FACES, PLY_STRIPS, PLY_SKIPPED } ply_kind;

typedef struct ply_element {
    ply_kind kind;
    size_t count;
    size_t first_property, property_count;
} ply_element;

typedef struct ply_header {
    bool ascii, big_endian;
    ply_element elements[PLY_ELEMENTS_MAX];
    size_t element_count;
    ply_property properties[PLY_PROPERTIES_MAX];
    size_t property_count;
    char texture[PLY_PATH_SIZE]; /* "": none */
    size_t size;                 /* of the header */
} ply_header;

/* Returns the bytes of a number. */
size_t ply_type_size(ply_type type);

bool ply_header_parse(const char *text, size_t size, const char *subject, ply_header *header,
                      base_error *error);

#endif
