/* SPDX-License-Identifier: MIT */
/* gltf_export.c - copies a glTF file with other lights: the inverse of gltf_view.c. */
#include "app/base/file.h"
#include "app/base/file_json.h"
#include "app/base/file_writer.h"
#include "app/scene/gltf/gltf.h"
#include "app/scene/vector.h"
#include "app/scene/world.h"

#include <limits.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

/* The node that holds the lights of a copy; a copy of the copy replaces it. */
#define GROUP      "Lampion lights"
#define SIZE_LIMIT ((size_t)4 << 30)

static const char *const extensions[] = { "KHR_lights_punctual", "EXT_lights_area" };
enum { PUNCTUAL, AREA, EXTENSIONS };

/* A copy in the making, and what glTF cannot say. */
typedef struct export {
    const scene *world;
    json_t *nodes, *children, *lights[EXTENSIONS];
    size_t left_out[SCENE_LIGHT_KIND_COUNT], parallel, seen;
    bool ok; /* whether memory has sufficed so far */
}
export;

/* --- the old lights --------------------------------------------------------------------------- */

static void remove_member(json_t *object, const char *name, const char *from) {
    json_t *list = json_object_get(object, from), *item;
    size_t i;
    json_object_del(list, name);
    json_array_foreach (list, i, item)
        if (json_is_string(item) && strcmp(json_string_value(item), name) == 0)
            json_array_remove(list, i--);
    if (json_object_size(list) + json_array_size(list) == 0)
        json_object_del(object, from);
}

/* Removes the last node and what it holds, if an earlier copy has added it. */
static void remove_group(const gltf *document) {
    json_t *nodes = document->lists[GLTF_NODES];
    size_t at = 0, i, k;
    const size_t count = json_array_size(nodes);
    while (at < count && strcmp(gltf_text(json_array_get(nodes, at), "name"), GROUP) != 0)
        at++;
    if (at == count ||
        json_array_size(json_object_get(json_array_get(nodes, at), "children")) != count - at - 1)
        return;
    for (i = count; i-- > at;)
        json_array_remove(nodes, i);
    json_t *entry, *item;
    json_array_foreach (document->lists[GLTF_SCENES], i, entry) {
        json_t *roots = json_object_get(entry, "nodes");
        json_array_foreach (roots, k, item)
            if (json_number_value(item) == (double)at)
                json_array_remove(roots, k--);
    }
}

static void remove_lights(const gltf *document) {
    json_t *node;
    size_t i;
    for (int e = 0; e < EXTENSIONS; e++) {
        json_array_foreach (document->lists[GLTF_NODES], i, node)
            remove_member(node, extensions[e], "extensions");
        remove_member(document->root, extensions[e], "extensions");
        remove_member(document->root, extensions[e], "extensionsUsed");
        remove_member(document->root, extensions[e], "extensionsRequired");
    }
    remove_group(document);
}

/* --- the new lights --------------------------------------------------------------------------- */

/* Returns an entry of a color up to 1 and what multiplies it. */
static json_t *make_light(const char *type, lmp_rgb color, double by) {
    const double r = (double)color.r, g = (double)color.g, b = (double)color.b;
    const double most = fmax(r, fmax(g, b)), unit = most > 0.0 ? most : 1.0;
    return json_pack("{s:s, s:[f, f, f], s:f}", "type", type, "color", r / unit, g / unit, b / unit,
                     "intensity", most * by);
}

/* Writes a vector in the axes of the file as a column of a matrix. */
static void set_column(const export *e, const double v[3], double column[3]) {
    column[0] = v[0];
    const bool stood = e->world->up == SCENE_UP_Z;
    column[1] = stood ? -v[2] : v[1];
    column[2] = stood ? v[1] : v[2];
}

/* Adds a light and the node that holds it, which has its unit x and z axis along these vectors. */
static void add(export *e, const lmp_light *light, int extension, json_t *entry, lmp_vec3 x,
                lmp_vec3 z) {
    const lmp_vec3 axes[3] = { x, vec_cross(z, x), z };
    double m[16] = { [15] = 1.0 }, point[3];
    float position[3];
    json_t *matrix = json_array();
    for (int k = 0; k < 3; k++)
        set_column(e, (double[]) { (double)axes[k].x, (double)axes[k].y, (double)axes[k].z },
                   m + 4 * k);
    vec_store(light->position, position);
    scene_point_to_world(e->world->origin, position, point);
    set_column(e, point, m + 12);
    for (int i = 0; i < 16; i++)
        matrix = file_json_append(matrix, json_real(m[i]));
    json_t *node = json_pack("{s:s, s:o, s:{s:{s:i}}}", "name", scene_light_kinds[light->kind].name,
                             "matrix", matrix, "extensions", extensions[extension], "light",
                             (int)json_array_size(e->lights[extension]));
    json_t *number = json_integer((json_int_t)json_array_size(e->nodes));
    e->ok &= json_array_append_new(e->lights[extension], entry) == 0;
    e->ok &= json_array_append_new(e->children, number) == 0;
    e->ok &= json_array_append_new(e->nodes, node) == 0;
}

/* Adds a light that shines along -z. */
static void add_along(export *e, const lmp_light *light, int extension, json_t *entry,
                      lmp_vec3 direction) {
    const lmp_vec3 z = vec_scale(direction, -1);
    add(e, light, extension, entry, vec_across(z), z);
}

static void add_spot(export *e, const lmp_light *light) {
    json_t *cone = json_pack("{s:f, s:f}", "innerConeAngle", (double)light->inner, "outerConeAngle",
                             (double)light->outer);
    json_t *entry = file_json_with(make_light("spot", light->intensity, 1), "spot", cone);
    add_along(e, light, PUNCTUAL, entry, light->direction);
}

static void add_sphere(export *e, const lmp_light *light) {
    const double radius = (double)light->radius;
    json_t *entry = make_light("point", light->radiance, M_PI * radius * radius);
    json_t *extras = json_pack("{s:f}", "radius", radius);
    add(e, light, PUNCTUAL, file_json_with(entry, "extras", extras), vec(1, 0, 0), vec(0, 0, 1));
}

/* Adds a disk or a rectangle, and if it shines from both sides another that faces back. */
static void add_area(export *e, const lmp_light *light) {
    const bool disk = light->kind == LMP_LIGHT_DISK;
    const float width = disk ? 0 : vec_length(light->half[0]);
    const float height = disk ? light->radius : vec_length(light->half[1]);
    lmp_vec3 x = disk ? vec_across(light->direction) : vec_scale(light->half[0], 1 / width);
    const lmp_vec3 front =
        disk ? light->direction : vec_cross(x, vec_scale(light->half[1], 1 / height));
    for (int side = 0; side <= (int)light->two_sided; side++) {
        json_t *entry = file_json_with(make_light(disk ? "disk" : "rect", light->radiance, 1),
                                       "size", json_real(2 * (double)height));
        if (!disk)
            entry = file_json_with(entry, "rect",
                                   json_pack("{s:f}", "aspect", (double)width / (double)height));
        add(e, light, AREA, entry, x, vec_scale(front, side ? 1 : -1));
        x = vec_scale(x, -1);
    }
}

/* Whether the sides of a rectangle are perpendicular, as glTF's are. */
static bool is_right_angled(const lmp_light *light) {
    const float along = vec_dot(light->half[0], light->half[1]);
    return fabsf(along) <= 1e-5f * vec_length(light->half[0]) * vec_length(light->half[1]);
}

/* Whether glTF has a light of this kind and shape, or parallel light in place of a cap. */
static bool can_say(const lmp_light *light) {
    switch (light->kind) {
    case LMP_LIGHT_SPOT:
        return light->outer <= 0.5f * PI;
    case LMP_LIGHT_CAP:
        return light->angle <= 0.5f * PI;
    case LMP_LIGHT_RECTANGLE:
        return is_right_angled(light);
    case LMP_LIGHT_HEMISPHERE:
    case LMP_LIGHT_TUBE:
    case LMP_LIGHT_POLYGON:
        return false;
    default:
        return true;
    }
}

static void add_light(export *e, const scene_light *given) {
    const lmp_light *light = &given->emitter;
    const double sine = sin((double)light->angle);
    if (!can_say(light)) {
        e->left_out[light->kind]++;
        return;
    }
    e->parallel += light->kind == LMP_LIGHT_CAP;
    e->seen += given->hidden && (light->kind == LMP_LIGHT_SPHERE || scene_light_is_area(light));
    if (light->kind == LMP_LIGHT_SPHERE)
        add_sphere(e, light);
    else if (light->kind == LMP_LIGHT_POINT)
        add(e, light, PUNCTUAL, make_light("point", light->intensity, 1), vec(1, 0, 0),
            vec(0, 0, 1));
    else if (light->kind == LMP_LIGHT_SPOT)
        add_spot(e, light);
    else if (scene_light_is_area(light))
        add_area(e, light);
    else
        add_along(e, light, PUNCTUAL,
                  make_light("directional", light->radiance,
                             light->kind == LMP_LIGHT_CAP ? M_PI * sine * sine : 1),
                  vec_scale(light->direction, -1));
}

/* Whether a light is that of a surface which glows and gives it to whoever reads the copy. Lights
 * that were saved and read again no longer tell so, but are the same. */
static bool is_glow(const scene *world, const scene_light *light) {
    for (size_t i = 0; i < world->light_count; i++)
        if (world->lights[i].glow &&
            memcmp(&world->lights[i].emitter, &light->emitter, sizeof light->emitter) == 0)
            return true;
    return false;
}

/* Whether surfaces of the file glow as lamps do. */
static bool has_lamps(const scene *world) {
    for (size_t i = 0; i < world->material_count; i++) {
        const scene_material *m = &world->materials[i];
        if (!(m->flags & (SCENE_UNLIT | SCENE_GLOWS_ALONE)) &&
            m->emission[0] + m->emission[1] + m->emission[2] > 0)
            return true;
    }
    return false;
}

/* Whether the lights have not all those of the surfaces that glow, as the file gives them. */
static bool changes_lamps(const scene *world, const scene_light *lights, size_t count) {
    size_t own = 0, kept = 0, edited = 0;
    for (size_t i = 0; i < world->light_count; i++)
        own += world->lights[i].glow > 0;
    for (size_t i = 0; i < count; i++) {
        const bool same = is_glow(world, &lights[i]);
        kept += same;
        edited += lights[i].glow && !same;
    }
    return own != kept || edited > 0 || (own == 0 && has_lamps(world));
}

/* --- the document ----------------------------------------------------------------------------- */

static bool declare(const gltf *document, const char *name, json_t *lights) {
    json_t *root = document->root;
    for (int i = 0; i < 2; i++) {
        const char *const member = i ? "extensionsUsed" : "extensions";
        if (!json_object_get(root, member))
            json_object_set_new(root, member, i ? json_array() : json_object());
    }
    return json_array_append_new(json_object_get(root, "extensionsUsed"), json_string(name)) == 0 &&
           json_object_set_new(json_object_get(root, "extensions"), name,
                               json_pack("{s:O}", "lights", lights)) == 0;
}

/* Puts the lights in place of those that the document has, below a node of their own. */
static bool replace_lights(export *e, const gltf *document, const scene_light *lights, size_t count,
                           base_error *error) {
    const long shown = gltf_index(document->root, "scene");
    json_t *entry = json_array_get(document->lists[GLTF_SCENES], shown < 0 ? 0 : (size_t)shown);
    if (!entry)
        return base_fail(error, document->subject, "has no scene that shows anything");
    remove_lights(document);
    if (!json_object_get(entry, "nodes"))
        json_object_set_new(entry, "nodes", json_array());
    e->nodes = document->lists[GLTF_NODES];
    e->children = json_array();
    e->ok = json_array_append_new(json_object_get(entry, "nodes"),
                                  json_integer((json_int_t)json_array_size(e->nodes))) == 0;
    e->ok &= json_array_append_new(
                 e->nodes, json_pack("{s:s, s:o}", "name", GROUP, "children", e->children)) == 0;
    for (int i = 0; i < EXTENSIONS; i++)
        e->lights[i] = json_array();
    for (size_t i = 0; i < count && e->ok; i++)
        if (!is_glow(e->world, &lights[i]))
            add_light(e, &lights[i]);
    if (json_array_size(e->children) == 0)
        remove_group(document);
    for (int i = 0; i < EXTENSIONS; i++) {
        if (json_array_size(e->lights[i]) > 0)
            e->ok &= declare(document, extensions[i], e->lights[i]);
        json_decref(e->lights[i]);
    }
    return e->ok || base_fail(error, NULL, "out of memory");
}

/* --- what is lost ----------------------------------------------------------------------------- */

static void tell(char *text, size_t size, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

static void tell(char *text, size_t size, const char *format, ...) {
    const size_t used = strlen(text);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text + used, size - used, format, arguments);
    va_end(arguments);
}

/* Says in one line what glTF cannot. */
static void describe_loss(const export *e, bool lamps, char *text, size_t size) {
    text[0] = '\0';
    for (int kind = 0; kind < SCENE_LIGHT_KIND_COUNT; kind++)
        if (e->left_out[kind] > 0)
            tell(text, size, "%s%zu %s", text[0] ? ", " : "without ", e->left_out[kind],
                 scene_light_kinds[kind].name);
    if (e->parallel > 0)
        tell(text, size, "%s%zu cap as parallel light", text[0] ? "; " : "", e->parallel);
    if (e->seen > 0)
        tell(text, size, "%s%zu hidden to be seen", text[0] ? "; " : "", e->seen);
    if (lamps)
        tell(text, size, "%swhat glows lights as before", text[0] ? "; " : "");
}

/* --- the file --------------------------------------------------------------------------------- */

static bool is_glb(const void *data, size_t size) {
    return size >= 4 && memcmp(data, "glTF", 4) == 0;
}

/* Whether a buffer or an image lies in a file of its own. */
static bool has_files(const gltf *document) {
    static const gltf_kind kinds[] = { GLTF_BUFFERS, GLTF_IMAGES };
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++)
        for (size_t i = 0; i < gltf_count(document, kinds[k]); i++) {
            const char *uri = gltf_text(gltf_item(document, kinds[k], i), "uri");
            if (uri[0] && strncmp(uri, "data:", 5) != 0)
                return true;
        }
    return false;
}

/* Whether two paths, or the folders that they lie in, exist and are the same. */
static bool same_file(const char *a, const char *b) {
    struct stat one, other;
    return stat(a, &one) == 0 && stat(b, &other) == 0 && one.st_dev == other.st_dev &&
           one.st_ino == other.st_ino;
}

static bool same_folder(const char *a, const char *b) {
    const char *paths[2] = { a, b };
    char folders[2][PATH_MAX];
    for (int i = 0; i < 2; i++) {
        const char *slash = strrchr(paths[i], '/');
        snprintf(folders[i], sizeof folders[i], "%.*s", slash ? (int)(slash - paths[i]) + 1 : 1,
                 slash ? paths[i] : ".");
    }
    return same_file(folders[0], folders[1]);
}

/* Whether the copy may have this name: its format's, not the file's own, and where its files are
 * found. */
static bool check_path(const gltf *document, bool glb, const char *path, base_error *error) {
    const char *from = document->subject, *dot = strrchr(path, '.');
    if (!dot || strcasecmp(dot, glb ? ".glb" : ".gltf") != 0)
        return base_fail(error, path, "is the name of no %s, as the scene is",
                         glb ? "GLB" : "glTF");
    if (same_file(from, path))
        return base_fail(error, path, "is the scene itself: give the copy another name");
    return !has_files(document) || same_folder(from, path) ||
           base_fail(error, path, "must lie beside %s, whose buffers and images it shares", from);
}

static void put_number(FILE *stream, size_t number) {
    for (int shift = 0; shift < 32; shift += 8)
        putc((int)(number >> shift & 0xff), stream);
}

static size_t padded(size_t size) {
    return (size + 3) & ~(size_t)3;
}

static void put_chunk(FILE *stream, const char *type, const void *bytes, size_t size,
                      char padding) {
    put_number(stream, padded(size));
    fwrite(type, 1, 4, stream);
    fwrite(bytes, 1, size, stream);
    for (; size % 4; size++)
        putc(padding, stream);
}

static bool write_glb(const gltf_bytes *binary, const char *text, const char *path,
                      base_error *error) {
    const size_t length = strlen(text), rest = binary->bytes ? 8 + padded(binary->size) : 0;
    const size_t size = 20 + padded(length) + rest;
    file_writer writer;
    if (size > UINT32_MAX)
        return base_fail(error, path, "would be too large for a GLB");
    if (!file_write_begin(&writer, path, error))
        return false;
    fwrite("glTF", 1, 4, writer.stream);
    put_number(writer.stream, 2);
    put_number(writer.stream, size);
    put_chunk(writer.stream, "JSON", text, length, ' ');
    if (binary->bytes)
        put_chunk(writer.stream, "BIN", binary->bytes, binary->size, 0);
    return file_write_commit(&writer, error);
}

static bool write_document(const gltf *document, bool glb, const char *path, base_error *error) {
    char *text = file_json_text(json_incref(document->root), !glb, path, error);
    const bool ok = text && (glb ? write_glb(&document->binary, text, path, error)
                                 : file_write_whole(path, text, strlen(text), error));
    free(text);
    return ok;
}

bool scene_is_gltf(const char *name) {
    const char *dot = strrchr(name, '.');
    return scene_is_file(name) && dot &&
           (strcasecmp(dot, ".gltf") == 0 || strcasecmp(dot, ".glb") == 0);
}

bool scene_export_gltf(const scene *world, const scene_light *lights, size_t count,
                       const char *path, char *lost, size_t lost_size, base_error *error) {
    void *data;
    size_t size;
    gltf document;
    scene_builder notes = { .out_of_memory = false };
    source_set sources = { .subject = world->name };
    export e = { .world = world };
    if (!scene_is_gltf(world->name))
        return base_fail(error, world->name,
                         "is not glTF, which alone can carry lights: export them as .json");
    if (!file_read(world->name, SIZE_LIMIT, &data, &size, error))
        return false;
    const bool ok = gltf_open(data, size, &sources, &notes, &document, error) &&
                    check_path(&document, is_glb(data, size), path, error) &&
                    replace_lights(&e, &document, lights, count, error) &&
                    write_document(&document, is_glb(data, size), path, error);
    describe_loss(&e, changes_lamps(world, lights, count), lost, lost_size);
    gltf_close(&document);
    builder_free(&notes);
    free(data);
    return ok;
}
