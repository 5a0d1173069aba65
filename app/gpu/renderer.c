/* SPDX-License-Identifier: MIT */
#include "app/gpu/internal.h"
#include "app/timing/timing.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The near plane's distance as a part of the scene's extent. Depth is reversed and in float32, so
 * that a small one costs no precision; there is no far plane. */
static const float near_of_extent = 1e-4f;

/* --- creation -----------------------------------------------------------------------------------
 */

static bool create_programs(gpu_renderer *r, cli_error *error) {
    const gpu_stage surface[] = { { GL_VERTEX_SHADER, "surface.vert" },
                                  { GL_FRAGMENT_SHADER, "surface.frag" } };
    const gpu_stage light[] = { { GL_VERTEX_SHADER, "light.vert" },
                                { GL_FRAGMENT_SHADER, "light.frag" } };
    const gpu_stage tone[] = { { GL_VERTEX_SHADER, "screen.vert" },
                               { GL_FRAGMENT_SHADER, "tone.frag" } };
    const gpu_stage surfaces[] = { { GL_COMPUTE_SHADER, "surfaces.comp" } };
    const gpu_stage resolve[] = { { GL_COMPUTE_SHADER, "resolve.comp" } };
    char defines[128];
    snprintf(defines, sizeof defines, "#define LMP_BANDS 1\n#define LMP_ALPHA_MIN %.9g\n",
             (double)LMP_ALPHA_MIN);
    return (r->surface = gpu_program(surface, 2, "", error)) &&
           (r->surface_masked = gpu_program(surface, 2, "#define SURFACE_MASKED\n", error)) &&
           (r->light = gpu_program(light, 2, "", error)) &&
           (r->tone = gpu_program(tone, 2, "", error)) &&
           (r->resolve = gpu_program(resolve, 1, "", error)) &&
           (r->surfaces = gpu_program(surfaces, 1, defines, error));
}

gpu_renderer *gpu_renderer_create(const gpu_context *context, const scene *world,
                                  cli_error *error) {
    gpu_renderer *r = calloc(1, sizeof *r);
    if (!r) {
        cli_fail(error, NULL, "out of memory");
        return NULL;
    }
    r->context = *context;
    if (!create_programs(r, error) || !gpu_mesh_create(context, world, &r->mesh, error)) {
        gpu_renderer_destroy(r);
        return NULL;
    }
    glCreateVertexArrays(1, &r->empty_array);
    glCreateBuffers(1, &r->frame_block);
    glNamedBufferStorage(r->frame_block, sizeof(shared_frame), NULL, GL_DYNAMIC_STORAGE_BIT);
    glCreateBuffers(1, &r->lights_block);
    glNamedBufferStorage(r->lights_block, sizeof(shared_lights), NULL, GL_DYNAMIC_STORAGE_BIT);
    glCreateQueries(GL_TIMESTAMP, GPU_TIMESTAMPS, r->timestamps);
    float extent = 0;
    for (int i = 0; i < 3; i++)
        extent = fmaxf(extent, world->maximum[i] - world->minimum[i]);
    r->near = near_of_extent * (extent > 0 ? extent : 1);
    return r;
}

void gpu_forget_geometry(gpu_renderer *r) {
    glDeleteTextures(GPU_ATTACHMENTS + 1, r->kept);
    memset(r->kept, 0, sizeof r->kept);
}

static void delete_targets(gpu_renderer *r) {
    glDeleteTextures(GPU_ATTACHMENTS, r->attachments);
    glDeleteTextures(1, &r->depth);
    gpu_forget_geometry(r);
    glDeleteTextures(1, &r->hdr);
    glDeleteTextures(1, &r->sums);
    r->sums = 0;
    glDeleteTextures(1, &r->ldr);
    glDeleteFramebuffers(1, &r->framebuffer);
    glDeleteFramebuffers(1, &r->ldr_framebuffer);
    gpu_gbuffer_free(&r->gbuffer);
    r->width = r->height = 0;
}

void gpu_renderer_destroy(gpu_renderer *r) {
    if (!r)
        return;
    delete_targets(r);
    gpu_mesh_destroy(&r->mesh);
    for (int i = 0; i < r->variant_count; i++)
        glDeleteProgram(r->variants[i].program);
    const GLuint programs[] = { r->surface, r->surface_masked, r->light,
                                r->tone,    r->surfaces,       r->resolve };
    for (size_t i = 0; i < sizeof programs / sizeof programs[0]; i++)
        if (programs[i])
            glDeleteProgram(programs[i]);
    glDeleteBuffers(1, &r->frame_block);
    glDeleteBuffers(1, &r->lights_block);
    gpu_set_responses(r, NULL);
    glDeleteBuffers(1, &r->response_block);
    glDeleteTextures(1, &r->response_pairs);
    glDeleteTextures(1, &r->zonal);
    glDeleteVertexArrays(1, &r->empty_array);
    glDeleteQueries(GPU_TIMESTAMPS, r->timestamps);
    free(r);
}

/* --- targets ------------------------------------------------------------------------------------
 */

static GLuint create_target(GLenum format, int width, int height) {
    GLuint texture = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    glTextureStorage2D(texture, 1, format, width, height);
    glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return texture;
}

/* Of the G-buffer's attachments, and of its depth. */
static const GLenum formats[GPU_ATTACHMENTS + 1] = { GL_RGBA8, GL_RG16, GL_RG8, GL_R11F_G11F_B10F,
                                                     GL_DEPTH_COMPONENT32F };

static bool create_targets(gpu_renderer *r, int width, int height, cli_error *error) {
    static const GLenum buffers[GPU_ATTACHMENTS] = { GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1,
                                                     GL_COLOR_ATTACHMENT2, GL_COLOR_ATTACHMENT3 };
    if (r->width == width && r->height == height)
        return true;
    if (width < 1 || height < 1 || width > r->context.size_max || height > r->context.size_max)
        return cli_fail(error, NULL, "an image of %d x %d is beyond %s, which takes %d a side",
                        width, height, r->context.device, r->context.size_max);
    delete_targets(r);
    glCreateFramebuffers(1, &r->framebuffer);
    for (int i = 0; i < GPU_ATTACHMENTS; i++) {
        r->attachments[i] = create_target(formats[i], width, height);
        glNamedFramebufferTexture(r->framebuffer, buffers[i], r->attachments[i], 0);
    }
    glNamedFramebufferDrawBuffers(r->framebuffer, GPU_ATTACHMENTS, buffers);
    r->depth = create_target(formats[GPU_ATTACHMENTS], width, height);
    glNamedFramebufferTexture(r->framebuffer, GL_DEPTH_ATTACHMENT, r->depth, 0);
    r->hdr = create_target(GL_RGBA32F, width, height);
    r->ldr = create_target(GL_RGBA8, width, height);
    glCreateFramebuffers(1, &r->ldr_framebuffer);
    glNamedFramebufferTexture(r->ldr_framebuffer, GL_COLOR_ATTACHMENT0, r->ldr, 0);
    const GLenum status = glCheckNamedFramebufferStatus(r->framebuffer, GL_DRAW_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE || glGetError() == GL_OUT_OF_MEMORY) {
        delete_targets(r);
        return cli_fail(error, NULL, "%s cannot hold an image of %d x %d", r->context.device, width,
                        height);
    }
    r->width = width;
    r->height = height;
    return true;
}

/* --- what the shaders are told ------------------------------------------------------------------
 */

static void subtract(const float a[3], const float b[3], float difference[3]) {
    for (int i = 0; i < 3; i++)
        difference[i] = a[i] - b[i];
}

static void cross(const float a[3], const float b[3], float product[3]) {
    product[0] = a[1] * b[2] - a[2] * b[1];
    product[1] = a[2] * b[0] - a[0] * b[2];
    product[2] = a[0] * b[1] - a[1] * b[0];
}

static float dot(const float a[3], const float b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static bool scale_to(float v[3], float length) {
    const float current = sqrtf(dot(v, v));
    if (!(current > 0))
        return false;
    for (int i = 0; i < 3; i++)
        v[i] *= length / current;
    return true;
}

/* Sample `index` of `count` in its pixel, -0.5 … 0.5, by the two-dimensional golden ratio (Roberts
 * 2018). */
static void place_sample(int index, int count, float offset[2]) {
    static const double steps[2] = { 0.7548776662466927, 0.5698402909980532 };
    for (int i = 0; i < 2; i++) {
        const double at = count > 1 ? 0.5 + steps[i] * index : 0.5;
        offset[i] = (float)(at - floor(at) - 0.5);
    }
}

/* Rows of the clip matrix: x right, y down (row 0 of an image is its top), depth = near /
 * distance, w = distance. */
static bool fill_frame(const gpu_renderer *r, const gpu_frame *frame, const float offset[2],
                       shared_frame *block, cli_error *error) {
    const scene_camera *camera = &frame->camera;
    const float half_height = tanf(0.5f * camera->fov);
    const float half_width = half_height * (float)frame->width / (float)frame->height;
    memset(block, 0, sizeof *block);
    memcpy(block->eye, camera->eye, sizeof camera->eye);
    block->eye[3] = r->near;
    subtract(camera->target, camera->eye, block->forward);
    cross(block->forward, camera->up, block->right);
    cross(block->forward, block->right, block->down);
    if (!scale_to(block->forward, 1) || !scale_to(block->right, half_width) ||
        !scale_to(block->down, half_height))
        return cli_fail(error, "camera", "it looks along its up direction, or at itself");
    memcpy(block->background, frame->background, sizeof frame->background);
    block->size_lights[0] = (float)frame->width;
    block->size_lights[1] = (float)frame->height;
    block->size_lights[2] = (float)r->shaded_lights;

    block->jitter[0] = 2 * offset[0] / (float)frame->width;
    block->jitter[1] = 2 * offset[1] / (float)frame->height;

    float rows[4][4] = { { 0 } };
    for (int i = 0; i < 3; i++) {
        rows[3][i] = block->forward[i];
        rows[0][i] = block->right[i] / (half_width * half_width) - block->jitter[0] * rows[3][i];
        rows[1][i] = block->down[i] / (half_height * half_height) - block->jitter[1] * rows[3][i];
    }
    for (int row = 0; row < 4; row++) {
        rows[row][3] = row == 2 ? r->near : -dot(rows[row], block->eye);
        for (int column = 0; column < 4; column++)
            block->clip_from_world[4 * column + row] = rows[row][column];
    }
    return true;
}

static void upload_lights(gpu_renderer *r, const gpu_frame *frame) {
    shared_lights block;
    r->shaded_lights = gpu_take_lights(frame, &block);
    if (r->shaded_lights)
        glNamedBufferSubData(r->lights_block, 0,
                             (GLsizeiptr)(r->shaded_lights * sizeof *block.lights), &block);
}

/* --- passes -------------------------------------------------------------------------------------
 */

/* The most bands of a variant: tables of materials are summed by bands whatever the method is. */
static int variant_bands_max(const gpu_variant *v) {
    const int most = method_table[v->method].bands_max[DEVICE_GPU];
    return v->tables && most > METHOD_GPU_BANDS_MAX ? METHOD_GPU_BANDS_MAX : most;
}

/* What a frame asks of the shading pass. A shader that sums nothing by bands is the same for all.
 */
static gpu_variant variant_of(const gpu_renderer *r, const gpu_frame *frame) {
    const bool preintegrated = method_table[frame->method].reads & METHOD_READS_PREINTEGRATED;
    const int tables = gpu_tables_by_bands(r, frame->method);
    const bool by_bands = !preintegrated || tables;
    return (gpu_variant) { .method = frame->method,
                           .bands = by_bands ? frame->bands : 1,
                           .window = by_bands ? frame->window : LMP_WINDOW_NONE,
                           .tables = tables,
                           .preintegrated_brdfs = preintegrated && gpu_has_preintegrated_brdf(r) };
}

static GLuint compile_variant(const gpu_variant *v, cli_error *error) {
    static const char *const table_defines[] = { "", "#define TABLE_FULL 0\n",
                                                 "#define TABLE_FULL 1\n" };
    const method_row *row = &method_table[v->method];
    char defines[256];
    snprintf(defines, sizeof defines,
             "%s#define SHADE %s\n#define LMP_BANDS %d\n#define LMP_WINDOW %d\n"
             "#define LMP_ALPHA_MIN %.9g\n%s%s",
             row->defines, row->function, v->bands, (int)v->window, (double)LMP_ALPHA_MIN,
             table_defines[v->tables],
             v->preintegrated_brdfs ? "#define SHADE_PREINTEGRATED_BRDF\n" : "");
    const gpu_stage compute = { GL_COMPUTE_SHADER, row->shader };
    const gpu_stage screen[] = { { GL_VERTEX_SHADER, "screen.vert" },
                                 { GL_FRAGMENT_SHADER, row->shader } };
    return row->fragment ? gpu_program(screen, 2, defines, error)
                         : gpu_program(&compute, 1, defines, error);
}

static GLuint find_variant(gpu_renderer *r, const gpu_frame *frame, cli_error *error) {
    gpu_variant wanted = variant_of(r, frame);
    const int bands_max = variant_bands_max(&wanted);
    if (r->table_count && r->table_bands != frame->bands) {
        cli_fail(error, NULL, "the tables of the materials have %d bands, the image %d",
                 r->table_bands, frame->bands);
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
            v->tables == wanted.tables && v->preintegrated_brdfs == wanted.preintegrated_brdfs)
            return v->program;
    }
    wanted.program = compile_variant(&wanted, error);
    if (!wanted.program)
        return 0;
    if (r->variant_count == GPU_VARIANTS)
        glDeleteProgram(r->variants[--r->variant_count].program);
    r->variants[r->variant_count++] = wanted;
    return wanted.program;
}

/* Uploads and binds what the frame's method reads. */
static bool bind_tables(gpu_renderer *r, const gpu_frame *frame, cli_error *error) {
    const unsigned reads = method_table[frame->method].reads;
    if (reads & METHOD_READS_PREINTEGRATED &&
        (!gpu_bind_preintegrated_lobe(r, frame->lobes, error) ||
         !gpu_bind_preintegrated_brdf(r, error)))
        return false;
    if (reads & METHOD_READS_TABULATED_Z && !gpu_bind_zonal(r, frame->bands, error))
        return false;
    return !gpu_tables_by_bands(r, frame->method) || gpu_bind_tables(r, frame->method, error);
}

/* Copies the G-buffer to what is kept, or back. */
static void copy_geometry(const gpu_renderer *r, bool back) {
    for (int i = 0; i <= GPU_ATTACHMENTS; i++) {
        const GLuint own = i < GPU_ATTACHMENTS ? r->attachments[i] : r->depth;
        glCopyImageSubData(back ? r->kept[i] : own, GL_TEXTURE_2D, 0, 0, 0, 0,
                           back ? own : r->kept[i], GL_TEXTURE_2D, 0, 0, 0, 0, r->width, r->height,
                           1);
    }
}

static void draw_geometry(gpu_renderer *r, const gpu_frame *frame, const shared_frame *block) {
    static const GLfloat zero[4] = { 0 };
    if (frame->keep_geometry && r->kept[0] &&
        memcmp(r->kept_view, block->clip_from_world, sizeof r->kept_view) == 0) {
        copy_geometry(r, true);
        return;
    }
    for (int i = 0; i < GPU_ATTACHMENTS; i++)
        glClearNamedFramebufferfv(r->framebuffer, GL_COLOR, i, zero);
    glClearNamedFramebufferfv(r->framebuffer, GL_DEPTH, 0, zero);
    gpu_mesh_draw(&r->mesh, block->clip_from_world, r->surface, r->surface_masked);
    if (!frame->keep_geometry)
        return;
    for (int i = 0; i <= GPU_ATTACHMENTS && !r->kept[0]; i++)
        r->kept[GPU_ATTACHMENTS - i] =
            create_target(formats[GPU_ATTACHMENTS - i], r->width, r->height);
    memcpy(r->kept_view, block->clip_from_world, sizeof r->kept_view);
    copy_geometry(r, false);
}

static void draw_gbuffer(gpu_renderer *r, const gpu_frame *frame, const shared_frame *block) {
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, r->framebuffer);
    glViewport(0, 0, r->width, r->height);
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glFrontFace(GL_CW); /* y runs down */
    glCullFace(GL_BACK);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glDepthMask(GL_TRUE);
    glBindBufferBase(GL_UNIFORM_BUFFER, SHARED_FRAME, r->frame_block);
    glBindBufferBase(GL_UNIFORM_BUFFER, SHARED_LIGHTS, r->lights_block);
    draw_geometry(r, frame, block);
    if (frame->light_count) {
        glBindVertexArray(r->empty_array);
        glUseProgram(r->light);
        glEnable(GL_CULL_FACE);
        glCullFace(GL_FRONT);
        glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 14, (GLsizei)frame->light_count);
    }
    glDisable(GL_CULL_FACE);
    glDisable(GL_DEPTH_TEST);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
}

void gpu_bind_gbuffer(const gpu_renderer *r) {
    static const GLuint units[GPU_ATTACHMENTS] = { SHARED_BASE_COLOR, SHARED_NORMAL,
                                                   SHARED_METALLIC_ROUGHNESS, SHARED_EMISSION };
    for (int i = 0; i < GPU_ATTACHMENTS; i++)
        glBindTextureUnit(units[i], r->attachments[i]);
    glBindTextureUnit(SHARED_DEPTH, r->depth);
    glBindBufferBase(GL_UNIFORM_BUFFER, SHARED_FRAME, r->frame_block);
    glBindBufferBase(GL_UNIFORM_BUFFER, SHARED_LIGHTS, r->lights_block);
}

static GLuint groups(int pixels) {
    return (GLuint)(pixels + SHARED_GROUP - 1) / SHARED_GROUP;
}

static void shade(gpu_renderer *r, const gpu_frame *frame, GLuint program) {
    gpu_bind_gbuffer(r);
    glUseProgram(program);
    if (method_table[frame->method].fragment) {
        glNamedFramebufferTexture(r->ldr_framebuffer, GL_COLOR_ATTACHMENT0, r->hdr, 0);
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, r->ldr_framebuffer);
        glViewport(0, 0, r->width, r->height);
        glBindVertexArray(r->empty_array);
        glDrawArrays(GL_TRIANGLES, 0, 3);
        glNamedFramebufferTexture(r->ldr_framebuffer, GL_COLOR_ATTACHMENT0, r->ldr, 0);
        return;
    }
    glBindImageTexture(0, r->hdr, 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA32F);
    glDispatchCompute(groups(r->width), groups(r->height), 1);
    glMemoryBarrier(GL_ALL_BARRIER_BITS);
}

/* --- timing -------------------------------------------------------------------------------------
 */

/* Marks an instant of the frame: a query on hardware, a finished wait on software. */
static void mark(gpu_renderer *r, int index) {
    if (!r->context.software) {
        glQueryCounter(r->timestamps[index], GL_TIMESTAMP);
        return;
    }
    glFinish();
    r->marks[index] = 1e3 * timing_now();
}

static double marked(const gpu_renderer *r, int index) {
    if (r->context.software)
        return r->marks[index];
    GLuint64 nanoseconds = 0;
    glGetQueryObjectui64v(r->timestamps[index], GL_QUERY_RESULT, &nanoseconds);
    return 1e-6 * (double)nanoseconds;
}

/* The G-buffer goes to the host and comes back as radiance. */
static bool shade_host(gpu_renderer *r, const gpu_frame *frame, const shared_frame *block,
                       gpu_times *times, cli_error *error) {
    const double start = 1e3 * timing_now();
    if (!gpu_gbuffer_read(r, block, frame, &r->gbuffer, error))
        return false;
    const double read = 1e3 * timing_now();
    if (!frame->host(frame, &r->gbuffer, &r->gbuffer.rgba[0][0], error))
        return false;
    const double shaded = 1e3 * timing_now();
    glTextureSubImage2D(r->hdr, 0, 0, 0, r->width, r->height, GL_RGBA, GL_FLOAT, r->gbuffer.rgba);
    if (times) {
        glFinish();
        times->shade += shaded - read;
        times->transfer += read - start + 1e3 * timing_now() - shaded;
    }
    return true;
}

/* One sample of every pixel into the HDR target. */
static bool render_sample(gpu_renderer *r, const gpu_frame *frame, int index, GLuint program,
                          gpu_times *times, cli_error *error) {
    shared_frame block;
    float offset[2];
    place_sample(index, frame->samples, offset);
    if (!fill_frame(r, frame, offset, &block, error))
        return false;
    glNamedBufferSubData(r->frame_block, 0, sizeof block, &block);
    if (times)
        mark(r, 0);
    draw_gbuffer(r, frame, &block);
    if (times)
        mark(r, 1);
    if (!frame->host)
        shade(r, frame, program);
    if (times) {
        mark(r, 2);
        times->gbuffer += marked(r, 1) - marked(r, 0);
        times->shade += frame->host ? 0 : marked(r, 2) - marked(r, 1);
    }
    return !frame->host || shade_host(r, frame, &block, times, error);
}

/* Adds the HDR target to the sums; the last sample leaves the mean there, with `show` every one. */
static void resolve_sample(gpu_renderer *r, const gpu_frame *frame, int index, bool show) {
    if (!r->sums)
        r->sums = create_target(GL_RGBA32F, r->width, r->height);
    glBindImageTexture(0, r->hdr, 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA32F);
    glBindImageTexture(1, r->sums, 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA32F);
    glUseProgram(r->resolve);
    glUniform1f(0, frame->samples_exposure);
    glUniform1i(1, index == 0);
    const bool last = index == frame->samples - 1;
    glUniform1i(2, !last);
    glUniform1i(3, last || show);
    glDispatchCompute(groups(r->width), groups(r->height), 1);
    glMemoryBarrier(GL_ALL_BARRIER_BITS);
}

/* Samples `first` to `last` of a frame. */
static bool render_samples(gpu_renderer *r, const gpu_frame *frame, int first, int last, bool show,
                           gpu_times *times, cli_error *error) {
    if (frame->light_count > SCENE_LIGHTS_MAX)
        return cli_fail(error, NULL, "%zu lights: the shaders take %d", frame->light_count,
                        SCENE_LIGHTS_MAX);
    if (method_table[frame->method].reads & METHOD_READS_PREINTEGRATED && !frame->lobes)
        return cli_fail(error, NULL, "preintegrated shading without its lobes");
    const GLuint program = frame->host ? 0 : find_variant(r, frame, error);
    if ((!frame->host && !program) || !create_targets(r, frame->width, frame->height, error))
        return false;
    if (!frame->host && !bind_tables(r, frame, error))
        return false;
    upload_lights(r, frame);
    if (times)
        memset(times, 0, sizeof *times);
    for (int i = first; i <= last; i++) {
        if (!render_sample(r, frame, i, program, times, error))
            return false;
        if (frame->samples > 1)
            resolve_sample(r, frame, i, show);
    }
    if (times)
        times->total = times->gbuffer + times->shade + times->transfer;
    return true;
}

bool gpu_render(gpu_renderer *r, const gpu_frame *frame, gpu_times *times, cli_error *error) {
    const int last = frame->samples > 1 ? frame->samples - 1 : 0;
    return render_samples(r, frame, 0, last, false, times, error);
}

bool gpu_refine(gpu_renderer *r, const gpu_frame *frame, int index, gpu_times *times,
                cli_error *error) {
    return render_samples(r, frame, index, index, true, times, error);
}

/* --- the image --------------------------------------------------------------------------------
 */

void gpu_present(gpu_renderer *r, unsigned framebuffer, float exposure, bool rows_from_top) {
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, r->width, r->height);
    glBindVertexArray(r->empty_array);
    glBindBufferBase(GL_UNIFORM_BUFFER, SHARED_FRAME, r->frame_block);
    glBindTextureUnit(SHARED_HDR, r->hdr);
    glUseProgram(r->tone);
    glUniform1f(0, exposure);
    glUniform1i(1, rows_from_top ? 0 : 1);
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

bool gpu_read_rgb8(gpu_renderer *r, float exposure, unsigned char *rgb8, gpu_times *times,
                   cli_error *error) {
    if (times)
        mark(r, 3);
    gpu_present(r, r->ldr_framebuffer, exposure, true);
    if (times) {
        mark(r, 4);
        times->tone = marked(r, 4) - marked(r, 3);
        times->total = times->gbuffer + times->shade + times->transfer + times->tone;
    }
    const size_t size = 3 * (size_t)r->width * (size_t)r->height;
    if (size > INT32_MAX)
        return cli_fail(error, NULL, "an image of %d x %d is too large to read back", r->width,
                        r->height);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(r->ldr, 0, GL_RGB, GL_UNSIGNED_BYTE, (GLsizei)size, rgb8);
    return true;
}

bool gpu_read_image(gpu_renderer *r, image *pixels, cli_error *error) {
    if (!image_create(pixels, r->width, r->height, error))
        return false;
    const size_t size = 3 * sizeof(float) * (size_t)r->width * (size_t)r->height;
    if (size > INT32_MAX) {
        image_free(pixels);
        return cli_fail(error, NULL, "an image of %d x %d is too large to read back", r->width,
                        r->height);
    }
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(r->hdr, 0, GL_RGB, GL_FLOAT, (GLsizei)size, pixels->rgb);
    return true;
}
