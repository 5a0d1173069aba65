/* SPDX-License-Identifier: MIT */
/* table.glsl - surfaces shaded by tabulated BRDFs: lmp_shade_table of the library, straight-line.
 *
 * TABLE_FULL is 0 where every table is mirror-symmetric, so that half the coefficients suffice.
 * TABLE_PAIR: rows are interpolated between two tables without columns. table_values begins with a
 * vec4 per table: its first value, rows over theta_o from 0 to pi/2, and columns over phi_o. Then
 * the tables, [column][row][coefficient], all of LMP_BANDS bands; rows and columns are so many that
 * linear interpolation between them follows the library's cubic. TABLE_ENVIRONMENT: the most bands
 * by which tables reflect that of environment.glsl; 0: none. SHADE_FIELD: tables reflect what
 * field.glsl has at the point last looked up, and the lights near it. */
#include "texels.glsl"

TEXELS(tables_block, table_values, SHARED_TABLES)

#if TABLE_FULL
#define TABLE_COUNT       LMP_SH_COUNT
#define TABLE_INDEX(l, m) LMP_INDEX(l, m)
#else
#define TABLE_COUNT       (LMP_BANDS * (LMP_BANDS + 1) / 2)
#define TABLE_INDEX(l, m) LMP_HALF_INDEX(l, m)
#endif
#if TABLE_FULL || defined(TABLE_PAIR)
#define TABLE_FAR(first, weight, i)                                                                \
    (weight.z * TEXEL(table_values, first.z + i).rgb + weight.w * TEXEL(table_values, first.w + i).rgb)
#else
#define TABLE_FAR(first, weight, i) 0.0
#endif

/* Coefficient i between the four rows of table_rows. */
#define TABLE_AT(first, weight, i)                                                                 \
    (weight.x * TEXEL(table_values, first.x + i).rgb + weight.y * TEXEL(table_values, first.y + i).rgb +         \
     TABLE_FAR(first, weight, i))

/* Returns v without its part along n, made unit; `otherwise` where nothing is left. */
vec3 table_flatten(vec3 v, vec3 n, vec3 otherwise) {
    vec3 rest = v - dot(v, n) * n;
    float length2 = dot(rest, rest);
    return length2 > 1e-12 * dot(v, v) ? rest * inversesqrt(length2) : otherwise;
}

/* Finds the first values of the four rows around a view, and their weights. */
void table_rows(int table, float cos_theta, float phi, out ivec4 first, out vec4 weight) {
    ivec3 shape = ivec3(TEXEL(table_values, table).xyz);
    float row = acos(clamp(cos_theta, 0.0, 1.0)) * (2.0 / LMP_PI) * float(shape.y - 1);
    float column = shape.z > 1 ? fract(phi * (0.5 / LMP_PI)) * float(shape.z) : 0.0;
    int r = min(int(row), shape.y - 2), c = min(int(column), shape.z - 1);
    vec2 f = vec2(row - float(r), column - float(c));
    int near = shape.x + (c * shape.y + r) * TABLE_COUNT;
    int far = shape.x + (((c + 1) % shape.z) * shape.y + r) * TABLE_COUNT;
    first = ivec4(near, near + TABLE_COUNT, far, far + TABLE_COUNT);
    weight = vec4((1.0 - f.x) * (1.0 - f.y), f.x * (1.0 - f.y), (1.0 - f.x) * f.y, f.x * f.y);
}

/* The frame of a surface's table: z is the normal, and the view is at y = 0, x >= 0. phi is its
 * angle from the horizontal tangent. */
struct table_frame {
    vec3 x, y, n;
    float phi;
};

table_frame table_frame_of(lmp_surface surface) {
    table_frame f;
    f.n = surface.normal;
    vec3 side = table_flatten(cross(vec3(0.0, 1.0, 0.0), f.n), f.n,
                              table_flatten(vec3(1.0, 0.0, 0.0), f.n, vec3(1.0, 0.0, 0.0)));
    f.x = table_flatten(surface.view, f.n, side);
    f.y = cross(f.n, f.x);
    f.phi = atan(dot(f.x, cross(f.n, side)), dot(f.x, side));
    return f;
}

/* --- light in the frame of the world -----------------------------------------------------------
 * Its coefficients, brought into the table's frame band by band: three rotations about z, with a quarter
 * turn about x, whose matrices the environment's block holds, between them and back. */
#if defined(SHADE_FIELD)
#define TABLE_ROTATED (LMP_BANDS > TABLE_ENVIRONMENT ? LMP_BANDS : TABLE_ENVIRONMENT)
#else
#define TABLE_ROTATED TABLE_ENVIRONMENT
#endif
#if defined(SHADE_FIELD) || TABLE_ENVIRONMENT

/* Returns the angles of Rz(a) Ry(b) Rz(c), the rotation into the frame. */
vec3 table_angles(table_frame f) {
    if (dot(f.n.xy, f.n.xy) < 1e-12)
        return vec3(f.n.z > 0.0 ? atan(f.y.x, f.x.x) : atan(-f.y.x, -f.x.x),
                    f.n.z > 0.0 ? 0.0 : LMP_PI, 0.0);
    return vec3(atan(f.y.z, f.x.z), atan(length(f.n.xy), f.n.z), atan(f.n.y, -f.n.x));
}

void table_rotate(int l, float angle, inout vec3 band[2 * TABLE_ROTATED - 1]) {
    for (int m = 1; m <= l; m++) {
        float c = cos(float(m) * angle), s = sin(float(m) * angle);
        vec3 even = band[l + m], odd = band[l - m];
        band[l + m] = even * c - odd * s;
        band[l - m] = even * s + odd * c;
    }
}

/* Rotates a band by a quarter turn about x, or back by the transposed matrix. */
void table_tilt(int l, bool back, inout vec3 band[2 * TABLE_ROTATED - 1]) {
    vec3 from[2 * TABLE_ROTATED - 1] = band;
    int size = 2 * l + 1, first = environment_tilts() + l * (4 * l * l - 1) / 3;
    for (int i = 0; i < size; i++) {
        band[i] = vec3(0.0);
        for (int k = 0; k < size; k++)
            band[i] += TEXEL(environment_sh, first + (back ? k * size + i : i * size + k)).x * from[k];
    }
}

/* Returns what the table reflects of a band. */
vec3 table_reflect(int l, vec3 angles, ivec4 first, vec4 weight,
                   vec3 band[2 * TABLE_ROTATED - 1]) {
    vec3 reflected = vec3(0.0);
    table_rotate(l, angles.z, band);
    table_tilt(l, false, band);
    table_rotate(l, angles.y, band);
    table_tilt(l, true, band);
    table_rotate(l, angles.x, band);
    for (int m = TABLE_FULL == 1 ? -l : 0; m <= l; m++)
        reflected += band[l + m] * TABLE_AT(first, weight, TABLE_INDEX(l, m));
    return reflected;
}
#endif

/* Returns what the table reflects of the field's interpolated coefficients. */
#ifdef SHADE_FIELD
vec3 table_reflect_field(table_frame f, ivec4 first, vec4 weight) {
    vec3 angles = table_angles(f), reflected = vec3(0.0), band[2 * TABLE_ROTATED - 1];
    field_corners corners = field_corners_around();
    for (int l = 0; l < LMP_BANDS; l++) {
        for (int i = 0; i <= 2 * l; i++)
            band[i] = field_coefficient(corners, l * l + i);
        reflected += table_reflect(l, angles, first, weight, band);
    }
    return reflected;
}
#endif

/* --- lights ----------------------------------------------------------------------------------- */

/* Sums the lights by the rows of a view. */
vec3 shade_rows(lmp_surface surface, table_frame f, ivec4 first, vec4 weight) {
    vec3 sum[LMP_SH_COUNT];
#define LMP_ROW(l, m)                                                                              \
    if (LMP_INSIDE(l, m)) {                                                                        \
        sum[LMP_INDEX(l, m)] = vec3(0.0);                                                          \
        sum[LMP_INDEX(l, -m)] = vec3(0.0);                                                         \
    }
#define LMP_COLUMN(m) LMP_FOR_COLUMN(LMP_ROW, m)
    LMP_FOR_COLUMNS(LMP_COLUMN)
#undef LMP_COLUMN
#undef LMP_ROW

    for (int i = 0; i < LMP_LIGHT_COUNT; i++) {
        if (!LMP_LIGHT_LIT(i, surface.position))
            continue;
        vec4 sphere = LMP_LIGHT_SPHERE(i);
        bool fixed_cap = LMP_LIGHT_FIXED(i);
        vec3 to = fixed_cap ? sphere.xyz : sphere.xyz - surface.position;
        vec3 radiance = LMP_LIGHT_COLOR(i, surface.position);
        float sh[LMP_SH_COUNT];
        vec4 local = vec4(dot(to, f.x), dot(to, f.y), dot(to, f.n), sphere.w);
        lmp_cap_project(lmp_cap_of_light(local, fixed_cap, vec3(0.0)), sh);
#define LMP_ROW(l, m)                                                                              \
    if (LMP_INSIDE(l, m)) {                                                                        \
        sum[LMP_INDEX(l, m)] += radiance * sh[LMP_INDEX(l, m)];                                    \
        if (TABLE_FULL == 1 && m > 0)                                                              \
            sum[LMP_INDEX(l, -m)] += radiance * sh[LMP_INDEX(l, -m)];                              \
    }
#define LMP_COLUMN(m) LMP_FOR_COLUMN(LMP_ROW, m)
        LMP_FOR_COLUMNS(LMP_COLUMN)
#undef LMP_COLUMN
#undef LMP_ROW
    }

    vec3 reflected = vec3(0.0);
#ifdef SHADE_FIELD
    if (field_inside)
        reflected = table_reflect_field(f, first, weight);
#endif
#define LMP_ROW(l, m)                                                                              \
    if (LMP_INSIDE(l, m)) {                                                                        \
        reflected += sum[LMP_INDEX(l, m)] * TABLE_AT(first, weight, TABLE_INDEX(l, m));            \
        if (TABLE_FULL == 1 && m > 0)                                                              \
            reflected += sum[LMP_INDEX(l, -m)] * TABLE_AT(first, weight, TABLE_INDEX(l, -m));      \
    }
#define LMP_COLUMN(m) LMP_FOR_COLUMN(LMP_ROW, m)
    LMP_FOR_COLUMNS(LMP_COLUMN)
#undef LMP_COLUMN
#undef LMP_ROW
    return max(reflected, vec3(0.0));
}

vec3 shade_table(lmp_surface surface, int table) {
#ifdef SHADE_FIELD
    field_find(surface.position);
#endif
    table_frame f = table_frame_of(surface);
    ivec4 first;
    vec4 weight;
    table_rows(table, dot(surface.view, f.n), f.phi, first, weight);
    return shade_rows(surface, f, first, weight);
}

/* --- an environment --------------------------------------------------------------------------- */
#if TABLE_ENVIRONMENT

vec3 shade_rows_environment(table_frame f, ivec4 first, vec4 weight) {
    vec3 angles = table_angles(f), reflected = vec3(0.0), band[2 * TABLE_ROTATED - 1];
    int bands = min(min(int(surroundings.x), LMP_BANDS), TABLE_ENVIRONMENT);
    for (int l = 0; l < bands; l++) {
        for (int i = 0; i <= 2 * l; i++)
            band[i] = TEXEL(environment_sh, environment_whole() + l * l + i).rgb;
        reflected += table_reflect(l, angles, first, weight, band);
    }
    return max(reflected, vec3(0.0));
}

vec3 shade_table_environment(lmp_surface surface, int table) {
    table_frame f = table_frame_of(surface);
    ivec4 first;
    vec4 weight;
    table_rows(table, dot(surface.view, f.n), f.phi, first, weight);
    return shade_rows_environment(f, first, weight);
}
#endif
