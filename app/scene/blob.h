/* SPDX-License-Identifier: MIT */
/* blob.h - a scene as one flat relocatable block: header, then arrays at offsets. The importing
 * child returns it, and the cache stores it; it is validated before use. */
#ifndef LAMPION_SCENE_BLOB_H
#define LAMPION_SCENE_BLOB_H

#include "app/base/error.h"
#include "app/base/file_hash.h"
#include "app/scene/scene.h"

#define BLOB_MAGIC   "LAMPSCN"
#define BLOB_VERSION 23u /* raise with any change of the layout or of what the importer makes */

typedef enum blob_section {
    BLOB_VERTICES,
    BLOB_INDICES,
    BLOB_MESHES,
    BLOB_INSTANCES,
    BLOB_NODES,
    BLOB_NAMES,
    BLOB_MATERIALS,
    BLOB_VARIANTS,
    BLOB_TEXTURES,
    BLOB_IMAGES,
    BLOB_ENCODED,
    BLOB_TEXELS, /* of scenes made in code, which have no encoded images */
    BLOB_CAMERAS,
    BLOB_LIGHTS,
    BLOB_MOTIONS,
    BLOB_OFFSETS,
    BLOB_UNSUPPORTED,
    BLOB_SOURCES,
    BLOB_SECTIONS
} blob_section;

/* A file that the scene was made from, for the cache; the scene file itself is not listed. */
#define BLOB_SOURCES_MAX   4096
#define BLOB_SOURCE_ABSENT UINT64_MAX /* the size of a file that could not be read */
typedef struct blob_source {
    char path[512]; /* relative to the scene's folder */
    uint64_t size;
    file_hash hash;
} blob_source;

typedef struct blob_header {
    char magic[8];
    uint32_t version, item_sizes; /* item_sizes: a digest of the structs' sizes */
    uint64_t size;                /* of the whole blob */
    file_hash content;            /* of all that follows the header; zero if not computed */
    double origin[3];             /* of the scene, in the world */
    uint32_t up, reserved;        /* up: the axis of the file that became y */
    struct {
        uint64_t offset, count;
    } sections[BLOB_SECTIONS];
} blob_header;

/* The size of one item of each section. */
extern const size_t blob_item_size[BLOB_SECTIONS];

/* Fills in the header of a blob with these numbers of items: offsets laid out, aligned to 16
 * bytes. */
void blob_layout(blob_header *header, const size_t counts[BLOB_SECTIONS]);

/* Returns the array of a section of a blob whose header has been validated. */
const void *blob_items(const void *block, blob_section section);

/* Returns where the texels of an image begin, at the start of a page, if the image before ends at
 * `end`. Images may then be decoded to pages of their own. */
#define BLOB_PAGE 4096
uint64_t blob_first_texel(uint64_t end);

/* Finds the bounds of the vertices of count > 0 indices. */
void blob_bounds(const scene_vertex *vertices, const uint32_t *indices, size_t count,
                 float minimum[3], float maximum[3]);

/* Points *scene at the geometry of a block whose header has been validated; zeroes the rest. */
void blob_geometry(const void *block, scene *scene);

/* Checks every offset, count, index, number, bound and name of the blob, and its content hash if
 * `checksum`. `subject` is named in the error. */
bool blob_validate(const void *block, size_t size, bool checksum, const char *subject,
                   base_error *error);

/* Points *scene into a validated block and copies its lights; computes bounds and area. */
bool blob_open(void *block, size_t size, const char *subject, scene *scene, base_error *error);

#endif
