/* SPDX-License-Identifier: MIT */
#include "app/render/gl/mesh.h"
#include "app/render/gl/block.h"
#include "app/render/gl/targets.h"
#include "app/scene/instance.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static GLuint upload(const void *data, size_t size) {
    GLuint buffer = 0;
    glCreateBuffers(1, &buffer);
    glNamedBufferStorage(buffer, size ? (GLsizeiptr)size : 4, size ? data : NULL, 0);
    return buffer;
}

/* --- textures --------------------------------------------------------------------------------- */

/* Creates the samplers, which hold the wrap modes: all textures that show an image share it. */
static void create_samplers(const gpu_context *context, gpu_mesh *mesh) {
    static const GLint modes[SCENE_WRAPS] = { [SCENE_WRAP_REPEAT] = GL_REPEAT,
                                              [SCENE_WRAP_CLAMP] = GL_CLAMP_TO_EDGE,
                                              [SCENE_WRAP_MIRROR] = GL_MIRRORED_REPEAT };
    glCreateSamplers(SCENE_WRAPS * SCENE_WRAPS, mesh->samplers);
    for (int i = 0; i < SCENE_WRAPS * SCENE_WRAPS; i++) {
        const GLuint sampler = mesh->samplers[i];
        glSamplerParameteri(sampler, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
        glSamplerParameteri(sampler, GL_TEXTURE_WRAP_S, modes[i % SCENE_WRAPS]);
        glSamplerParameteri(sampler, GL_TEXTURE_WRAP_T, modes[i / SCENE_WRAPS]);
        if (!context->software && epoxy_has_gl_extension("GL_EXT_texture_filter_anisotropic"))
            glSamplerParameterf(sampler, GL_TEXTURE_MAX_ANISOTROPY_EXT, 8);
    }
}

static GLsizei level_count(uint32_t width, uint32_t height) {
    GLsizei levels = 1;
    for (uint32_t side = width > height ? width : height; side > 1; side /= 2)
        levels++;
    return levels;
}

static bool create_texture(const gpu_context *context, const scene *world,
                           const scene_texture *source, GLuint *texture, base_error *error) {
    if (source->width > (uint32_t)context->size_max || source->height > (uint32_t)context->size_max)
        return base_fail(error, world->name, "texture %s has %u x %u texels; %s takes %d a side",
                         source->name, source->width, source->height, context->device,
                         context->size_max);
    glCreateTextures(GL_TEXTURE_2D, 1, texture);
    const GLsizei width = (GLsizei)source->width, height = (GLsizei)source->height;
    glTextureStorage2D(*texture, level_count(source->width, source->height),
                       source->srgb ? GL_SRGB8_ALPHA8 : GL_RGBA8, width, height);
    glTextureSubImage2D(*texture, 0, 0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE,
                        world->texels + source->first_byte);
    glGenerateTextureMipmap(*texture);
    return true;
}

/* Orders textures so that those with the same texels and color space are adjacent. */
static int compare_images(const void *a, const void *b) {
    const scene_texture *const *const left = a, *const *const right = b;
    const scene_texture *const x = *left, *const y = *right;
    const int order[] = { (x->first_byte > y->first_byte) - (x->first_byte < y->first_byte),
                          (x->width > y->width) - (x->width < y->width),
                          (x->height > y->height) - (x->height < y->height),
                          (x->srgb > y->srgb) - (x->srgb < y->srgb) };
    for (size_t i = 0; i < sizeof order / sizeof *order; i++)
        if (order[i])
            return order[i];
    return 0;
}

static bool create_textures(const gpu_context *context, const scene *world, gpu_mesh *mesh,
                            base_error *error) {
    const scene_texture **const sorted = calloc(world->texture_count + 1, sizeof *sorted);
    mesh->textures = calloc(world->texture_count + 1, sizeof *mesh->textures);
    if (!sorted || !mesh->textures) {
        free(sorted);
        return base_fail(error, world->name, "out of memory");
    }
    mesh->texture_count = (GLsizei)world->texture_count;
    for (size_t i = 0; i < world->texture_count; i++)
        sorted[i] = &world->textures[i];
    qsort(sorted, world->texture_count, sizeof *sorted, compare_images);
    bool ok = true;
    for (size_t i = 0; ok && i < world->texture_count; i++) {
        GLuint *const texture = &mesh->textures[sorted[i] - world->textures];
        if (i > 0 && compare_images(&sorted[i - 1], &sorted[i]) == 0)
            *texture = mesh->textures[sorted[i - 1] - world->textures];
        else
            ok = create_texture(context, world, sorted[i], texture, error);
    }
    free(sorted);
    return ok;
}

/* --- materials -------------------------------------------------------------------------------- */

static void fill_material(const scene *world, size_t number, const gpu_mesh *mesh,
                          gpu_material *material, shared_material *block) {
    const scene_material *source = &world->materials[number];
    gpu_fill_material(source, number, block);
    for (int i = 0; i < SHARED_MAPS; i++) {
        const int32_t map = source->maps[i].texture;
        if (map < 0)
            continue;
        const scene_texture *texture = &world->textures[map];
        material->maps[i] = mesh->textures[map];
        material->samplers[i] = mesh->samplers[texture->wrap_u + SCENE_WRAPS * texture->wrap_v];
    }
    material->layered = scene_is_layered(source);
    material->double_sided = source->flags & SCENE_DOUBLE_SIDED;
    material->masked = source->flags & (SCENE_ALPHA_MASK | SCENE_ALPHA_BLEND);
    material->plain = gpu_material_is_plain(source);
}

static bool create_materials(const scene *world, gpu_mesh *mesh) {
    GLint alignment = 1;
    glGetIntegerv(GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT, &alignment);
    const size_t align = (size_t)alignment;
    const size_t stride = (sizeof(shared_material) + align - 1) / align * align;
    unsigned char *blocks = calloc(world->material_count + 1, stride);
    mesh->materials = calloc(world->material_count + 1, sizeof *mesh->materials);
    if (!blocks || !mesh->materials) {
        free(blocks);
        return false;
    }
    mesh->material_count = world->material_count;
    for (size_t i = 0; i < world->material_count; i++) {
        shared_material block;
        fill_material(world, i, mesh, &mesh->materials[i], &block);
        mesh->layered = mesh->layered || mesh->materials[i].layered;
        mesh->translucent = mesh->translucent || scene_is_translucent(&world->materials[i]);
        memcpy(blocks + i * stride, &block, sizeof block);
    }
    glCreateBuffers(1, &mesh->material_blocks);
    glNamedBufferStorage(mesh->material_blocks, (GLsizeiptr)((world->material_count + 1) * stride),
                         blocks, GL_DYNAMIC_STORAGE_BIT);
    mesh->material_stride = (GLsizeiptr)stride;
    free(blocks);
    return true;
}

static bool create_material_constants(const scene *world, gpu_mesh *mesh) {
    shared_material_constants *all = calloc(world->material_count + 1, sizeof *all);
    if (!all)
        return false;
    for (size_t i = 0; i < world->material_count; i++)
        all[i] = gpu_material_constants(&world->materials[i]);
    glCreateBuffers(1, &mesh->material_constants);
    glNamedBufferStorage(mesh->material_constants,
                         (GLsizeiptr)((world->material_count + 1) * sizeof *all), all,
                         GL_DYNAMIC_STORAGE_BIT);
    free(all);
    return true;
}

void gpu_mesh_set_table(const gpu_mesh *mesh, size_t material, int table) {
    const float value = (float)table;
    glNamedBufferSubData(mesh->material_constants,
                         (GLintptr)(material * sizeof(shared_material_constants) +
                                    offsetof(shared_material_constants, table)),
                         sizeof value, &value);
}

/* --- triangles -------------------------------------------------------------------------------- */

/* Adds the rows of the instance's matrix, then its number. */
static void add_instance_attributes(const gpu_mesh *mesh, GLuint array, GLuint first) {
    glVertexArrayVertexBuffer(array, 1, mesh->seen_buffer, 0, sizeof(gpu_instance));
    glVertexArrayBindingDivisor(array, 1, 1);
    for (GLuint i = 0; i < 4; i++) {
        const GLuint offset = i * (GLuint)sizeof(float[4]);
        glEnableVertexArrayAttrib(array, first + i);
        if (i < 3)
            glVertexArrayAttribFormat(array, first + i, 4, GL_FLOAT, GL_FALSE, offset);
        else
            glVertexArrayAttribIFormat(array, first + i, 1, GL_UNSIGNED_INT, offset);
        glVertexArrayAttribBinding(array, first + i, 1);
    }
}

static GLuint create_vertex_array(const gpu_mesh *mesh) {
    static const struct {
        GLint size;
        GLenum type;
        size_t offset;
    } attributes[] = { { 3, GL_FLOAT, offsetof(scene_vertex, position) },
                       { 3, GL_FLOAT, offsetof(scene_vertex, normal) },
                       { 4, GL_FLOAT, offsetof(scene_vertex, uv) },
                       { 4, GL_FLOAT, offsetof(scene_vertex, tangent) },
                       { 4, GL_UNSIGNED_SHORT, offsetof(scene_vertex, color) } };
    GLuint array = 0;
    glCreateVertexArrays(1, &array);
    glVertexArrayVertexBuffer(array, 0, mesh->vertices, 0, sizeof(scene_vertex));
    glVertexArrayElementBuffer(array, mesh->indices);
    for (GLuint i = 0; i < sizeof attributes / sizeof *attributes; i++) {
        glEnableVertexArrayAttrib(array, i);
        glVertexArrayAttribFormat(array, i, attributes[i].size, attributes[i].type, GL_TRUE,
                                  (GLuint)attributes[i].offset);
        glVertexArrayAttribBinding(array, i, 0);
    }
    add_instance_attributes(mesh, array, sizeof attributes / sizeof *attributes);
    return array;
}

/* Adds an instance to its draw. */
static void place_instance(const scene *world, size_t number, gpu_draw *draw, gpu_mesh *mesh) {
    const scene_instance *placed = &world->instances[number];
    const size_t at = draw->first + draw->count;
    gpu_instance *instance = &mesh->instances[at];
    memcpy(instance->world_from_mesh, placed->world_from_mesh, sizeof instance->world_from_mesh);
    instance->number = (GLuint)draw->count & ~SHARED_INSTANCE_MOVES;
    if (!scene_instance_is_identity(placed))
        instance->number |= SHARED_INSTANCE_MOVES;
    scene_instance_box(world, number, mesh->boxes[at].minimum, mesh->boxes[at].maximum);
    draw->count++;
}

/* Returns which possible draw an instance belongs to: that of its mesh, mirrored or not. */
static size_t draw_of(const scene_instance *placed) {
    return 2 * (size_t)placed->mesh + scene_instance_mirrors(placed);
}

/* Lays out the draws that have instances, with room for these; of[i] becomes the number of possible
 * draw i. */
static void lay_out_draws(const scene *world, gpu_mesh *mesh, size_t *of) {
    size_t first = 0;
    for (int masked = 0; masked < 2; masked++)
        for (size_t i = 0; i < 2 * world->mesh_count; i++) {
            const scene_mesh *source = &world->meshes[i / 2];
            if (of[i] == 0 || mesh->materials[source->material].masked != (masked == 1))
                continue;
            gpu_draw *draw = &mesh->draws[mesh->draw_count];
            *draw = (gpu_draw) { .first_index = source->first_index,
                                 .index_count = source->index_count,
                                 .material = source->material,
                                 .mirrors = i % 2 == 1,
                                 .first = first };
            first += of[i];
            of[i] = mesh->draw_count++;
        }
}

static bool create_draws(const scene *world, gpu_mesh *mesh) {
    size_t *of = calloc(2 * world->mesh_count + 1, sizeof *of);
    mesh->draws = calloc(2 * world->mesh_count + 1, sizeof *mesh->draws);
    mesh->instances = malloc((world->instance_count + 1) * sizeof *mesh->instances);
    mesh->seen = malloc((world->instance_count + 1) * sizeof *mesh->seen);
    mesh->boxes = malloc((world->instance_count + 1) * sizeof *mesh->boxes);
    const bool ok = of && mesh->draws && mesh->instances && mesh->seen && mesh->boxes;
    for (size_t i = 0; ok && i < world->instance_count; i++)
        of[draw_of(&world->instances[i])]++;
    if (ok)
        lay_out_draws(world, mesh, of);
    for (size_t i = 0; ok && i < world->instance_count; i++)
        place_instance(world, i, &mesh->draws[of[draw_of(&world->instances[i])]], mesh);
    free(of);
    return ok;
}

bool gpu_mesh_create(const gpu_context *context, const scene *world, gpu_mesh *mesh,
                     base_error *error) {
    memset(mesh, 0, sizeof *mesh);
    if (!create_textures(context, world, mesh, error))
        return false;
    create_samplers(context, mesh);
    if (world->material_count > SHARED_MATERIALS_MAX)
        return base_fail(error, world->name, "has %zu materials: the shaders tell %d apart",
                         world->material_count, SHARED_MATERIALS_MAX);
    if (!create_materials(world, mesh) || !create_material_constants(world, mesh) ||
        !create_draws(world, mesh))
        return base_fail(error, world->name, "out of memory");
    mesh->vertices = upload(world->vertices, world->vertex_count * sizeof *world->vertices);
    mesh->indices = upload(world->indices, world->index_count * sizeof *world->indices);
    glCreateBuffers(1, &mesh->seen_buffer);
    mesh->vertex_array = create_vertex_array(mesh);
    if (glGetError() == GL_OUT_OF_MEMORY)
        return base_fail(error, world->name, "the scene does not fit the memory of %s",
                         context->device);
    return true;
}

void gpu_mesh_destroy(gpu_mesh *mesh) {
    glDeleteVertexArrays(1, &mesh->vertex_array);
    glDeleteBuffers(1, &mesh->vertices);
    glDeleteBuffers(1, &mesh->indices);
    glDeleteBuffers(1, &mesh->seen_buffer);
    glDeleteBuffers(1, &mesh->material_blocks);
    glDeleteBuffers(1, &mesh->material_constants);
    glDeleteSamplers(SCENE_WRAPS * SCENE_WRAPS, mesh->samplers);
    if (mesh->textures) /* OpenGL ignores a name that occurs a second time */
        glDeleteTextures(mesh->texture_count, mesh->textures);
    free(mesh->textures);
    free(mesh->materials);
    free(mesh->draws);
    free(mesh->instances);
    free(mesh->seen);
    free(mesh->boxes);
    memset(mesh, 0, sizeof *mesh);
}

/* --- drawing ---------------------------------------------------------------------------------- */

/* Returns false if the box is entirely outside one of the planes w ± x >= 0, w ± y >= 0, w - z >= 0
 * (near). */
static bool may_be_seen(const mat4 m, const gpu_box *box) {
    static const float planes[5][4] = {
        { 1, 0, 0, 1 }, { -1, 0, 0, 1 }, { 0, 1, 0, 1 }, { 0, -1, 0, 1 }, { 0, 0, -1, 1 }
    };
    for (int p = 0; p < 5; p++) {
        float farthest = 0;
        for (int axis = 0; axis < 4; axis++) {
            float along = 0;
            for (int row = 0; row < 4; row++)
                along += planes[p][row] * m[4 * axis + row];
            farthest += axis == 3   ? along
                        : along > 0 ? along * box->maximum[axis]
                                    : along * box->minimum[axis];
        }
        if (farthest < 0)
            return false;
    }
    return true;
}

static GLuint program_of(const gpu_surfaces *programs, const gpu_material *material) {
    if (material->layered)
        return material->masked ? programs->layered_masked : programs->layered;
    if (material->plain)
        return programs->plain;
    return material->masked ? programs->masked : programs->opaque;
}

/* Enables the attachments of layers for layered materials only. */
static void choose_attachments(bool layered) {
    const GLboolean write = layered ? GL_TRUE : GL_FALSE;
    for (GLuint i = GPU_ATTACHMENTS_PLAIN; i < GPU_ATTACHMENTS; i++)
        glColorMaski(i, write, write, write, write);
}

/* Collects the instances that may be visible, draw by draw. */
static void find_seen(const gpu_mesh *mesh, const mat4 clip_from_world) {
    size_t count = 0;
    for (size_t i = 0; i < mesh->draw_count; i++) {
        gpu_draw *draw = &mesh->draws[i];
        draw->first_seen = (GLuint)count;
        for (size_t k = draw->first; k < draw->first + draw->count; k++)
            if (may_be_seen(clip_from_world, &mesh->boxes[k]))
                mesh->seen[count++] = mesh->instances[k];
        draw->seen = (GLuint)count - draw->first_seen;
    }
    glNamedBufferData(mesh->seen_buffer, (GLsizeiptr)((count + 1) * sizeof *mesh->seen), mesh->seen,
                      GL_STREAM_DRAW);
}

void gpu_mesh_draw(const gpu_mesh *mesh, const mat4 clip_from_world, const gpu_surfaces *programs) {
    find_seen(mesh, clip_from_world);
    glBindVertexArray(mesh->vertex_array);
    GLuint program = 0, current = ~0u;
    for (size_t i = 0; i < mesh->draw_count; i++) {
        const gpu_draw *draw = &mesh->draws[i];
        if (draw->seen == 0)
            continue;
        const gpu_material *material = &mesh->materials[draw->material];
        if (current != draw->material) {
            current = draw->material;
            if (program != program_of(programs, material)) {
                glUseProgram(program = program_of(programs, material));
                choose_attachments(material->layered);
            }
            glBindBufferRange(GL_UNIFORM_BUFFER, SHARED_MATERIAL, mesh->material_blocks,
                              (GLintptr)draw->material * mesh->material_stride,
                              sizeof(shared_material));
            glBindTextures(SHARED_BASE_COLOR, 4, material->maps);
            glBindTextures(SHARED_OCCLUSION, SHARED_MAPS - 4, material->maps + 4);
            glBindSamplers(SHARED_BASE_COLOR, 4, material->samplers);
            glBindSamplers(SHARED_OCCLUSION, SHARED_MAPS - 4, material->samplers + 4);
            if (material->double_sided)
                glDisable(GL_CULL_FACE);
            else
                glEnable(GL_CULL_FACE);
        }
        glFrontFace(draw->mirrors ? GL_CCW : GL_CW); /* y runs downward, which swaps the winding */
        glDrawElementsInstancedBaseInstance(GL_TRIANGLES, (GLsizei)draw->index_count,
                                            GL_UNSIGNED_INT,
                                            (const void *)(4 * (uintptr_t)draw->first_index),
                                            (GLsizei)draw->seen, draw->first_seen);
    }
    glFrontFace(GL_CW);
    choose_attachments(false);
    glBindSamplers(SHARED_BASE_COLOR, 4, NULL);
    glBindSamplers(SHARED_OCCLUSION, SHARED_MAPS - 4, NULL);
}
