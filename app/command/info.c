/* SPDX-License-Identifier: MIT */
/* info.c - lampion info: the contents of a scene, or of a field (info_field.c). */
#include "app/command/info.h"
#include "app/base/cli.h"
#include "app/base/file_json.h"
#include "app/base/printable.h"
#include "app/scene/instance.h"
#include "app/scene/world.h"

#include <stdio.h>
#include <stdlib.h>

static json_t *material_to_json(const scene_material *m) {
    return json_pack(
        "{s:o, s:o, s:o, s:o, s:o, s:b, s:b, s:b}", "name", file_json_string(m->name), "base_color",
        file_json_floats(m->base_color, 4), "metallic", file_json_float(m->metallic), "roughness",
        file_json_float(m->roughness), "emission", file_json_floats(m->emission, 3), "double_sided",
        (m->flags & SCENE_DOUBLE_SIDED) != 0, "alpha_blend", (m->flags & SCENE_ALPHA_BLEND) != 0,
        "alpha_mask", (m->flags & SCENE_ALPHA_MASK) != 0);
}

static json_t *mesh_to_json(const scene *s, const scene_mesh *mesh) {
    return json_pack("{s:o, s:i, s:o}", "name", file_json_string(mesh->name), "triangles",
                     (int)(mesh->index_count / 3), "material",
                     file_json_string(s->materials[mesh->material].name));
}

static json_t *texture_to_json(const scene_texture *texture) {
    return json_pack("{s:o, s:i, s:i, s:b}", "name", file_json_string(texture->name), "width",
                     (int)texture->width, "height", (int)texture->height, "srgb",
                     texture->srgb != 0);
}

static json_t *camera_to_json(const scene *s, const scene_camera *camera) {
    const bool parallel = camera->height > 0;
    return json_pack("{s:o, s:o, s:o, s:o}", "name", file_json_string(camera->name), "eye",
                     scene_world_to_json(s->origin, camera->eye), "target",
                     scene_world_to_json(s->origin, camera->target), parallel ? "height" : "fov",
                     file_json_float(parallel ? camera->height : camera->fov));
}

static json_t *unsupported_to_json(const scene_unsupported *unsupported) {
    char text[2 * SCENE_NAME_SIZE + 32];
    scene_unsupported_text(unsupported, text, sizeof text);
    return file_json_string(text);
}

static json_t *describe(const scene *s) {
    json_t *meshes = json_array(), *materials = json_array(), *variants = json_array(),
           *textures = json_array(), *cameras = json_array(), *lights = json_array(),
           *unsupported = json_array();
    for (size_t i = 0; i < s->mesh_count; i++)
        meshes = file_json_append(meshes, mesh_to_json(s, &s->meshes[i]));
    for (size_t i = 0; i < s->material_count; i++)
        materials = file_json_append(materials, material_to_json(&s->materials[i]));
    for (size_t i = 0; i < s->variant_count; i++)
        variants = file_json_append(variants, file_json_string(s->variants[i].name));
    for (size_t i = 0; i < s->texture_count; i++)
        textures = file_json_append(textures, texture_to_json(&s->textures[i]));
    for (size_t i = 0; i < s->camera_count; i++)
        cameras = file_json_append(cameras, camera_to_json(s, &s->cameras[i]));
    for (size_t i = 0; i < s->light_count; i++)
        lights = file_json_append(lights, scene_light_to_json(&s->lights[i], s->origin));
    for (size_t i = 0; i < s->unsupported_count; i++)
        unsupported = file_json_append(unsupported, unsupported_to_json(&s->unsupported[i]));
    return json_pack("{s:o, s:b, s:I, s:I, s:I, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o}",
                     "scene", file_json_string(s->name), "cached", s->cached, "triangles",
                     (json_int_t)scene_triangle_count(s), "vertices", (json_int_t)s->vertex_count,
                     "instances", (json_int_t)s->instance_count, "minimum",
                     scene_world_to_json(s->origin, s->minimum), "maximum",
                     scene_world_to_json(s->origin, s->maximum), "area",
                     file_json_real(scene_area(s)), "meshes", meshes, "materials", materials,
                     "variants", variants, "textures", textures, "cameras", cameras, "lights",
                     lights, "left_out", unsupported);
}

static int print_json(const scene *s) {
    base_error error;
    return file_json_print(describe(s), s->name, &error) ? BASE_OK : base_report(&error);
}

static void print_names(const char *what, const char *name, size_t size, size_t count) {
    enum { SHOWN = 12 };
    printf("%-10s %zu", what, count);
    for (size_t i = 0; i < count && i < SHOWN; i++)
        printf("%s%s", i ? ", " : ": ", name[i * size] ? name + i * size : "\"\"");
    puts(count > SHOWN ? ", …" : "");
}

/* Prints a summary such as "30: 28 sphere, 2 spot". */
static void print_lights(const scene *s) {
    size_t of_kind[SCENE_LIGHT_KIND_COUNT] = { 0 }, hidden = 0;
    for (size_t i = 0; i < s->light_count; i++) {
        of_kind[s->lights[i].emitter.kind]++;
        hidden += s->lights[i].hidden;
    }
    const char *separator = ": ";
    printf("%-10s %zu", "lights", s->light_count);
    for (int kind = 0; kind < SCENE_LIGHT_KIND_COUNT; kind++)
        if (of_kind[kind]) {
            printf("%s%zu %s", separator, of_kind[kind], scene_light_kinds[kind].name);
            separator = ", ";
        }
    printf(hidden ? " (%zu of them hidden: emissive meshes)\n" : "\n", hidden);
    for (size_t i = 0; i < s->unsupported_count; i++) {
        char text[2 * SCENE_NAME_SIZE + 32];
        scene_unsupported_text(&s->unsupported[i], text, sizeof text);
        printf("%-10s %s\n", i ? "" : "left out", text);
    }
}

static void print_corner(const scene *s, const float corner[3]) {
    for (int k = 0; k < 3; k++) {
        scene_world_text text;
        scene_print_world(s->origin[k], corner[k], 6, text);
        printf(" %s", text);
    }
}

static void print_text(const scene *s) {
    printable_print(s->name);
    puts(s->cached ? " (from the cache)" : "");
    printf("%-10s %zu\n", "triangles", scene_triangle_count(s));
    printf("%-10s %zu\n", "vertices", s->vertex_count);
    printf("%-10s", "bounds");
    print_corner(s, s->minimum);
    printf(" …");
    print_corner(s, s->maximum);
    putchar('\n');
    printf("%-10s %.6g\n", "area", scene_area(s));
    print_names("meshes", s->meshes->name, sizeof *s->meshes, s->mesh_count);
    printf("%-10s %zu\n", "instances", s->instance_count);
    print_names("materials", s->materials->name, sizeof *s->materials, s->material_count);
    if (s->variant_count > 0)
        print_names("variants", s->variants->name, sizeof *s->variants, s->variant_count);
    print_names("textures", s->textures->name, sizeof *s->textures, s->texture_count);
    print_names("cameras", s->cameras->name, sizeof *s->cameras, s->camera_count);
    print_lights(s);
}

static void print_materials(const scene *s) {
    for (size_t i = 0; i < s->material_count; i++)
        puts(s->materials[i].name);
}

/* Prints a line of JSON per light, in the form of a lights file. */
static int print_each_light(const scene *s) {
    for (size_t i = 0; i < s->light_count; i++) {
        base_error error;
        char *text =
            file_json_text(scene_light_to_json(&s->lights[i], s->origin), false, s->name, &error);
        if (!text)
            return base_report(&error);
        puts(text);
        free(text);
    }
    return BASE_OK;
}

static int run(const cli_command *command, int argc, char **argv) {
    bool json = false, materials = false, lights = false;
    scene_options load = { .no_texels = true };
    const cli_option options[] = {
        { .name = "json", .kind = CLI_FLAG, .target = &json, .help = "print everything as JSON" },
        { .name = "materials",
          .kind = CLI_FLAG,
          .target = &materials,
          .help = "print the names of its materials, one per line" },
        { .name = "lights",
          .kind = CLI_FLAG,
          .target = &lights,
          .help = "print its lights, one per line, as a file for --lights has them" },
        { .name = "no-cache",
          .kind = CLI_FLAG,
          .target = &load.no_cache,
          .help = "read the file itself, not its copy in the cache" },
        SCENE_LOAD_OPTION_ROWS(load),
        { 0 },
    };
    int operand_count, status;
    char **operands;
    if (!cli_parse(command, options, argc, argv, &operand_count, &operands, &status))
        return status;
    if (operand_count != 1)
        return cli_usage(command, "needs one scene");
    if (json + materials + lights > 1)
        return cli_usage(command, "give one of --json, --materials and --lights");
    if (info_is_field(operands[0]))
        return materials || lights
                   ? cli_usage(command, "a field has no --%s", materials ? "materials" : "lights")
                   : info_print_field(operands[0], json);
    scene loaded;
    base_error error = { 0 };
    if (!scene_load(operands[0], &load, &loaded, &error))
        return base_report(&error);
    status = BASE_OK;
    if (json)
        status = print_json(&loaded);
    else if (materials)
        print_materials(&loaded);
    else if (lights)
        status = print_each_light(&loaded);
    else
        print_text(&loaded);
    scene_free(&loaded);
    return status;
}

const cli_command command_info = {
    .name = "info",
    .operands = "SCENE",
    .summary = "tell what is in a scene, or in a field (.lmpf)",
    .examples = "lampion info builtin:atrium\n"
                "lampion info --json model.gltf\n"
                "lampion info --lights model.gltf\n"
                "lampion info field.lmpf\n",
    .run = run,
};
