/* SPDX-License-Identifier: MIT */
/* lanterns.frag - casts one ray per pixel to a floor and a row of balls, shaded by lampion.glsl.
 * lanterns.c puts a #version line and lampion.glsl's text before it. */
const int BALLS = 5;

in vec2 at; /* -1 … 1 across the window's height */
out vec4 color;

/* Returns the distance along the ray to a sphere, or 1e9. */
float hit_sphere(vec3 eye, vec3 ray, vec4 sphere) {
    vec3 v = eye - sphere.xyz;
    float b = dot(v, ray), c = dot(v, v) - sphere.w * sphere.w;
    float root = b * b - c;
    float t = -b - sqrt(max(root, 0.0));
    return root > 0.0 && t > 0.0 ? t : 1e9;
}

vec3 shade(vec3 position, vec3 normal, vec3 ray, vec3 base, float metallic, float roughness) {
    lmp_surface surface = lmp_surface(position, normal, -ray);
    float alpha = roughness * roughness;
    return lmp_shade_zonal(surface, lmp_material(base * (1.0 - metallic), mix(vec3(0.04), base, metallic),
                                                 0.5 / (alpha * alpha)));
}

void main() {
    vec3 eye = vec3(0.0, 1.9, 5.6);
    vec3 ray = normalize(vec3(at.x, at.y - 0.4, -1.9));
    float nearest = 60.0;
    vec3 radiance = vec3(0.0);

    float floor_t = -eye.y / min(ray.y, -1e-6);
    if (ray.y < 0.0 && floor_t < nearest) {
        nearest = floor_t;
        vec3 p = eye + floor_t * ray;
        vec2 tile = abs(fract(p.xz) - 0.5);
        float joint = smoothstep(0.47, 0.49, max(tile.x, tile.y));
        radiance = shade(p, vec3(0.0, 1.0, 0.0), ray, mix(vec3(0.4, 0.35, 0.3), vec3(0.1), joint), 0.0, 0.45);
    }
    for (int i = 0; i < BALLS; i++) {
        float x = float(i) - 0.5 * float(BALLS - 1);
        vec4 ball = vec4(1.35 * x, 0.6, 0.0, 0.6);
        float t = hit_sphere(eye, ray, ball);
        if (t < nearest) {
            nearest = t;
            vec3 p = eye + t * ray;
            radiance = shade(p, (p - ball.xyz) / ball.w, ray, vec3(0.9, 0.6, 0.25), float(i % 2),
                             mix(0.75, 0.35, float(i) / float(BALLS - 1)));
        }
    }
    for (int i = 0; i < LMP_LIGHT_COUNT; i++) {
        float t = hit_sphere(eye, ray, LMP_LIGHT_SPHERE(i));
        if (t < nearest) {
            nearest = t;
            radiance = 0.06 * LMP_LIGHT_RADIANCE(i); /* dimmed to show its color */
        }
    }
    color = vec4(pow(1.0 - exp(-2.5 * radiance), vec3(1.0 / 2.2)), 1.0);
}
