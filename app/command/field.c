/* SPDX-License-Identifier: MIT */
/* lampion field - an irradiance volume of a scene's lights, in the form that engines use. */
#include "app/base/cli.h"
#include "app/command/command.h"
#include "app/render/renderer/bounces.h"
#include "app/scene/world.h"
#include "app/study/volume.h"

#include <lampion/light.h>

#include <math.h>
#include <string.h>

typedef struct field_options {
    volume_settings settings;
    volume_output output;
    double minimum[3], maximum[3]; /* of the grid, in the world */
    bool minimum_given, maximum_given, shadows;
    scene_lights_options lights;
    environment_options environment;
    scene_options load;
} field_options;

/* Places the grid; without given limits its outer nodes are at the scene's bounds. */
static bool place_grid(const field_options *o, const scene *world, volume_grid *grid,
                       base_error *error) {
    memcpy(grid->minimum, world->minimum, sizeof grid->minimum);
    memcpy(grid->maximum, world->maximum, sizeof grid->maximum);
    if (o->minimum_given)
        scene_point_from_world(world->origin, o->minimum, grid->minimum);
    if (o->maximum_given)
        scene_point_from_world(world->origin, o->maximum, grid->maximum);
    bool extended = false;
    for (int a = 0; a < 3; a++) {
        if (!(fabsf(grid->minimum[a]) <= LMP_LENGTH_MAX &&
              fabsf(grid->maximum[a]) <= LMP_LENGTH_MAX))
            return base_fail(error, NULL, "the grid is too far away (up to %g)",
                             (double)LMP_LENGTH_MAX);
        if (!(grid->minimum[a] <= grid->maximum[a]))
            return base_fail(error, NULL, "the grid ends before it begins: %c from %g to %g",
                             "xyz"[a], scene_to_world(world->origin[a], grid->minimum[a]),
                             scene_to_world(world->origin[a], grid->maximum[a]));
        extended = extended || grid->minimum[a] < grid->maximum[a];
    }
    return extended ||
           base_fail(error, NULL, "the grid has no extent (see --minimum and --maximum)");
}

static bool write_field(const field_options *o, const scene *world, const environment *around,
                        const volume_settings *settings, base_error *error) {
    lmp_field *field;
    if (environment_shines(around))
        return base_fail(error, o->output.path,
                         "a .lmpf holds no environment (give the scene lights, or take "
                         "--environment none)");
    const scene_light *area = scene_find_area(world->lights, world->light_count);
    if (area)
        return base_fail(error, o->output.path,
                         "a .lmpf holds no areas, and light %zu is a %s (probes in .json do)",
                         (size_t)(area - world->lights),
                         scene_light_kinds[area->emitter.kind].name);
    const bool ok = volume_make_field(world, settings, &field, error) &&
                    volume_write_field(field, o->output.path, error);
    if (ok && !scene_origin_is_0(world->origin))
        base_note(o->output.path, "is relative to %.17g,%.17g,%.17g, for a field has float32",
                  world->origin[0], world->origin[1], world->origin[2]);
    lmp_field_destroy(field);
    return ok;
}

static bool write_volume(const field_options *o, const scene *world, const environment *around,
                         const volume_settings *settings, base_error *error) {
    volume made;
    if (!volume_make(world, around, settings, &made, error))
        return false;
    const bool ok = volume_write(&made, &o->output, error);
    volume_free(&made);
    return ok;
}

static bool make(const field_options *o, const char *name, base_error *error) {
    scene world;
    environment around = { .bands = 0 };
    volume_settings settings = o->settings;
    /* surfaces are lit by at least 3 bands */
    const int bands = settings.bounces > 0 && settings.bands < 3 ? 3 : settings.bands;
    if (!o->shadows)
        settings.rays = 0;
    if (!scene_load(name, &o->load, &world, error))
        return false;
    bool ok = place_grid(o, &world, &settings.grid, error) &&
              scene_apply_lights(&world, &o->lights, error) &&
              environment_open(&o->environment, &world, &around, error) &&
              environment_extract_suns(&around, error) &&
              environment_project(&around, bands, error);
    if (ok) {
        world.light_count = environment_add_suns(&around, world.lights, world.light_count);
        ok = (volume_file_of(o->output.path) == VOLUME_LMPF ? write_field : write_volume)(
            o, &world, &around, &settings, error);
    }
    environment_free(&around);
    scene_free(&world);
    return ok;
}

/* Checks what the table of options cannot express. */
static int check_options(const cli_command *command, const field_options *o, int operand_count) {
    const int *counts = o->settings.grid.counts;
    if (operand_count != 1)
        return cli_usage(command, "one SCENE is needed, %d given", operand_count);
    if (!o->output.path)
        return cli_usage_output(command, "FILE");
    const volume_file kind = volume_file_of(o->output.path);
    if (kind == VOLUME_UNKNOWN)
        return cli_usage(command, "%s: unknown kind of file (name it .lmpf, .json, .csv or .npy)",
                         o->output.path);
    if ((long)counts[0] * counts[1] * counts[2] > VOLUME_PROBES_MAX)
        return cli_usage(command, "--grid %dx%dx%d: more than %d probes", counts[0], counts[1],
                         counts[2], VOLUME_PROBES_MAX);
    if (o->settings.preset != VOLUME_OWN && o->settings.bands != 3)
        return cli_usage(command, "--bands %d: %s keeps 3", o->settings.bands,
                         volume_presets()[o->settings.preset]);
    if (kind == VOLUME_LMPF && (o->settings.preset != VOLUME_OWN || o->output.half ||
                                o->output.layout != VOLUME_INTERLEAVED || o->shadows ||
                                o->settings.dering || o->settings.bounces > 0))
        return cli_usage(command,
                         "a .lmpf has no preset, layout, 16 bits, shadows, bounces or deringing");
    if (kind == VOLUME_CSV && o->output.layout == VOLUME_PLANAR)
        return cli_usage(command,
                         "a table has a line a probe: --layout planar takes .json or .npy");
    return BASE_OK;
}

static int run(const cli_command *command, int argc, char **argv) {
    field_options o = {
        .settings = { .grid = { .counts = { 16, 8, 16 } }, .bands = 3, .rays = 64 },
        .environment = ENVIRONMENT_DEFAULTS,
    };
    const double length_max = (double)LMP_LENGTH_MAX;
    const cli_option options[] = {
        { "output", 'o', CLI_TEXT, &o.output.path, "FILE",
          "the volume: .json, .csv, .npy, or .lmpf (the library's own)", 0, 0, NULL, NULL },
        { "grid", 'g', CLI_GRID, o.settings.grid.counts, "NXxNYxNZ",
          "probes along the scene's x, y and z", 2, LMP_FIELD_NODES_MAX, NULL, NULL },
        { "minimum", 0, CLI_POSITION, o.minimum, "X,Y,Z",
          "the first probe; without it a corner of the scene's bounds", -length_max, length_max,
          NULL, &o.minimum_given },
        { "maximum", 0, CLI_POSITION, o.maximum, "X,Y,Z",
          "the last probe; without it the opposite corner", -length_max, length_max, NULL,
          &o.maximum_given },
        { "bands", 'n', CLI_INT, &o.settings.bands, "N", "bands of spherical harmonics", 1,
          LMP_FIELD_BANDS_MAX, NULL, NULL },
        { "preset", 0, CLI_CHOICE, &o.settings.preset, "ENGINE",
          "whose axes, signs, order and factors: those of lampion are radiance as it is", 0, 0,
          volume_presets(), NULL },
        { "dering", 0, CLI_FLAG, &o.settings.dering, NULL,
          "damp each probe's bands until its irradiance is nowhere below 0", 0, 0, NULL, NULL },
        { "layout", 0, CLI_CHOICE, &o.output.layout, "LAYOUT",
          "probe after probe, or value after value: a grid of each", 0, 0, volume_layouts, NULL },
        { "half", 0, CLI_FLAG, &o.output.half, NULL, "round values to 16 bits", 0, 0, NULL, NULL },
        { "shadows", 0, CLI_FLAG, &o.shadows, NULL, "let surfaces hide lights from probes, by rays",
          0, 0, NULL, NULL },
        { "shadow-rays", 0, CLI_INT, &o.settings.rays, "N", "rays of --shadows for each light", 1,
          VOLUME_RAYS_MAX, NULL, NULL },
        BOUNCES_OPTION_ROW(o.settings.bounces),
        SCENE_LIGHTS_OPTION_ROWS(o.lights),
        ENVIRONMENT_OPTION_ROWS(o.environment),
        SCENE_LOAD_OPTION_ROWS(o.load),
        { .name = NULL },
    };
    base_error error;
    int operand_count, status;
    char **operands;
    if (!cli_parse(command, options, argc, argv, &operand_count, &operands, &status))
        return status;
    status = check_options(command, &o, operand_count);
    if (status != BASE_OK)
        return status;
    return make(&o, operands[0], &error) ? BASE_OK : base_report(&error);
}

const cli_command command_field = {
    .name = "field",
    .operands = "SCENE",
    .summary = "make an irradiance volume of a scene's lights for an engine",
    .examples = "lampion field builtin:atrium --grid 32x16x32 --preset unity -o probes.json\n"
                "lampion field scene.gltf --preset unreal --shadows --bounces 4 -o probes.csv\n"
                "lampion field scene.gltf --preset filament --layout planar --half -o probes.npy\n"
                "lampion field scene.gltf --random-lights 1000 --bands 5 -o field.lmpf\n",
    .run = run,
    .kernels = true,
};
