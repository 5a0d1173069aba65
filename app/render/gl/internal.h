/* SPDX-License-Identifier: MIT */
/* internal.h - what the files of this folder share. */
#ifndef LAMPION_GPU_INTERNAL_H
#define LAMPION_GPU_INTERNAL_H

#include "app/render/gl/gpu.h"
#include "shaders/shared.h"

#include <epoxy/gl.h>

/* --- crash.c ---------------------------------------------------------------------------------- */

/* Where the address space is limited, a crash of the driver becomes a line and an end: drivers do
 * not ask whether they were given the memory that they then use. */
void gpu_expect_crashes(void);

/* --- program.c: shaders ----------------------------------------------------------------------- */

typedef struct gpu_stage {
    GLenum type;
    const char *file;
} gpu_stage;

/* Compiles and links; `defines` is text put before every stage. 0 on failure. */
GLuint gpu_program(const gpu_stage *stages, int count, const char *defines, cli_error *error);

/* --- mesh.c: the scene's triangles, materials and textures ------------------------------------ */

/* As surface.vert reads it, once for all vertices of the instance. */
typedef struct gpu_instance {
    float world_from_mesh[3][4];
    GLuint number; /* among its mesh's, + SHARED_INSTANCE_MOVES */
} gpu_instance;

/* Bounds in the world. */
typedef struct gpu_box {
    float minimum[3], maximum[3];
} gpu_box;

/* A mesh, by all of its instances that mirror it or all that do not. */
typedef struct gpu_draw {
    GLuint first_index, index_count, material;
    bool mirrors;
    size_t first, count;     /* of instances */
    GLuint seen, first_seen; /* how many of them the frustum may hold, and the first's place */
} gpu_draw;

typedef struct gpu_material {
    GLuint maps[SHARED_MAPS], samplers[SHARED_MAPS]; /* of OpenGL; map 0 = none */
    bool double_sided, masked, layered;
    bool plain; /* none of these but the first, no maps and no colors of vertices */
} gpu_material;

typedef struct gpu_mesh {
    GLuint vertices, indices, vertex_array, material_blocks, reflectors;
    GLsizeiptr material_stride;
    gpu_instance *instances, *seen; /* draw by draw; those that are drawn */
    gpu_box *boxes;                 /* of the instances */
    size_t instance_count;
    GLuint seen_buffer;
    gpu_draw *draws; /* opaque ones first, then by material */
    size_t draw_count;
    gpu_material *materials;
    size_t material_count;
    GLuint *textures; /* of the scene's, which share those of OpenGL */
    GLsizei texture_count;
    GLuint samplers[SCENE_WRAPS * SCENE_WRAPS]; /* by wrap_u + SCENE_WRAPS * wrap_v */
    bool layered;                               /* some material is */
} gpu_mesh;

/* The variants of surface.frag. */
typedef struct gpu_surfaces {
    GLuint plain, opaque, masked, layered, layered_masked;
} gpu_surfaces;

bool gpu_mesh_create(const gpu_context *context, const scene *scene, gpu_mesh *mesh,
                     cli_error *error);
void gpu_mesh_destroy(gpu_mesh *mesh);

/* Has a material shaded by a table, or with -1 by itself. */
void gpu_mesh_set_table(const gpu_mesh *mesh, size_t material, int table);

/* Draws what the frustum of clip_from_world may hold. */
void gpu_mesh_draw(const gpu_mesh *mesh, const mat4 clip_from_world, const gpu_surfaces *programs);

/* --- what follows shares the renderer --------------------------------------------------------- */

/* Of all attachments (shared.h), those that only layered materials have come last. */
enum { GPU_ATTACHMENTS = 8, GPU_ATTACHMENTS_PLAIN = 5, GPU_VARIANTS = 64, GPU_TIMESTAMPS = 5 };

/* A compiled shading pass. */
typedef struct gpu_variant {
    method_kind method;
    int bands;
    lmp_window window;
    int tables;               /* summed by bands: 0 none, 1 mirrored ones, 2 any */
    bool preintegrated_brdfs; /* some tables are read preintegrated */
    int environment_bands;    /* of the one that tables reflect; 0: none */
    bool fibers;              /* another pass has drawn them */
    GLuint program;
} gpu_variant;

/* --- preintegrated_lobe.c --------------------------------------------------------------------- */

/* Uploads the lobes once, and again when another one takes its place. */
bool gpu_bind_preintegrated_lobe(gpu_renderer *renderer, const lmp_preintegrated_lobe *lobe,
                                 cli_error *error);

/* --- fibers.c --------------------------------------------------------------------------------- */

/* Whether the GPU draws the sheen of materials in the frame. */
bool gpu_shades_fibers(const gpu_renderer *renderer, const render_frame *frame);

/* If so, uploads the tables once and compiles the pass that does, on its first use. */
bool gpu_prepare_fibers(gpu_renderer *renderer, const render_frame *frame, cli_error *error);

/* --- table.c ---------------------------------------------------------------------------------- */

/* Views of a table as the shader reads them: rows over their angle, columns over their azimuth,
 * each of `stride` values, of tables that are mirror-symmetric the half unless `full`. */
typedef struct gpu_table_shape {
    size_t rows, columns;
} gpu_table_shape;
bool gpu_table_fill(const lmp_brdf_table *table, gpu_table_shape shape, int bands, bool full,
                    size_t stride, vec4 *values);

/* Which tables a frame sums by bands: as in gpu_variant. */
int gpu_tables_by_bands(const gpu_renderer *renderer, method_kind method);

/* What was uploaded is not used any more. */
void gpu_forget_tables(gpu_renderer *renderer);

/* Uploads the tables that a frame of so many bands sums by bands, once; what they lack is 0. */
bool gpu_bind_tables(gpu_renderer *renderer, method_kind method, int bands, cli_error *error);

/* --- preintegrated_brdf.c --------------------------------------------------------------------- */

/* Whether some material is read preintegrated. */
bool gpu_has_preintegrated_brdf(const gpu_renderer *renderer);

/* Uploads the preintegrated BRDFs, once. */
bool gpu_bind_preintegrated_brdf(gpu_renderer *renderer, cli_error *error);

/* --- zonal.c ---------------------------------------------------------------------------------- */

/* Binds the table of Z_l of so many bands, made at its first use. */
bool gpu_bind_zonal(gpu_renderer *renderer, int bands, cli_error *error);

/* --- field_level.c ---------------------------------------------------------------------------- */

/* A field or, where shaders compute its nodes, a coarser one: buffers of its nodes and of its lists
 * of near lights. */
typedef struct gpu_field_level {
    GLuint nodes, block;
    size_t bytes;   /* of the nodes */
    size_t longest; /* lights near a cell, at most */
} gpu_field_level;
enum { GPU_FIELD_LEVELS = 8 };

/* Bytes of a field's nodes as shaders read them, and room for so many. */
size_t gpu_node_bytes(const lmp_field_desc *desc);
void gpu_reserve_nodes(gpu_field_level *level, size_t bytes);

/* Uploads what there is of a field but its nodes. */
bool gpu_upload_field(const gpu_renderer *renderer, const lmp_field *field, gpu_field_level *level);

/* --- field_nodes.c ---------------------------------------------------------------------------- */

/* Computes a field's nodes from the renderer's lights, those of the coarsest field first, and
 * uploads the lists of all; compiles the pass that does on its first use. */
bool gpu_compute_nodes(gpu_renderer *renderer, const lmp_field *field, cli_error *error);

/* --- field.c ---------------------------------------------------------------------------------- */

/* Binds the frame's field, computed or uploaded where it has changed; *milliseconds, if not NULL,
 * receives what that took, with computing the nodes. */
bool gpu_bind_field(gpu_renderer *renderer, const render_frame *frame, double *milliseconds,
                    cli_error *error);

/* What was uploaded is not used any more. */
void gpu_forget_field(gpu_renderer *renderer);

/* --- environment.c ---------------------------------------------------------------------------- */

/* Uploads what the shaders read of the environment, once for so many bands and a window. */
bool gpu_bind_environment(gpu_renderer *renderer, const render_frame *frame, cli_error *error);

/* Of so many bands of the environment those that tables reflect. */
int gpu_reflected_bands(const gpu_renderer *renderer, int bands);

/* Fills the frame block's member. */
void gpu_describe_environment(const gpu_renderer *renderer, const render_frame *frame,
                              vec4 surroundings);

/* --- gbuffer.c -------------------------------------------------------------------------------- */

typedef struct gpu_pair16 {
    uint16_t u, v;
} gpu_pair16;

typedef struct gpu_pair8 {
    uint8_t u, v;
} gpu_pair8;

typedef struct gpu_base16 {
    uint16_t root[3], metallic;
} gpu_base16;

typedef struct gpu_coat16 {
    uint16_t u, v, weight, roughness;
} gpu_coat16;

/* The attachments as they are stored (shared.h). */
typedef struct gpu_gbuffer {
    int width, height;
    float *depth;
    gpu_base16 *base_metallic;
    gpu_pair16 *normal, *roughness_kind;
    float (*emission)[3];
    gpu_pair8 *layers;
    gpu_coat16 *coat; /* and those after it: NULL where no material is layered */
    uint8_t (*tint)[4], (*sheen)[4];
    vec4 *rgba;               /* for what the host makes of it */
    render_surfaces surfaces; /* what they hold */
} gpu_gbuffer;

/* Reads and decodes a sample; allocates at the first frame of a size. */
bool gpu_gbuffer_read(const gpu_renderer *renderer, const render_camera *camera,
                      const render_frame *frame, gpu_gbuffer *gbuffer, cli_error *error);
void gpu_gbuffer_free(gpu_gbuffer *gbuffer);

/* --- the renderer ----------------------------------------------------------------------------- */

struct gpu_renderer {
    gpu_context context;
    gpu_mesh mesh;
    gpu_surfaces surface; /* programs, as those after it */
    GLuint light, surfaces, resolve;
    GLuint tones[IMAGE_TONES_MAX]; /* of the rows of image_tones */
    gpu_variant variants[GPU_VARIANTS];
    int variant_count;
    GLuint frame_block, lights_block, ggx_block, empty_array;
    shared_light *lights; /* SHARED_LIGHTS_MAX of them, as lights_block has them */
    size_t shaded_lights; /* in it */
    GLuint zonal;         /* texture of the tabulated Z_l */
    int zonal_bands;
    GLuint lobe_pairs, lobe_block;      /* texture, buffer */
    const lmp_preintegrated_lobe *lobe; /* what they hold */
    int lobe_bands;
    lmp_window lobe_window;
    gpu_field_level field[GPU_FIELD_LEVELS]; /* the field, then coarser ones */
    GLuint field_staging, field_program;     /* buffer, or 0; field_nodes.comp, or 0 */
    uint64_t field_stamp;                    /* of what the buffers hold */
    int width, height;                       /* of the targets below */
    GLuint kept[GPU_ATTACHMENTS + 1];        /* attachments and depth without lights, or 0 */
    mat4 kept_view;
    GLuint attachments[GPU_ATTACHMENTS], depth, hdr, sums, framebuffer, ldr, ldr_framebuffer;
    GLuint timestamps[GPU_TIMESTAMPS]; /* hardware */
    double marks[GPU_TIMESTAMPS];      /* software, milliseconds */
    render_materials materials;
    GLuint tables_buffer;                       /* of the tables summed by bands, or 0 */
    method_kind tables_method;                  /* that it was made for */
    int tables_bands;                           /* and how many bands */
    GLuint fibers_buffer, fibers_program;       /* of those; or 0 */
    int fibers_bands, fibers_environment_bands; /* that the program was made for */
    bool fibers_by_field;
    GLuint brdf_texels, brdf_block;     /* texture, buffer; or 0 */
    const environment *environment;     /* or NULL; not owned */
    GLuint backdrop, environment_block; /* texture, buffer; or 0 */
    int environment_bands;              /* that the block was made for */
    lmp_window environment_window;
    scene bounds;        /* of the scene its bounds alone */
    gpu_gbuffer gbuffer; /* of host shaders */
};

/* --- targets.c -------------------------------------------------------------------------------- */

/* Of the G-buffer's attachments, and of its depth. */
extern const GLenum gpu_target_formats[GPU_ATTACHMENTS + 1];
GLuint gpu_target_create(GLenum format, int width, int height);

/* Those that the scene needs: the first ones. */
int gpu_attachment_count(const gpu_renderer *renderer);

/* All targets of frames of this size, in place of those before. */
bool gpu_targets_create(gpu_renderer *renderer, int width, int height, cli_error *error);
void gpu_targets_delete(gpu_renderer *renderer);

/* What a frame of keep_geometry has left is not used any more. */
void gpu_forget_geometry(gpu_renderer *renderer);

/* --- frame.c ---------------------------------------------------------------------------------- */

/* What depths are made from (camera.glsl): the near plane's, of parallel rays the farthest. */
float gpu_depth_reach(const gpu_renderer *renderer, const render_camera *camera);

/* For one sample. */
void gpu_fill_frame(const gpu_renderer *renderer, const render_frame *frame,
                    const render_camera *camera, shared_frame *block);
/* The depth at a distance from the camera; 0: of what is infinitely far, as of distance 0. */
float gpu_depth_of(const shared_frame *block, float distance);
void gpu_upload_lights(gpu_renderer *renderer, const render_frame *frame);

/* --- variant.c -------------------------------------------------------------------------------- */

/* The program that shades the frame, 0 on failure; and what its method reads, uploaded and bound.
 * *milliseconds, if not NULL, receives what a part of shading took before the passes. */
GLuint gpu_variant_find(gpu_renderer *renderer, const render_frame *frame, cli_error *error);
bool gpu_variant_bind(gpu_renderer *renderer, const render_frame *frame, double *milliseconds,
                      cli_error *error);

/* --- passes.c --------------------------------------------------------------------------------- */

void gpu_draw_gbuffer(gpu_renderer *renderer, const render_frame *frame, const shared_frame *block);

/* Binds the G-buffer's textures and the blocks for a compute pass. */
void gpu_bind_gbuffer(const gpu_renderer *renderer);

/* One sample of every pixel into the HDR target. */
void gpu_shade(gpu_renderer *renderer, const render_frame *frame, GLuint program);

/* Adds the HDR target to the sums; the last sample leaves the mean there, with `show` every one. */
void gpu_resolve(gpu_renderer *renderer, const render_frame *frame, int index, bool show);

/* --- clock.c ---------------------------------------------------------------------------------- */

/* Marks an instant of the frame; its milliseconds, once the frame is done. */
void gpu_mark(gpu_renderer *renderer, int index);
double gpu_marked(const gpu_renderer *renderer, int index);

#endif
