/* SPDX-License-Identifier: MIT */
/* volume.h - an irradiance volume: light probes at the nodes of a grid, in the form that engines
 * use. docs/probes.md tells which engine expects what. */
#ifndef LAMPION_STUDY_VOLUME_H
#define LAMPION_STUDY_VOLUME_H

#include "app/scene/environment.h"

#include <lampion/field.h>
#include <lampion/probe.h>

/* Nodes of the grid along the scene's axes; the first and the last are relative to its origin. */
typedef struct volume_grid {
    int counts[3]; /* 2 … LMP_FIELD_NODES_MAX each */
    float minimum[3], maximum[3];
} volume_grid;
#define VOLUME_RAYS_MAX   4096
#define VOLUME_PROBES_MAX 16777216

/* Returns the names of the presets: the library's own coefficients with any bands, or an engine's
 * format. */
const char *const *volume_presets(void);
#define VOLUME_OWN 0 /* "lampion" */

typedef struct volume_settings {
    volume_grid grid;
    int bands; /* 1 … LMP_FIELD_BANDS_MAX; 3 for an engine's preset */
    int preset;
    bool dering; /* damp a probe's bands until its irradiance is nowhere below 0 */
    int rays;    /* to each light, to find whether surfaces block it; 0: nothing blocks light */
    int bounces; /* of light on surfaces before it arrives; 0: direct light alone */
} volume_settings;

/* The values of the probes, `value_count` for node i + counts[0] * (j + counts[1] * k). */
typedef struct volume {
    volume_settings settings;
    const lmp_probe_format *format;
    double origin[3]; /* of the scene, in the preset's world */
    size_t probe_count, value_count;
    float *values;
} volume;

/* Computes the light of the scene's lights and of its environment, which need not shine, at every
 * node. The environment has as many bands, and at least 3 if light bounces. */
bool volume_make(const scene *scene, const environment *surroundings,
                 const volume_settings *settings, volume *volume, base_error *error);
void volume_free(volume *volume);

/* Return the node of a probe, its position in the preset's world relative to the origin there, and
 * the step between nodes along an axis of the grid. */
void volume_node(const volume *volume, size_t probe, int node[3]);
void volume_position(const volume *volume, const int node[3], float position[3]);
void volume_step(const volume *volume, int axis, float step[3]);

/* Names value i of a probe, such as "r0". */
typedef char volume_name[24];
void volume_name_value(const volume *volume, size_t i, volume_name name);

/* Makes the same grid as a field of the library, whatever the preset. A field is in float32, so it
 * stays relative to the scene's origin. */
bool volume_make_field(const scene *scene, const volume_settings *settings, lmp_field **field,
                       base_error *error);

/* --- files ------------------------------------------------------------------------------------ */

typedef enum volume_file {
    VOLUME_JSON,
    VOLUME_CSV,
    VOLUME_NPY,
    VOLUME_LMPF,
    VOLUME_UNKNOWN
} volume_file;

/* Returns the kind of a file by its extension. */
volume_file volume_file_of(const char *path);

/* Order of values: probe after probe, or value after value, a grid for each. */
enum { VOLUME_INTERLEAVED, VOLUME_PLANAR };
extern const char *const volume_layouts[];

typedef struct volume_output {
    const char *path;
    int layout; /* of a table: VOLUME_INTERLEAVED or VOLUME_PLANAR */
    bool half;  /* round values to what 16 bits can represent */
} volume_output;

/* Writes JSON, CSV or NPY; fails if a value is too large for 16 bits. */
bool volume_write(const volume *volume, const volume_output *output, base_error *error);
bool volume_write_field(const lmp_field *field, const char *path, base_error *error);

/* The properties of a .lmpf, which is read in a sandbox. */
typedef struct volume_facts {
    lmp_field_info info;
    size_t of_kind[SCENE_LIGHT_KIND_COUNT]; /* number of lights */
    size_t bytes;                           /* of the file */
} volume_facts;
bool volume_describe_field(const char *path, volume_facts *facts, base_error *error);

#endif
