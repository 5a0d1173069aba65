/* SPDX-License-Identifier: MIT */
#include "app/truth/reference.h"
#include "app/base/cli.h"
#include "app/base/number.h"
#include "app/command/command.h"
#include "app/render/method.h"
#include "app/render/renderer/override.h"
#include "app/render/renderer/shadows.h"
#include "app/scene/environment.h"
#include "app/truth/reference_part.h"
#include "app/truth/reference_quadrature.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { RAYS_OF_PNG = 8, RAYS_MAX = 256 /* as in render */, BOUNCES_MAX = 1000 };

typedef struct reference_arguments {
    const char *output;
    int size[2];
    scene_camera_options camera;
    scene_lights_options lights;
    environment_options environment;
    shadow_options shadow; /* whether shadows are cast */
    cli_list materials;
    reference_settings settings;
    int bands, window;
    float error, exposure, stops;
    bool exposure_given;
    int tone;
    int samples, rays; /* light samples and camera rays per pixel */
    bool rays_given, shard_given;
    char *const *words; /* of the command line */
    /* A single point instead of an image. */
    bool point_given;
    float point[3], normal[3], view[3], diffuse[3], specular[3], exponent;
    cli_list point_lights;
    scene_options load;
} reference_arguments;

/* Writes the image. A linear image has its standard error as a second layer, and a part also has
 * what merge needs. */
static bool write_image(const reference_arguments *a, const scene *world, image *radiance,
                        image *standard_error, base_error *error) {
    const image_layer layers[] = { { NULL, radiance }, { "stderr", standard_error } };
    const size_t light_count = world->light_count;
    image_make_finite(radiance, a->output);
    image_make_finite(standard_error, a->output);
    if (a->shard_given)
        return reference_part_write(a->output, &a->settings, world, a->words, layers, error);
    if (image_format_of(a->output) == IMAGE_EXR)
        return image_write_exr_layers(a->output, layers, 2, error);
    float exposure = a->exposure_given ? a->exposure
                                       : environment_exposure(a->settings.environment, light_count);
    if (!(exposure > 0)) {
        image lit;
        if (!reference_meter(world, &a->settings, &lit, error))
            return false;
        exposure = image_auto_exposure(&lit);
        image_free(&lit);
    }
    const image_display display = { .exposure = exposure * image_exposure_of_stops(a->stops),
                                    .tone = a->tone };
    return image_write(radiance, a->output, &display, error);
}

/* Chooses the materials in the reference's form, truncated ones as tables. The caller frees the
 * array. */
static bool choose_materials(reference_arguments *a, const scene *world, override_set *all,
                             reference_material_source **sources, base_error *error) {
    const reference_band_limit *limit = &a->settings.band_limit;
    if (!override_open(&a->materials, world, all, error) ||
        (limit->bands && !override_bake(all, limit->bands, limit->window, error)))
        return false;
    if (all->count == 0)
        return true;
    a->settings.materials = *sources = calloc(world->material_count + 1, sizeof **sources);
    if (!*sources)
        return base_fail(error, NULL, "out of memory");
    for (size_t i = 0; i < world->material_count; i++) {
        const int use = all->uses[i];
        if (use < 0)
            continue;
        const lmp_brdf_table *table = limit->bands ? all->tables[use] : all->opened[use].table;
        if (table)
            (*sources)[i] =
                (reference_material_source) { .coefficients = lmp_brdf_table_coefficients(table),
                                              .table = lmp_brdf_table_describe(table) };
        else
            (*sources)[i].brdf = all->opened[use].brdf;
        (*sources)[i].made_from = all->opened[use].hash;
    }
    return true;
}

static bool render(reference_arguments *a, const char *name, base_error *error) {
    scene world;
    environment around = { .bands = 0 };
    image radiance = { .rgb = NULL }, standard_error = { .rgb = NULL };
    reference_settings *settings = &a->settings;
    reference_material_source *sources = NULL;
    override_set all = { .count = 0 };
    if (!scene_load(name, &a->load, &world, error))
        return false;
    settings->width = a->size[0];
    settings->height = a->size[1];
    settings->environment = &around;
    const bool lit = scene_apply_lights(&world, &a->lights, error) &&
                     environment_open(&a->environment, &world, &around, error);
    settings->shadows = lit && shadow_wanted(&a->shadow, &around, &world);
    const bool ok = lit &&
                    scene_place_camera(&world, &a->camera, a->size, &settings->camera, error) &&
                    choose_materials(a, &world, &all, &sources, error) &&
                    reference_render(&world, settings, &radiance, &standard_error, error) &&
                    write_image(a, &world, &radiance, &standard_error, error);
    image_free(&radiance);
    image_free(&standard_error);
    free(sources);
    override_free(&all);
    environment_free(&around);
    scene_free(&world);
    return ok;
}

/* Parses a light, "X,Y,Z,RADIUS,R,G,B". */
static bool parse_light(const char *text, scene_light *light, base_error *error) {
    float values[7];
    const char *at = text;
    for (int i = 0; i < 7; i++) {
        const size_t length = strcspn(at, ",");
        double value;
        if (at[length] != (i < 6 ? ',' : '\0') || !number_read(at, length, &value))
            return base_fail(error, "--light", "\"%s\" is not X,Y,Z,RADIUS,R,G,B", text);
        values[i] = (float)value;
        at += length + 1;
    }
    *light = (scene_light) {
        .emitter = { .position = { values[0], values[1], values[2] },
                     .radius = values[3],
                     .radiance = { values[4], values[5], values[6] } },
    };
    scene_light_error wrong;
    return scene_light_check(light, &wrong) ||
           base_fail(error, "--light", "\"%s\": %s", text, wrong.text + (wrong.text[0] == '.'));
}

static bool solve_point(const reference_arguments *a, base_error *error) {
    scene_light lights[sizeof a->point_lights.items / sizeof *a->point_lights.items];
    reference_material lobes = { .exponent = (double)a->exponent };
    reference_surface surface;
    double radiance[3];
    for (int i = 0; i < a->point_lights.count; i++)
        if (!parse_light(a->point_lights.items[i], &lights[i], error))
            return false;
    for (int c = 0; c < 3; c++) {
        lobes.diffuse[c] = (double)a->diffuse[c];
        lobes.specular[c] = (double)a->specular[c];
    }
    reference_surface_set(&surface, &a->settings.band_limit, &lobes,
                          reference_from_floats(a->point),
                          reference_normalize(reference_from_floats(a->normal)),
                          reference_normalize(reference_from_floats(a->view)));
    reference_quadrature(&surface, lights, (size_t)a->point_lights.count, radiance);
    printf("%.12g %.12g %.12g\n", radiance[0], radiance[1], radiance[2]);
    return true;
}

/* Divides the light samples of a pixel among its camera rays. */
static void share_samples(reference_arguments *a) {
    if (!a->rays_given)
        a->rays = a->output && image_format_of(a->output) == IMAGE_PNG ? RAYS_OF_PNG : 1;
    a->settings.rays = a->rays < a->samples ? a->rays : a->samples;
    a->settings.samples = (a->samples + a->settings.rays - 1) / a->settings.rays;
}

static int execute(const cli_command *command, reference_arguments *a, int count, char **operands) {
    base_error error;
    share_samples(a);
    a->settings.error = (double)a->error;
    a->settings.band_limit =
        (reference_band_limit) { .bands = a->bands, .window = (lmp_window)a->window };
    if (a->point_given) {
        if (count != 0)
            return cli_usage(command, "--point takes no scene: give its lights with --light");
        return solve_point(a, &error) ? BASE_OK : base_report(&error);
    }
    if (count != 1)
        return cli_usage(command, "expected one scene");
    if (!a->output)
        return cli_usage_output(command, "FILE");
    if (a->settings.bounces > 0 && a->bands)
        return cli_usage(command, "--bounces needs whole lobes: a series of --bands cannot be "
                                  "sampled");
    if (a->shard_given &&
        (image_format_of(a->output) != IMAGE_EXR || a->bands || a->error > 0 || a->rays > 1))
        return cli_usage(command, "--shard writes .exr, of whole lobes, a fixed number of samples "
                                  "and one ray per pixel: without --bands, --error and --samples");
    if (a->shard_given && reference_samples(&a->settings) < 1)
        return cli_usage(command, "--shard: part %d of %d has no sample of --spp %d",
                         a->settings.shard[0], a->settings.shard[1], a->settings.samples);
    return image_check_path(a->output, &error) && render(a, operands[0], &error)
               ? BASE_OK
               : base_report(&error);
}

static const reference_arguments defaults = { .size = { 1280, 720 },
                                              .settings = { .seed = 1 },
                                              .samples = 64,
                                              .environment = ENVIRONMENT_DEFAULTS,
                                              .window = LMP_WINDOW_HANNING,
                                              .normal = { 0, 1, 0 },
                                              .view = { 0, 1, 0 },
                                              .diffuse = { 1, 1, 1 } };

static int run(const cli_command *command, int argc, char **argv) {
    reference_arguments a = defaults;
    const cli_option options[] = {
        { "output", 'o', CLI_TEXT, &a.output, "FILE",
          "the image: .exr (linear, the standard error as layer \"stderr\") or .png", 0, 0, NULL,
          NULL },
        { "size", 's', CLI_SIZE, a.size, "WxH", "pixels", 1, IMAGE_SIZE_MAX, NULL, NULL },
        SCENE_CAMERA_OPTION_ROWS(a.camera, a.load),
        OVERRIDE_OPTION_ROW(a.materials),
        { "spp", 0, CLI_INT, &a.samples, "N", "light samples per pixel; with --error the most", 1,
          REFERENCE_SAMPLES_MAX, NULL, NULL },
        { "samples", 0, CLI_INT, &a.rays, "N",
          "camera rays per pixel, which share its light samples; without it 8, or one through the "
          "center for a .exr",
          1, RAYS_MAX, NULL, &a.rays_given },
        { "error", 0, CLI_FLOAT, &a.error, "E",
          "stop a pixel when its standard error is below E times its value; 0 means never", 0, 1,
          NULL, NULL },
        { "shard", 0, CLI_PART, a.settings.shard, "I/N",
          "only part I of N, every N-th sample of each pixel: lampion merge joins the parts", 1,
          REFERENCE_PARTS_MAX, NULL, &a.shard_given },
        { "noise-seed", 0, CLI_SEED, &a.settings.seed, "SEED",
          "seed of the noise: the same seed gives the same image", 0, 0, NULL, NULL },
        SHADOW_SWITCH_ROWS(a.shadow, SHADOW_SUITS),
        { "bounces", 0, CLI_INT, &a.settings.bounces, "N",
          "how often surfaces reflect light on to other surfaces; 0 means direct light alone", 0,
          BOUNCES_MAX, NULL, NULL },
        { "bands", 'n', CLI_INT, &a.bands, "N",
          "truncate the lobes to N bands, as render does; 0 means whole lobes", 0, LMP_BANDS_MAX,
          NULL, NULL },
        { "window", 0, CLI_CHOICE, &a.window, "KIND",
          "windowing filter of lobes truncated by --bands", 0, 0, method_window_names(), NULL },
        IMAGE_DISPLAY_OPTION_ROWS(a.exposure, a.exposure_given, a.stops, a.tone),
        { "threads", 0, CLI_INT, &a.settings.threads, "N",
          "threads to render with; 0 means all cores; the image is the same", 0, 1024, NULL, NULL },
        SCENE_LIGHTS_OPTION_ROWS(a.lights),
        ENVIRONMENT_OPTION_ROWS(a.environment),
        SCENE_LOAD_OPTION_ROWS(a.load),
        { "point", 0, CLI_VEC3, a.point, "X,Y,Z",
          "no image: print the radiance that one point reflects, by quadrature", 0, 0, NULL,
          &a.point_given },
        { "normal", 0, CLI_VEC3, a.normal, "X,Y,Z", "the point's normal", 0, 0, NULL, NULL },
        { "view", 0, CLI_VEC3, a.view, "X,Y,Z", "direction from the point to the viewer", 0, 0,
          NULL, NULL },
        { "diffuse", 0, CLI_VEC3, a.diffuse, "R,G,B", "the point's diffuse albedo", 0, 0, NULL,
          NULL },
        { "specular", 0, CLI_VEC3, a.specular, "R,G,B", "the weight of its Phong lobe", 0, 0, NULL,
          NULL },
        { "exponent", 0, CLI_FLOAT, &a.exponent, "E", "the lobe's exponent", 0, 1e9, NULL, NULL },
        { "light", 0, CLI_LIST, &a.point_lights, "X,Y,Z,RADIUS,R,G,B",
          "a light of the point; may be repeated", 0, 0, NULL, NULL },
        { .name = NULL },
    };
    int count, status;
    char **operands;
    if (!cli_parse(command, options, argc, argv, &count, &operands, &status))
        return status;
    a.words = argv;
    return execute(command, &a, count, operands);
}

const cli_command command_reference = {
    .name = "reference",
    .operands = "SCENE",
    .summary = "render a Monte Carlo reference, without harmonics",
    .examples = "lampion reference builtin:atrium -o truth.exr --random-lights 30 --spp 256\n"
                "lampion reference builtin:balls -o truth.png --error 0.01 --spp 4096\n"
                "lampion reference --point 0,0,0 --normal 0,1,0 --light 0,2,0,0.5,10,10,10\n",
    .run = run,
};
