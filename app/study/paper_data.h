/* SPDX-License-Identifier: MIT */
/* paper_data.h - the scenes and materials of the figures: the paper's where the reader's folders
 * have them (docs/paper.md), else stand-ins. */
#ifndef LAMPION_STUDY_PAPER_DATA_H
#define LAMPION_STUDY_PAPER_DATA_H

#include "app/base/cli.h"
#include "app/scene/scene.h"

/* A scene of a figure. Its lights come from the file that lies beside it, else from the scene, or
 * are random. */
typedef struct paper_scene {
    const char *name;   /* "San Miguel", or that of the built-in scene */
    const char *credit; /* author, as the page shows it; "" for a built-in scene */
    bool real;          /* whether it is the paper's */
    char file[1024];    /* for scene_load */
    char lights[1024];  /* a file; "": none */
    int random_lights;  /* number of random lights without such a file */
    bool hide_lights;
    char words[10240];         /* scene and lights in a command line, with all lights visible */
    scene_camera_options view; /* zero: the scene's first camera */
    const char *camera;        /* view and hide_lights in a command line */
    const char *overview;      /* a camera farther away, from which the lights are visible */
} paper_scene;

typedef enum paper_source { PAPER_MEASURED, PAPER_FIT, PAPER_STAND_IN } paper_source;

/* A material of figure 6: a file of the RGL database, NAME_rgb.bsdf; a fit to it, NAME.binary; or a
 * similar one of the program's own. */
typedef struct paper_material {
    const char *letter, *name; /* in the paper */
    paper_source source;
    char value[1100]; /* for --material: test_material=… */
    char word[4500];  /* value as a word of a command line */
    char label[96];   /* its name on the page, which tells whether it is a fit */
} paper_material;

enum { PAPER_MATERIALS = 5 };

typedef struct paper_data {
    paper_scene san_miguel, sponza, ball;
    paper_material materials[PAPER_MATERIALS];
} paper_data;

/* Looks in each folder and in its subfolder data. Returns false if a folder cannot be read or a
 * name is too long. */
bool paper_data_find(const cli_list *folders, paper_data *data, base_error *error);

/* Names the materials from first to last and their ball, in at most 128 bytes. */
void paper_name_materials(const paper_data *data, int first, int last, char *names, size_t size);

/* Loads the scene with its lights. */
bool paper_scene_load(const paper_scene *from, scene *world, base_error *error);

/* Writes one word of a command line, quoted if a shell would interpret it. Returns false if it is
 * too long. */
bool paper_quote(const char *text, char *word, size_t size);

#endif
