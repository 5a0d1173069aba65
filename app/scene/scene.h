/* SPDX-License-Identifier: MIT */
/* scene.h - a scene, however it came to be: meshes and where they stand, materials, textures,
 * cameras and the lights it brings along. */
#ifndef LAMPION_SCENE_H
#define LAMPION_SCENE_H

#include "app/cli/cli.h"
#include "app/scene/light.h"
#include "app/scene/name.h"

#include <lampion/lampion.h>

#define SCENE_LIGHTS_MAX 65536 /* from all sources together */

/* 64 bytes, as the vertex shader reads them. */
typedef struct scene_vertex {
    float position[3];
    float normal[3];   /* unit */
    float uv[2][2];    /* two sets; glTF convention: v down */
    float tangent[4];  /* unit; w = ±1, the sign of the bitangent */
    uint16_t color[4]; /* linear, 65535 is 1; of materials with SCENE_VERTEX_COLORS */
} scene_vertex;

/* A run of triangles with one material, in a space of its own: what is seen are its instances. */
typedef struct scene_mesh {
    char name[SCENE_NAME_SIZE];
    uint32_t first_index, index_count; /* a multiple of 3 */
    uint32_t material;
    float minimum[3], maximum[3];
} scene_mesh;

/* A mesh where it stands in the scene, y up: x' = the first row · (x, y, z, 1), and so on. */
typedef struct scene_instance {
    float world_from_mesh[3][4];
    uint32_t mesh;
} scene_instance;

typedef enum scene_flags {
    SCENE_DOUBLE_SIDED = 1,
    SCENE_ALPHA_MASK = 2,    /* discard where alpha < alpha_cutoff */
    SCENE_VERTEX_COLORS = 4, /* the base color is multiplied by that of the vertices */
    SCENE_UNLIT = 8,         /* its emission is what one sees, and no light to others */
    SCENE_ALPHA_BLEND = 16,  /* by alpha, it hides what is behind it */
    SCENE_SIDES_UNSAID = 32, /* double-sided, as its format says nothing of sides; glows by one */
    SCENE_GLOWS_ALONE = 64,  /* its emission is a look, and no light to others */
} scene_flags;

/* A texture and how its coordinates are made: uv' = matrix uv + offset (KHR_texture_transform). */
typedef struct scene_texture_use {
    int32_t texture; /* index, or -1 */
    float matrix[4]; /* row-major 2x2 */
    float offset[2];
    uint32_t set; /* of coordinates: 0 or 1 */
} scene_texture_use;

/* glTF metallic-roughness, and what lies over it. */
#define SCENE_MAPS 12
typedef struct scene_material {
    char name[SCENE_NAME_SIZE];
    float base_color[4]; /* linear, with alpha */
    float metallic, roughness, normal_scale, alpha_cutoff;
    float emission[3]; /* radiance, linear */
    float f0[3];       /* of the dielectric, held to 1, times f90 */
    float f90;         /* 0 … 1 */
    float occlusion;   /* strength of the occlusion map */
    float coat, coat_roughness, coat_normal_scale;
    float sheen_color[3], sheen_roughness; /* 0 … 1 */
    uint32_t flags;                        /* scene_flags */
    union {
        struct {
            scene_texture_use base_color_map, metallic_roughness_map, normal_map, emission_map;
            scene_texture_use occlusion_map;      /* r: how much of the ambient light comes */
            scene_texture_use specular_map;       /* a: a factor on f90 */
            scene_texture_use specular_color_map; /* a factor on f0 */
            scene_texture_use coat_map, coat_roughness_map, coat_normal_map;
            scene_texture_use sheen_color_map, sheen_roughness_map;
        };
        scene_texture_use maps[SCENE_MAPS];
    };
} scene_material;

/* A choice among the materials of a file's parts, made when it is read (KHR_materials_variants). */
typedef struct scene_variant {
    char name[SCENE_NAME_SIZE];
} scene_variant;

typedef enum scene_wrap {
    SCENE_WRAP_REPEAT,
    SCENE_WRAP_CLAMP,
    SCENE_WRAP_MIRROR,
    SCENE_WRAPS
} scene_wrap;

/* An image as its file has it. Its texels are RGBA, 8 bits a channel, rows from the top; they are
 * there once it has been decoded. */
typedef struct scene_image {
    char name[SCENE_NAME_SIZE]; /* for messages */
    uint32_t width, height;
    uint32_t formats, unused;  /* of which it may be: texture_format */
    uint64_t first_byte, size; /* among the encoded bytes */
    uint64_t first_texel;      /* where its first is among the texels, in bytes */
} scene_image;

/* How a material shows an image. */
typedef struct scene_texture {
    char name[SCENE_NAME_SIZE];
    uint32_t width, height;
    uint32_t srgb; /* 1: color, to be linearized */
    uint32_t wrap_u, wrap_v;
    uint64_t first_byte; /* into texels: 4 * width * height bytes, those of an image */
} scene_texture;

typedef struct scene_camera {
    char name[SCENE_NAME_SIZE];
    float eye[3], target[3], up[3];
    float fov;    /* vertical field of view, radians */
    float height; /* of all that it sees by parallel rays (orthographic), without fov; 0: by fov */
    float aspect; /* the image it was framed for, width / height; 0: any */
    float near, far; /* what is nearer or farther along the view is not seen; 0: all is */
} scene_camera;

/* How the scene file moves a light: its offset from where it rests at even steps of time, from 0 to
 * the period, after which it begins anew. */
typedef struct scene_motion {
    uint32_t light;
    uint32_t first, count; /* of the scene's offsets; count >= 2 */
    float period;          /* seconds */
} scene_motion;

#define SCENE_LEFT_OUT_MAX 64

/* What a file has and nothing here shows: "sheen" of 2 of noun "material"; without `what`, the
 * nouns themselves. */
typedef struct scene_left_out {
    char what[SCENE_NAME_SIZE], noun[SCENE_NAME_SIZE];
    uint32_t count;
} scene_left_out;

/* From where a scene is seen that brings no camera. */
typedef enum scene_framing {
    SCENE_FRAMING_AUTO, /* inside of a room, in doubt outside */
    SCENE_FRAMING_OUTSIDE,
    SCENE_FRAMING_INSIDE
} scene_framing;
extern const char *const scene_framing_names[];

/* How it is framed (app/scene/framing.c). */
typedef struct scene_frame {
    scene_framing wanted, framing; /* by the options; found: AUTO until then */
    bool own;                      /* the file's first camera is the one inside */
    lmp_vec3 middle;               /* of the room, where another one stands inside */
    int quarter;                   /* of a circle that a camera outside goes around */
} scene_frame;

/* Views into one block of memory; indices and ranges are validated, never out of bounds. Immutable
 * after loading but for the lights. All positions are relative to the origin (app/scene/world.h),
 * whose axes are the world's. */
typedef struct scene {
    const scene_vertex *vertices;
    const uint32_t *indices;
    const scene_mesh *meshes;
    const scene_instance *instances; /* what is seen; app/scene/instance.h reads them */
    const scene_material *materials;
    const scene_variant *variants;
    const scene_texture *textures;
    const scene_image *images;
    const unsigned char *encoded; /* bytes of the images */
    const unsigned char *texels;  /* NULL: not decoded */
    const scene_camera *cameras;
    const scene_motion *motions; /* at most one a light */
    const lmp_vec3 *offsets;
    const scene_left_out *left_out;
    size_t vertex_count, index_count, mesh_count, instance_count;
    size_t material_count, variant_count, texture_count, image_count, encoded_bytes, texel_bytes;
    size_t camera_count, motion_count, offset_count, left_out_count;
    scene_light *lights; /* SCENE_LIGHTS_MAX allocated */
    size_t light_count;
    bool lights_chosen; /* by the command line: none of them is then a wish for darkness */
    float minimum[3], maximum[3]; /* bounds of all instances; without one: a unit box */
    scene_frame *frame;           /* kept once it has been found; NULL: it is found anew */
    double origin[3];             /* in the world; 0 unless the scene lies far from there */
    void *block;                  /* owned by the scene */
    size_t block_size;
    bool mapped;   /* the block is a mapping, not from malloc */
    void *decoded; /* a mapping that holds the texels of the images, or NULL */
    size_t decoded_size;
    scene_material *own_materials; /* instead of the block's, of a scene that lacks images */
    scene_left_out *own_left_out;
    bool cached;      /* it came from the cache */
    const char *name; /* it was loaded by, for messages; the caller's string */
} scene;

enum { SCENE_UP_Y, SCENE_UP_Z }; /* the file's axis that points up */
extern const char *const scene_up_names[];

typedef struct scene_options {
    int up;              /* the scene is rotated so that this is y */
    int framing;         /* scene_framing */
    const char *variant; /* of materials, by name or number from 0; NULL: the file's own */
    bool no_cache;       /* neither read nor write the cache */
    bool strict;         /* a file of which something is left out is an error */
    bool no_texels;      /* images are not decoded: for what shows none of them */
} scene_options;

/* The names of the built-in scenes, i = 0, 1, …; NULL past the last. */
const char *scene_builtin_name(size_t i);

/* Loads "builtin:NAME[:PARAMETER]" or a scene file. Files are parsed in a sandboxed child process
 * and cached by content. False with one line in *error; *scene is then zero. */
bool scene_load(const char *name, const scene_options *options, scene *scene, cli_error *error);

/* Whether a scene's name is that of a file, not of a built-in scene. */
bool scene_is_file(const char *name);
void scene_free(scene *scene);

/* The rows of a command's option table that fill a scene_options variable. */
#define SCENE_LOAD_OPTION_ROWS(variable)                                                           \
    { .name = "up",                                                                                \
      .kind = CLI_CHOICE,                                                                          \
      .target = &(variable).up,                                                                    \
      .argument = "AXIS",                                                                          \
      .help = "the axis of the scene file that points up; the scene is rotated to make it y",      \
      .choices = scene_up_names },                                                                 \
        { .name = "variant",                                                                       \
          .kind = CLI_TEXT,                                                                        \
          .target = &(variable).variant,                                                           \
          .argument = "NAME",                                                                      \
          .help = "a variant of the materials of a glTF, by name or number from 0 (info lists "    \
                  "them)" },                                                                       \
    {                                                                                              \
        .name = "strict", .kind = CLI_FLAG, .target = &(variable).strict,                          \
        .help = "refuse a scene of which something would be left out"                              \
    }

/* One thing that is left out, as "sheen (2 materials)" or "1 skin". */
void scene_left_out_text(const scene_left_out *item, char *text, size_t size);

/* And with them their motions. */
void scene_clear_lights(scene *scene);

/* White and matte, without maps: what a material is unless a file says more. */
scene_material scene_material_plain(void);

/* Whether the material has more than glTF's core: a coat, a sheen, or a map that tints f0. */
bool scene_is_layered(const scene_material *material);
bool scene_has_sheen(const scene_material *material);

/* Reads the lights of a JSON file (docs/lights.md), or of a screenshot or state of the viewer, of
 * which there is room for so many. Files have them in the world, others know the origin. */
bool scene_read_lights(const char *path, const double origin[3], size_t room, scene_light *lights,
                       size_t *count, cli_error *error);
bool scene_write_lights(const char *path, const double origin[3], const scene_light *lights,
                        size_t count, cli_error *error);

/* Adds those to the scene's; none of them on failure. */
bool scene_add_lights_file(scene *scene, const char *path, cli_error *error);

/* Adds `count` seeded random lights where there is room, sized to the scene: the same on any
 * machine.
 */
bool scene_add_random_lights(scene *scene, int count, uint64_t seed, cli_error *error);

/* The lights a command line asks for. Zero is the default: the scene's own. */
typedef struct scene_lights_options {
    const char *file; /* a lights file, or NULL */
    int random_count; /* random lights */
    uint64_t seed;
    bool keep;          /* keep the scene's own lights beside these, which otherwise replace them */
    bool hide;          /* all lights shine without being seen */
    float point_radius; /* of the scene's own point lights, which become spheres; 0: points */
    float sun_angle;    /* degrees: half that of its directional lights; 0: parallel rays */
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
bool scene_apply_lights(scene *scene, const scene_lights_options *options, cli_error *error);

/* The height of what an image shows at a distance along the view. */
float scene_camera_height(const scene_camera *camera, float distance);

/* How the scene is framed: never AUTO. With cameras in the file, AUTO is where the first stands. */
scene_frame scene_frame_of(const scene *scene);
bool scene_is_inside(const scene *scene);

/* The scene's first camera, or where there is none, or another framing is chosen, one that frames
 * it. In an image narrower than the camera's aspect it sees more, so that nothing is cut off at the
 * sides. */
scene_camera scene_default_camera(const scene *scene, float aspect);
scene_camera scene_framed_camera(const scene *scene, scene_framing framing, float aspect);

/* The camera a command line asks for. Zero is the default: scene_default_camera. */
typedef struct scene_camera_options {
    const char *name;         /* a camera of the scene, by name or number from 0 */
    double eye[3], target[3]; /* in the world */
    float fov, height;
    bool eye_given, target_given, fov_given, height_given;
} scene_camera_options;

/* The rows of a command's option table that fill a scene_camera_options variable, and say in a
 * scene_options variable how the scene is framed. */
#define SCENE_CAMERA_OPTION_ROWS(variable, load)                                                   \
    { .name = "framing",                                                                           \
      .kind = CLI_CHOICE,                                                                          \
      .target = &(load).framing,                                                                   \
      .argument = "FROM",                                                                          \
      .help = "where the camera stands by itself: outside, inside, or auto: where the file's "     \
              "camera is, else inside of what is a room, in doubt outside",                        \
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

/* Finds the camera for an image of `size` pixels, upright and not inside its own target. */
bool scene_place_camera(const scene *scene, const scene_camera_options *options, const int size[2],
                        scene_camera *camera, cli_error *error);

#endif
