/* SPDX-License-Identifier: MIT */
#include "app/scene/phong.h"
#include "app/scene/vector.h"

#include <math.h>
#include <stdlib.h>

#define METAL_SPECULAR_MIN        0.25f /* least specular color of a metal, absolute */
#define METAL_SPECULAR_TO_DIFFUSE 2.0f  /* and least multiple of the diffuse color */

static float clamp_unit(float x) {
    return fminf(fmaxf(x, 0.0f), 1.0f);
}

void phong_apply(const phong *from, scene_material *to) {
    const float specular = rgb_brightest(from->specular);
    const bool metal = specular >= METAL_SPECULAR_MIN &&
                       specular > METAL_SPECULAR_TO_DIFFUSE * rgb_brightest(from->diffuse);
    for (int k = 0; k < 3; k++) {
        to->base_color[k] = clamp_unit(metal ? from->specular[k] : from->diffuse[k]);
        to->emission[k] = fmaxf(from->emission[k], 0.0f);
    }
    to->base_color[3] = clamp_unit(from->opacity);
    to->flags |= SCENE_DOUBLE_SIDED | SCENE_SIDES_UNSAID;
    to->metallic = metal ? 1.0f : 0.0f;
    to->roughness = 1.0f;
    if (specular > 0.0f && from->exponent > 0.0f)
        to->roughness = fminf(1.0f, sqrtf(sqrtf(2.0f / (from->exponent + 2.0f))));
    if (to->base_color[3] < 1.0f)
        to->flags |= SCENE_ALPHA_BLEND;
}

static bool is_invisible(const scene_material *material) {
    return material->base_color[3] == 0.0f && material->flags & SCENE_ALPHA_BLEND;
}

bool phong_tell_invisible(scene_builder *builder, const char *told) {
    const size_t count = builder_count(builder, BLOB_MATERIALS);
    scene_material *const materials = builder_items(builder, BLOB_MATERIALS);
    const scene_mesh *const meshes = builder_items(builder, BLOB_MESHES);
    unsigned char *const used = calloc(count + 1, 1);
    bool all = true;
    size_t invisible = 0;
    if (!used)
        return false;
    for (size_t i = 0; i < builder_count(builder, BLOB_MESHES); i++) {
        if (meshes[i].material >= count)
            continue;
        const bool hidden = is_invisible(&materials[meshes[i].material]);
        all &= hidden;
        invisible += hidden && !used[meshes[i].material];
        used[meshes[i].material] = 1;
    }
    for (size_t i = 0; all && i < count; i++)
        if (used[i]) {
            materials[i].base_color[3] = 1.0f;
            materials[i].flags &= ~(uint32_t)SCENE_ALPHA_BLEND;
        }
    free(used);
    builder_unsupported(builder, all ? "opacity 0 of all there is" : told, "material", invisible);
    return true;
}
