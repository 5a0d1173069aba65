/* SPDX-License-Identifier: MIT */
#include "app/base/timing.h"
#include "app/render/gl/block.h"
#include "app/render/gl/frame.h"
#include "app/render/gl/passes.h"
#include "app/render/gl/program.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* --- creation --------------------------------------------------------------------------------- */

static bool create_tones(gpu_renderer *r, base_error *error) {
    const gpu_stage tone[] = { { GL_VERTEX_SHADER, "screen.vert" },
                               { GL_FRAGMENT_SHADER, "tone.frag" } };
    for (int i = 0; image_tones[i].name; i++) {
        char define[64];
        snprintf(define, sizeof define, "#define TONE %s\n", image_tones[i].function);
        if (!(r->tones[i] = gpu_program(tone, 2, define, error)))
            return false;
    }
    return true;
}

static bool create_surface(bool layered, gpu_surfaces *surface, base_error *error) {
    const gpu_stage stages[] = { { GL_VERTEX_SHADER, "surface.vert" },
                                 { GL_FRAGMENT_SHADER, "surface.frag" } };
    return (surface->plain = gpu_program(stages, 2, "#define SURFACE_PLAIN\n", error)) &&
           (surface->opaque = gpu_program(stages, 2, "", error)) &&
           (surface->masked = gpu_program(stages, 2, "#define SURFACE_MASKED\n", error)) &&
           (!layered ||
            ((surface->layered = gpu_program(stages, 2, "#define SURFACE_LAYERED\n", error)) &&
             (surface->layered_masked = gpu_program(
                  stages, 2, "#define SURFACE_LAYERED\n#define SURFACE_MASKED\n", error))));
}

static bool create_programs(gpu_renderer *r, base_error *error) {
    const gpu_stage light[] = { { GL_VERTEX_SHADER, "light.vert" },
                                { GL_FRAGMENT_SHADER, "light.frag" } };
    const gpu_stage surfaces[] = { { GL_COMPUTE_SHADER, "surfaces.comp" } };
    const gpu_stage resolve[] = { { GL_COMPUTE_SHADER, "resolve.comp" } };
    const char *const defines =
        r->mesh.layered ? "#define LMP_BANDS 1\n#define PIXEL_LAYERED\n" : "#define LMP_BANDS 1\n";
    return create_surface(r->mesh.layered, &r->surface, error) &&
           (r->light = gpu_program(light, 2, "", error)) && create_tones(r, error) &&
           (r->resolve = gpu_program(resolve, 1, "", error)) &&
           (r->surfaces = gpu_program(surfaces, 1, defines, error));
}

/* Uploads lmp_lobe_find_ggx's table, for ggx.glsl. */
static void upload_ggx(gpu_texels *own) {
    float texels[LMP_GGX_TEXELS * 4];
    lmp_lobe_copy_ggx_texels(texels);
    gpu_texels_create(own, sizeof texels, texels);
}

gpu_renderer *gpu_renderer_create(const gpu_context *context, const scene *world,
                                  base_error *error) {
    gpu_renderer *r = calloc(1, sizeof *r);
    if (!r) {
        base_fail(error, NULL, "out of memory");
        return NULL;
    }
    r->context = *context;
    if (!gpu_lights_create(&r->lights) || !render_materials_create(world, &r->materials)) {
        gpu_renderer_destroy(r);
        base_fail(error, world->name, "out of memory");
        return NULL;
    }
    if (!gpu_mesh_create(context, world, &r->mesh, error) || !create_programs(r, error)) {
        gpu_renderer_destroy(r);
        return NULL;
    }
    glCreateVertexArrays(1, &r->empty_array);
    glCreateBuffers(1, &r->frame_block);
    glNamedBufferStorage(r->frame_block, sizeof(shared_frame), NULL, GL_DYNAMIC_STORAGE_BIT);
    upload_ggx(&r->ggx);
    gpu_clock_create(&r->clock, context->software);
    memcpy(r->bounds.minimum, world->minimum, sizeof world->minimum);
    memcpy(r->bounds.maximum, world->maximum, sizeof world->maximum);
    return r;
}

static void delete_programs(const gpu_renderer *r) {
    const GLuint programs[] = { r->surface.plain,
                                r->surface.opaque,
                                r->surface.masked,
                                r->surface.layered,
                                r->surface.layered_masked,
                                r->light,
                                r->areas,
                                r->surfaces,
                                r->resolve };
    for (size_t i = 0; i < sizeof programs / sizeof programs[0]; i++)
        if (programs[i])
            glDeleteProgram(programs[i]);
    for (int i = 0; i < IMAGE_TONES_MAX; i++)
        if (r->tones[i])
            glDeleteProgram(r->tones[i]);
}

void gpu_renderer_destroy(gpu_renderer *r) {
    if (!r)
        return;
    gpu_targets_delete(&r->targets);
    gpu_gbuffer_free(&r->gbuffer);
    gpu_mesh_destroy(&r->mesh);
    render_materials_free(&r->materials);
    gpu_variants_delete(&r->variants);
    delete_programs(r);
    gpu_lights_free(&r->lights);
    glDeleteBuffers(1, &r->frame_block);
    gpu_texels_free(&r->ggx);
    gpu_preintegrated_brdfs_free(&r->brdfs);
    gpu_tables_free(&r->tables);
    gpu_environment_set(&r->environment, NULL);
    gpu_sheen_free(&r->sheen);
    gpu_preintegrated_lobe_free(&r->lobe);
    gpu_zonal_free(&r->zonal);
    gpu_field_free(&r->field);
    glDeleteVertexArrays(1, &r->empty_array);
    gpu_clock_delete(&r->clock);
    free(r);
}

/* --- materials and environment ---------------------------------------------------------------- */

bool gpu_set_tables(gpu_renderer *r, const lmp_brdf_table *const *tables, int count,
                    const int *uses, base_error *error) {
    if (!render_materials_set_tables(&r->materials, tables, count, uses, error))
        return false;
    gpu_set_preintegrated_brdfs(r, NULL);
    for (size_t i = 0; i < r->materials.count; i++)
        gpu_mesh_set_table(&r->mesh, i, uses[i]);
    return true;
}

bool gpu_tables_fit(const gpu_renderer *r, method_kind method, const lmp_brdf_table_info *tables,
                    int count, base_error *error) {
    return gpu_tables_would_fit(r->environment.source, method, tables, count, error);
}

/* Sets the preintegrated BRDFs and frees the tables on the device: which of them are summed by
 * bands depends on these. */
void gpu_set_preintegrated_brdfs(gpu_renderer *r, const lmp_preintegrated_brdf *const *brdfs) {
    for (int t = 0; t < RENDER_TABLES_MAX; t++)
        r->materials.brdfs[t] = brdfs && t < r->materials.table_count ? brdfs[t] : NULL;
    gpu_preintegrated_brdfs_free(&r->brdfs);
    gpu_tables_free(&r->tables);
}

void gpu_set_sheen(gpu_renderer *r, const lmp_brdf_table *const *white) {
    render_materials_set_sheen(&r->materials, white);
    gpu_sheen_forget(&r->sheen);
}

void gpu_set_environment(gpu_renderer *r, const environment *e) {
    gpu_environment_set(&r->environment, e);
    gpu_tables_free(&r->tables); /* the environment decides which tables are summed by bands */
}

/* --- a frame ---------------------------------------------------------------------------------- */

/* Adds bounced light to what shaders have computed. */
static void add_bounced(const render_surfaces *s, float *rgba) {
    for (size_t i = 0; s->bounced[0] && i < (size_t)s->width * (size_t)s->height; i++)
        for (size_t c = 0; c < 3 && s->seen[i] < RENDER_SEES_LIGHT; c++)
            rgba[4 * i + c] += s->bounced[c][i];
}

/* Shades on the CPU: reads the G-buffer and uploads the radiance. */
static bool shade_on_cpu(gpu_renderer *r, const render_frame *frame, const render_camera *camera,
                         render_times *times, base_error *error) {
    const double start = 1e3 * timing_now();
    if (!gpu_gbuffer_read(&r->targets, &r->materials, r->environment.source, camera,
                          gpu_depth_reach(&r->bounds, camera), frame, &r->gbuffer, error))
        return false;
    render_surfaces *const s = &r->gbuffer.surfaces;
    float *const rgba = &r->gbuffer.rgba[0][0];
    if (!frame->cpu_shader)
        glGetTextureImage(
            r->targets.hdr, 0, GL_RGBA, GL_FLOAT,
            (GLsizei)((size_t)r->targets.width * (size_t)r->targets.height * sizeof(vec4)), rgba);
    const double read = 1e3 * timing_now();
    if (!render_surfaces_fit_bounced(frame, s) || !render_surfaces_fill_bounced(s))
        return base_fail(error, NULL, "out of memory");
    if (!frame->cpu_shader)
        add_bounced(s, rgba);
    const double bounced = 1e3 * timing_now();
    if (frame->cpu_shader && !frame->cpu_shader(frame, s, rgba, error))
        return false;
    const double shaded = 1e3 * timing_now();
    if (frame->shadow.run && !frame->shadow.run(frame->shadow.user, frame, s, rgba, error))
        return false;
    const double shadowed = 1e3 * timing_now();
    glTextureSubImage2D(r->targets.hdr, 0, 0, 0, r->targets.width, r->targets.height, GL_RGBA,
                        GL_FLOAT, rgba);
    if (times) {
        glFinish();
        times->bounces += bounced - read;
        times->shade += shaded - bounced;
        times->shadow += shadowed - shaded;
        times->transfer += read - start + 1e3 * timing_now() - shadowed;
    }
    return true;
}

/* Renders one sample of every pixel into the HDR target. */
static bool render_sample(gpu_renderer *r, const render_frame *frame, int index, GLuint program,
                          render_times *times, base_error *error) {
    shared_frame block;
    render_camera camera;
    if (!render_camera_set(&r->bounds, frame, index, &camera, error))
        return false;
    gpu_fill_frame(&r->bounds, &r->environment, &r->lights, frame, &camera, &block);
    glNamedBufferSubData(r->frame_block, 0, sizeof block, &block);
    if (times)
        gpu_clock_mark(&r->clock, 0);
    gpu_draw_gbuffer(r, frame, &block);
    if (times)
        gpu_clock_mark(&r->clock, 1);
    if (!frame->cpu_shader)
        gpu_shade(r, frame, program);
    if (times) {
        gpu_clock_mark(&r->clock, 2);
        times->surfaces += gpu_clock_marked(&r->clock, 1) - gpu_clock_marked(&r->clock, 0);
        times->shade +=
            frame->cpu_shader ? 0 : gpu_clock_marked(&r->clock, 2) - gpu_clock_marked(&r->clock, 1);
    }
    return (!frame->cpu_shader && !frame->shadow.run && !frame->bounces.fill) ||
           shade_on_cpu(r, frame, &camera, times, error);
}

size_t gpu_lights_max(const gpu_context *context, const render_frame *frame) {
    return context->software && !frame->cpu_shader ? GPU_SOFTWARE_LIGHTS_MAX : SCENE_LIGHTS_MAX;
}

/* Uploads and binds what the frame's method reads; *milliseconds, if not NULL, receives the time of
 * shading work before the passes. */
static bool bind_method(gpu_renderer *r, const render_frame *frame, double *milliseconds,
                        base_error *error) {
    const environment *const around = r->environment.source;
    const unsigned reads = method_table[frame->method].reads;
    if (reads & METHOD_READS_PREINTEGRATED &&
        (!gpu_preintegrated_lobe_bind(&r->lobe, frame->lobes, error) ||
         !gpu_preintegrated_brdfs_bind(&r->brdfs, &r->materials, error)))
        return false;
    if (reads & METHOD_READS_TABULATED_Z && !gpu_zonal_bind(&r->zonal, frame->bands, error))
        return false;
    if (reads & METHOD_READS_FIELD &&
        !gpu_field_bind(&r->field, &r->context, &r->lights, frame, milliseconds, error))
        return false;
    return gpu_sheen_prepare(&r->sheen, &r->context, &r->materials, &r->environment, frame,
                             error) &&
           (!gpu_tables_by_bands(&r->materials, around, frame->method) ||
            gpu_tables_bind(&r->tables, &r->materials, around, frame->method, frame->bands, error));
}

static bool check_lights(const gpu_renderer *r, const render_frame *frame, base_error *error) {
    const size_t most = gpu_lights_max(&r->context, frame);
    const char *hint = most < SCENE_LIGHTS_MAX ? " (--device cpu takes more)" : "";
    const size_t areas = scene_count_areas(frame->lights, frame->light_count);
    if (frame->light_count > most)
        return base_fail(error, NULL, "%zu lights: %s takes %zu%s", frame->light_count,
                         r->context.device, most, hint);
    return areas <= most / GPU_SOFTWARE_AREA ||
           base_fail(error, NULL, "%zu areas: %s takes %zu%s", areas, r->context.device,
                     most / GPU_SOFTWARE_AREA, hint);
}

/* Uploads the frame's lights and compiles what draws areas on first use. */
static bool take_lights(gpu_renderer *r, const render_frame *frame, base_error *error) {
    const gpu_stage stages[] = { { GL_VERTEX_SHADER, "area.vert" },
                                 { GL_FRAGMENT_SHADER, "area.frag" } };
    if (!gpu_lights_upload(&r->lights, frame->lights, frame->light_count))
        return base_fail(error, NULL, "out of memory");
    if (r->lights.area_count == 0 || r->areas)
        return true;
    r->areas = gpu_program(stages, 2, gpu_texels_define(&r->context), error);
    return r->areas;
}

/* Renders samples `first` to `last` of a frame. */
static bool render_samples(gpu_renderer *r, const render_frame *frame, int first, int last,
                           bool show, render_times *times, base_error *error) {
    if (!check_lights(r, frame, error))
        return false;
    if (!render_frame_check(frame, error))
        return false;
    const GLuint program = frame->cpu_shader
                               ? 0
                               : gpu_variant_find(&r->variants, &r->context, &r->mesh,
                                                  &r->materials, &r->environment, frame, error);
    if ((!frame->cpu_shader && !program) ||
        !gpu_targets_create(&r->targets, &r->context, r->mesh.layered, frame->width, frame->height,
                            error))
        return false;
    double before = 0;
    if (!take_lights(r, frame, error))
        return false;
    if (!frame->cpu_shader && !bind_method(r, frame, times ? &before : NULL, error))
        return false;
    if (!gpu_environment_bind(&r->environment, &r->materials, frame, error))
        return false;
    render_materials_note_sheen(&r->materials,
                                r->materials.sheen_tables[0] &&
                                    (frame->cpu_shader || gpu_sheen_shade(&r->materials, frame)));
    if (times)
        *times = (render_times) { .shade = before };
    for (int i = first; i <= last; i++) {
        if (!render_sample(r, frame, i, program, times, error))
            return false;
        if (frame->samples > 1)
            gpu_resolve(r, frame, i, show);
    }
    if (times)
        times->total =
            times->surfaces + times->shade + times->shadow + times->bounces + times->transfer;
    return true;
}

bool gpu_render(gpu_renderer *r, const render_frame *frame, render_times *times,
                base_error *error) {
    const int last = frame->samples > 1 ? frame->samples - 1 : 0;
    return render_samples(r, frame, 0, last, false, times, error);
}

bool gpu_refine(gpu_renderer *r, const render_frame *frame, int index, render_times *times,
                base_error *error) {
    return render_samples(r, frame, index, index, true, times, error);
}
