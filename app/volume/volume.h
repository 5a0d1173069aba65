/* SPDX-License-Identifier: MIT */
/* volume.h - an irradiance volume: light probes at the nodes of a grid, as an engine keeps them.
 * docs/probes.md tells which engine wants what. */
#ifndef LAMPION_VOLUME_H
#define LAMPION_VOLUME_H

#include "app/environment/environment.h"

#include <lampion/field.h>
#include <lampion/probe.h>

/* Nodes of the grid along the scene's axes, the first and the last of them relative to its origin.
 */
typedef struct volume_grid {
    int counts[3]; /* 2 … LMP_FIELD_NODES_MAX each */
    float minimum[3], maximum[3];
} volume_grid;
#define VOLUME_RAYS_MAX   4096
#define VOLUME_PROBES_MAX 16777216

/* What a preset keeps: the library's own coefficients of any bands, or those of an engine. */
const char *const *volume_presets(void);
#define VOLUME_OWN 0 /* "lampion" */

typedef struct volume_settings {
    volume_grid grid;
    int bands; /* 1 … LMP_FIELD_BANDS_MAX; 3 of an engine's preset */
    int preset;
    bool dering; /* damp a probe's bands as far as its irradiance would fall below 0 */
    int rays;    /* to each light, by which the scene's surfaces hide it; 0: none does */
} volume_settings;

/* What is read at node i + counts[0] * (j + counts[1] * k): `value_count` values. */
typedef struct volume {
    volume_settings settings;
    const lmp_probe_format *format;
    double origin[3]; /* of the scene, in the world of the preset */
    size_t probe_count, value_count;
    float *values;
} volume;

/* The light of the scene's lights and its environment, which may shine or not, at every node. */
bool volume_make(const scene *scene, const environment *surroundings,
                 const volume_settings *settings, volume *volume, cli_error *error);
void volume_free(volume *volume);

/* The node of a probe, where it is in the world of the preset relative to the origin there, and
 * from a node to the next along an axis of the grid. */
void volume_node(const volume *volume, size_t probe, int node[3]);
void volume_position(const volume *volume, const int node[3], float position[3]);
void volume_step(const volume *volume, int axis, float step[3]);

/* "r0": value i of a probe. */
typedef char volume_name[24];
void volume_name_value(const volume *volume, size_t i, volume_name name);

/* The same grid with the scene's lights as a field of the library, whatever the preset says. A
 * field is in float32: it stays relative to the scene's origin. */
bool volume_make_field(const scene *scene, const volume_settings *settings, lmp_field **field,
                       cli_error *error);

/* --- files ------------------------------------------------------------------------------------ */

typedef enum volume_file {
    VOLUME_JSON,
    VOLUME_CSV,
    VOLUME_NPY,
    VOLUME_LMPF,
    VOLUME_UNKNOWN
} volume_file;

/* By the ending of its name. */
volume_file volume_file_of(const char *path);

/* Probe after probe, or value after value: a grid of each. */
enum { VOLUME_INTERLEAVED, VOLUME_PLANAR };
extern const char *const volume_layouts[];

typedef struct volume_output {
    const char *path;
    int layout; /* of a table: probe after probe */
    bool half;  /* values are rounded to what 16 bits hold */
} volume_output;

/* Writes JSON, CSV or NPY; fails where a value is too large for 16 bits. */
bool volume_write(const volume *volume, const volume_output *output, cli_error *error);
bool volume_write_field(const lmp_field *field, const char *path, cli_error *error);

/* What a .lmpf holds; it is read in a sandbox. */
typedef struct volume_facts {
    lmp_field_info info;
    size_t of_kind[LMP_LIGHT_KINDS]; /* lights */
    size_t bytes;                    /* of the file */
} volume_facts;
bool volume_describe_field(const char *path, volume_facts *facts, cli_error *error);

#endif
