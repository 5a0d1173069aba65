/* SPDX-License-Identifier: MIT */
/* read_probes.c - reads an irradiance volume and prints what a white diffuse surface reflects at a
 * point, with a normal: between eight probes, by Filament's nine colors. Standard C alone.
 *
 *     lampion field scene.gltf --preset filament -o probes.csv
 *     cc read_probes.c -o read_probes && ./read_probes probes.csv 0 1 0  0 1 0 */
#include <stdio.h>
#include <stdlib.h>

enum { COLORS = 9, COLUMNS = 3 + 3 * COLORS };
typedef float probe[COLUMNS]; /* x, y, z, then red, green, blue of each color */

typedef struct volume {
    probe *probes;
    size_t count, counts[3]; /* number of probes; and along x, which varies fastest, y and z */
} volume;

/* Reads a probe; returns false at the end of the file. */
static int read_probe(FILE *file, float *values) {
    for (int i = 0; i < COLUMNS; i++)
        if (fscanf(file, i == 0 ? "%f" : ",%f", &values[i]) != 1)
            return 0;
    return 1;
}

/* Returns how many probes there are before a coordinate changes. */
static size_t run_of(const volume *v, int axis) {
    size_t i = 1;
    while (i < v->count && v->probes[i][axis] == v->probes[0][axis])
        i++;
    return i;
}

static int read_volume(const char *path, volume *v) {
    FILE *file = fopen(path, "r");
    size_t room = 0;
    *v = (volume) { 0 };
    if (!file || fscanf(file, "x,y,z,r0,g0,b0,%*[^\n]") == EOF)
        return 0;
    do {
        if (v->count == room) {
            room = room ? 2 * room : 1024;
            probe *more = realloc(v->probes, room * sizeof *more);
            if (!more)
                return 0;
            v->probes = more;
        }
    } while (read_probe(file, v->probes[v->count]) && ++v->count);
    fclose(file);
    if (v->count < 8)
        return 0;
    v->counts[0] = run_of(v, 1);
    v->counts[1] = run_of(v, 2) / v->counts[0];
    v->counts[2] = v->count / v->counts[0] / v->counts[1];
    return v->counts[0] > 1 && v->counts[1] > 1 && v->counts[2] > 1;
}

/* Finds the cell that a coordinate lies in, and the fraction along it; outside the grid, the
 * nearest cell. */
static size_t cell_of(const volume *v, int axis, float at, float *fraction) {
    const size_t last = v->counts[axis] - 1;
    const float first = v->probes[0][axis], end = v->probes[v->count - 1][axis];
    float offset = (at - first) / (end - first) * (float)last;
    offset = offset > 0 ? offset < (float)last ? offset : (float)last : 0;
    const size_t cell = (size_t)offset < last ? (size_t)offset : last - 1;
    *fraction = offset - (float)cell;
    return cell;
}

static void interpolate(const volume *v, const float point[3], float values[3 * COLORS]) {
    size_t cell[3];
    float fraction[3];
    for (int axis = 0; axis < 3; axis++)
        cell[axis] = cell_of(v, axis, point[axis], &fraction[axis]);
    for (int i = 0; i < 3 * COLORS; i++)
        values[i] = 0;
    for (size_t corner = 0; corner < 8; corner++) {
        const size_t up[3] = { corner % 2, corner / 2 % 2, corner / 4 };
        const size_t row = (cell[2] + up[2]) * v->counts[1] + cell[1] + up[1];
        const float *near = v->probes[row * v->counts[0] + cell[0] + up[0]];
        float weight = 1;
        for (int axis = 0; axis < 3; axis++)
            weight *= up[axis] ? fraction[axis] : 1 - fraction[axis];
        for (int i = 0; i < 3 * COLORS; i++)
            values[i] += weight * near[3 + i];
    }
}

/* Returns a channel's irradiance over pi, as Filament's shaders evaluate it. */
static float reflected(const float *values, int channel, const float n[3]) {
    const float x = n[0], y = n[1], z = n[2];
    const float terms[COLORS] = { 1, y, z, x, x * y, y * z, 3 * z * z - 1, z * x, x * x - y * y };
    float sum = 0;
    for (int i = 0; i < COLORS; i++)
        sum += terms[i] * values[3 * i + channel];
    return sum > 0 ? sum : 0;
}

int main(int argc, char **argv) {
    float numbers[6], values[3 * COLORS];
    volume v;
    if (argc != 8) {
        fprintf(stderr, "usage: read_probes probes.csv X Y Z NX NY NZ\n");
        return 2;
    }
    if (!read_volume(argv[1], &v)) {
        fprintf(stderr, "read_probes: %s: is no volume of Filament's probes\n", argv[1]);
        return 1;
    }
    for (int i = 0; i < 6; i++)
        numbers[i] = strtof(argv[2 + i], NULL);
    interpolate(&v, numbers, values);
    for (int channel = 0; channel < 3; channel++)
        printf("%.6g%c", (double)reflected(values, channel, numbers + 3), channel < 2 ? ' ' : '\n');
    free(v.probes);
    return 0;
}
