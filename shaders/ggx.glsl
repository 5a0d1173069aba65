/* SPDX-License-Identifier: MIT */
/* ggx.glsl - glTF's GGX as Phong lobes: lmp_lobe_ggx of lampion/lobe.h, which says what they mean.
 *
 * Fill a buffer or a texture of vec4 with lmp_lobe_ggx_texels and define before including
 *   LMP_GGX_TEXEL(i)   vec4: texel i, 0 <= i < 3104 */
#ifndef LAMPION_GGX_GLSL
#define LAMPION_GGX_GLSL

/* As in lampion/lobe.h and src/lobe/ggx_table.h. */
#define LMP_GGX_LOBES         3
#define LMP_GGX_VIEWS         32
#define LMP_GGX_ROUGHNESSES   32
#define LMP_GGX_ROUGHNESS_MIN 0.0316227766

/* What the includer defined is read here alone, where no local name can stand for one of its own. */
vec4 lmp_ggx_texel(int lmp_i) {
    return LMP_GGX_TEXEL(lmp_i);
}

/* Reflectance of the lobe: f0 F0 + f90 F90. */
struct lmp_ggx_lobe {
    vec3 axis;
    float exponent, f0, f90;
};

/* Where a surface lies in the table: the first texel of the nearest node, steps in x and y. */
struct lmp_ggx_place {
    float along, cosine, alpha;
    ivec2 node;
    vec2 fraction;
};

lmp_ggx_place lmp_ggx_lookup(vec3 normal, vec3 view, float roughness) {
    lmp_ggx_place place;
    float rough = clamp(roughness, LMP_GGX_ROUGHNESS_MIN, 1.0);
    place.alpha = rough * rough;
    place.along = dot(normal, view);
    place.cosine = max(place.along, 0.0);
    vec2 size = vec2(LMP_GGX_VIEWS - 1, LMP_GGX_ROUGHNESSES - 1);
    vec2 unit = vec2(sqrt(place.cosine),
                     (rough - LMP_GGX_ROUGHNESS_MIN) / (1.0 - LMP_GGX_ROUGHNESS_MIN));
    vec2 at = clamp(unit, 0.0, 1.0) * size;
    place.node = ivec2(min(at, size - 1.0));
    place.fraction = at - vec2(place.node);
    return place;
}

/* Lobe k, 0 <= k < LMP_GGX_LOBES. */
lmp_ggx_lobe lmp_ggx_lobe_at(lmp_ggx_place place, vec3 normal, vec3 view, int k) {
    int i = (place.node.y * LMP_GGX_VIEWS + place.node.x) * LMP_GGX_LOBES + k;
    int j = i + LMP_GGX_VIEWS * LMP_GGX_LOBES;
    vec4 near = mix(lmp_ggx_texel(i), lmp_ggx_texel(i + LMP_GGX_LOBES), place.fraction.x);
    vec4 far = mix(lmp_ggx_texel(j), lmp_ggx_texel(j + LMP_GGX_LOBES), place.fraction.x);
    vec4 p = mix(near, far, place.fraction.y);
    float rise = place.cosine + place.alpha * p.x + place.along;
    lmp_ggx_lobe lobe;
    lobe.axis = normalize(normal * rise - view);
    lobe.exponent = 1.0 / (place.alpha * place.alpha * p.y);
    lobe.f0 = p.z - p.w;
    lobe.f90 = p.w;
    return lobe;
}

/* The diffuse part is (1 - (1 - x) F0 - x F90) base / pi. */
float lmp_ggx_diffuse_f90(lmp_ggx_place place) {
    int i = LMP_GGX_ROUGHNESSES * LMP_GGX_VIEWS * LMP_GGX_LOBES + place.node.x;
    return mix(lmp_ggx_texel(i).x, lmp_ggx_texel(i + 1).x, place.fraction.x);
}

#endif
