/* SPDX-License-Identifier: MIT */
/* rotate_splats.c - rotates a scene of 3D Gaussian splats with everything that depends on
 * direction.
 *
 *     cc rotate_splats.c $(pkg-config --cflags --libs lampion) -lm -o rotate_splats
 *     ./rotate_splats IN.ply OUT.ply AXIS_X AXIS_Y AXIS_Z DEGREES
 *
 * Reads the binary PLY files of Kerbl et al. 2023 ("3D Gaussian Splatting"): a row of floats for
 * each splat. Its color seen along a direction is a sum of spherical harmonics in lampion's own
 * convention, f_dc the first band and f_rest the others, channel by channel. Positions, normals and
 * orientations rotate as usual; each color rotates by the matrices of lmp_sh_make_rotation. */
#include <lampion/lampion.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PROPERTIES_MAX = 256, LINE_MAX_BYTES = 256, BANDS_MAX = 5 };

/* Where a splat's numbers are in its row of floats; -1 where the file has none. */
typedef struct layout {
    long splats;
    int properties;
    int position, normal, quaternion; /* of the first of 3, 3 and 4 numbers */
    int color, rest;                  /* of f_dc_0 and f_rest_0 */
    int rest_count;
} layout;

typedef struct rotation {
    lmp_quat quat;
    int bands;
    float matrices[LMP_SH_ROTATION_COUNT(BANDS_MAX)];
} rotation;

static const char *add_property(layout *l, const char *line) {
    char name[LINE_MAX_BYTES];
    const int at = l->properties++;
    if (sscanf(line, "property float %255s", name) != 1)
        return "a property is not a float";
    if (at == PROPERTIES_MAX)
        return "too many properties";
    if (strcmp(name, "x") == 0)
        l->position = at;
    else if (strcmp(name, "nx") == 0)
        l->normal = at;
    else if (strcmp(name, "rot_0") == 0)
        l->quaternion = at;
    else if (strcmp(name, "f_dc_0") == 0)
        l->color = at;
    else if (strcmp(name, "f_rest_0") == 0)
        l->rest = at;
    l->rest_count += strncmp(name, "f_rest_", 7) == 0;
    return NULL;
}

/* Reads the header and copies it. Returns what is wrong with it, or NULL. */
static const char *read_header(FILE *in, FILE *out, layout *l) {
    char line[LINE_MAX_BYTES];
    *l = (layout) { -1, 0, -1, -1, -1, -1, -1, 0 };
    for (int number = 0; fgets(line, sizeof line, in); number++) {
        const char *wrong = NULL;
        fputs(line, out);
        if (number == 0 && strncmp(line, "ply", 3) != 0)
            return "not a PLY file";
        if (strncmp(line, "format ", 7) == 0 && strncmp(line + 7, "binary_little_endian", 20) != 0)
            return "not a binary little-endian PLY file";
        if (strncmp(line, "element ", 8) == 0 &&
            sscanf(line, "element vertex %ld", &l->splats) != 1)
            return "an element is not a vertex";
        if (strncmp(line, "property ", 9) == 0)
            wrong = add_property(l, line);
        if (wrong)
            return wrong;
        if (strncmp(line, "end_header", 10) == 0)
            return l->splats < 0 || l->position < 0 || l->position + 3 > l->properties
                       ? "no vertices with x, y and z"
                       : NULL;
    }
    return "the header does not end";
}

/* Returns the bands of the colors, which have 3 (bands² - 1) numbers beside f_dc; 0 if the count
 * fits none. */
static int color_bands(const layout *l) {
    for (int bands = 1; bands <= BANDS_MAX; bands++)
        if (l->rest_count == 3 * (bands * bands - 1))
            return l->rest_count == 0 || (l->color >= 0 && l->rest + l->rest_count <= l->properties)
                       ? bands
                       : 0;
    return 0;
}

static rotation make_rotation(int bands, lmp_vec3 axis, float degrees) {
    const float half = degrees * 3.14159265f / 360.0f;
    const float length = sqrtf(axis.x * axis.x + axis.y * axis.y + axis.z * axis.z);
    const float s = sinf(half) / length;
    rotation r = { .bands = bands, .quat = { axis.x * s, axis.y * s, axis.z * s, cosf(half) } };
    lmp_sh_make_rotation(bands, r.quat, r.matrices);
    return r;
}

/* Rotates v by a unit quaternion, q v q*: v + 2 u x (u x v + w v). */
static void rotate_vector(lmp_quat q, float v[3]) {
    const float a[3] = { q.y * v[2] - q.z * v[1] + q.w * v[0], q.z * v[0] - q.x * v[2] + q.w * v[1],
                         q.x * v[1] - q.y * v[0] + q.w * v[2] };
    v[0] += 2 * (q.y * a[2] - q.z * a[1]);
    v[1] += 2 * (q.z * a[0] - q.x * a[2]);
    v[2] += 2 * (q.x * a[1] - q.y * a[0]);
}

/* Multiplies q with an orientation, which stores its real part first. */
static void rotate_orientation(lmp_quat q, float o[4]) {
    const float w = o[0], x = o[1], y = o[2], z = o[3];
    o[0] = q.w * w - q.x * x - q.y * y - q.z * z;
    o[1] = q.w * x + q.x * w + q.y * z - q.z * y;
    o[2] = q.w * y - q.x * z + q.y * w + q.z * x;
    o[3] = q.w * z + q.x * y - q.y * x + q.z * w;
}

/* Rotates the bands past the first, which is the same in every direction. */
static void rotate_color(const rotation *r, float *rest) {
    const size_t count = LMP_SH_COUNT(r->bands);
    for (int channel = 0; channel < 3; channel++) {
        float sh[LMP_SH_COUNT(BANDS_MAX)] = { 0 }, rotated[LMP_SH_COUNT(BANDS_MAX)];
        float *coefficients = rest + (size_t)channel * (count - 1);
        memcpy(sh + 1, coefficients, (count - 1) * sizeof *sh);
        lmp_sh_rotate(r->bands, r->matrices, sh, rotated);
        memcpy(coefficients, rotated + 1, (count - 1) * sizeof *sh);
    }
}

static void rotate_splat(const layout *l, const rotation *r, float *row) {
    rotate_vector(r->quat, row + l->position);
    if (l->normal >= 0)
        rotate_vector(r->quat, row + l->normal);
    if (l->quaternion >= 0)
        rotate_orientation(r->quat, row + l->quaternion);
    if (r->bands > 1)
        rotate_color(r, row + l->rest);
}

/* Copies `in` to `out`, rotated. Returns what is wrong, or NULL. */
static const char *rotate_file(FILE *in, FILE *out, lmp_vec3 axis, float degrees) {
    layout l;
    const char *wrong = read_header(in, out, &l);
    if (wrong)
        return wrong;
    const int bands = color_bands(&l);
    if (!bands)
        return "the f_rest properties are no whole number of bands";
    if ((l.normal >= 0 && l.normal + 3 > l.properties) ||
        (l.quaternion >= 0 && l.quaternion + 4 > l.properties))
        return "a normal or an orientation is incomplete";
    const rotation r = make_rotation(bands, axis, degrees);
    float row[PROPERTIES_MAX];
    for (long i = 0; i < l.splats; i++) {
        if (fread(row, sizeof *row, (size_t)l.properties, in) != (size_t)l.properties)
            return "the file ends before its last splat";
        rotate_splat(&l, &r, row);
        if (fwrite(row, sizeof *row, (size_t)l.properties, out) != (size_t)l.properties)
            return "cannot write the rotated splats";
    }
    return NULL;
}

int main(int argc, char **argv) {
    if (argc != 7) {
        fprintf(stderr, "usage: rotate_splats IN.ply OUT.ply AXIS_X AXIS_Y AXIS_Z DEGREES\n");
        return 1;
    }
    const lmp_vec3 axis = { strtof(argv[3], NULL), strtof(argv[4], NULL), strtof(argv[5], NULL) };
    const float degrees = strtof(argv[6], NULL);
    const float length2 = axis.x * axis.x + axis.y * axis.y + axis.z * axis.z;
    if (!(length2 > 0 && length2 < HUGE_VALF) || !isfinite(degrees)) {
        fprintf(stderr, "rotate_splats: the axis must not be zero, and the angle be finite\n");
        return 1;
    }
    FILE *in = fopen(argv[1], "rb"), *out = in ? fopen(argv[2], "wbx") : NULL;
    if (!in || !out) {
        perror(in ? argv[2] : argv[1]);
        return 1;
    }
    const char *wrong = rotate_file(in, out, axis, degrees);
    if (fclose(out) != 0 && !wrong)
        wrong = "cannot write the rotated splats";
    fclose(in);
    if (wrong) {
        fprintf(stderr, "%s: %s\n", argv[1], wrong);
        remove(argv[2]);
    }
    return wrong ? 1 : 0;
}
