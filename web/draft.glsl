/* SPDX-License-Identifier: MIT */
/* draft.glsl - shading for the page's first frame, which waits until its shaders are compiled: matte surfaces of the
 * base color, lit by every sphere as if the horizon cut none. A sphere of radius r at a distance d, its center at an
 * angle theta to the normal, then gives pi r^2 / d^2 cos theta times its radiance. */
vec3 shade_surface(ivec2 at, int kind) {
    camera_ray ray = camera_ray_through((vec2(at) + 0.5) / size_lights.xy * 2.0 - 1.0);
    vec3 position = ray.from + ray.along * camera_distance(texelFetch(depths, at, 0).r);
    vec3 normal = gbuffer_decode_normal(texelFetch(normals, at, 0).rg);
    vec3 lit = vec3(0.0); /* irradiance / pi */
    for (int i = 0; i < LMP_LIGHT_COUNT; i++) {
        vec3 to = LMP_LIGHT_SPHERE(i).xyz - position;
        float square = max(dot(to, to), LMP_LIGHT_SPHERE(i).w * LMP_LIGHT_SPHERE(i).w);
        float sine = LMP_LIGHT_SPHERE(i).w * inversesqrt(square);
        lit += lights[i].radiance.rgb * (sine * sine * max(dot(normal, to) * inversesqrt(square), 0.0));
    }
    return gbuffer_decode_color(texelFetch(base_metallic, at, 0).rgb) * lit + texelFetch(emissions, at, 0).rgb;
}
