/* SPDX-License-Identifier: MIT */
/* atrium_court.c - the floor of the court, its barrel vault, and the walls that close the vault. */
#include "app/scene/builtin/atrium.h"

#include "app/scene/random.h"
#include "app/scene/vector.h"

#include <math.h>

/* Adds a beveled tile of the checkered floor with its border; every tile has its own gloss. */
static void put_tile(scene_shaper *shaper, float x, float z, float size) {
    const float gap = 0.006f, bevel = 0.010f, low = 0.004f, high = 0.012f;
    const float a = x + gap, b = x + size - gap, c = z + gap, d = z + size - gap;
    const lmp_vec3 outer[4] = { vec(a, low, d), vec(b, low, d), vec(b, low, c), vec(a, low, c) };
    const lmp_vec3 inner[4] = { vec(a + bevel, high, d - bevel), vec(b - bevel, high, d - bevel),
                                vec(b - bevel, high, c + bevel), vec(a + bevel, high, c + bevel) };
    shape_quad(shaper, inner[0], inner[1], inner[2], inner[3]);
    for (int i = 0; i < 4; i++) {
        const int next = (i + 1) % 4;
        shape_quad(shaper, outer[i], outer[next], inner[next], inner[i]);
    }
}

static void put_floor(court_plan *court) {
    scene_shaper *shaper = &court->shaper;
    const float size = 0.75f, half_x = HALF_WIDTH - WALL, half_z = court->half_length - WALL;
    const int columns = (int)(2.0f * half_x / size), rows = (int)(2.0f * half_z / size);
    shaper->material = GROUT;
    shape_quad(shaper, vec(-half_x, 0.003f, half_z), vec(half_x, 0.003f, half_z),
               vec(half_x, 0.003f, -half_z), vec(-half_x, 0.003f, -half_z));
    for (int row = 0; row < rows; row++)
        for (int column = 0; column < columns; column++) {
            const bool border = row == 0 || row == rows - 1 || column == 0 || column == columns - 1;
            const bool runner = column == columns / 2 && row % 4 == 2;
            const uint32_t gloss = (uint32_t)(random_bits(&court->random) >> 62);
            shaper->material = gloss + (border || runner          ? (uint32_t)TILE_ACCENT
                                        : (row + column) % 2 == 0 ? (uint32_t)TILE_LIGHT
                                                                  : (uint32_t)TILE_DARK);
            put_tile(shaper, size * ((float)column - 0.5f * (float)columns),
                     size * ((float)row - 0.5f * (float)rows), size);
        }
}

/* Adds the barrel vault: a shell whose coffers lie between transverse ribs over the columns and
 * ribs along it. */
static void put_vault(court_plan *court) {
    scene_shaper *shaper = &court->shaper;
    const float r = HALF_WIDTH - 0.1f, length = court->half_length;
    enum { RIBS_ALONG = 9 };
    const shape_point shell[] = { { r, length }, { r, -length } };
    shaper->material = PLASTER;
    atrium_revolve_arch(shaper, shell, 2, CORNICE, 64);
    shaper->material = TRIM;
    for (int i = 0; i <= 2 * court->bays; i++) {
        const float z = 0.5f * BAY * ((float)i - (float)court->bays);
        const float half = i % 2 ? 0.10f : 0.20f, drop = i % 2 ? 0.12f : 0.20f;
        const shape_point rib[] = { { r, z + half },
                                    { r - 0.7f * drop, z + half },
                                    { r - drop, z + half - 0.06f },
                                    { r - drop, z - half + 0.06f },
                                    { r - 0.7f * drop, z - half },
                                    { r, z - half } };
        atrium_revolve_arch(shaper, rib, sizeof rib / sizeof *rib, CORNICE, 64);
    }
    for (int i = 1; i <= RIBS_ALONG; i++) {
        const float middle = PI * (float)i / (RIBS_ALONG + 1), half = 0.022f, inner = r - 0.12f;
        const lmp_vec3 p[4] = {
            vec(r * cosf(middle - half), CORNICE + r * sinf(middle - half), 0.0f),
            vec(inner * cosf(middle - half), CORNICE + inner * sinf(middle - half), 0.0f),
            vec(inner * cosf(middle + half), CORNICE + inner * sinf(middle + half), 0.0f),
            vec(r * cosf(middle + half), CORNICE + r * sinf(middle + half), 0.0f),
        };
        for (int k = 0; k < 3; k++)
            shape_quad(shaper, vec(p[k].x, p[k].y, -length), vec(p[k].x, p[k].y, length),
                       vec(p[k + 1].x, p[k + 1].y, length), vec(p[k + 1].x, p[k + 1].y, -length));
    }
}

/* Adds four bars from the hub, and a ring between each two. */
static void put_spokes(scene_shaper *shaper, lmp_vec3 center) {
    static const shape_point ring[] = {
        { 0.30f, 0.02f }, { 0.30f, 0.08f }, { 0.24f, 0.08f }, { 0.24f, 0.02f }
    };
    shaper->material = TRIM;
    for (int i = 0; i < 4; i++) {
        const float x = i % 2 ? 0.0f
                        : i   ? -0.74f
                              : 0.74f,
                    y = i % 2 ? (i > 1 ? -0.74f : 0.74f) : 0.0f;
        const float wide = i % 2 ? 0.04f : 0.46f, high = i % 2 ? 0.46f : 0.04f;
        shape_box(shaper, vec_add(center, vec(x - wide, y - high, 0.02f)),
                  vec_add(center, vec(x + wide, y + high, 0.09f)));
        const lmp_vec3 between = vec(i & 1 ? -0.53f : 0.53f, i & 2 ? -0.53f : 0.53f, 0.0f);
        shape_revolve(shaper, &(shape_revolution) { .profile = ring,
                                                    .point_count = sizeof ring / sizeof *ring,
                                                    .origin = vec_add(center, between),
                                                    .axis = 'z',
                                                    .segments = 32 });
    }
}

/* Adds the half discs that close the vault, with a round window's frame and spokes. */
static void put_lunettes(court_plan *court) {
    scene_shaper *shaper = &court->shaper;
    static const shape_point ring[] = { { 1.45f, 0.00f }, { 1.45f, 0.12f }, { 1.38f, 0.17f },
                                        { 1.28f, 0.17f }, { 1.24f, 0.10f }, { 1.16f, 0.08f },
                                        { 1.16f, 0.02f } };
    static const shape_point hub[] = {
        { 0.30f, 0.02f }, { 0.30f, 0.10f }, { 0.22f, 0.14f }, { 0.0f, 0.16f }
    };
    static const shape_point glass[] = { { 1.17f, 0.02f }, { 0.0f, 0.02f } };
    for (int end = 0; end < 2; end++) {
        shaper->quarters = 2 * end;
        shaper->origin = vec(0.0f, 0.0f, end ? court->half_length : -court->half_length);
        const shape_point wall[] = { { HALF_WIDTH, 0.0f }, { 0.0f, 0.0f } };
        shaper->material = LIMESTONE;
        atrium_revolve_arch(shaper, wall, 2, CORNICE, 64);
        const lmp_vec3 center = vec(0.0f, CORNICE + 1.95f, 0.0f);
        const struct {
            const shape_point *profile;
            int count;
            uint32_t stone;
        } parts[] = { { ring, 7, TRIM }, { hub, 4, TRIM }, { glass, 2, FRESCO } };
        for (int i = 0; i < 3; i++) {
            shaper->material = parts[i].stone;
            shape_revolve(shaper, &(shape_revolution) { .profile = parts[i].profile,
                                                        .point_count = parts[i].count,
                                                        .origin = center,
                                                        .axis = 'z',
                                                        .segments = 64 });
        }
        put_spokes(shaper, center);
    }
    shaper->quarters = 0;
    shaper->origin = vec(0.0f, 0.0f, 0.0f);
}

void atrium_put_court(court_plan *court) {
    put_floor(court);
    put_vault(court);
    put_lunettes(court);
}
