/* SPDX-License-Identifier: MIT */
/* data.h - what the figures show: the paper's scenes and materials where the reader's folders have
 * them (docs/paper.md), else what stands in for them. */
#ifndef LAMPION_PAPER_DATA_H
#define LAMPION_PAPER_DATA_H

#include "app/scene/scene.h"

/* Lights as the file that lies beside the scene has them, else its own or random ones. */
typedef struct paper_scene {
    const char *name;   /* "San Miguel", or that of the built-in scene */
    const char *credit; /* who made it, as the page shows it; "" for a built-in scene */
    bool real;          /* the paper's */
    char file[1024];    /* for scene_load */
    char lights[1024];  /* "": none */
    int random_lights;  /* without such a file */
    bool hide_lights;
    char words[10240];         /* scene and lights in a command line, all lights to be seen */
    scene_camera_options view; /* zero: the scene's first camera */
    const char *camera;        /* view and hide_lights in a command line */
    const char *overview;      /* a camera farther away, which sees the lights */
} paper_scene;

typedef enum paper_source { PAPER_MEASURED, PAPER_FIT, PAPER_STAND_IN } paper_source;

/* A material of figure 6: a file of the RGL database, NAME_rgb.bsdf; a fit to it, NAME.binary;
 * or one of the program's own that looks like it. */
typedef struct paper_material {
    const char *letter, *name; /* the paper's */
    paper_source source;
    char value[1100]; /* for --material: test_material=… */
    char word[4500];  /* the same in a command line */
    char label[96];   /* what the page calls it, and that it is a fit where it is one */
} paper_material;

enum { PAPER_MATERIALS = 5 };

typedef struct paper_data {
    paper_scene san_miguel, sponza, ball;
    paper_material materials[PAPER_MATERIALS];
} paper_data;

/* Looks in each folder and in the folder data there. False if one of them cannot be looked into, or
 * a name is too long. */
bool paper_data_find(const cli_list *folders, paper_data *data, cli_error *error);

/* What the materials from first to last are, and on what ball: at most 128 bytes. */
void paper_name_materials(const paper_data *data, int first, int last, char *names, size_t size);

/* The scene with its lights. */
bool paper_scene_load(const paper_scene *from, scene *world, cli_error *error);

/* Writes one word of a command line, quoted if a shell would see more in it. False if it is too
 * long. */
bool paper_quote(const char *text, char *word, size_t size);

#endif
