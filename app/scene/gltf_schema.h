/* SPDX-License-Identifier: MIT */
/* gltf_schema.h - what glTF's schema says of the fields of its objects, as tables. */
#ifndef LAMPION_SCENE_GLTF_SCHEMA_H
#define LAMPION_SCENE_GLTF_SCHEMA_H

#include "app/scene/gltf.h"

typedef enum gltf_type {
    GLTF_TYPE_NUMBER,
    GLTF_TYPE_INTEGER,
    GLTF_TYPE_TEXT,
    GLTF_TYPE_FLAG,
    GLTF_TYPE_OBJECT,
    GLTF_TYPE_REFERENCE,  /* the index of an item of `kind` */
    GLTF_TYPE_REFERENCES, /* an object: any names, each with the index of an item of `kind` */
} gltf_type;

/* One field, or each entry of an array. Zero is the default. */
typedef struct gltf_field {
    const char *name; /* NULL ends the table */
    gltf_type type;
    bool required;
    bool array;
    size_t least, most;      /* entries of the array; most 0: any number */
    bool distinct;           /* no entry is there twice */
    double minimum, maximum; /* of numbers and integers; both 0: any */
    bool above;              /* the minimum itself is none */
    const char *choices;     /* the only values, with a space before and after each */
    bool forgiven;           /* another choice counts as if the field were not there */
    gltf_kind kind;
    const struct gltf_object *object;
} gltf_field;

typedef struct gltf_object {
    const char *noun; /* for what is left out of it */
    const gltf_field *fields;
    const gltf_field *extensions; /* those that are read; NULL: none */
} gltf_object;

/* The document itself. */
extern const gltf_object gltf_schema;

#endif
