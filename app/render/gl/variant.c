/* SPDX-License-Identifier: MIT */
/* The shading pass of a frame: compiled on first use for its method, bands, window and tables. */
#include "app/render/gl/variant.h"
#include "app/render/gl/block.h"
#include "app/render/gl/preintegrated_brdf.h"
#include "app/render/gl/program.h"
#include "app/render/gl/sheen.h"
#include "app/render/gl/table.h"

#include <stdio.h>

/* Returns the most bands of a variant; tables and areas are summed by bands whatever the method. */
static int variant_bands_max(const gpu_variant *v) {
    const int most = method_table[v->method].bands_max[DEVICE_GPU];
    return (v->tables || v->areas) && most > METHOD_GPU_BANDS_MAX ? METHOD_GPU_BANDS_MAX : most;
}

/* Finds the variant that a frame needs. A shader that sums nothing by bands is the same for all
 * bands and windows. */
static gpu_variant variant_of(const render_materials *materials, const gpu_environment *around,
                              const render_frame *frame) {
    const bool preintegrated = method_table[frame->method].reads & METHOD_READS_PREINTEGRATED;
    const int tables = gpu_tables_by_bands(materials, around->source, frame->method);
    const bool areas = scene_find_area(frame->lights, frame->light_count) != NULL;
    const bool by_bands = !preintegrated || tables || areas;
    return (gpu_variant) { .method = frame->method,
                           .bands = by_bands ? frame->bands : 1,
                           .window = by_bands ? frame->window : LMP_WINDOW_NONE,
                           .tables = tables,
                           .environment_bands =
                               tables ? gpu_environment_reflected(around, frame->bands) : 0,
                           .preintegrated_brdfs =
                               preintegrated && gpu_preintegrated_brdfs_exist(materials),
                           .sheen = gpu_sheen_shade(materials, frame),
                           .areas = areas };
}

/* Checks that the shaders light by the frame's areas: they have no coefficients of them, by which
 * tables and fields light. */
static bool check_areas(const gpu_variant *v, const render_materials *materials,
                        base_error *error) {
    const method_row *row = &method_table[v->method];
    const char *what = row->reads & METHOD_READS_FIELD ? "a field"
                       : row->fragment                 ? "the paper's shader"
                       : materials->table_count > 0    ? "a tabulated material"
                       : v->sheen                      ? "sheen"
                                                       : NULL;
    return !v->areas || !what ||
           base_fail(error, NULL, "%s: the GPU does not light it by areas (the CPU does)", what);
}

/* Prints the weights of the windowing filter as a list for the shader. */
static void print_weights(const gpu_variant *v, char *text, size_t size) {
    float weights[METHOD_GPU_BANDS_MAX];
    size_t used = 0;
    lmp_sh_make_window(v->bands, v->window, 0, weights);
    for (int l = 0; l < v->bands; l++)
        used +=
            (size_t)snprintf(text + used, size - used, "%s%.9f", l ? ", " : "", (double)weights[l]);
}

static GLuint compile_variant(const gpu_variant *v, const gpu_context *context,
                              const gpu_mesh *mesh, base_error *error) {
    static const char *const table_defines[] = { "", "#define TABLE_FULL 0\n",
                                                 "#define TABLE_FULL 1\n" };
    const method_row *row = &method_table[v->method];
    char weights[16 * METHOD_GPU_BANDS_MAX], defines[sizeof weights + 384];
    print_weights(v, weights, sizeof weights);
    snprintf(defines, sizeof defines,
             "%s%s#define SHADE %s\n#define LMP_BANDS %d\n#define LMP_WINDOW_WEIGHTS %s\n"
             "#define TABLE_ENVIRONMENT %d\n%s%s%s%s%s%s",
             gpu_texels_define(context), row->defines ? row->defines : "", row->function, v->bands,
             weights, v->environment_bands, table_defines[v->tables],
             v->preintegrated_brdfs ? "#define SHADE_PREINTEGRATED_BRDF\n" : "",
             mesh->layered ? "#define PIXEL_LAYERED\n" : "",
             mesh->translucent ? "#define PIXEL_TRANSLUCENT\n" : "",
             v->sheen ? "#define PIXEL_SHEEN\n" : "", v->areas ? "#define SHADE_AREAS\n" : "");
    const gpu_stage compute = { GL_COMPUTE_SHADER, row->shader };
    const gpu_stage screen[] = { { GL_VERTEX_SHADER, "screen.vert" },
                                 { GL_FRAGMENT_SHADER, row->shader } };
    return row->fragment ? gpu_program(screen, 2, defines, error)
                         : gpu_program(&compute, 1, defines, error);
}

GLuint gpu_variant_find(gpu_variants *variants, const gpu_context *context, const gpu_mesh *mesh,
                        const render_materials *materials, const gpu_environment *around,
                        const render_frame *frame, base_error *error) {
    gpu_variant wanted = variant_of(materials, around, frame);
    const int bands_max = variant_bands_max(&wanted);
    if (materials->table_count && materials->table_bands > frame->bands) {
        base_fail(error, NULL,
                  "the tables of the materials have %d bands, the image %d (more --bands)",
                  materials->table_bands, frame->bands);
        return 0;
    }
    if (!check_areas(&wanted, materials, error))
        return 0;
    if (frame->bands < 1 || frame->bands > bands_max) {
        base_fail(error, NULL, "%d bands: the method's shader takes 1 to %d", frame->bands,
                  bands_max);
        return 0;
    }
    for (int i = 0; i < variants->count; i++) {
        const gpu_variant *v = &variants->items[i];
        if (v->method == wanted.method && v->bands == wanted.bands && v->window == wanted.window &&
            v->tables == wanted.tables && v->preintegrated_brdfs == wanted.preintegrated_brdfs &&
            v->environment_bands == wanted.environment_bands && v->sheen == wanted.sheen &&
            v->areas == wanted.areas)
            return v->program;
    }
    wanted.program = compile_variant(&wanted, context, mesh, error);
    if (!wanted.program)
        return 0;
    if (variants->count == GPU_VARIANTS)
        glDeleteProgram(variants->items[--variants->count].program);
    variants->items[variants->count++] = wanted;
    return wanted.program;
}

void gpu_variants_delete(gpu_variants *variants) {
    for (int i = 0; i < variants->count; i++)
        glDeleteProgram(variants->items[i].program);
}
