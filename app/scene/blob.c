/* SPDX-License-Identifier: MIT */
#include "app/scene/blob.h"

#include "app/scene/instance.h"
#include "app/scene/vector.h"

#include <stdlib.h>
#include <string.h>

const size_t blob_item_size[BLOB_SECTIONS] = {
    [BLOB_VERTICES] = sizeof(scene_vertex),
    [BLOB_INDICES] = sizeof(uint32_t),
    [BLOB_MESHES] = sizeof(scene_mesh),
    [BLOB_INSTANCES] = sizeof(scene_instance),
    [BLOB_NODES] = sizeof(scene_node),
    [BLOB_NAMES] = 1,
    [BLOB_MATERIALS] = sizeof(scene_material),
    [BLOB_VARIANTS] = sizeof(scene_variant),
    [BLOB_TEXTURES] = sizeof(scene_texture),
    [BLOB_IMAGES] = sizeof(scene_image),
    [BLOB_ENCODED] = 1,
    [BLOB_TEXELS] = 1,
    [BLOB_CAMERAS] = sizeof(scene_camera),
    [BLOB_LIGHTS] = sizeof(scene_light),
    [BLOB_MOTIONS] = sizeof(scene_motion),
    [BLOB_OFFSETS] = sizeof(lmp_vec3),
    [BLOB_UNSUPPORTED] = sizeof(scene_unsupported),
    [BLOB_SOURCES] = sizeof(blob_source),
};

static uint32_t digest_item_sizes(void) {
    uint32_t digest = 0;
    for (int i = 0; i < BLOB_SECTIONS; i++)
        digest = digest * 1021u + (uint32_t)blob_item_size[i];
    return digest;
}

void blob_layout(blob_header *header, const size_t counts[BLOB_SECTIONS]) {
    memset(header, 0, sizeof *header);
    memcpy(header->magic, BLOB_MAGIC, sizeof header->magic);
    header->version = BLOB_VERSION;
    header->item_sizes = digest_item_sizes();
    uint64_t offset = sizeof *header;
    for (int i = 0; i < BLOB_SECTIONS; i++) {
        offset = (offset + 15) & ~(uint64_t)15;
        header->sections[i].offset = offset;
        header->sections[i].count = counts[i];
        offset += counts[i] * blob_item_size[i];
    }
    header->size = offset;
}

const void *blob_items(const void *block, blob_section section) {
    const blob_header *header = block;
    return (const char *)block + header->sections[section].offset;
}

uint64_t blob_first_texel(uint64_t end) {
    return (end + BLOB_PAGE - 1) / BLOB_PAGE * BLOB_PAGE;
}

/* --- validation ------------------------------------------------------------------------------- */

static bool all_finite(const float *numbers, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (!isfinite(numbers[i]))
            return false;
    return true;
}

static bool origin_fits(const double origin[3]) {
    for (int k = 0; k < 3; k++)
        if (!(fabs(origin[k]) <= (double)LMP_LENGTH_MAX))
            return false;
    return true;
}

static bool header_fits(const blob_header *header, size_t size) {
    if (size < sizeof *header || memcmp(header->magic, BLOB_MAGIC, sizeof header->magic) != 0 ||
        header->version != BLOB_VERSION || header->item_sizes != digest_item_sizes() ||
        header->size != size)
        return false;
    for (int i = 0; i < BLOB_SECTIONS; i++) {
        const uint64_t offset = header->sections[i].offset, count = header->sections[i].count;
        if (offset % 16 != 0 || offset < sizeof *header || offset > size ||
            count > (size - offset) / blob_item_size[i])
            return false;
    }
    return header->up <= SCENE_UP_Z && origin_fits(header->origin) &&
           header->sections[BLOB_LIGHTS].count <= SCENE_LIGHTS_MAX &&
           header->sections[BLOB_SOURCES].count <= BLOB_SOURCES_MAX &&
           header->sections[BLOB_VERTICES].count < UINT32_MAX &&
           header->sections[BLOB_INDICES].count < UINT32_MAX &&
           header->sections[BLOB_INSTANCES].count < UINT32_MAX &&
           header->sections[BLOB_NODES].count < UINT32_MAX &&
           header->sections[BLOB_NAMES].count < UINT32_MAX;
}

static bool all_in_reach(const float *coordinates, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (!(fabsf(coordinates[i]) <= LMP_LENGTH_MAX))
            return false;
    return true;
}

/* Whether a name is valid, which means that cleaning it changes nothing. */
static bool name_fits(const char name[SCENE_NAME_SIZE]) {
    char clean[SCENE_NAME_SIZE];
    if (name[SCENE_NAME_SIZE - 1] != 0)
        return false;
    scene_clean_name(clean, name);
    return memcmp(clean, name, SCENE_NAME_SIZE) == 0;
}

void blob_bounds(const scene_vertex *vertices, const uint32_t *indices, size_t count,
                 float minimum[3], float maximum[3]) {
    for (size_t i = 0; i < count; i++)
        for (int k = 0; k < 3; k++) {
            const float x = vertices[indices[i]].position[k];
            if (i == 0 || x < minimum[k])
                minimum[k] = x;
            if (i == 0 || x > maximum[k])
                maximum[k] = x;
        }
}

/* Whether a mesh's bounds are those of its vertices: with others it would be drawn, and lit,
 * elsewhere. */
static bool bounds_fit(const blob_header *header, const scene_mesh *mesh) {
    const uint32_t *indices = blob_items(header, BLOB_INDICES);
    float minimum[3], maximum[3];
    blob_bounds(blob_items(header, BLOB_VERTICES), indices + mesh->first_index, mesh->index_count,
                minimum, maximum);
    for (int k = 0; k < 3; k++)
        if (!(mesh->minimum[k] == minimum[k] && mesh->maximum[k] == maximum[k]))
            return false;
    return true;
}

static bool is_unit(const float v[3]) {
    return fabsf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2] - 1.0f) <= 1e-3f;
}

static bool vertex_fits(const scene_vertex *vertex) {
    return all_in_reach(vertex->position, 3) && all_finite(vertex->uv[0], 4) &&
           is_unit(vertex->normal) && is_unit(vertex->tangent) && fabsf(vertex->tangent[3]) == 1.0f;
}

static bool geometry_fits(const blob_header *header) {
    const scene_vertex *vertices = blob_items(header, BLOB_VERTICES);
    const uint64_t vertex_count = header->sections[BLOB_VERTICES].count;
    for (uint64_t i = 0; i < vertex_count; i++)
        if (!vertex_fits(&vertices[i]))
            return false;
    const uint32_t *indices = blob_items(header, BLOB_INDICES);
    const uint64_t index_count = header->sections[BLOB_INDICES].count;
    for (uint64_t i = 0; i < index_count; i++)
        if (indices[i] >= vertex_count)
            return false;
    const scene_mesh *meshes = blob_items(header, BLOB_MESHES);
    uint64_t corners = 0; /* of all meshes: they do not overlap, or a copy of them would overrun */
    for (uint64_t i = 0; i < header->sections[BLOB_MESHES].count; i++)
        if (!name_fits(meshes[i].name) || meshes[i].index_count % 3 != 0 ||
            meshes[i].index_count == 0 || meshes[i].first_index > index_count ||
            meshes[i].index_count > index_count - meshes[i].first_index ||
            meshes[i].material >= header->sections[BLOB_MATERIALS].count ||
            (corners += meshes[i].index_count) > index_count || !bounds_fit(header, &meshes[i]))
            return false;
    return true;
}

/* Whether all instances together have no more triangles than 32 bits can number. */
static bool instances_fit(const blob_header *header) {
    uint64_t corners = 0;
    scene s;
    blob_geometry(header, &s);
    for (size_t i = 0; i < s.instance_count; i++) {
        const scene_instance *instance = &s.instances[i];
        float minimum[3], maximum[3];
        if (instance->mesh >= s.mesh_count || !scene_instance_fits(instance) ||
            (corners += s.meshes[instance->mesh].index_count) >= UINT32_MAX)
            return false;
        scene_instance_box(&s, i, minimum, maximum);
        if (!all_in_reach(minimum, 3) || !all_in_reach(maximum, 3))
            return false;
    }
    return true;
}

/* Whether a name of a node begins at an offset. */
static bool name_begins(const blob_header *header, uint32_t offset) {
    const char *names = blob_items(header, BLOB_NAMES);
    const uint64_t size = header->sections[BLOB_NAMES].count;
    char name[SCENE_NAME_SIZE] = "";
    if (offset >= size || (offset > 0 && names[offset - 1]))
        return false;
    memcpy(name, names + offset, size - offset < sizeof name ? size - offset : sizeof name);
    const char *const end = memchr(name, '\0', sizeof name);
    if (!end || names[size - 1])
        return false;
    memset(name + (end - name), 0, sizeof name - (size_t)(end - name));
    return name_fits(name);
}

/* Whether the nodes are a tree, parents first, and hold every instance. */
static bool nodes_fit(const blob_header *header) {
    const scene_node *nodes = blob_items(header, BLOB_NODES);
    const uint64_t count = header->sections[BLOB_NODES].count;
    const uint64_t instances = header->sections[BLOB_INSTANCES].count;
    for (uint64_t i = 0; i < count; i++) {
        const scene_node *node = &nodes[i];
        const uint64_t bound = node->parent < i ? nodes[node->parent].end : count;
        if ((node->parent >= i && node->parent != SCENE_NO_NODE) || i >= bound || node->end <= i ||
            node->end > bound || node->first > instances ||
            (i > 0 ? node->first < nodes[i - 1].first : node->first > 0) ||
            (node->name != SCENE_NO_NODE && !name_begins(header, node->name)))
            return false;
    }
    return count > 0 || instances == 0;
}

static bool use_fits(const scene_texture_use *use, uint64_t texture_count) {
    return use->texture >= -1 && use->set <= 1 &&
           (use->texture < 0 || (uint64_t)use->texture < texture_count) &&
           all_finite(use->matrix, 4) && all_finite(use->offset, 2);
}

static bool maps_fit(const scene_material *m, uint64_t texture_count) {
    for (int i = 0; i < SCENE_MAPS; i++)
        if (!use_fits(&m->maps[i], texture_count))
            return false;
    return true;
}

/* Whether all numbers are in 0 … 1. */
static bool all_parts(const float *numbers, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (!(numbers[i] >= 0.0f && numbers[i] <= 1.0f))
            return false;
    return true;
}

/* Whether images follow one another, so that no two share texels; *texel_bytes receives their
 * size. */
static bool images_fit(const blob_header *header, uint64_t *texel_bytes) {
    const scene_image *images = blob_items(header, BLOB_IMAGES);
    const uint64_t count = header->sections[BLOB_IMAGES].count;
    const uint64_t encoded = header->sections[BLOB_ENCODED].count;
    *texel_bytes = header->sections[BLOB_TEXELS].count;
    if (count > 0 && *texel_bytes > 0)
        return false;
    for (uint64_t i = 0; i < count; i++) {
        const scene_image *image = &images[i];
        if (!name_fits(image->name) || image->width == 0 || image->height == 0 ||
            image->width > 65536 || image->height > 65536 || image->first_byte > encoded ||
            image->size > encoded - image->first_byte ||
            image->first_texel != blob_first_texel(*texel_bytes))
            return false;
        *texel_bytes = image->first_texel + 4 * (uint64_t)image->width * image->height;
    }
    return true;
}

static bool materials_fit(const blob_header *header) {
    const scene_material *materials = blob_items(header, BLOB_MATERIALS);
    const uint64_t texture_count = header->sections[BLOB_TEXTURES].count;
    for (uint64_t i = 0; i < header->sections[BLOB_MATERIALS].count; i++) {
        const scene_material *m = &materials[i];
        const float numbers[] = {
            m->metallic, m->roughness, m->normal_scale, m->alpha_cutoff,
            m->f0[0],    m->f0[1],     m->f0[2],        m->coat_normal_scale
        };
        const float parts[] = {
            m->f90, m->occlusion, m->coat, m->coat_roughness, m->sheen_roughness, m->transmission
        };
        if (!name_fits(m->name) || !all_finite(m->base_color, 4) || !all_finite(numbers, 8) ||
            !scene_color_fits(m->emission) || !all_parts(parts, 6) ||
            !all_parts(m->sheen_color, 3) || !all_parts(m->transmission_color, 3) ||
            !maps_fit(m, texture_count))
            return false;
    }
    const scene_texture *textures = blob_items(header, BLOB_TEXTURES);
    uint64_t texel_bytes;
    if (!images_fit(header, &texel_bytes))
        return false;
    for (uint64_t i = 0; i < texture_count; i++) {
        const uint64_t bytes = 4 * (uint64_t)textures[i].width * textures[i].height;
        if (!name_fits(textures[i].name) || textures[i].width == 0 || textures[i].height == 0 ||
            textures[i].width > 65536 || textures[i].height > 65536 || textures[i].srgb > 1 ||
            textures[i].wrap_u >= SCENE_WRAPS || textures[i].wrap_v >= SCENE_WRAPS ||
            textures[i].first_byte > texel_bytes || bytes > texel_bytes - textures[i].first_byte)
            return false;
    }
    return true;
}

static bool views_fit(const blob_header *header) {
    const scene_camera *cameras = blob_items(header, BLOB_CAMERAS);
    for (uint64_t i = 0; i < header->sections[BLOB_CAMERAS].count; i++)
        if (!name_fits(cameras[i].name) || !all_finite(cameras[i].eye, 3) ||
            !all_finite(cameras[i].target, 3) || !all_finite(cameras[i].up, 3) ||
            !(cameras[i].fov > 0.0f && cameras[i].fov < 3.1415f) ||
            !(cameras[i].height >= 0.0f && cameras[i].height < 1e17f) ||
            !(cameras[i].aspect >= 0.0f && cameras[i].aspect < 1e6f) ||
            !(cameras[i].near >= 0.0f && cameras[i].near < LMP_LENGTH_MAX) ||
            !(cameras[i].far == 0.0f ||
              (cameras[i].far > cameras[i].near && cameras[i].far < LMP_LENGTH_MAX)))
            return false;
    const scene_light *lights = blob_items(header, BLOB_LIGHTS);
    for (uint64_t i = 0; i < header->sections[BLOB_LIGHTS].count; i++) {
        scene_light_error wrong;
        if (lights[i].hidden > 1 || lights[i].glows_both > 1 ||
            lights[i].glow > header->sections[BLOB_INSTANCES].count ||
            !scene_light_check(&lights[i], &wrong))
            return false;
    }
    const blob_source *sources = blob_items(header, BLOB_SOURCES);
    for (uint64_t i = 0; i < header->sections[BLOB_SOURCES].count; i++)
        if (!memchr(sources[i].path, 0, sizeof sources[i].path))
            return false;
    return true;
}

static bool motions_fit(const blob_header *header) {
    const scene_motion *motions = blob_items(header, BLOB_MOTIONS);
    const uint64_t light_count = header->sections[BLOB_LIGHTS].count;
    const uint64_t offset_count = header->sections[BLOB_OFFSETS].count;
    uint64_t offsets_used = 0;
    for (uint64_t i = 0; i < header->sections[BLOB_MOTIONS].count; i++) {
        const scene_motion *m = &motions[i];
        /* in ascending order of lights, so that no light has two */
        if (m->light >= light_count || (i > 0 && m->light <= motions[i - 1].light) ||
            m->count < 2 || m->first > offset_count || m->count > offset_count - m->first ||
            (offsets_used += m->count) > offset_count || !(m->period > 0.0f) ||
            !isfinite(m->period))
            return false;
    }
    const lmp_vec3 *offsets = blob_items(header, BLOB_OFFSETS);
    return all_in_reach(&offsets->x, 3 * offset_count);
}

static bool variants_fit(const blob_header *header) {
    const scene_variant *variants = blob_items(header, BLOB_VARIANTS);
    for (uint64_t i = 0; i < header->sections[BLOB_VARIANTS].count; i++)
        if (!name_fits(variants[i].name))
            return false;
    return true;
}

static bool unsupported_fits(const blob_header *header) {
    const scene_unsupported *items = blob_items(header, BLOB_UNSUPPORTED);
    const uint64_t count = header->sections[BLOB_UNSUPPORTED].count;
    for (uint64_t i = 0; i < count && i < SCENE_UNSUPPORTED_MAX; i++)
        if (!name_fits(items[i].what) || !name_fits(items[i].noun))
            return false;
    return count <= SCENE_UNSUPPORTED_MAX;
}

bool blob_validate(const void *block, size_t size, bool checksum, const char *subject,
                   base_error *error) {
    const blob_header *header = block;
    if (!header_fits(header, size))
        return base_fail(error, subject, "gave a scene that is damaged or of another version");
    file_hash content = { 0 };
    for (int i = 0; checksum && i < BLOB_SECTIONS; i++)
        file_hash_add(&content, blob_items(block, (blob_section)i),
                      header->sections[i].count * blob_item_size[i]);
    if (checksum && (content.low != header->content.low || content.high != header->content.high))
        return base_fail(error, subject, "gave a scene whose checksum is wrong");
    if (!geometry_fits(header) || !instances_fit(header) || !nodes_fit(header))
        return base_fail(error, subject, "has invalid vertices or triangles");
    if (!materials_fit(header) || !variants_fit(header))
        return base_fail(error, subject, "has invalid materials or textures");
    if (!views_fit(header))
        return base_fail(error, subject, "has invalid cameras or lights");
    if (!unsupported_fits(header))
        return base_fail(error, subject, "has an invalid list of unsupported features");
    if (!motions_fit(header))
        return base_fail(error, subject, "has an invalid animation");
    return true;
}

/* --- opening ---------------------------------------------------------------------------------- */

void blob_geometry(const void *block, scene *s) {
    const blob_header *header = block;
    memset(s, 0, sizeof *s);
    s->vertices = blob_items(block, BLOB_VERTICES);
    s->indices = blob_items(block, BLOB_INDICES);
    s->meshes = blob_items(block, BLOB_MESHES);
    s->instances = blob_items(block, BLOB_INSTANCES);
    s->vertex_count = header->sections[BLOB_VERTICES].count;
    s->index_count = header->sections[BLOB_INDICES].count;
    s->mesh_count = header->sections[BLOB_MESHES].count;
    s->instance_count = header->sections[BLOB_INSTANCES].count;
    memcpy(s->origin, header->origin, sizeof s->origin);
    s->up = (int)header->up;
}

static void measure(scene *s) {
    for (int k = 0; k < 3; k++) {
        s->minimum[k] = -0.5f;
        s->maximum[k] = 0.5f;
    }
    scene_bounds(s, s->minimum, s->maximum);
}

bool blob_open(void *block, size_t size, const char *subject, scene *s, base_error *error) {
    const blob_header *header = block;
    scene_light *lights = calloc(SCENE_LIGHTS_MAX, sizeof *lights);
    scene_frame *frame = calloc(1, sizeof *frame);
    if (!lights || !frame) {
        free(lights);
        free(frame);
        return base_fail(error, subject, "does not fit into memory");
    }
    memcpy(lights, blob_items(block, BLOB_LIGHTS),
           header->sections[BLOB_LIGHTS].count * sizeof *lights);
    blob_geometry(block, s);
    s->nodes = blob_items(block, BLOB_NODES);
    s->names = blob_items(block, BLOB_NAMES);
    s->node_count = header->sections[BLOB_NODES].count;
    s->materials = blob_items(block, BLOB_MATERIALS);
    s->variants = blob_items(block, BLOB_VARIANTS);
    s->textures = blob_items(block, BLOB_TEXTURES);
    s->images = blob_items(block, BLOB_IMAGES);
    s->encoded = blob_items(block, BLOB_ENCODED);
    s->cameras = blob_items(block, BLOB_CAMERAS);
    s->motions = blob_items(block, BLOB_MOTIONS);
    s->offsets = blob_items(block, BLOB_OFFSETS);
    s->unsupported = blob_items(block, BLOB_UNSUPPORTED);
    s->material_count = header->sections[BLOB_MATERIALS].count;
    s->variant_count = header->sections[BLOB_VARIANTS].count;
    s->texture_count = header->sections[BLOB_TEXTURES].count;
    s->image_count = header->sections[BLOB_IMAGES].count;
    s->encoded_bytes = header->sections[BLOB_ENCODED].count;
    s->texel_bytes = header->sections[BLOB_TEXELS].count;
    if (s->image_count == 0)
        s->texels = blob_items(block, BLOB_TEXELS);
    s->camera_count = header->sections[BLOB_CAMERAS].count;
    s->motion_count = header->sections[BLOB_MOTIONS].count;
    s->offset_count = header->sections[BLOB_OFFSETS].count;
    s->unsupported_count = header->sections[BLOB_UNSUPPORTED].count;
    s->lights = lights;
    s->frame = frame;
    s->light_count = header->sections[BLOB_LIGHTS].count;
    s->block = block;
    s->block_size = size;
    s->name = subject;
    measure(s);
    return true;
}
