/* SPDX-License-Identifier: MIT */
/* scene.h - a scene from any source: meshes and their instances, materials, textures, cameras and
 * the lights it comes with. */
#ifndef LAMPION_SCENE_SCENE_H
#define LAMPION_SCENE_SCENE_H

#include "app/base/cli.h"
#include "app/scene/light.h"
#include "app/scene/name.h"

#include <lampion/lampion.h>

#ifndef SCENE_LIGHTS_MAX
#define SCENE_LIGHTS_MAX 65536 /* from all sources together */
#endif
#define SCENE_MESH_LIGHTS_MAX 1024

/* A vertex: 64 bytes, as the vertex shader reads them. */
typedef struct scene_vertex {
    float position[3];
    float normal[3];   /* unit */
    float uv[2][2];    /* two sets; glTF convention: v down */
    float tangent[4];  /* unit; w = ±1, the sign of the bitangent */
    uint16_t color[4]; /* linear, 65535 is 1; used by materials with SCENE_VERTEX_COLORS */
} scene_vertex;

/* A run of triangles with one material, in a space of its own; its instances are what is drawn. */
typedef struct scene_mesh {
    char name[SCENE_NAME_SIZE];
    uint32_t first_index, index_count; /* a multiple of 3 */
    uint32_t material;
    float minimum[3], maximum[3];
} scene_mesh;

/* A mesh placed in the scene, y up: x' = the first row · (x, y, z, 1), and so on. */
typedef struct scene_instance {
    float world_from_mesh[3][4];
    uint32_t mesh;
} scene_instance;

/* A node of the file's tree that has instances below it. Nodes come before those below them, in the
 * order of their instances: its own are the first of those below it. */
#define SCENE_NO_NODE UINT32_MAX
typedef struct scene_node {
    uint32_t name;   /* where its name begins among the scene's names; SCENE_NO_NODE: its mesh's */
    uint32_t parent; /* or SCENE_NO_NODE */
    uint32_t end;    /* the node after the last one below it */
    uint32_t first;  /* of the instances below it */
} scene_node;

typedef enum scene_flags {
    SCENE_DOUBLE_SIDED = 1,
    SCENE_ALPHA_MASK = 2,    /* discard where alpha < alpha_cutoff */
    SCENE_VERTEX_COLORS = 4, /* the base color is multiplied by the vertex color */
    SCENE_UNLIT = 8,         /* its emission is its appearance and lights nothing else */
    SCENE_ALPHA_BLEND = 16,  /* blends by alpha with what is behind it */
    SCENE_SIDES_UNSAID = 32, /* double-sided because its format has no sides; emits on one side */
    SCENE_GLOWS_ALONE = 64,  /* its emission is seen but lights nothing else */
    SCENE_LEAF = 128,        /* transmits a part of its color (app/scene/load/leaves.h) */
} scene_flags;

/* A texture and the transform of its coordinates: uv' = matrix uv + offset
 * (KHR_texture_transform). */
typedef struct scene_texture_use {
    int32_t texture; /* index, or -1 */
    float matrix[4]; /* row-major 2x2 */
    float offset[2];
    uint32_t set; /* of coordinates: 0 or 1 */
} scene_texture_use;

/* A material: glTF metallic-roughness, and the layers over it. */
#define SCENE_MAPS 14
typedef struct scene_material {
    char name[SCENE_NAME_SIZE];
    float base_color[4]; /* linear, with alpha */
    float metallic, roughness, normal_scale, alpha_cutoff;
    float emission[3]; /* radiance, linear */
    float f0[3];       /* of the dielectric, at most 1, times f90 */
    float f90;         /* 0 … 1 */
    float occlusion;   /* strength of the occlusion map */
    float coat, coat_roughness, coat_normal_scale;
    float sheen_color[3], sheen_roughness; /* 0 … 1 */
    float transmission; /* fraction transmitted of the light that is not reflected as by metal */
    float transmission_color[3]; /* of the transmitted light, in place of the base color */
    uint32_t flags;              /* scene_flags */
    union {
        struct {
            scene_texture_use base_color_map, metallic_roughness_map, normal_map, emission_map;
            scene_texture_use occlusion_map; /* r: fraction of the ambient light that arrives */
            scene_texture_use specular_map;  /* a: a factor on f90 */
            scene_texture_use specular_color_map; /* a factor on f0 */
            scene_texture_use coat_map, coat_roughness_map, coat_normal_map;
            scene_texture_use sheen_color_map, sheen_roughness_map;
            scene_texture_use transmission_map;       /* a: a factor */
            scene_texture_use transmission_color_map; /* a factor */
        };
        scene_texture_use maps[SCENE_MAPS];
    };
} scene_material;

/* A choice among the materials of a file's parts, made when the file is read
 * (KHR_materials_variants). */
typedef struct scene_variant {
    char name[SCENE_NAME_SIZE];
} scene_variant;

typedef enum scene_wrap {
    SCENE_WRAP_REPEAT,
    SCENE_WRAP_CLAMP,
    SCENE_WRAP_MIRROR,
    SCENE_WRAPS
} scene_wrap;

/* An image as its file stores it. Its texels, once decoded, are RGBA, 8 bits per channel, rows from
 * the top. */
typedef struct scene_image {
    char name[SCENE_NAME_SIZE]; /* for messages */
    uint32_t width, height;
    uint32_t formats, unused;  /* texture_format bits that it may have */
    uint64_t first_byte, size; /* of the encoded bytes */
    uint64_t first_texel;      /* byte offset of its first texel */
} scene_image;

/* How a material shows an image. */
typedef struct scene_texture {
    char name[SCENE_NAME_SIZE];
    uint32_t width, height;
    uint32_t srgb; /* 1: color, to be linearized */
    uint32_t wrap_u, wrap_v;
    uint64_t first_byte; /* byte offset of 4 * width * height bytes of texels, those of an image */
} scene_texture;

typedef struct scene_camera {
    char name[SCENE_NAME_SIZE];
    float eye[3], target[3], up[3];
    float fov;       /* vertical field of view, radians */
    float height;    /* of the view of an orthographic camera, in place of fov; 0: perspective */
    float aspect;    /* width / height of the image it was framed for; 0: any */
    float near, far; /* clipping distances along the view; 0: no clipping */
} scene_camera;

/* How the scene file moves a light: offsets from its rest position at equal time steps, from 0 to
 * the period, after which the motion repeats. */
typedef struct scene_motion {
    uint32_t light;
    uint32_t first, count; /* of the scene's offsets; count >= 2 */
    float period;          /* seconds */
} scene_motion;

#define SCENE_UNSUPPORTED_MAX 64

/* An unsupported feature of a file: `what`, such as "sheen", of `count` things that are called
 * `noun`, such as "material". If `what` is empty, the things themselves are unsupported. */
typedef struct scene_unsupported {
    char what[SCENE_NAME_SIZE], noun[SCENE_NAME_SIZE];
    uint32_t count;
} scene_unsupported;

/* Where a scene that has no camera is seen from. */
typedef enum scene_framing {
    SCENE_FRAMING_AUTO, /* inside a room; otherwise, or in doubt, outside */
    SCENE_FRAMING_OUTSIDE,
    SCENE_FRAMING_INSIDE
} scene_framing;
extern const char *const scene_framing_names[];

/* What a camera outside frames: a box, and whether it is but a part of the scene. */
typedef struct scene_subject {
    lmp_vec3 low, high;
    bool part;
} scene_subject;

/* The framing of a scene (app/scene/framing.c). */
typedef struct scene_frame {
    scene_framing wanted, framing; /* what the options ask for; what was found, AUTO until then */
    bool own;                      /* whether the file's first camera is the one inside */
    lmp_vec3 middle;               /* of the room, where a camera inside stands if not the file's */
    scene_subject subject;
    int quarter; /* quarter turns around the model of a camera outside */
    float sky;   /* fraction of the upper sky that reaches what a camera outside sees; 1 for the
                    file's */
} scene_frame;

/* Views into one block of memory, whose indices and ranges have been validated and are never out of
 * bounds. A scene is immutable after loading, except for its lights. All positions are relative to
 * the origin (app/scene/world.h); the axes are the world's. */
typedef struct scene {
    const scene_vertex *vertices;
    const uint32_t *indices;
    const scene_mesh *meshes;
    const scene_instance *instances; /* what is drawn; app/scene/instance.h reads them */
    const scene_node *nodes;         /* every instance is below one (app/scene/node.h) */
    const char *names;               /* of nodes, each ended by NUL */
    const scene_material *materials;
    const scene_variant *variants;
    const scene_texture *textures;
    const scene_image *images;
    const unsigned char *encoded; /* bytes of the images */
    const unsigned char *texels;  /* NULL if not decoded */
    const scene_camera *cameras;
    const scene_motion *motions; /* at most one per light */
    const lmp_vec3 *offsets;
    const scene_unsupported *unsupported;
    size_t vertex_count, index_count, mesh_count, instance_count, node_count;
    size_t material_count, variant_count, texture_count, image_count, encoded_bytes, texel_bytes;
    size_t camera_count, motion_count, offset_count, unsupported_count;
    scene_light *lights; /* SCENE_LIGHTS_MAX allocated */
    size_t light_count;
    bool lights_chosen; /* by the command line: a scene without lights is then meant to be dark */
    float minimum[3], maximum[3]; /* of all instances; of a unit box if there are none */
    scene_frame *frame;           /* filled in when first needed; NULL: determined each time */
    double origin[3];             /* in the world; 0 unless the scene lies far from there */
    int up;                       /* the file's axis that became y */
    void *block;                  /* owned by the scene */
    size_t block_size;
    bool mapped;   /* whether the block is a mapping rather than from malloc */
    void *decoded; /* a mapping that holds the texels of the images, or NULL */
    size_t decoded_size;
    scene_material *own_materials; /* in place of the block's, in a scene that lacks images */
    scene_unsupported *own_unsupported;
    bool cached;      /* whether it came from the cache */
    const char *name; /* the name it was loaded under, for messages; the caller's string */
} scene;

/* The file's axis that points up; AUTO: as its format says, else y. */
enum { SCENE_UP_AUTO, SCENE_UP_Y, SCENE_UP_Z };
extern const char *const scene_up_names[];

/* How foliage is shown if its file says nothing about transmission (app/scene/load/leaves.h). */
enum { SCENE_LEAVES_TRANSLUCENT, SCENE_LEAVES_OPAQUE };
extern const char *const scene_leaves_names[];

typedef struct scene_options {
    int up;              /* the axis of the file that becomes y */
    int framing;         /* scene_framing */
    int leaves;          /* translucent or opaque */
    const char *variant; /* of materials, by name or number from 0; NULL: the file's default */
    int mesh_lights;     /* the most lights of a glowing mesh, to SCENE_MESH_LIGHTS_MAX; 0: some */
    bool no_cache;       /* neither read nor write the cache */
    bool strict;         /* fail if any part of the file is unsupported */
    bool no_texels;      /* do not decode images, for commands that show none */
} scene_options;

/* Returns the name of built-in scene i = 0, 1, …, or NULL past the last. */
const char *scene_builtin_name(size_t i);

/* Loads "builtin:NAME[:PARAMETER]" or a scene file. Files are parsed in a sandboxed child process
 * and cached by content. On failure returns false with one line in *error; *scene is then zero. */
bool scene_load(const char *name, const scene_options *options, scene *scene, base_error *error);

/* Writes the version of Assimp, which reads some formats; returns false if it is not installed. */
bool scene_assimp_version(char *text, size_t size, base_error *error);

/* Whether a scene's name is that of a file rather than of a built-in scene. */
bool scene_is_file(const char *name);
void scene_free(scene *scene);

/* The rows of a command's option table that fill a scene_options variable. */
#define SCENE_LOAD_OPTION_ROWS(variable)                                                           \
    { .name = "up",                                                                                \
      .kind = CLI_CHOICE,                                                                          \
      .target = &(variable).up,                                                                    \
      .argument = "AXIS",                                                                          \
      .help =                                                                                      \
          "the axis of the scene file that points up: y, z, or auto: as its format says, else "    \
          "y; the scene is rotated to make it y",                                                  \
      .choices = scene_up_names },                                                                 \
        { .name = "variant",                                                                       \
          .kind = CLI_TEXT,                                                                        \
          .target = &(variable).variant,                                                           \
          .argument = "NAME",                                                                      \
          .help = "a variant of the materials of a glTF, by name or number from 0 (info lists "    \
                  "them)" },                                                                       \
        { .name = "mesh-lights",                                                                   \
          .kind = CLI_INT,                                                                         \
          .target = &(variable).mesh_lights,                                                       \
          .argument = "N",                                                                         \
          .help = "the most lights that stand for a glowing mesh of the file; 0: 40, or fewer "    \
                  "where more than 25 meshes glow",                                                \
          .minimum = 0,                                                                            \
          .maximum = SCENE_MESH_LIGHTS_MAX },                                                      \
        { .name = "leaves",                                                                        \
          .kind = CLI_CHOICE,                                                                      \
          .target = &(variable).leaves,                                                            \
          .argument = "HOW",                                                                       \
          .help = "how green, masked, double-sided surfaces are drawn if the file does not say: "  \
                  "translucent, as leaves are, or opaque",                                         \
          .choices = scene_leaves_names },                                                         \
    {                                                                                              \
        .name = "strict", .kind = CLI_FLAG, .target = &(variable).strict,                          \
        .help = "refuse a scene of which something would be left out"                              \
    }

/* Describes one unsupported feature, such as "sheen (2 materials)" or "1 skin". */
void scene_unsupported_text(const scene_unsupported *item, char *text, size_t size);

/* Removes all lights and their motions. */
void scene_clear_lights(scene *scene);

/* Returns a white matte material without maps: the default that files modify. */
scene_material scene_material_plain(void);

/* Whether the material has layers beyond glTF's core: a coat, a sheen, or a map that tints f0. */
bool scene_is_layered(const scene_material *material);
bool scene_has_sheen(const scene_material *material);

/* The fraction of its base color that a leaf transmits, in addition to reflecting all of it. */
#define SCENE_LEAF_TRANSMITS 0.5f

/* Whether the material transmits light diffusely (KHR_materials_diffuse_transmission). */
bool scene_is_translucent(const scene_material *material);

/* Reads the lights of a JSON file (docs/lights.md), or of a screenshot or saved state of the
 * viewer; fails if there are more than `room`. Files hold world positions, which become relative to
 * the origin. */
bool scene_read_lights(const char *path, const double origin[3], size_t room, scene_light *lights,
                       size_t *count, base_error *error);
bool scene_write_lights(const char *path, const double origin[3], const scene_light *lights,
                        size_t count, base_error *error);

/* Whether a scene's name is that of a glTF file, .gltf or .glb. */
bool scene_is_gltf(const char *name);

/* Writes a copy of the scene's glTF file with these lights in place of its own. A copy beside the
 * file shares its buffers and images; a GLB stays one. `lost` says in one line what glTF cannot: ""
 * is nothing. */
bool scene_export_gltf(const scene *scene, const scene_light *lights, size_t count,
                       const char *path, char *lost, size_t lost_size, base_error *error);

/* Adds the lights of a file to the scene's; adds none on failure. */
bool scene_add_lights_file(scene *scene, const char *path, base_error *error);

/* Adds `count` random lights in free space, sized to suit the scene; a seed gives the same lights
 * on any machine. */
bool scene_add_random_lights(scene *scene, int count, uint64_t seed, base_error *error);

/* The lights that a command line asks for. Zero is the default: the scene's own. */
typedef struct scene_lights_options {
    const char *file; /* a lights file, or NULL */
    int random_count; /* random lights */
    uint64_t seed;
    bool keep;          /* keep the scene's own lights, which are otherwise replaced */
    bool hide;          /* all lights shine without being seen */
    float point_radius; /* of the scene's own point lights, which become spheres; 0: points */
    float sun_angle;    /* half angle in degrees of its directional lights; 0: parallel rays */
} scene_lights_options;

/* The rows of a command's option table that fill a scene_lights_options variable. */
#define SCENE_LIGHTS_OPTION_ROWS(variable)                                                         \
    { .name = "lights",                                                                            \
      .kind = CLI_TEXT,                                                                            \
      .target = &(variable).file,                                                                  \
      .argument = "FILE",                                                                          \
      .help = "lights from a JSON file or a screenshot, instead of the scene's own" },             \
        { .name = "random-lights",                                                                 \
          .kind = CLI_INT,                                                                         \
          .target = &(variable).random_count,                                                      \
          .argument = "N",                                                                         \
          .help = "replace the scene's own lights by N random ones",                               \
          .minimum = 0,                                                                            \
          .maximum = SCENE_LIGHTS_MAX },                                                           \
        { .name = "seed",                                                                          \
          .kind = CLI_SEED,                                                                        \
          .target = &(variable).seed,                                                              \
          .argument = "SEED",                                                                      \
          .help = "seed of the random lights" },                                                   \
        { .name = "point-radius",                                                                  \
          .kind = CLI_FLOAT,                                                                       \
          .target = &(variable).point_radius,                                                      \
          .argument = "RADIUS",                                                                    \
          .help = "make the scene's own point lights spheres of the same intensity",               \
          .minimum = 0,                                                                            \
          .maximum = 1e12 },                                                                       \
        { .name = "sun-angle",                                                                     \
          .kind = CLI_FLOAT,                                                                       \
          .target = &(variable).sun_angle,                                                         \
          .argument = "DEGREES",                                                                   \
          .help = "make the scene's directional lights suns of this angular radius (the Sun has "  \
                  "0.27)",                                                                         \
          .minimum = 0,                                                                            \
          .maximum = 89 },                                                                         \
        { .name = "hide-lights",                                                                   \
          .kind = CLI_FLAG,                                                                        \
          .target = &(variable).hide,                                                              \
          .help = "let all lights shine without being seen" },                                     \
    {                                                                                              \
        .name = "keep-lights", .kind = CLI_FLAG, .target = &(variable).keep,                       \
        .help = "keep the scene's own lights beside --lights and --random-lights"                  \
    }

/* Gives the scene the lights that the command line asks for. */
bool scene_apply_lights(scene *scene, const scene_lights_options *options, base_error *error);

/* Returns the height of the part of the scene that an image shows at a distance along the view. */
float scene_camera_height(const scene_camera *camera, float distance);

/* Returns the framing of a scene, never AUTO. If the file has cameras, AUTO is resolved to where
 * the first one stands. */
scene_frame scene_frame_of(const scene *scene);
bool scene_is_inside(const scene *scene);

/* Returns the scene's first camera or, if it has none or another framing is chosen, one that frames
 * the scene. If the image is narrower than the camera's aspect, the view is widened so that nothing
 * is cut off at the sides. */
scene_camera scene_default_camera(const scene *scene, float aspect);
scene_camera scene_framed_camera(const scene *scene, scene_framing framing, float aspect);

/* The camera that a command line asks for. Zero is the default: scene_default_camera. */
typedef struct scene_camera_options {
    const char *name;         /* a camera of the scene, by name or number from 0 */
    double eye[3], target[3]; /* in the world */
    float fov, height;
    bool eye_given, target_given, fov_given, height_given;
} scene_camera_options;

/* The rows of a command's option table that fill a scene_camera_options variable, and the framing
 * in a scene_options variable. */
#define SCENE_CAMERA_OPTION_ROWS(variable, load)                                                   \
    { .name = "framing",                                                                           \
      .kind = CLI_CHOICE,                                                                          \
      .target = &(load).framing,                                                                   \
      .argument = "FROM",                                                                          \
      .help = "where the automatic camera stands: outside, inside, or auto: where the file's "     \
              "camera is, else inside a room, and outside if in doubt",                            \
      .choices = scene_framing_names },                                                            \
        { .name = "camera",                                                                        \
          .kind = CLI_TEXT,                                                                        \
          .target = &(variable).name,                                                              \
          .argument = "NAME",                                                                      \
          .help = "a camera of the scene, by name or number from 0" },                             \
        { .name = "eye",                                                                           \
          .kind = CLI_POSITION,                                                                    \
          .target = (variable).eye,                                                                \
          .argument = "X,Y,Z",                                                                     \
          .help = "where the camera is",                                                           \
          .minimum = -(double)LMP_LENGTH_MAX,                                                      \
          .maximum = (double)LMP_LENGTH_MAX,                                                       \
          .given = &(variable).eye_given },                                                        \
        { .name = "target",                                                                        \
          .kind = CLI_POSITION,                                                                    \
          .target = (variable).target,                                                             \
          .argument = "X,Y,Z",                                                                     \
          .help = "where it looks",                                                                \
          .minimum = -(double)LMP_LENGTH_MAX,                                                      \
          .maximum = (double)LMP_LENGTH_MAX,                                                       \
          .given = &(variable).target_given },                                                     \
        { .name = "fov",                                                                           \
          .kind = CLI_FLOAT,                                                                       \
          .target = &(variable).fov,                                                               \
          .argument = "DEGREES",                                                                   \
          .help = "its vertical field of view",                                                    \
          .minimum = 1,                                                                            \
          .maximum = 170,                                                                          \
          .given = &(variable).fov_given },                                                        \
    {                                                                                              \
        .name = "orthographic", .kind = CLI_FLOAT, .target = &(variable).height,                   \
        .argument = "HEIGHT",                                                                      \
        .help = "without perspective: how much of the scene is seen, top to bottom",               \
        .minimum = 1e-6, .maximum = 1e12, .given = &(variable).height_given                        \
    }

/* Finds the camera for an image of `size` pixels, made upright and kept away from its own
 * target. */
bool scene_place_camera(const scene *scene, const scene_camera_options *options, const int size[2],
                        scene_camera *camera, base_error *error);

#endif
