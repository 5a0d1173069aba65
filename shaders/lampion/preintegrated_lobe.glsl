/* SPDX-License-Identifier: MIT */
/* preintegrated_lobe.glsl - shading from a preintegrated lobe (lampion/preintegrated.h): a reading
 * per lobe and light, whatever the number of bands. Include it after lampion.glsl and
 * preintegrated_lookup.h.
 *
 * Put the cells' pairs into a texture of two signed normalized 16-bit channels, `columns` texels a
 * row, cells side by side as you like. Define before including, the rest of what
 * lmp_preintegrated_lobe_describe returns:
 *   LMP_PREINTEGRATED_LOBE_PAIR(p)   vec2: the texture at p, filtered linearly; texel centers at .5
 *   LMP_PREINTEGRATED_LOBE_CELL(i)   vec4: scale and offset of cell i; x and y of its first texel
 *   LMP_PREINTEGRATED_LOBE_REMAP(i)  float: entry i of the remap, LMP_LOOKUP_REMAP_COUNT of them
 *   LMP_PREINTEGRATED_LOBE_SHAPE     vec4: width2, the number of cells */
#ifndef LAMPION_PREINTEGRATED_LOBE_GLSL
#define LAMPION_PREINTEGRATED_LOBE_GLSL
#ifndef LAMPION_PREINTEGRATED_LOOKUP_H
#error "include preintegrated_lookup.h before preintegrated_lobe.glsl"
#endif

/* What the includer defined is only read here, where no local name can hide one of its own. */
vec2 lmp_preintegrated_lobe_pair(vec2 lmp_p) {
    return LMP_PREINTEGRATED_LOBE_PAIR(lmp_p);
}
vec4 lmp_preintegrated_lobe_cell(int lmp_i) {
    return LMP_PREINTEGRATED_LOBE_CELL(lmp_i);
}
float lmp_preintegrated_lobe_remap(int lmp_i) {
    return LMP_PREINTEGRATED_LOBE_REMAP(lmp_i);
}
vec4 lmp_preintegrated_lobe_shape() {
    return LMP_PREINTEGRATED_LOBE_SHAPE;
}

/* Where the lobe of an exponent lies. */
struct lmp_lobe_position {
    vec2 corner;
    float fraction, density, angle;
};

lmp_lobe_position lmp_preintegrated_lobe_lookup(float exponent) {
    float e = clamp(exponent, 0.0, LMP_LOOKUP_EXPONENT_MAX), entry = lmp_lookup_exponent(e);
    int i = lmp_lookup_first(entry, float(LMP_LOOKUP_REMAP_COUNT - 2));
    float slice = lmp_lookup_between(lmp_preintegrated_lobe_remap(i),
                                     lmp_preintegrated_lobe_remap(i + 1), entry - float(i));
    int k = lmp_lookup_first(slice, lmp_preintegrated_lobe_shape().y - 1.0);
    vec4 cell = lmp_preintegrated_lobe_cell(k);
    lmp_lobe_position position;
    position.corner = cell.zw;
    position.fraction = slice - float(k);
    position.density = lmp_lookup_density(cell.x, cell.y, e);
    position.angle = lmp_lookup_solid_angle(e, lmp_preintegrated_lobe_shape().x);
    return position;
}

/* Computes the cubic B-spline's weights of four neighbors, for a point x past the second, as two
 * linear readings (Sigg and Hadwiger 2005): their positions from the first neighbor on, and the
 * weight of the second reading. */
vec3 lmp_spline(float x) {
    float w0 = lmp_lookup_outer(1.0 - x), w3 = lmp_lookup_outer(x);
    float second = lmp_lookup_inner(1.0 - x) + w3;
    return vec3(1.0 - w0 / (6.0 - second), 2.0 + w3 / second, second / 6.0);
}

/* Returns the lobe's mean over a cap, times the sum of the solid angles of cap and lobe. */
float lmp_preintegrated_lobe_read(lmp_lobe_position position, float g, float a) {
    float x = g * position.density, y = a * position.density;
    vec2 corner = position.corner + floor(vec2(x, y)) + 0.5;
    vec3 across = lmp_spline(fract(x)), down = lmp_spline(fract(y));
    vec2 upper = mix(lmp_preintegrated_lobe_pair(corner + vec2(across.x, down.x)),
                     lmp_preintegrated_lobe_pair(corner + vec2(across.y, down.x)), across.z);
    vec2 lower = mix(lmp_preintegrated_lobe_pair(corner + vec2(across.x, down.y)),
                     lmp_preintegrated_lobe_pair(corner + vec2(across.y, down.y)), across.z);
    vec2 slices = mix(upper, lower, down.z);
    return mix(slices.x, slices.y, position.fraction) * LMP_LOOKUP_COEFFICIENT_MAX;
}

#ifdef LMP_LIGHT_COUNT
/* Returns a lobe's response to a cap of radiance 1, given the cosine between their axes. */
float lmp_preintegrated_lobe_response(lmp_lobe_position position, lmp_cap cap, float cosine) {
    /* More than a hemisphere is ambient light less the complementary cap. */
    bool inside = cap.base > 2.0 && cap.strength <= 0.0;
    float solid_angle = 2.0 * LMP_PI * cap.one_minus_cos;
    /* for a Dirac, what makes it as strong */
    float covered = inside ? solid_angle : LMP_PI * cap.base;
    float read = lmp_preintegrated_lobe_read(position, lmp_lookup_acos(cosine), lmp_lookup_arc(cap.one_minus_cos));
    float part = read * covered / (solid_angle + position.angle);
    return inside ? 1.0 - part : part;
}

/* Does lmp_shade_zonal, within the error of the preintegrated lobe; areas are summed by bands. */
vec3 lmp_shade_some_preintegrated(lmp_surface surface, lmp_lobes lobes) {
    lmp_lobe_position specular[LMP_LOBES];
    for (int k = 0; k < LMP_LOBES; k++)
        specular[k] = lmp_preintegrated_lobe_lookup(LMP_LOBE(lobes.exponent, k));
    vec3 sum = vec3(0.0);
    for (int i = 0; i < lmp_light_count(); i++) {
        lmp_cap cap = lmp_light_find_cap(i, surface.position);
        vec3 reflected = lobes.diffuse * (lmp_cap_irradiance(cap, surface.normal) / LMP_PI);
        for (int k = 0; k < LMP_LOBES; k++)
            reflected += LMP_LOBE(lobes.weight, k) *
                         lmp_preintegrated_lobe_response(specular[k], cap, dot(cap.axis, LMP_LOBE(lobes.axis, k)));
        sum += lmp_light_color(i, surface.position) * reflected;
    }
#ifdef LMP_AREA_COUNT
    LMP_EACH weights[LMP_BANDS];
    lmp_lobe_make_phong(lobes.exponent, weights);
    lmp_lobe_weigh(weights);
    sum += lmp_areas_shade(surface, lobes, weights);
#endif
    return sum;
}

LMP_SHADE_MATERIALS(lmp_shade_preintegrated, lmp_shade_some_preintegrated)
#endif
#endif
