/* SPDX-License-Identifier: MIT */
#include "app/render/gl/internal.h"
#include "app/timing/timing.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* --- creation --------------------------------------------------------------------------------- */

static bool create_tones(gpu_renderer *r, cli_error *error) {
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

static bool create_surface(bool layered, gpu_surfaces *surface, cli_error *error) {
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

static bool create_programs(gpu_renderer *r, cli_error *error) {
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

/* The table of lmp_lobe_ggx, for ggx.glsl. */
static GLuint create_ggx_block(void) {
    float texels[LMP_GGX_TEXELS * 4];
    GLuint block = 0;
    lmp_lobe_ggx_texels(texels);
    glCreateBuffers(1, &block);
    glNamedBufferStorage(block, sizeof texels, texels, 0);
    return block;
}

gpu_renderer *gpu_renderer_create(const gpu_context *context, const scene *world,
                                  cli_error *error) {
    gpu_renderer *r = calloc(1, sizeof *r);
    if (r)
        r->lights = malloc(SHARED_LIGHTS_MAX * sizeof *r->lights);
    if (!r || !r->lights) {
        free(r);
        cli_fail(error, NULL, "out of memory");
        return NULL;
    }
    r->context = *context;
    if (!render_materials_create(world, &r->materials)) {
        gpu_renderer_destroy(r);
        cli_fail(error, world->name, "out of memory");
        return NULL;
    }
    if (!gpu_mesh_create(context, world, &r->mesh, error) || !create_programs(r, error)) {
        gpu_renderer_destroy(r);
        return NULL;
    }
    glCreateVertexArrays(1, &r->empty_array);
    glCreateBuffers(1, &r->frame_block);
    glNamedBufferStorage(r->frame_block, sizeof(shared_frame), NULL, GL_DYNAMIC_STORAGE_BIT);
    glCreateBuffers(1, &r->lights_block);
    glNamedBufferStorage(r->lights_block, SHARED_LIGHTS_MAX * sizeof *r->lights, NULL,
                         GL_DYNAMIC_STORAGE_BIT);
    r->ggx_block = create_ggx_block();
    glCreateQueries(GL_TIMESTAMP, GPU_TIMESTAMPS, r->timestamps);
    memcpy(r->bounds.minimum, world->minimum, sizeof world->minimum);
    memcpy(r->bounds.maximum, world->maximum, sizeof world->maximum);
    return r;
}

void gpu_renderer_destroy(gpu_renderer *r) {
    if (!r)
        return;
    gpu_targets_delete(r);
    gpu_mesh_destroy(&r->mesh);
    render_materials_free(&r->materials);
    for (int i = 0; i < r->variant_count; i++)
        glDeleteProgram(r->variants[i].program);
    const GLuint programs[] = {
        r->surface.plain,          r->surface.opaque, r->surface.masked, r->surface.layered,
        r->surface.layered_masked, r->light,          r->surfaces,       r->resolve
    };
    for (size_t i = 0; i < sizeof programs / sizeof programs[0]; i++)
        if (programs[i])
            glDeleteProgram(programs[i]);
    for (int i = 0; i < IMAGE_TONES_MAX; i++)
        if (r->tones[i])
            glDeleteProgram(r->tones[i]);
    glDeleteBuffers(1, &r->frame_block);
    glDeleteBuffers(1, &r->lights_block);
    glDeleteBuffers(1, &r->ggx_block);
    gpu_set_preintegrated_brdfs(r, NULL);
    gpu_set_environment(r, NULL);
    gpu_set_fibers(r, NULL);
    glDeleteProgram(r->fibers_program);
    glDeleteBuffers(1, &r->lobe_block);
    glDeleteTextures(1, &r->lobe_pairs);
    glDeleteTextures(1, &r->zonal);
    gpu_forget_field(r);
    glDeleteProgram(r->field_program);
    glDeleteVertexArrays(1, &r->empty_array);
    glDeleteQueries(GPU_TIMESTAMPS, r->timestamps);
    free(r->lights);
    free(r);
}

/* --- a frame ---------------------------------------------------------------------------------- */

/* The G-buffer goes to the host and comes back as radiance. */
static bool shade_host(gpu_renderer *r, const render_frame *frame, const render_camera *camera,
                       render_times *times, cli_error *error) {
    const double start = 1e3 * timing_now();
    if (!gpu_gbuffer_read(r, camera, frame, &r->gbuffer, error))
        return false;
    float *const rgba = &r->gbuffer.rgba[0][0];
    if (!frame->host)
        glGetTextureImage(r->hdr, 0, GL_RGBA, GL_FLOAT,
                          (GLsizei)((size_t)r->width * (size_t)r->height * sizeof(vec4)), rgba);
    const double read = 1e3 * timing_now();
    if (frame->host && !frame->host(frame, &r->gbuffer.surfaces, rgba, error))
        return false;
    const double shaded = 1e3 * timing_now();
    if (frame->shadow.run &&
        !frame->shadow.run(frame->shadow.user, frame, &r->gbuffer.surfaces, rgba, error))
        return false;
    const double shadowed = 1e3 * timing_now();
    glTextureSubImage2D(r->hdr, 0, 0, 0, r->width, r->height, GL_RGBA, GL_FLOAT, rgba);
    if (times) {
        glFinish();
        times->shade += shaded - read;
        times->shadow += shadowed - shaded;
        times->transfer += read - start + 1e3 * timing_now() - shadowed;
    }
    return true;
}

/* One sample of every pixel into the HDR target. */
static bool render_sample(gpu_renderer *r, const render_frame *frame, int index, GLuint program,
                          render_times *times, cli_error *error) {
    shared_frame block;
    render_camera camera;
    if (!render_camera_set(&r->bounds, frame, index, &camera, error))
        return false;
    gpu_fill_frame(r, frame, &camera, &block);
    glNamedBufferSubData(r->frame_block, 0, sizeof block, &block);
    if (times)
        gpu_mark(r, 0);
    gpu_draw_gbuffer(r, frame, &block);
    if (times)
        gpu_mark(r, 1);
    if (!frame->host)
        gpu_shade(r, frame, program);
    if (times) {
        gpu_mark(r, 2);
        times->surfaces += gpu_marked(r, 1) - gpu_marked(r, 0);
        times->shade += frame->host ? 0 : gpu_marked(r, 2) - gpu_marked(r, 1);
    }
    return (!frame->host && !frame->shadow.run) || shade_host(r, frame, &camera, times, error);
}

size_t gpu_lights_max(const gpu_context *context, const render_frame *frame) {
    return context->software && !frame->host ? GPU_SOFTWARE_LIGHTS_MAX : SCENE_LIGHTS_MAX;
}

/* Samples `first` to `last` of a frame. */
static bool render_samples(gpu_renderer *r, const render_frame *frame, int first, int last,
                           bool show, render_times *times, cli_error *error) {
    const size_t lights_max = gpu_lights_max(&r->context, frame);
    if (frame->light_count > lights_max)
        return cli_fail(error, NULL, "%zu lights: %s takes %zu%s", frame->light_count,
                        r->context.device, lights_max,
                        lights_max < SCENE_LIGHTS_MAX ? " (--device cpu takes more)" : "");
    if (!render_frame_check(frame, error))
        return false;
    const GLuint program = frame->host ? 0 : gpu_variant_find(r, frame, error);
    if ((!frame->host && !program) || !gpu_targets_create(r, frame->width, frame->height, error))
        return false;
    double before = 0;
    gpu_upload_lights(r, frame);
    if (!frame->host && !gpu_variant_bind(r, frame, times ? &before : NULL, error))
        return false;
    if (!gpu_bind_environment(r, frame, error))
        return false;
    render_materials_note_sheen(&r->materials, r->materials.fibers &&
                                                   (frame->host || gpu_shades_fibers(r, frame)));
    if (times)
        *times = (render_times) { .shade = before };
    for (int i = first; i <= last; i++) {
        if (!render_sample(r, frame, i, program, times, error))
            return false;
        if (frame->samples > 1)
            gpu_resolve(r, frame, i, show);
    }
    if (times)
        times->total = times->surfaces + times->shade + times->shadow + times->transfer;
    return true;
}

bool gpu_render(gpu_renderer *r, const render_frame *frame, render_times *times, cli_error *error) {
    const int last = frame->samples > 1 ? frame->samples - 1 : 0;
    return render_samples(r, frame, 0, last, false, times, error);
}

bool gpu_refine(gpu_renderer *r, const render_frame *frame, int index, render_times *times,
                cli_error *error) {
    return render_samples(r, frame, index, index, true, times, error);
}
