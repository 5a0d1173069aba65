/* SPDX-License-Identifier: MIT */
#include "app/truth/reference_describe.h"

#include "app/scene/texture_at.h"

static void sample(const reference_materials *m, const scene_texture_use *use,
                   const reference_hit *hit, double rgba[4]) {
    texture_at(m->scene, use, hit->uv + 2 * use->set, rgba);
}

static reference_vec mapped_normal(const reference_materials *m, const reference_hit *hit,
                                   const scene_texture_use *map, double scale) {
    double texel[4];
    if (map->texture < 0)
        return hit->normal;
    sample(m, map, hit, texel);
    const reference_vec bitangent =
        reference_scale(hit->handedness, reference_cross(hit->normal, hit->tangent));
    const reference_vec normal =
        reference_add(reference_scale((2 * texel[0] - 1) * scale, hit->tangent),
                      reference_add(reference_scale((2 * texel[1] - 1) * scale, bitangent),
                                    reference_scale(2 * texel[2] - 1, hit->normal)));
    return reference_normalize(normal);
}

static reference_dielectric dielectric_of(const reference_materials *m, const reference_hit *hit,
                                          const scene_material *material) {
    double weight[4], tint[4];
    sample(m, &material->specular_map, hit, weight);
    sample(m, &material->specular_color_map, hit, tint);
    reference_dielectric d = { .f90 = (double)material->f90 * weight[3] };
    for (int c = 0; c < 3; c++)
        d.f0[c] = fmin((double)material->f0[c] * tint[c], 1) * d.f90;
    return d;
}

static void sheen_surface(const reference_materials *m, const reference_hit *hit,
                          reference_vec normal, reference_vec view, reference_description *d) {
    const scene_material *material = &m->scene->materials[hit->material];
    double tint[4], rough[4], color[3];
    sample(m, &material->sheen_color_map, hit, tint);
    sample(m, &material->sheen_roughness_map, hit, rough);
    for (int c = 0; c < 3; c++)
        color[c] = tint[c] * (double)material->sheen_color[c];
    reference_sheen_set(&d->sheen, m->albedos, color, rough[3] * (double)material->sheen_roughness,
                        normal, view);
    reference_surface_sheen(&d->surface, &d->sheen);
}

/* Puts a coat over the surface, which also attenuates its emission. */
static void coat_surface(const reference_materials *m, const reference_hit *hit, reference_vec view,
                         reference_description *d) {
    const scene_material *material = &m->scene->materials[hit->material];
    double weight[4], rough[4];
    sample(m, &material->coat_map, hit, weight);
    sample(m, &material->coat_roughness_map, hit, rough);
    const reference_vec normal =
        mapped_normal(m, hit, &material->coat_normal_map, (double)material->coat_normal_scale);
    reference_coat_set(&d->coat, weight[0] * (double)material->coat,
                       rough[1] * (double)material->coat_roughness, normal, view);
    reference_surface_coat(&d->surface, &d->coat, normal, view);
    for (int c = 0; c < 3; c++)
        d->emission[c] *= d->surface.under;
}

/* Finds the transmitted color, which is taken from the base color except for leaves. */
static void take_transmission(const reference_materials *m, const reference_hit *hit,
                              double metallic, double base[3], double through[3]) {
    const scene_material *material = &m->scene->materials[hit->material];
    double part[4], color[4];
    sample(m, &material->transmission_map, hit, part);
    sample(m, &material->transmission_color_map, hit, color);
    const double left = (double)material->transmission * part[3] * (1 - metallic);
    for (int c = 0; c < 3; c++) {
        if (material->flags & SCENE_LEAF) {
            through[c] = (double)SCENE_LEAF_TRANSMITS * base[c] * (1 - metallic);
        } else {
            through[c] = left * color[c] * (double)material->transmission_color[c];
            base[c] *= 1 - left;
        }
    }
}

void reference_describe(const reference_materials *m, const reference_hit *hit, reference_vec view,
                        reference_description *d) {
    reference_surface *const surface = &d->surface;
    const scene_material *material = &m->scene->materials[hit->material];
    double color[4], rough[4], glow[4], shade[4], base[3], through[3] = { 0 };
    sample(m, &material->base_color_map, hit, color);
    sample(m, &material->metallic_roughness_map, hit, rough);
    sample(m, &material->emission_map, hit, glow);
    for (int c = 0; c < 3; c++) {
        base[c] = color[c] * hit->color[c] * (double)material->base_color[c];
        d->emission[c] = glow[c] * (double)material->emission[c] *
                         (material->flags & SCENE_UNLIT ? hit->color[c] : 1);
    }
    sample(m, &material->occlusion_map, hit, shade);
    const reference_vec normal =
        mapped_normal(m, hit, &material->normal_map, (double)material->normal_scale);
    const reference_dielectric dielectric = dielectric_of(m, hit, material);
    const double metallic = rough[2] * (double)material->metallic;
    if (scene_is_translucent(material))
        take_transmission(m, hit, metallic, base, through);
    reference_ggx_set(&d->ggx, base, metallic, rough[1] * (double)material->roughness, &dielectric,
                      normal, view);
    surface->position = hit->position;
    surface->ray_origin = hit->ray_origin;
    reference_surface_shine(surface, &m->band_limit, &d->ggx, normal, view);
    const reference_material_source *source = m->sources ? &m->sources[hit->material] : NULL;
    if (source && (source->brdf || source->coefficients)) {
        reference_tabulated_orient(&d->tabulated, source, normal, hit->tangent, view);
        reference_surface_measure(surface, &d->tabulated, normal, view);
    } else {
        if (scene_has_sheen(material))
            sheen_surface(m, hit, normal, view, d);
        if (material->coat > 0)
            coat_surface(m, hit, view, d);
        if (scene_is_translucent(material)) {
            for (int c = 0; c < 3; c++)
                through[c] *= surface->under;
            reference_surface_transmit(surface, through, normal, hit->ray_behind);
        }
    }
    surface->occluded = (double)material->occlusion * (1 - shade[0]);
}

double reference_opacity(const reference_materials *m, const reference_hit *hit) {
    const scene_material *material = &m->scene->materials[hit->material];
    double texel[4];
    if (!(material->flags & SCENE_ALPHA_BLEND))
        return 1;
    sample(m, &material->base_color_map, hit, texel);
    return texel[3] * hit->color[3] * (double)material->base_color[3];
}

bool reference_description_create(const reference_materials *m, reference_description *d) {
    *d = (reference_description) { .tabulated = { .coefficients = NULL } };
    return reference_tabulated_create(&d->tabulated, m->sources,
                                      m->sources ? m->scene->material_count : 0);
}

void reference_description_free(reference_description *d) {
    reference_tabulated_free(&d->tabulated);
}
