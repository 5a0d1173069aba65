/* SPDX-License-Identifier: MIT */
/* area.glsl, as an engine includes it, against the library and against quadrature. */
#include "tests/gpu/compute.h"
#include "tests/oracle/areas.h"

#include <lampion/lobe.h>
#include <lampion/shade.h>

enum { BANDS = 10, GROUP = 64 };

static GLuint respond; /* the program that computes the irradiance and the response of a lobe */

/* What a thread of the shader reads, in vec4. */
typedef struct seen_area {
    float texel[LMP_AREA_TEXELS][4], position[4], normal[4], axis[4]; /* axis: w, the exponent */
} seen_area;

static const char head[] = "#version 450 core\n"
                           "#define LMP_BANDS 10\n"
                           "#define LMP_LIGHT_COUNT 0\n"
                           "#define LMP_LIGHT_SPHERE(i) vec4(0.0)\n"
                           "#define LMP_LIGHT_RADIANCE(i) vec3(0.0)\n"
                           "layout(std430, binding = 0) buffer in_block { vec4 seen[]; };\n"
                           "#define LMP_AREA_COUNT int(seen.length() / 14)\n"
                           "#define LMP_AREA_TEXEL(i, k) seen[14 * (i) + (k)]\n";
static const char respond_main[] =
    "layout(local_size_x = 64) in;\n"
    "layout(std430, binding = 1) buffer out_block { vec2 values[]; };\n"
    "void main() {\n"
    "    int i = int(gl_GlobalInvocationID.x);\n"
    "    vec3 normal = seen[14 * i + 12].xyz;\n"
    "    vec4 lobe = seen[14 * i + 13];\n"
    "    float weights[LMP_BANDS];\n"
    "    lmp_lobe_make_phong(lobe.w, weights);\n"
    "    lmp_lobe_weigh(weights);\n"
    "    lmp_surface surface = lmp_surface(seen[14 * i + 11].xyz, normal, normal);\n"
    "    lmp_area_light light = lmp_area_respond(i, surface, lobe.xyz, weights);\n"
    "    values[i] = vec2(light.irradiance, light.lobes);\n"
    "}\n";
static const char *const area_files[] = { "lampion.glsl", "area.glsl", NULL };

/* --- what a surface gets of an area ----------------------------------------------------------- */

/* A light, a point, a surface there and a lobe. */
typedef struct lit_place {
    lmp_light light;
    lmp_vec3 point, normal, axis;
    float exponent;
    double size; /* of the light */
} lit_place;

static double distance_between(lmp_vec3 a, lmp_vec3 b) {
    return hypot(hypot((double)a.x - (double)b.x, (double)a.y - (double)b.y),
                 (double)a.z - (double)b.z);
}

/* Returns the distance of a point from the plane of a flat area, 1 for a tube. */
static double height_over(const lmp_light *light, lmp_vec3 point) {
    float texel[LMP_AREA_TEXELS][4];
    double height = 0;
    lmp_light_copy_area_texels(light, texel[0]);
    for (int c = 0; c < 3; c++)
        height += ((double)(&point.x)[c] - (double)texel[0][c]) * (double)texel[2][c];
    return light->kind == LMP_LIGHT_TUBE ? 1 : fabs(height);
}

/* Returns a random place from 1e-4 … 1e3 sizes. The light is near the origin, and the point not all
 * but in its plane, because the shader's positions are float. */
static lit_place random_place(lmp_light_kind kind) {
    lit_place s;
    do {
        random_area a = area_random(kind);
        const lmp_vec3 center =
            area_sum((lmp_vec3) { 0, 0, 0 }, 0.3 * a.size, check_random_direction());
        a.on = area_sum(area_sum(a.on, -1, a.light.position), 1, center);
        a.light.position = center;
        s = (lit_place) { .light = a.light, .point = area_point(&a), .size = a.size };
    } while (distance_between(s.point, s.light.position) > 1e3 * s.size ||
             height_over(&s.light, s.point) < 5e-5 * s.size);
    s.normal = check_random_direction();
    s.axis = check_random_direction();
    s.exponent = (float)pow(10, check_random_between(0, 2.5));
    return s;
}

static void fill(const lit_place *from, seen_area *to) {
    const lmp_vec3 *p = &from->point, *n = &from->normal, *q = &from->axis;
    lmp_light_copy_area_texels(&from->light, to->texel[0]);
    memcpy(to->position, (float[4]) { p->x, p->y, p->z }, sizeof to->position);
    memcpy(to->normal, (float[4]) { n->x, n->y, n->z }, sizeof to->normal);
    memcpy(to->axis, (float[4]) { q->x, q->y, q->z, from->exponent }, sizeof to->axis);
}

/* Returns the irradiance and the response of the lobe at each place, by the shader. */
static float *shader_values(const lit_place *places, int count) {
    seen_area *seen = calloc((size_t)count, sizeof *seen);
    assert_non_null(seen);
    assert_int_equal(count % GROUP, 0);
    for (int i = 0; i < count; i++)
        fill(&places[i], &seen[i]);
    float *values = run_compute(respond, seen, (size_t)count * sizeof *seen,
                                (size_t)count * 2 * sizeof *values, count / GROUP);
    free(seen);
    return values;
}

/* The most that a surface and a lobe can get of a light at so large a distance, whatever their and
 * its direction. */
typedef struct most {
    double irradiance, response;
} most;

static most most_of(const lit_place *s, const float *lambda) {
    lmp_light one = s->light;
    one.two_sided = false;
    const double facing = (double)lmp_light_intensity_from_radiance(&one, 1);
    const double d = distance_between(s->point, s->light.position);
    const double solid_angle = facing / (d * d + facing / (2 * ORACLE_PI));
    double peak = 0;
    for (int l = 0; l < BANDS; l++)
        peak += (2 * l + 1) / (4 * ORACLE_PI) * fabs((double)lambda[l]);
    return (most) { fmin(solid_angle, ORACLE_PI), fmin(peak * solid_angle, 1) };
}

static double distance_to_segment(lmp_vec3 p, lmp_vec3 a, lmp_vec3 b) {
    const double length = distance_between(a, b);
    double along = 0;
    const double pa[3] = { (double)p.x - (double)a.x, (double)p.y - (double)a.y,
                           (double)p.z - (double)a.z };
    const double ba[3] = { (double)b.x - (double)a.x, (double)b.y - (double)a.y,
                           (double)b.z - (double)a.z };
    for (int c = 0; c < 3; c++)
        along += pa[c] * ba[c] / (length * length);
    return distance_between(p, area_sum(a, fmin(fmax(along, 0), 1), area_sum(b, -1, a)));
}

/* Returns the distance to the sides of a flat area with corners, the rim of a disk or a tube. */
static double distance_to_outline(const lit_place *s) {
    float texel[LMP_AREA_TEXELS][4];
    const lmp_light *l = &s->light;
    const lmp_vec3 to = area_sum(s->point, -1, l->position), none = { 0, 0, 0 };
    if (l->kind == LMP_LIGHT_TUBE)
        return distance_to_segment(to, l->half[0], area_sum(none, -1, l->half[0])) -
               (double)l->radius;
    if (l->kind == LMP_LIGHT_DISK) {
        const lmp_vec3 n = l->direction;
        const double above = (double)(to.x * n.x + to.y * n.y + to.z * n.z),
                     d = distance_between(to, none);
        return hypot(sqrt(fmax(d * d - above * above, 0)) - (double)l->radius, above);
    }
    lmp_light_copy_area_texels(l, texel[0]);
    const int count = (int)fabsf(texel[0][3]);
    double least = (double)INFINITY;
    for (int i = 0; i < count; i++) {
        const float *m = texel[0], *a = texel[3 + i], *b = texel[3 + (i + 1) % count];
        least =
            fmin(least,
                 distance_to_segment(s->point, (lmp_vec3) { m[0] + a[0], m[1] + a[1], m[2] + a[2] },
                                     (lmp_vec3) { m[0] + b[0], m[1] + b[1], m[2] + b[2] }));
    }
    return least;
}

/* Errors in parts of the most, or their bounds: less than a tenth of the light's size from its
 * outline, less than the size, and farther. */
enum { RANGES = 3 };
typedef struct errors {
    double irradiance, response;
} errors;
static const errors of_corners[RANGES] = { { 1e-2, 4e-3 }, { 4e-4, 4e-4 }, { 1e-4, 6e-4 } },
                    of_disks[RANGES] = { { 1e-2, 2e-2 }, { 5e-4, 8e-3 }, { 1e-4, 5e-4 } },
                    of_tubes[RANGES] = { { 1e-2, 1e-2 }, { 5e-4, 4e-3 }, { 5e-4, 5e-4 } };

static void compare(const lit_place *s, const float *lambda, const float values[2],
                    double irradiance, double response, errors worst[RANGES]) {
    const lmp_light_kind kind = s->light.kind;
    const double distance = distance_to_outline(s) / s->size;
    const int range = distance < 0.1 ? 0 : distance < 1 ? 1 : 2;
    const errors bound = (kind == LMP_LIGHT_DISK   ? of_disks
                          : kind == LMP_LIGHT_TUBE ? of_tubes
                                                   : of_corners)[range];
    const most scale = most_of(s, lambda);
    const errors e = { fabs((double)values[0] - irradiance) / scale.irradiance,
                       fabs((double)values[1] - response) / scale.response };
    worst[range].irradiance = fmax(worst[range].irradiance, e.irradiance);
    worst[range].response = fmax(worst[range].response, e.response);
    CHECK_WITHIN(e.irradiance, bound.irradiance);
    CHECK_WITHIN(e.response, bound.response);
}

static void areas_give_what_their_outlines_give(void **state) {
    (void)state;
    enum { MOST = 1 << 15 };
    const int count = check_count(1 << 11, MOST);
    lit_place *places = calloc((size_t)count, sizeof *places);
    assert_non_null(places);
    for (int k = 0; k < AREA_KINDS; k++) {
        errors worst[RANGES] = { { 0, 0 } };
        for (int i = 0; i < count; i++)
            places[i] = random_place(area_kinds[k]);
        float *values = shader_values(places, count);
        for (int i = 0; i < count; i++) {
            const lit_place *s = &places[i];
            float lambda[BANDS];
            lmp_lobe_make_phong(BANDS, s->exponent, lambda);
            const lmp_rgb e = lmp_light_irradiance(&s->light, 1, s->point, s->normal);
            const lmp_rgb g = lmp_lobe_response(BANDS, lambda, s->axis, &s->light, 1, s->point);
            compare(s, lambda, values + (ptrdiff_t)2 * i, (double)e.g, (double)g.g, worst);
        }
        for (int r = 0; r < RANGES; r++)
            print_message("%s: irradiance %.1e, lobes %.1e\n", area_names[k], worst[r].irradiance,
                          worst[r].response);
        free(values);
    }
    free(places);
}

static double quadrature_of_lobe(const lit_place *s, const float *lambda, const double point[3]) {
    const double length = distance_between(s->axis, (lmp_vec3) { 0, 0, 0 });
    const double q[3] = { (double)s->axis.x / length, (double)s->axis.y / length,
                          (double)s->axis.z / length };
    double moments[BANDS], sum = 0;
    oracle_area_moments(&s->light, point, BANDS, q, moments);
    for (int l = 0; l < BANDS; l++)
        sum += (2 * l + 1) / (4 * ORACLE_PI) * (double)lambda[l] * moments[l];
    return sum;
}

static void areas_give_the_integral_over_them(void **state) {
    (void)state;
    enum { MOST = 1 << 10 };
    static lit_place places[MOST];
    const int count = check_count(GROUP, MOST);
    errors worst[RANGES] = { { 0, 0 } };
    for (int i = 0; i < count; i++)
        places[i] = random_place(area_kinds[i % AREA_KINDS]);
    float *values = shader_values(places, count);
    for (int i = 0; i < count; i++) {
        const lit_place *s = &places[i];
        const double point[3] = { (double)s->point.x, (double)s->point.y, (double)s->point.z };
        const double normal[3] = { (double)s->normal.x, (double)s->normal.y, (double)s->normal.z };
        float lambda[BANDS];
        lmp_lobe_make_phong(BANDS, s->exponent, lambda);
        compare(s, lambda, values + (ptrdiff_t)2 * i,
                oracle_area_irradiance(&s->light, point, normal),
                quadrature_of_lobe(s, lambda, point), worst);
    }
    free(values);
}

/* Returns a light at the origin, a surface that it grazes and a lobe around the direction to it. */
static lit_place place_seen_from(lmp_light_kind kind, lmp_vec3 away) {
    lit_place s = { .light = { .kind = kind,
                               .direction = { 0, 0, 1 },
                               .radius = 0.3f,
                               .two_sided = true,
                               .radiance = { 1, 1, 1 } },
                    .normal = { 0, 0.8f, -0.6f },
                    .axis = { -away.x, -away.y, -away.z },
                    .exponent = 30 };
    if (kind == LMP_LIGHT_POLYGON) {
        s.light.corner_count = 5;
        for (int i = 0; i < 5; i++)
            s.light.corner[i] = (lmp_vec3) { cosf(1.2f * (float)i), sinf(1.2f * (float)i), 0 };
    } else {
        s.light.half[0] = (lmp_vec3) { 1, 0, 0 };
        s.light.half[1] = (lmp_vec3) { 0, 0.5f, 0 };
    }
    return s;
}

/* Returns the largest change of the errors from one step to the next, in parts of what the light
 * gives. */
static double largest_step(const lit_place *places, const float *values, int count) {
    double before[2] = { 0, 0 }, largest = 0;
    float lambda[BANDS];
    lmp_lobe_make_phong(BANDS, places->exponent, lambda);
    for (int i = 0; i < count; i++) {
        const lit_place *s = &places[i];
        const double e = (double)lmp_light_irradiance(&s->light, 1, s->point, s->normal).g;
        const double g =
            (double)lmp_lobe_response(BANDS, lambda, s->axis, &s->light, 1, s->point).g;
        const double now[2] = { ((double)values[2 * i] - e) / most_of(s, lambda).irradiance,
                                (double)values[2 * i + 1] / g };
        for (int c = 0; c < 2; c++) {
            if (i > 0 && !(fabs(now[c] - before[c]) <= largest))
                largest = fabs(now[c] - before[c]);
            before[c] = now[c];
        }
    }
    return largest;
}

/* On the way from a light, where it is summed in another way each time that it looks small enough,
 * the error changes by less than what shows. */
static void no_step_shows_where_the_sum_changes(void **state) {
    (void)state;
    enum { STEPS = 1024 };
    static lit_place places[STEPS];
    const lmp_vec3 away = { 0.48f, 0.6f, 0.64f }, none = { 0, 0, 0 };
    for (int k = 0; k < AREA_KINDS; k++) {
        for (int i = 0; i < STEPS; i++) {
            places[i] = place_seen_from(area_kinds[k], away);
            places[i].point = area_sum(none, pow(10, 0.3 + 1.7 * i / STEPS), away);
        }
        float *values = shader_values(places, STEPS);
        const double step = largest_step(places, values, STEPS);
        print_message("%s: steps of at most %.1e\n", area_names[k], step);
        CHECK_WITHIN(step, 1e-4);
        free(values);
    }
}

/* --- what a surface reflects ------------------------------------------------------------------ */

enum { SHADE_BANDS = 4, LIGHTS = AREA_KINDS + 1 };

/* What the shader reads, in vec4: the texels of areas, a sphere and its radiance, and surfaces. */
typedef struct lit_scene {
    float area[AREA_KINDS][LMP_AREA_TEXELS][4], sphere[2][4];
    float surface[GROUP][3][4]; /* position and roughness, normal, view */
    float ggx[LMP_GGX_TEXELS][4];
} lit_scene;

static const char shade_head[] = "#version 450 core\n"
                                 "#define LMP_BANDS 4\n"
                                 "#define LMP_WINDOW LMP_WINDOW_HANNING\n"
                                 "layout(std430, binding = 0) buffer in_block {\n"
                                 "    vec4 area[44], sphere[2], surfaces[192], ggx[];\n"
                                 "};\n"
                                 "#define LMP_LIGHT_COUNT 1\n"
                                 "#define LMP_LIGHT_SPHERE(i) sphere[0]\n"
                                 "#define LMP_LIGHT_RADIANCE(i) sphere[1].rgb\n"
                                 "#define LMP_AREA_COUNT 4\n"
                                 "#define LMP_AREA_TEXEL(i, k) area[11 * (i) + (k)]\n"
                                 "#define LMP_GGX_TEXEL(i) ggx[i]\n";
static const char shade_main[] =
    "layout(local_size_x = 64) in;\n"
    "layout(std430, binding = 1) buffer out_block { vec4 values[]; };\n"
    "void main() {\n"
    "    int i = int(gl_GlobalInvocationID.x);\n"
    "    vec4 first = surfaces[3 * i];\n"
    "    lmp_surface surface =\n"
    "        lmp_surface(first.xyz, surfaces[3 * i + 1].xyz, surfaces[3 * i + 2].xyz);\n"
    "    lmp_metallic_roughness brass =\n"
    "        lmp_metallic_roughness(vec3(0.9, 0.6, 0.3), 0.7, first.w);\n"
    "    values[2 * i] = vec4(lmp_shade_zonal(surface, brass), 0.0);\n"
    "    values[2 * i + 1] = vec4(lmp_shade_coefficients(surface, brass), 0.0);\n"
    "}\n";

static void set(lmp_vec3 v, float w, float to[4]) {
    memcpy(to, (float[4]) { v.x, v.y, v.z, w }, 4 * sizeof *to);
}

/* Fills in lights around the origin and surfaces farther out than they reach. */
static void fill_scene(lit_scene *lit, lmp_light lights[LIGHTS], lmp_surface surfaces[GROUP]) {
    for (int k = 0; k < AREA_KINDS; k++) {
        const random_area a = area_random(area_kinds[k]);
        lights[k] = a.light;
        lights[k].radiance = (lmp_rgb) { 1, (float)k, 2 };
        lmp_light_copy_area_texels(&lights[k], lit->area[k][0]);
    }
    lights[AREA_KINDS] =
        (lmp_light) { .position = { 3, 4, 5 }, .radius = 2, .radiance = { 4, 1, 0 } };
    set(lights[AREA_KINDS].position, 2, lit->sphere[0]);
    set((lmp_vec3) { 4, 1, 0 }, 0, lit->sphere[1]);
    for (int i = 0; i < GROUP; i++) {
        const lmp_vec3 none = { 0, 0, 0 };
        lmp_surface *s = &surfaces[i];
        s->position = area_sum(none, check_random_between(15, 40), check_random_direction());
        s->normal = check_random_direction();
        do
            s->view = check_random_direction();
        while (s->view.x * s->normal.x + s->view.y * s->normal.y + s->view.z * s->normal.z < 0.05f);
        set(s->position, (float)check_random_between(0.2, 1), lit->surface[i][0]);
        set(s->normal, 0, lit->surface[i][1]);
        set(s->view, 0, lit->surface[i][2]);
    }
    lmp_lobe_copy_ggx_texels(lit->ggx[0]);
}

static double largest_difference(const float a[4], lmp_rgb b) {
    return fmax(fabs((double)a[0] - (double)b.r),
                fmax(fabs((double)a[1] - (double)b.g), fabs((double)a[2] - (double)b.b)));
}

static void surfaces_reflect_what_the_library_says(void **state) {
    (void)state;
    static const char *const files[] = { "ggx.glsl", "lampion.glsl", "coefficients.glsl",
                                         "area.glsl", NULL };
    static lit_scene lit;
    lmp_light lights[LIGHTS];
    lmp_surface surfaces[GROUP];
    fill_scene(&lit, lights, surfaces);
    const GLuint program = build_compute(shade_head, files, shade_main);
    float *values = run_compute(program, &lit, sizeof lit, (size_t)8 * GROUP * sizeof *values, 1);
    for (int i = 0; i < GROUP; i++) {
        const lmp_material brass = { .kind = LMP_MATERIAL_METALLIC_ROUGHNESS,
                                     .base_color = { 0.9f, 0.6f, 0.3f },
                                     .metallic = 0.7f,
                                     .roughness = lit.surface[i][0][3] };
        for (int method = 0; method < 2; method++) {
            const lmp_shade_settings settings = { .method = method ? LMP_SHADE_COEFFICIENTS
                                                                   : LMP_SHADE_ZONAL,
                                                  .bands = SHADE_BANDS,
                                                  .window = LMP_WINDOW_HANNING };
            const lmp_rgb expected = lmp_shade(&settings, &brass, &surfaces[i], lights, LIGHTS);
            const double bright = (double)fmaxf(expected.r, fmaxf(expected.g, expected.b));
            CHECK_WITHIN(largest_difference(values + (ptrdiff_t)8 * i + 4 * method, expected),
                         1e-4 * bright + 1e-6);
        }
    }
    free(values);
    glDeleteProgram(program);
}

static int open_all(void **state) {
    if (open_device(state))
        return 1;
    respond = build_compute(head, area_files, respond_main);
    return 0;
}

static int close_all(void **state) {
    glDeleteProgram(respond);
    return close_device(state);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(areas_give_what_their_outlines_give),
        cmocka_unit_test(areas_give_the_integral_over_them),
        cmocka_unit_test(no_step_shows_where_the_sum_changes),
        cmocka_unit_test(surfaces_reflect_what_the_library_says),
    };
    return cmocka_run_group_tests(tests, open_all, close_all);
}
