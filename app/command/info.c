/* SPDX-License-Identifier: MIT */
/* info.c - lampion info: what is in a scene, or in a field (info_field.c). */
#include "app/command/info.h"
#include "app/cli/printable.h"
#include "app/file/file.h"
#include "app/scene/instance.h"
#include "app/scene/world.h"

#include <cjson/cJSON.h>
#include <stdio.h>
#include <stdlib.h>

static void add_materials(cJSON *root, const scene *s) {
    cJSON *list = cJSON_AddArrayToObject(root, "materials");
    for (size_t i = 0; i < s->material_count; i++) {
        const scene_material *material = &s->materials[i];
        cJSON *entry = cJSON_CreateObject();
        cJSON_AddStringToObject(entry, "name", material->name);
        file_json_add_floats(entry, "base_color", material->base_color, 4);
        cJSON_AddNumberToObject(entry, "metallic", (double)material->metallic);
        cJSON_AddNumberToObject(entry, "roughness", (double)material->roughness);
        file_json_add_floats(entry, "emission", material->emission, 3);
        cJSON_AddBoolToObject(entry, "double_sided", (material->flags & SCENE_DOUBLE_SIDED) != 0);
        cJSON_AddBoolToObject(entry, "alpha_blend", (material->flags & SCENE_ALPHA_BLEND) != 0);
        cJSON_AddBoolToObject(entry, "alpha_mask", (material->flags & SCENE_ALPHA_MASK) != 0);
        cJSON_AddItemToArray(list, entry);
    }
}

static void add_lights(cJSON *root, const scene *s) {
    cJSON *list = cJSON_AddArrayToObject(root, "lights");
    for (size_t i = 0; i < s->light_count; i++)
        cJSON_AddItemToArray(list, scene_light_to_json(&s->lights[i], s->origin));
}

static cJSON *describe(const scene *s) {
    cJSON *root = cJSON_CreateObject();
    cJSON_AddStringToObject(root, "scene", s->name);
    cJSON_AddBoolToObject(root, "cached", s->cached);
    cJSON_AddNumberToObject(root, "triangles", (double)scene_triangle_count(s));
    cJSON_AddNumberToObject(root, "vertices", (double)s->vertex_count);
    cJSON_AddNumberToObject(root, "instances", (double)s->instance_count);
    scene_add_world(root, "minimum", s->origin, s->minimum);
    scene_add_world(root, "maximum", s->origin, s->maximum);
    cJSON_AddNumberToObject(root, "area", scene_area(s));
    cJSON *meshes = cJSON_AddArrayToObject(root, "meshes");
    for (size_t i = 0; i < s->mesh_count; i++) {
        cJSON *entry = cJSON_CreateObject();
        cJSON_AddStringToObject(entry, "name", s->meshes[i].name);
        cJSON_AddNumberToObject(entry, "triangles", s->meshes[i].index_count / 3);
        cJSON_AddStringToObject(entry, "material", s->materials[s->meshes[i].material].name);
        cJSON_AddItemToArray(meshes, entry);
    }
    add_materials(root, s);
    cJSON *variants = cJSON_AddArrayToObject(root, "variants");
    for (size_t i = 0; i < s->variant_count; i++)
        cJSON_AddItemToArray(variants, cJSON_CreateString(s->variants[i].name));
    cJSON *textures = cJSON_AddArrayToObject(root, "textures");
    for (size_t i = 0; i < s->texture_count; i++) {
        cJSON *entry = cJSON_CreateObject();
        cJSON_AddStringToObject(entry, "name", s->textures[i].name);
        cJSON_AddNumberToObject(entry, "width", s->textures[i].width);
        cJSON_AddNumberToObject(entry, "height", s->textures[i].height);
        cJSON_AddBoolToObject(entry, "srgb", s->textures[i].srgb != 0);
        cJSON_AddItemToArray(textures, entry);
    }
    cJSON *cameras = cJSON_AddArrayToObject(root, "cameras");
    for (size_t i = 0; i < s->camera_count; i++) {
        cJSON *entry = cJSON_CreateObject();
        cJSON_AddStringToObject(entry, "name", s->cameras[i].name);
        scene_add_world(entry, "eye", s->origin, s->cameras[i].eye);
        scene_add_world(entry, "target", s->origin, s->cameras[i].target);
        const bool parallel = s->cameras[i].height > 0;
        file_json_add_floats(entry, parallel ? "height" : "fov",
                             parallel ? &s->cameras[i].height : &s->cameras[i].fov, 1);
        cJSON_AddItemToArray(cameras, entry);
    }
    add_lights(root, s);
    cJSON *left_out = cJSON_AddArrayToObject(root, "left_out");
    for (size_t i = 0; i < s->left_out_count; i++) {
        char text[2 * SCENE_NAME_SIZE + 32];
        scene_left_out_text(&s->left_out[i], text, sizeof text);
        cJSON_AddItemToArray(left_out, cJSON_CreateString(text));
    }
    return root;
}

static int print_json(const scene *s) {
    cli_error error;
    return file_json_print(describe(s), s->name, &error) ? CLI_OK : cli_report(&error);
}

static void print_names(const char *what, const char *name, size_t size, size_t count) {
    enum { SHOWN = 12 };
    printf("%-10s %zu", what, count);
    for (size_t i = 0; i < count && i < SHOWN; i++)
        printf("%s%s", i ? ", " : ": ", name[i * size] ? name + i * size : "\"\"");
    puts(count > SHOWN ? ", …" : "");
}

/* "30: 28 sphere, 2 spot" */
static void print_lights(const scene *s) {
    size_t of_kind[LMP_LIGHT_KINDS] = { 0 }, hidden = 0;
    for (size_t i = 0; i < s->light_count; i++) {
        of_kind[s->lights[i].emitter.kind]++;
        hidden += s->lights[i].hidden;
    }
    const char *separator = ": ";
    printf("%-10s %zu", "lights", s->light_count);
    for (int kind = 0; kind < LMP_LIGHT_KINDS; kind++)
        if (of_kind[kind]) {
            printf("%s%zu %s", separator, of_kind[kind], scene_light_kinds[kind].name);
            separator = ", ";
        }
    printf(hidden ? " (%zu of them emissive meshes)\n" : "\n", hidden);
    for (size_t i = 0; i < s->left_out_count; i++) {
        char text[2 * SCENE_NAME_SIZE + 32];
        scene_left_out_text(&s->left_out[i], text, sizeof text);
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
    cli_print_name(s->name);
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

/* A line per light: as JSON, which a file of lights may hold. */
static int print_each_light(const scene *s) {
    for (size_t i = 0; i < s->light_count; i++) {
        cli_error error;
        char *text =
            file_json_text(scene_light_to_json(&s->lights[i], s->origin), false, s->name, &error);
        if (!text)
            return cli_report(&error);
        puts(text);
        free(text);
    }
    return CLI_OK;
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
    cli_error error = { 0 };
    if (!scene_load(operands[0], &load, &loaded, &error))
        return cli_report(&error);
    status = CLI_OK;
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
