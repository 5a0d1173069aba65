/* SPDX-License-Identifier: MIT */
/* The shading pass of a frame: compiled on first use for its method, bands, window and tables. */
#include "app/render/gl/internal.h"

#include <stdio.h>

/* The most bands of a variant: tables of materials are summed by bands whatever the method is. */
static int variant_bands_max(const gpu_variant *v) {
    const int most = method_table[v->method].bands_max[DEVICE_GPU];
    return v->tables && most > METHOD_GPU_BANDS_MAX ? METHOD_GPU_BANDS_MAX : most;
}

/* What a frame asks of the shading pass. A shader that sums nothing by bands is the same for all.
 */
static gpu_variant variant_of(const gpu_renderer *r, const render_frame *frame) {
    const bool preintegrated = method_table[frame->method].reads & METHOD_READS_PREINTEGRATED;
    const int tables = gpu_tables_by_bands(r, frame->method);
    const bool by_bands = !preintegrated || tables;
    return (gpu_variant) { .method = frame->method,
                           .bands = by_bands ? frame->bands : 1,
                           .window = by_bands ? frame->window : LMP_WINDOW_NONE,
                           .tables = tables,
                           .environment_bands = tables ? gpu_reflected_bands(r, frame->bands) : 0,
                           .preintegrated_brdfs = preintegrated && gpu_has_preintegrated_brdf(r),
                           .fibers = gpu_shades_fibers(r, frame) };
}

/* The weights of the windowing filter, as the shader's list of numbers. */
static void print_weights(const gpu_variant *v, char *text, size_t size) {
    float weights[METHOD_GPU_BANDS_MAX];
    size_t used = 0;
    lmp_sh_window(v->bands, v->window, 0, weights);
    for (int l = 0; l < v->bands; l++)
        used +=
            (size_t)snprintf(text + used, size - used, "%s%.9f", l ? ", " : "", (double)weights[l]);
}

static GLuint compile_variant(const gpu_variant *v, bool layered, cli_error *error) {
    static const char *const table_defines[] = { "", "#define TABLE_FULL 0\n",
                                                 "#define TABLE_FULL 1\n" };
    const method_row *row = &method_table[v->method];
    char weights[16 * METHOD_GPU_BANDS_MAX], defines[sizeof weights + 320];
    print_weights(v, weights, sizeof weights);
    snprintf(defines, sizeof defines,
             "%s#define SHADE %s\n#define LMP_BANDS %d\n#define LMP_WINDOW_WEIGHTS %s\n"
             "#define TABLE_ENVIRONMENT %d\n%s%s%s%s",
             row->defines ? row->defines : "", row->function, v->bands, weights,
             v->environment_bands, table_defines[v->tables],
             v->preintegrated_brdfs ? "#define SHADE_PREINTEGRATED_BRDF\n" : "",
             layered ? "#define PIXEL_LAYERED\n" : "", v->fibers ? "#define PIXEL_FIBERS\n" : "");
    const gpu_stage compute = { GL_COMPUTE_SHADER, row->shader };
    const gpu_stage screen[] = { { GL_VERTEX_SHADER, "screen.vert" },
                                 { GL_FRAGMENT_SHADER, row->shader } };
    return row->fragment ? gpu_program(screen, 2, defines, error)
                         : gpu_program(&compute, 1, defines, error);
}

GLuint gpu_variant_find(gpu_renderer *r, const render_frame *frame, cli_error *error) {
    gpu_variant wanted = variant_of(r, frame);
    const int bands_max = variant_bands_max(&wanted);
    if (r->materials.table_count && r->materials.table_bands > frame->bands) {
        cli_fail(error, NULL,
                 "the tables of the materials have %d bands, the image %d (more --bands)",
                 r->materials.table_bands, frame->bands);
        return 0;
    }
    if (frame->bands < 1 || frame->bands > bands_max) {
        cli_fail(error, NULL, "%d bands: the method's shader takes 1 to %d", frame->bands,
                 bands_max);
        return 0;
    }
    for (int i = 0; i < r->variant_count; i++) {
        const gpu_variant *v = &r->variants[i];
        if (v->method == wanted.method && v->bands == wanted.bands && v->window == wanted.window &&
            v->tables == wanted.tables && v->preintegrated_brdfs == wanted.preintegrated_brdfs &&
            v->environment_bands == wanted.environment_bands && v->fibers == wanted.fibers)
            return v->program;
    }
    wanted.program = compile_variant(&wanted, r->mesh.layered, error);
    if (!wanted.program)
        return 0;
    if (r->variant_count == GPU_VARIANTS)
        glDeleteProgram(r->variants[--r->variant_count].program);
    r->variants[r->variant_count++] = wanted;
    return wanted.program;
}

/* Uploads and binds what the frame's method reads. */
bool gpu_variant_bind(gpu_renderer *r, const render_frame *frame, double *milliseconds,
                      cli_error *error) {
    const unsigned reads = method_table[frame->method].reads;
    if (reads & METHOD_READS_PREINTEGRATED &&
        (!gpu_bind_preintegrated_lobe(r, frame->lobes, error) ||
         !gpu_bind_preintegrated_brdf(r, error)))
        return false;
    if (reads & METHOD_READS_TABULATED_Z && !gpu_bind_zonal(r, frame->bands, error))
        return false;
    if (reads & METHOD_READS_FIELD && !gpu_bind_field(r, frame, milliseconds, error))
        return false;
    return gpu_prepare_fibers(r, frame, error) &&
           (!gpu_tables_by_bands(r, frame->method) ||
            gpu_bind_tables(r, frame->method, frame->bands, error));
}
