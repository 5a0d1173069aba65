/* SPDX-License-Identifier: MIT */
/* gltf_schema_words.h - the struct of a schema's fields, and macros to write its tables with. */
#ifndef LAMPION_SCENE_GLTF_GLTF_SCHEMA_WORDS_H
#define LAMPION_SCENE_GLTF_GLTF_SCHEMA_WORDS_H

#include "app/scene/gltf/gltf.h"

#include <math.h>

typedef enum gltf_type {
    GLTF_TYPE_NUMBER,
    GLTF_TYPE_INTEGER,
    GLTF_TYPE_TEXT,
    GLTF_TYPE_FLAG,
    GLTF_TYPE_OBJECT,
    GLTF_TYPE_REFERENCE,  /* the index of an item of `kind` */
    GLTF_TYPE_REFERENCES, /* an object: any names, each with the index of an item of `kind` */
} gltf_type;

/* One field, or each entry of an array; zero is the default. */
typedef struct gltf_field {
    const char *name; /* NULL ends the table */
    gltf_type type;
    bool required;
    bool array;
    size_t least, most;      /* entries of the array; most 0: any number */
    bool distinct;           /* no entry occurs twice */
    double minimum, maximum; /* of numbers and integers; both 0: any */
    bool above;              /* the minimum itself is excluded */
    const char *choices;     /* the allowed values, with a space before and after each */
    bool forgiven;           /* any other choice is treated as absent */
    gltf_kind kind;
    const struct gltf_object *object;
} gltf_field;

typedef struct gltf_object {
    const char *noun; /* for notes of unsupported features */
    const gltf_field *fields;
    const gltf_field *extensions; /* the supported ones; NULL: none */
} gltf_object;

#define END                                                                                        \
    { .name = NULL }
#define TEXT .type = GLTF_TYPE_TEXT
#define FLAG .type = GLTF_TYPE_FLAG
#define NAME                                                                                       \
    { .name = "name", TEXT }
#define COUNT                  .type = GLTF_TYPE_INTEGER, .maximum = 9007199254740991.0 /* 2^53 - 1 */
#define UNIT                   .maximum = 1.0
#define POSITIVE               .maximum = HUGE_VAL, .above = true
#define NOT_NEGATIVE           .maximum = HUGE_VAL
#define CHOICE(values)         .choices = " " values " "
#define REFERENCE(of)          .type = GLTF_TYPE_REFERENCE, .kind = (of)
#define OBJECT(of)             .type = GLTF_TYPE_OBJECT, .object = &(of)
#define LIST_OF(of)            .array = true, OBJECT(of)
#define VECTOR(n)              .array = true, .least = (n), .most = (n)
#define FORGIVEN               .forgiven = true
#define INTEGER_CHOICE(values) .type = GLTF_TYPE_INTEGER, CHOICE(values)

#endif
