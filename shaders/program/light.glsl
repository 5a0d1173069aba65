/* SPDX-License-Identifier: MIT */
/* light.glsl - the lights of the program, of every kind, as lampion.glsl takes them. */

/* Returns a light's color: a cone gives saturate(cone.xyz · w + cone.w)² of its intensity in the
 * direction w from it. */
vec3 light_color(int i, vec3 point) {
    vec4 cone = lights[i].cone;
    vec3 away = point - lights[i].sphere.xyz;
    if (lights[i].radiance.w != float(SHARED_LIGHT_CONE))
        return lights[i].radiance.rgb;
    float inside = dot(cone.xyz, away) * inversesqrt(max(dot(away, away), 1e-37)) + cone.w;
    inside = clamp(inside, 0.0, 1.0);
    return lights[i].radiance.rgb * (inside * inside);
}

#ifdef SHADE_FIELD
/* Declared for fields (field.glsl): the lights near the point last looked up, and the fractions of
 * them that the field does not hold there. */
int field_light_count();
int field_light(int i);
float field_residual(int light, vec3 point);
#define LMP_LIGHT_COUNT       field_light_count()
#define LMP_LIGHT_SPHERE(i)   lights[field_light(i)].sphere
#define LMP_LIGHT_FIXED(i)    (lights[field_light(i)].radiance.w == float(SHARED_LIGHT_FIXED))
#define LMP_LIGHT_COLOR(i, p) (light_color(field_light(i), p) * field_residual(field_light(i), p))
#define LMP_LIGHT_LIT(i, p)   (field_residual(field_light(i), p) > 0.0)
#else
#define LMP_LIGHT_COUNT       int(size_lights.z)
#define LMP_LIGHT_SPHERE(i)   lights[i].sphere
#define LMP_LIGHT_FIXED(i)    (lights[i].radiance.w == float(SHARED_LIGHT_FIXED))
#define LMP_LIGHT_COLOR(i, p) light_color(i, p)
#endif
