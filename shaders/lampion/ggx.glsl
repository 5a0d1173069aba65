/* SPDX-License-Identifier: MIT */
/* ggx.glsl - glTF's GGX as Phong lobes: lmp_lobe_find_ggx of lampion/lobe.h, which says what they mean.
 *
 * Fill a buffer or a texture of vec4 with lmp_lobe_copy_ggx_texels and define before including
 *   LMP_GGX_TEXEL(i)   vec4: texel i, 0 <= i < 5152 */
#ifndef LAMPION_GGX_GLSL
#define LAMPION_GGX_GLSL

#ifndef LMP_GGX_TEXEL
#error "define LMP_GGX_TEXEL(i), the texels of lmp_lobe_copy_ggx_texels, before including ggx.glsl"
#endif

/* The constants are those of lampion/lobe.h and src/lobe/ggx_table.h. */
#define LMP_GGX_LOBES         5
#define LMP_GGX_LOBES_FEW     3
#define LMP_GGX_VIEWS         32
#define LMP_GGX_ROUGHNESSES   32
#define LMP_GGX_ROUGHNESS_MIN 0.0316227766

/* What the includer defined is only read here, where no local name can hide one of its own. */
vec4 lmp_ggx_texel(int lmp_i) {
    return LMP_GGX_TEXEL(lmp_i);
}

/* The material of glTF; metallic and roughness are in 0 … 1. */
struct lmp_metallic_roughness {
    vec3 base_color;
    float metallic, roughness;
};

/* The reflectance of the layer over a dielectric, along the normal and at grazing angles. */
struct lmp_dielectric {
    vec3 f0;
    float f90;
};

/* A lobe, whose reflectance is f0 F0 + f90 F90. */
struct lmp_ggx_lobe {
    vec3 axis;
    float exponent, f0, f90;
};

/* Where a surface lies in the table: the node before it, by view and roughness, and the fractions
 * of the nodes after it. */
struct lmp_ggx_node {
    float along, cosine, alpha;
    ivec2 first;
    vec2 fraction;
};

lmp_ggx_node lmp_ggx_lookup(vec3 normal, vec3 view, float roughness) {
    lmp_ggx_node node;
    float rough = clamp(roughness, LMP_GGX_ROUGHNESS_MIN, 1.0);
    node.alpha = rough * rough;
    node.along = dot(normal, view);
    node.cosine = max(node.along, 0.0);
    vec2 size = vec2(LMP_GGX_VIEWS - 1, LMP_GGX_ROUGHNESSES - 1);
    vec2 unit = vec2(sqrt(node.cosine),
                     (rough - LMP_GGX_ROUGHNESS_MIN) / (1.0 - LMP_GGX_ROUGHNESS_MIN));
    vec2 at = clamp(unit, vec2(0.0), vec2(1.0)) * size;
    node.first = ivec2(min(at, size - 1.0));
    node.fraction = at - vec2(node.first);
    return node;
}

/* Returns LMP_GGX_LOBES_FEW where the lobes after these have weight 0, else LMP_GGX_LOBES. */
int lmp_ggx_count(lmp_ggx_node node) {
    int i = LMP_GGX_ROUGHNESSES * LMP_GGX_VIEWS * LMP_GGX_LOBES + node.first.y;
    float few = max(lmp_ggx_texel(i).y, lmp_ggx_texel(i + 1).y);
    return float(node.first.x) + node.fraction.x >= few ? LMP_GGX_LOBES_FEW : LMP_GGX_LOBES;
}

/* Returns lobe k, 0 <= k < LMP_GGX_LOBES. */
lmp_ggx_lobe lmp_ggx_lobe_at(lmp_ggx_node node, vec3 normal, vec3 view, int k) {
    int i = (node.first.y * LMP_GGX_VIEWS + node.first.x) * LMP_GGX_LOBES + k;
    int j = i + LMP_GGX_VIEWS * LMP_GGX_LOBES;
    vec4 near = mix(lmp_ggx_texel(i), lmp_ggx_texel(i + LMP_GGX_LOBES), node.fraction.x);
    vec4 far = mix(lmp_ggx_texel(j), lmp_ggx_texel(j + LMP_GGX_LOBES), node.fraction.x);
    vec4 p = mix(near, far, node.fraction.y);
    float rise = node.cosine + node.alpha * p.x + node.along;
    lmp_ggx_lobe lobe;
    lobe.axis = normalize(normal * rise - view);
    lobe.exponent = 1.0 / (node.alpha * node.alpha * p.y);
    lobe.f0 = p.z - p.w;
    lobe.f90 = p.w;
    return lobe;
}

/* Finds LMP_GGX_LOBES_FEW of the lobes, from `first` on, as columns of axes and of reflectances by
 * these F0 and F90; past the last lobe they reflect nothing. */
void lmp_ggx_lobes(lmp_ggx_node node, vec3 normal, vec3 view, int first, vec3 f0, float f90,
                   out mat3 axis, out mat3 weight, out vec3 exponent) {
    axis = mat3(normal, normal, normal);
    weight = mat3(0.0);
    exponent = vec3(1.0);
    for (int k = 0; k < LMP_GGX_LOBES_FEW; k++)
        if (first + k < LMP_GGX_LOBES) {
            lmp_ggx_lobe lobe = lmp_ggx_lobe_at(node, normal, view, first + k);
            axis[k] = lobe.axis;
            weight[k] = lobe.f0 * f0 + lobe.f90 * f90;
            exponent[k] = lobe.exponent;
        }
}

/* Returns x of the diffuse part, (1 - (1 - x) F0 - x F90) base / pi. */
float lmp_ggx_diffuse_f90(lmp_ggx_node node) {
    int i = LMP_GGX_ROUGHNESSES * LMP_GGX_VIEWS * LMP_GGX_LOBES + node.first.x;
    return mix(lmp_ggx_texel(i).x, lmp_ggx_texel(i + 1).x, node.fraction.x);
}

#endif
