/* SPDX-License-Identifier: MIT */
/* demo.c - what the page calls of the library and of the program's scenes. The page draws by WebGL
 * itself, with the program's own shaders: arrays here have the layout that these read. */
#include "app/base/sandbox.h"
#include "app/image/tone.h"
#include "app/render/gl/block.h"
#include "app/render/gl/shelves.h"
#include "app/scene/animation.h"
#include "app/scene/builtin/builtin.h"
#include "app/scene/flatten.h"
#include "app/scene/gltf/gltf.h"
#include "app/scene/load/origin.h"
#include "app/scene/texture.h"
#include "web/probes.h"
#include "web/splats.h"

#include <emscripten/emscripten.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define EXPORT EMSCRIPTEN_KEEPALIVE

enum { AREAS_MAX = 64 };

static struct {
    base_error error;
    scene world;
    animation *path;
    size_t fixtures; /* the first lights, which belong to the scene and stay where they are */
    /* SCENE_LIGHTS_MAX of each, allocated with the first scene: as they move, as the shaders and as
     * the library take them. A module's static memory is small. */
    scene_light *moved;
    shared_light *lights; /* spheres, and then areas, of which shaders show the radiance */
    size_t sphere_count, area_count;
    float areas[AREAS_MAX][4 * LMP_AREA_TEXELS];
    lmp_light *emitters; /* of lights[] */
    probes_grid probes;
    shared_material *materials;
    shared_material_constants *constants;
} demo;

static const char *outcome(bool ok) {
    return ok ? NULL : demo.error.text;
}

/* Reports no progress, because nobody waits long enough to see it. */
void sandbox_progress(double done) {
    (void)done;
}

/* Opens nothing: a page reads only the file that is dropped on it. */
int sandbox_open(const char *name, int *number, base_error *error) {
    *number = -1;
    base_fail(error, "file",
              "refers to another file, \"%.200s\": use a .glb, which holds everything", name);
    return -1;
}

/* --- scenes ----------------------------------------------------------------------------------- */

static bool fill_materials(void) {
    const scene *w = &demo.world;
    demo.materials = calloc(w->material_count + 1, sizeof *demo.materials);
    demo.constants = calloc(w->material_count + 1, sizeof *demo.constants);
    if (!demo.materials || !demo.constants)
        return base_fail(&demo.error, w->name, "does not fit into memory");
    for (size_t i = 0; i < w->material_count; i++) {
        gpu_fill_material(&w->materials[i], i, &demo.materials[i]);
        demo.constants[i] = gpu_material_constants(&w->materials[i]);
    }
    return true;
}

static bool allocate_lights(void) {
    if (!demo.moved)
        demo.moved = calloc(SCENE_LIGHTS_MAX, sizeof *demo.moved);
    if (!demo.lights)
        demo.lights = calloc(SCENE_LIGHTS_MAX, sizeof *demo.lights);
    if (!demo.emitters)
        demo.emitters = calloc(SCENE_LIGHTS_MAX, sizeof *demo.emitters);
    return (demo.moved && demo.lights && demo.emitters) ||
           base_fail(&demo.error, "lights", "do not fit into memory");
}

static void close_scene(void) {
    animation_close(demo.path);
    demo.path = NULL;
    free(demo.materials);
    free(demo.constants);
    demo.materials = NULL;
    demo.constants = NULL;
    scene_free(&demo.world);
}

/* Packs what has been built and makes it the scene; on failure the scene before it stays. */
static bool take(scene_builder *builder, const char *name) {
    void *block = NULL;
    size_t size = 0;
    scene world;
    builder_flatten(builder);
    if (!allocate_lights() || !texture_decode_all(builder, name, &demo.error))
        return false;
    if (!builder_pack(builder, &block, &size))
        return base_fail(&demo.error, name, "does not fit into memory");
    if (!blob_validate(block, size, false, name, &demo.error) ||
        !blob_open(block, size, name, &world, &demo.error)) {
        free(block);
        return false;
    }
    close_scene();
    demo.world = world;
    if (!probes_spread(&demo.probes, world.minimum, world.maximum))
        return base_fail(&demo.error, name, "does not fit into memory");
    return fill_materials() && animation_open("orbit", &demo.world, &demo.path, &demo.error);
}

/* Open a scene; each returns NULL, or what is wrong. */
EXPORT const char *demo_open_builtin(const char *name) {
    scene_builder builder = { 0 };
    const bool ok = builtin_make(name, &builder, &demo.error) && take(&builder, "builtin");
    builder_free(&builder);
    const bool lit = strncmp(name, "atrium", 6) == 0 || strncmp(name, "room", 4) == 0;
    demo.fixtures = ok && lit ? demo.world.light_count : 0;
    return outcome(ok);
}

EXPORT const char *demo_open_file(const void *data, size_t size) {
    static const char name[] = "file";
    source_set sources = { .subject = name, .folder = "/", .sandboxed = true };
    scene_builder builder = { 0 };
    bool ok = origin_read(gltf_add, data, size, &sources, &builder, &demo.error);
    sources_free(&sources);
    if (ok && builder_count(&builder, BLOB_INDICES) == 0)
        ok = base_fail(&demo.error, name, "has no triangles");
    ok = ok && take(&builder, name);
    builder_free(&builder);
    demo.fixtures = ok ? 0 : demo.fixtures;
    return outcome(ok);
}

/* Returns what of the file is not shown, or "". */
EXPORT const char *demo_unsupported(void) {
    static char text[2 * SCENE_NAME_SIZE + 32];
    text[0] = '\0';
    if (demo.world.unsupported_count > 0)
        scene_unsupported_text(&demo.world.unsupported[0], text, sizeof text);
    return text;
}

typedef struct demo_draw {
    uint32_t first_index, index_count, material, masked, double_sided, plain;
    int32_t maps[SHARED_MAPS]; /* indices of textures, or -1 */
} demo_draw;

EXPORT size_t demo_draw_count(void) {
    return demo.world.instance_count;
}

EXPORT const demo_draw *demo_draw_at(size_t i) {
    static demo_draw draw;
    const scene_mesh *mesh = &demo.world.meshes[demo.world.instances[i].mesh];
    const scene_material *m = &demo.world.materials[mesh->material];
    draw = (demo_draw) { .first_index = mesh->first_index,
                         .index_count = mesh->index_count,
                         .material = mesh->material,
                         .masked = m->flags & (SCENE_ALPHA_MASK | SCENE_ALPHA_BLEND),
                         .double_sided = m->flags & SCENE_DOUBLE_SIDED,
                         .plain = gpu_material_is_plain(m) };
    for (int k = 0; k < SHARED_MAPS; k++)
        draw.maps[k] = m->maps[k].texture;
    return &draw;
}

/* Returns pointers, counts and sizes, in the order of library.js. */
EXPORT const uintptr_t *demo_arrays(void) {
    static uintptr_t arrays[9];
    const scene *w = &demo.world;
    const uintptr_t values[] = {
        (uintptr_t)w->vertices, w->vertex_count,           (uintptr_t)w->indices,
        w->index_count,         (uintptr_t)demo.materials, (uintptr_t)demo.constants,
        w->material_count,      (uintptr_t)w->minimum,     (uintptr_t)w->maximum,
    };
    static_assert(sizeof arrays == sizeof values, "as many");
    memcpy(arrays, values, sizeof values);
    return arrays;
}

EXPORT size_t demo_material_size(void) {
    return sizeof(shared_material);
}

/* Returns width, height, 1 for colors, wrapping in both directions, and the texels. */
EXPORT const uintptr_t *demo_texture(size_t i) {
    static uintptr_t texture[6];
    const scene_texture *t = &demo.world.textures[i];
    const uintptr_t values[6] = { t->width,  t->height,
                                  t->srgb,   t->wrap_u,
                                  t->wrap_v, (uintptr_t)(demo.world.texels + t->first_byte) };
    memcpy(texture, values, sizeof values);
    return texture;
}

EXPORT size_t demo_texture_count(void) {
    return demo.world.texture_count;
}

/* Returns eye, target, up, and the field of view. */
EXPORT const float *demo_camera(float aspect) {
    static float camera[10];
    const scene_camera c = scene_default_camera(&demo.world, aspect);
    memcpy(camera, c.eye, sizeof c.eye);
    memcpy(camera + 3, c.target, sizeof c.target);
    memcpy(camera + 6, c.up, sizeof c.up);
    camera[9] = c.fov;
    return camera;
}

/* --- lights ----------------------------------------------------------------------------------- */

/* Scatters lights, `count` in all: the scene's own, if it has any, and others. */
EXPORT const char *demo_scatter_lights(int count, uint32_t seed) {
    const int others = count - (int)demo.fixtures;
    if (demo.fixtures == 0)
        scene_clear_lights(&demo.world);
    else
        demo.world.light_count = demo.fixtures;
    return outcome(others <= 0 || scene_add_random_lights(&demo.world, others, seed, &demo.error));
}

EXPORT const shared_light *demo_lights(void) {
    return demo.lights;
}

static void add_sphere(const scene_light *light) {
    const lmp_light *e = &light->emitter;
    demo.emitters[demo.sphere_count] = *e;
    demo.lights[demo.sphere_count++] = (shared_light) {
        { e->position.x, e->position.y, e->position.z, e->radius },
        { e->radiance.r, e->radiance.g, e->radiance.b,
          (float)(scene_light_is_drawn(light) ? SHARED_LIGHT_DRAWN : SHARED_LIGHT_HIDDEN) },
        { 0 }
    };
}

/* Adds an area, once all spheres are there. */
static void add_area(const scene_light *light) {
    const lmp_rgb radiance = light->emitter.radiance;
    if (demo.area_count == AREAS_MAX)
        return;
    const size_t number = demo.sphere_count + demo.area_count;
    float *const texels = demo.areas[demo.area_count++];
    lmp_light_copy_area_texels(&light->emitter, texels);
    texels[4 * SHARED_AREA_NUMBER + 3] = light->hidden ? -1 : (float)number;
    demo.emitters[number] = light->emitter;
    demo.lights[number] =
        (shared_light) { .radiance = { radiance.r, radiance.g, radiance.b, SHARED_LIGHT_HIDDEN } };
}

/* Moves the lights to where they are after so many seconds; returns how many spheres there are.
 * Lights of other kinds than spheres and areas do not shine here. */
EXPORT size_t demo_move_lights(double seconds) {
    const size_t count = demo.world.light_count;
    animation_move_all(demo.path, &demo.world, seconds, demo.moved);
    memcpy(demo.moved, demo.world.lights, demo.fixtures * sizeof *demo.moved);
    demo.sphere_count = demo.area_count = 0;
    for (size_t i = 0; i < count; i++)
        if (demo.moved[i].emitter.kind == LMP_LIGHT_SPHERE)
            add_sphere(&demo.moved[i]);
    for (size_t i = 0; i < count; i++)
        if (scene_light_is_area(&demo.moved[i].emitter))
            add_area(&demo.moved[i]);
    return demo.sphere_count;
}

EXPORT size_t demo_area_count(void) {
    return demo.area_count;
}

EXPORT const float *demo_areas(void) {
    return demo.areas[0];
}

/* Relights the probes by the lights as demo_move_lights has moved them. */
EXPORT const probes_grid *demo_light_probes(void) {
    probes_light(&demo.probes, demo.emitters, demo.sphere_count + demo.area_count);
    return &demo.probes;
}

/* Lights the splats by the lights as demo_move_lights has moved them; returns all SPLATS_COUNT. */
EXPORT const splats_splat *demo_light_splats(int bands, int window) {
    static splats_splat splats[SPLATS_COUNT];
    static bool placed;
    const lmp_shade_settings settings = { .bands = bands, .window = (lmp_window)window };
    if (!placed)
        splats_place(splats);
    placed = true;
    splats_light(splats, &settings, demo.emitters, demo.sphere_count + demo.area_count);
    return splats;
}

EXPORT size_t demo_splat_count(void) {
    return SPLATS_COUNT;
}

/* Moves sphere i. */
EXPORT void demo_drag_light(size_t i, float x, float y, float z) {
    scene_light *light = demo.world.lights;
    for (size_t before = 0; light->emitter.kind != LMP_LIGHT_SPHERE || before++ < i; light++) {
    }
    lmp_vec3 *position = &light->emitter.position;
    *position = (lmp_vec3) { position->x + x, position->y + y, position->z + z };
}

/* --- numbers ---------------------------------------------------------------------------------- */

EXPORT const float *demo_ggx_texels(void) {
    static float texels[LMP_GGX_TEXELS * 4];
    lmp_lobe_copy_ggx_texels(texels);
    return texels;
}

EXPORT float demo_exposure(int width, int height, float *rgb) {
    return image_auto_exposure(&(image) { .width = width, .height = height, .rgb = rgb });
}

/* A preintegrated lobe as the shader reads it: the block's floats, then the height of the texture
 * of pairs, and the pairs. */
typedef struct demo_lobe {
    shared_preintegrated_lobe block;
    uint32_t height;
    float *pairs;
} demo_lobe;

enum { LOBE_WIDTH = 2048 };

static float *lay_out(const lmp_preintegrated_lobe_info *info, demo_lobe *to) {
    gpu_shelves shelves = { .width = LOBE_WIDTH };
    for (uint32_t i = 0; i < info->cell_count; i++) {
        const lmp_preintegrated_lobe_cell *cell = &info->cells[i];
        const gpu_corner corner = gpu_shelves_put(&shelves, (int)cell->columns, (int)cell->rows);
        float *const block = to->block.cells[i];
        block[0] = cell->scale;
        block[1] = cell->offset;
        block[2] = (float)corner.x;
        block[3] = (float)corner.y;
    }
    to->height = (uint32_t)shelves.bottom;
    float *const pairs = calloc((size_t)shelves.bottom * LOBE_WIDTH, 2 * sizeof *pairs);
    for (uint32_t i = 0; pairs && i < info->cell_count; i++) {
        const lmp_preintegrated_lobe_cell *cell = &info->cells[i];
        const size_t x = (size_t)to->block.cells[i][2], y = (size_t)to->block.cells[i][3];
        const int16_t *from = info->coefficients + 2 * (size_t)cell->first;
        for (size_t row = 0; row < cell->rows; row++)
            for (size_t k = 0; k < 2 * (size_t)cell->columns; k++)
                pairs[2 * ((y + row) * LOBE_WIDTH + x) + k] = (float)*from++ / 32767.0f;
    }
    return pairs;
}

/* Makes a lobe and frees the one before; returns NULL if it cannot be made. */
EXPORT const demo_lobe *demo_make_lobe(int bands, int window) {
    static demo_lobe made;
    const lmp_preintegrated_lobe_desc desc = { .bands = bands, .window = (lmp_window)window };
    lmp_preintegrated_lobe *lobe;
    free(made.pairs);
    memset(&made, 0, sizeof made);
    if (lmp_preintegrated_lobe_create(NULL, &desc, &lobe) != LMP_OK)
        return NULL;
    const lmp_preintegrated_lobe_info info = lmp_preintegrated_lobe_describe(lobe);
    if (info.cell_count <= SHARED_PREINTEGRATED_LOBE_CELLS &&
        (made.pairs = lay_out(&info, &made))) {
        const float shape[4] = { info.width2, (float)info.cell_count, 1.0f / LOBE_WIDTH,
                                 1.0f / (float)made.height };
        memcpy(made.block.shape, shape, sizeof shape);
        memcpy(made.block.remap, info.remap, LMP_PREINTEGRATED_LOBE_REMAP_COUNT * sizeof(float));
    }
    lmp_preintegrated_lobe_destroy(lobe);
    return made.pairs ? &made : NULL;
}

/* --- what the kernels cost -------------------------------------------------------------------- */

enum { POINTS = 256 };

/* Shades vertices of the scene under all its lights by the library's kernels, with vector
 * instructions or without; returns the number of points times lights. The page measures the time.
 */
EXPORT size_t demo_shade(int bands, int vectors) {
    static lmp_surface surfaces[POINTS];
    static float rgb[3 * POINTS];
    const lmp_material clay = { .diffuse = { 0.5f, 0.5f, 0.5f },
                                .specular = { 0.04f, 0.04f, 0.04f },
                                .exponent = 30 };
    const lmp_shade_settings settings = { .bands = bands, .window = LMP_WINDOW_HANNING };
    const scene *w = &demo.world;
    for (size_t i = 0; i < POINTS; i++) {
        const scene_vertex *v = &w->vertices[i * (w->vertex_count - 1) / POINTS];
        const lmp_vec3 normal = { v->normal[0], v->normal[1], v->normal[2] };
        surfaces[i] =
            (lmp_surface) { .position = { v->position[0], v->position[1], v->position[2] },
                            .normal = normal,
                            .view = normal };
    }
    for (size_t i = 0; i < w->light_count; i++)
        demo.emitters[i] = w->lights[i].emitter;
    const size_t stride = sizeof *surfaces;
    const lmp_surfaces all = {
        .position = { &surfaces->position.x, &surfaces->position.y, &surfaces->position.z, stride },
        .normal = { &surfaces->normal.x, &surfaces->normal.y, &surfaces->normal.z, stride },
        .view = { &surfaces->view.x, &surfaces->view.y, &surfaces->view.z, stride },
        .material = &clay
    };
    lmp_cpu_limit(vectors ? LMP_CPU_ALL : LMP_CPU_SCALAR);
    lmp_shade_n(&settings, &all, POINTS, demo.emitters, w->light_count, (lmp_rgb_array) { rgb, 0 });
    return POINTS * w->light_count;
}
