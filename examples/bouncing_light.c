/* SPDX-License-Identifier: MIT */
/* bouncing_light.c - a lamp moves through a box whose left wall is red, and light bounces between
 * the walls. Rays are cast once, before the first frame; a frame costs two sums.
 *
 *     cc bouncing_light.c $(pkg-config --cflags --libs lampion) -lm -o bouncing_light */
#include <lampion/lampion.h>

#include <math.h>
#include <stdio.h>

/* The box reaches from 0 to SIZE; each wall has CELLS x CELLS surfels. */
enum { WALLS = 6, CELLS = 12, SURFELS = WALLS * CELLS * CELLS, RAYS = 128, LINKS = 24 };
static const float size = 3, spacing = 3.0f / CELLS;

static lmp_transfer_surfel surfels[SURFELS];
static uint32_t hits[SURFELS * RAYS], links[SURFELS * LINKS];
static lmp_rgb direct[SURFELS];

/* Walls 0 and 1 are x = 0 and x = size, then follow those of y and z. */
static uint32_t surfel_at(int wall, const float point[3]) {
    const int column = (int)(point[(wall / 2 + 1) % 3] / spacing);
    const int row = (int)(point[(wall / 2 + 2) % 3] / spacing);
    const int last = CELLS - 1;
    return (uint32_t)((wall * CELLS + (row < last ? row : last)) * CELLS +
                      (column < last ? column : last));
}

/* Returns the surfel that a ray from inside the box hits: your own ray tracer would. */
static uint32_t cast(lmp_vec3 from, lmp_vec3 direction) {
    const float at[3] = { from.x, from.y, from.z };
    const float along[3] = { direction.x, direction.y, direction.z };
    float nearest = INFINITY, point[3];
    int wall = 0;
    for (int a = 0; a < 3; a++) {
        const float distance = ((along[a] > 0 ? size : 0) - at[a]) / along[a];
        if (along[a] != 0 && distance < nearest) {
            nearest = distance;
            wall = 2 * a + (along[a] > 0);
        }
    }
    for (int a = 0; a < 3; a++)
        point[a] = fminf(fmaxf(at[a] + nearest * along[a], 0), size);
    return surfel_at(wall, point);
}

/* Returns ray k from a wall: its directions are spread by Roberts' sequence R2, shifted for each
 * surfel, so that they are distributed as the cosine with the normal. */
static lmp_vec3 ray_from(int wall, int surfel, int k) {
    const float u = fmodf(0.754878f * (float)k + 0.618034f * (float)surfel, 1);
    const float v = fmodf(0.569840f * (float)k + 0.414214f * (float)surfel, 1);
    const float sine = sqrtf(u), cosine = sqrtf(1 - u);
    float w[3];
    w[wall / 2] = wall % 2 ? -cosine : cosine;
    w[(wall / 2 + 1) % 3] = sine * cosf(6.283185f * v);
    w[(wall / 2 + 2) % 3] = sine * sinf(6.283185f * v);
    return (lmp_vec3) { w[0], w[1], w[2] };
}

/* Links a surfel with those up to two cells away on its wall: in a box they all see it. */
static void link_surfel(int wall, int row, int column, uint32_t *linked) {
    int count = 0;
    for (int r = row - 2; r <= row + 2; r++)
        for (int c = column - 2; c <= column + 2; c++) {
            if (r == row && c == column)
                continue;
            const int there = r >= 0 && c >= 0 && r < CELLS && c < CELLS;
            linked[count++] =
                there ? (uint32_t)((wall * CELLS + r) * CELLS + c) : LMP_TRANSFER_NONE;
        }
}

static lmp_transfer_surfel make_surfel(int wall, int row, int column) {
    const float white = 0.7f;
    float at[3], normal[3] = { 0, 0, 0 };
    at[wall / 2] = wall % 2 ? size : 0;
    at[(wall / 2 + 1) % 3] = ((float)column + 0.5f) * spacing;
    at[(wall / 2 + 2) % 3] = ((float)row + 0.5f) * spacing;
    normal[wall / 2] = wall % 2 ? -1 : 1;
    return (lmp_transfer_surfel) { .position = { at[0], at[1], at[2] },
                                   .normal = { normal[0], normal[1], normal[2] },
                                   .albedo = { white, wall ? white : 0.1f, wall ? white : 0.1f },
                                   .radius = 1.5f * spacing };
}

static lmp_result make_transfer(lmp_transfer **transfer) {
    for (int i = 0; i < SURFELS; i++) {
        const int wall = i / (CELLS * CELLS), row = i / CELLS % CELLS, column = i % CELLS;
        surfels[i] = make_surfel(wall, row, column);
        link_surfel(wall, row, column, links + i * LINKS);
        for (int k = 0; k < RAYS; k++)
            hits[i * RAYS + k] = cast(surfels[i].position, ray_from(wall, i, k));
    }
    const lmp_transfer_desc desc = { .surfels = surfels,
                                     .surfel_count = SURFELS,
                                     .hits = hits,
                                     .ray_count = RAYS,
                                     .links = links,
                                     .link_count = LINKS };
    return lmp_transfer_create(NULL, &desc, transfer);
}

int main(void) {
    const float floor_point[3] = { 1.1f, 0, 1.6f };
    const lmp_vec3 point = { floor_point[0], floor_point[1], floor_point[2] }, up = { 0, 1, 0 };
    lmp_transfer *transfer;
    if (make_transfer(&transfer) != LMP_OK)
        return 1;
    puts("lamp at x  direct                indirect");
    for (int frame = 0; frame <= 4; frame++) {
        const lmp_light lamp = { .position = { 0.5f + 0.5f * (float)frame, 2, 1.5f },
                                 .radius = 0.15f,
                                 .radiance = { 40, 40, 40 } };
        for (int i = 0; i < SURFELS; i++)
            direct[i] = lmp_light_irradiance(&lamp, 1, surfels[i].position, surfels[i].normal);
        const lmp_transfer_settings settings = { .iterations = 50, .remainder = 1e-4f };
        const lmp_transfer_lighting lighting = { .direct = direct };
        if (lmp_transfer_update(NULL, transfer, &settings, &lighting) != LMP_OK)
            return 1;
        const lmp_rgb seen = lmp_light_irradiance(&lamp, 1, point, up);
        const lmp_rgb bounced =
            lmp_transfer_irradiance(transfer, surfel_at(2, floor_point), point, up);
        printf("%9.1f  %.3f %.3f %.3f     %.3f %.3f %.3f\n", (double)lamp.position.x,
               (double)seen.r, (double)seen.g, (double)seen.b, (double)bounced.r, (double)bounced.g,
               (double)bounced.b);
    }
    lmp_transfer_destroy(transfer);
    return 0;
}
