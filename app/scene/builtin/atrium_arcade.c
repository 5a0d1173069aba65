/* SPDX-License-Identifier: MIT */
/* atrium_arcade.c - columns, arches and what runs along them, in the frame of one bay. */
#include "app/scene/builtin/atrium.h"

#include "app/scene/vector.h"

#include <math.h>
#include <string.h>

static void box_at(scene_shaper *shaper, lmp_vec3 center, float half, float from_y, float to_y) {
    shape_box(shaper, vec(center.x - half, center.y + from_y, center.z - half),
              vec(center.x + half, center.y + to_y, center.z + half));
}

/* An Attic base: torus, scotia, torus; for radius 1, heights from 0 to 0.62. */
static const shape_point attic_base[] = {
    { 1.28f, 0.00f }, { 1.36f, 0.04f }, { 1.40f, 0.10f }, { 1.40f, 0.16f }, { 1.36f, 0.22f },
    { 1.28f, 0.26f }, { 1.22f, 0.26f }, { 1.22f, 0.29f }, { 1.15f, 0.32f }, { 1.11f, 0.37f },
    { 1.12f, 0.42f }, { 1.17f, 0.45f }, { 1.17f, 0.47f }, { 1.22f, 0.48f }, { 1.25f, 0.51f },
    { 1.25f, 0.55f }, { 1.22f, 0.58f }, { 1.14f, 0.60f }, { 1.08f, 0.60f }, { 1.08f, 0.62f },
    { 1.02f, 0.64f },
};

/* A bell capital, for radius 1, heights from 0 to 1.3: astragal, bell, lip. */
static const shape_point astragal[] = {
    { 0.90f, 0.00f }, { 0.98f, 0.02f }, { 1.01f, 0.06f }, { 0.98f, 0.10f }, { 0.88f, 0.12f }
};
static const shape_point bell[] = { { 0.86f, 0.12f }, { 0.92f, 0.30f }, { 0.98f, 0.44f },
                                    { 1.08f, 0.52f }, { 1.02f, 0.54f }, { 0.94f, 0.56f },
                                    { 0.98f, 0.72f }, { 1.08f, 0.86f }, { 1.22f, 0.95f },
                                    { 1.16f, 0.98f }, { 1.04f, 1.00f }, { 1.08f, 1.10f },
                                    { 1.20f, 1.20f }, { 1.34f, 1.26f } };

void atrium_put_column(scene_shaper *shaper, lmp_vec3 foot, float radius, float height,
                       int flutes) {
    enum { RINGS = 8 };
    shape_point scaled[64];
    const float plinth = 0.36f * radius, base = plinth + 0.62f * radius;
    const float capital = height - 1.5f * radius;
    shaper->material = MARBLE;
    box_at(shaper, foot, 1.42f * radius, 0.0f, plinth);
    const int base_count = sizeof attic_base / sizeof *attic_base;
    for (int i = 0; i < base_count; i++)
        scaled[i] = (shape_point) { attic_base[i].r * radius, plinth + attic_base[i].a * radius };
    atrium_revolve(shaper, scaled, base_count, foot, 32);
    /* The shaft swells a little before it tapers: entasis. */
    for (int i = 0; i <= RINGS; i++) {
        const float t = (float)i / RINGS;
        scaled[i] = (shape_point) { radius * (1.0f - 0.14f * t * t), base + (capital - base) * t };
    }
    shape_revolve(shaper, &(shape_revolution) { .profile = scaled,
                                                .point_count = RINGS + 1,
                                                .origin = foot,
                                                .axis = 'y',
                                                .segments = flutes ? 4 * flutes : 28,
                                                .flutes = flutes,
                                                .depth = 0.055f });
    const int astragal_count = sizeof astragal / sizeof *astragal;
    for (int i = 0; i < astragal_count; i++)
        scaled[i] = (shape_point) { astragal[i].r * radius, capital + astragal[i].a * radius };
    atrium_revolve(shaper, scaled, astragal_count, foot, 32);
    const int bell_count = sizeof bell / sizeof *bell;
    for (int i = 0; i < bell_count; i++)
        scaled[i] = (shape_point) { bell[i].r * radius, capital + bell[i].a * radius };
    shape_revolve(shaper, &(shape_revolution) { .profile = scaled,
                                                .point_count = bell_count,
                                                .origin = foot,
                                                .axis = 'y',
                                                .segments = 80,
                                                .flutes = 16,
                                                .depth = 0.10f });
    box_at(shaper, foot, 1.38f * radius, height - 0.26f * radius, height - 0.08f * radius);
    box_at(shaper, foot, 1.48f * radius, height - 0.09f * radius, height);
}

static void atrium_put_balustrade(scene_shaper *shaper, float floor) {
    static const shape_point baluster[] = {
        { 0.070f, 0.10f }, { 0.070f, 0.14f }, { 0.050f, 0.16f }, { 0.046f, 0.19f },
        { 0.076f, 0.26f }, { 0.088f, 0.35f }, { 0.066f, 0.48f }, { 0.040f, 0.60f },
        { 0.038f, 0.67f }, { 0.052f, 0.72f }, { 0.070f, 0.75f }, { 0.070f, 0.80f },
    };
    static const shape_point rail[] = { { -0.11f, 0.92f }, { -0.13f, 0.88f }, { -0.13f, 0.84f },
                                        { -0.10f, 0.80f }, { 0.10f, 0.80f },  { 0.13f, 0.84f },
                                        { 0.13f, 0.88f },  { 0.11f, 0.92f },  { -0.11f, 0.92f } };
    enum { BALUSTERS = 9 };
    shaper->material = BALUSTER;
    for (int i = 0; i < BALUSTERS; i++) {
        const float x = 2.3f * (((float)i + 0.5f) / BALUSTERS - 0.5f);
        atrium_revolve(shaper, baluster, sizeof baluster / sizeof *baluster, vec(x, floor, 0.05f),
                       12);
    }
    const float end = 0.5f * BAY - 0.2f;
    shaper->material = TRIM;
    shape_box(shaper, vec(-end, floor, -0.07f), vec(end, floor + 0.10f, 0.17f));
    shape_sweep(shaper, rail, sizeof rail / sizeof *rail, vec(0.0f, floor, 0.05f), -end, end);
}

/* --- arches ----------------------------------------------------------------------------------- */

/* Adds one face of the wall around an arch, at depth z, seen from +z (or from -z if `back`). */
static void put_spandrels(scene_shaper *shaper, const storey_plan *s, float z, bool back) {
    const int steps = shaper_steps(shaper, 24);
    const float half = 0.5f * BAY, r = s->opening;
    for (int i = 0; i < steps; i++) {
        const float from = PI * (float)i / (float)steps, to = PI * (float)(i + 1) / (float)steps;
        const lmp_vec3 a = vec(r * cosf(from), s->springing + r * sinf(from), z);
        const lmp_vec3 b = vec(r * cosf(to), s->springing + r * sinf(to), z);
        const lmp_vec3 c = vec(b.x, s->top, z), d = vec(a.x, s->top, z);
        if (back)
            shape_quad(shaper, a, b, c, d);
        else
            shape_quad(shaper, b, a, d, c);
    }
    for (int side = 0; side < 2; side++) {
        const float from = side ? r : -half, to = side ? half : -r;
        const lmp_vec3 a = vec(from, s->springing, z), b = vec(to, s->springing, z);
        const lmp_vec3 c = vec(to, s->top, z), d = vec(from, s->top, z);
        if (back)
            shape_quad(shaper, b, a, d, c);
        else
            shape_quad(shaper, a, b, c, d);
    }
}

static void put_arch(scene_shaper *shaper, const storey_plan *s) {
    const float r = s->opening, half = 0.5f * BAY;
    shaper->material = LIMESTONE;
    put_spandrels(shaper, s, WALL, false);
    put_spandrels(shaper, s, -WALL, true);
    const shape_point soffit[] = { { r, WALL }, { r, -WALL } };
    shaper->material = TRIM;
    atrium_revolve_arch(shaper, soffit, 2, s->springing, 32);
    for (int side = 0; side < 2; side++) {
        const float from = side ? r : -half, to = side ? half : -r;
        shape_quad(shaper, vec(from, s->springing, -WALL), vec(to, s->springing, -WALL),
                   vec(to, s->springing, WALL), vec(from, s->springing, WALL));
    }
    const shape_point archivolt[] = {
        { r + 0.26f, WALL },         { r + 0.26f, WALL + 0.07f }, { r + 0.22f, WALL + 0.09f },
        { r + 0.19f, WALL + 0.07f }, { r + 0.18f, WALL + 0.05f }, { r + 0.10f, WALL + 0.05f },
        { r + 0.10f, WALL + 0.03f }, { r, WALL + 0.03f },         { r, WALL },
    };
    atrium_revolve_arch(shaper, archivolt, sizeof archivolt / sizeof *archivolt, s->springing, 32);
    /* keystone */
    const float y0 = s->springing + r - 0.04f, y1 = s->springing + r + 0.36f, z = WALL + 0.13f;
    const lmp_vec3 k[8] = { vec(-0.09f, y0, WALL), vec(0.09f, y0, WALL), vec(0.14f, y1, WALL),
                            vec(-0.14f, y1, WALL), vec(-0.09f, y0, z),   vec(0.09f, y0, z),
                            vec(0.14f, y1, z),     vec(-0.14f, y1, z) };
    shape_quad(shaper, k[4], k[5], k[6], k[7]);
    shape_quad(shaper, k[0], k[4], k[7], k[3]);
    shape_quad(shaper, k[5], k[1], k[2], k[6]);
    shape_quad(shaper, k[7], k[6], k[2], k[3]);
    shape_quad(shaper, k[0], k[1], k[5], k[4]);
}

/* Adds a round medallion on the wall over a column. */
static void put_medallion(scene_shaper *shaper, float y) {
    static const shape_point ring[] = { { 0.30f, 0.00f }, { 0.30f, 0.04f }, { 0.27f, 0.06f },
                                        { 0.23f, 0.06f }, { 0.20f, 0.03f }, { 0.20f, 0.01f } };
    static const shape_point boss[] = {
        { 0.10f, 0.01f }, { 0.09f, 0.05f }, { 0.05f, 0.08f }, { 0.0f, 0.09f }
    };
    static const shape_point disc[] = { { 0.21f, 0.012f }, { 0.0f, 0.012f } };
    const struct {
        const shape_point *profile;
        int count;
        uint32_t stone;
    } parts[] = { { ring, 6, TRIM }, { boss, 4, TRIM }, { disc, 2, DADO } };
    for (int i = 0; i < 3; i++) {
        shaper->material = parts[i].stone;
        shape_revolve(shaper, &(shape_revolution) { .profile = parts[i].profile,
                                                    .point_count = parts[i].count,
                                                    .origin = vec(-0.5f * BAY, y, WALL),
                                                    .axis = 'z',
                                                    .segments = 32 });
    }
}

/* Adds a cornice along the bay whose top is at y, with dentils under it. */
static void put_cornice(scene_shaper *shaper, float y, float scale) {
    static const shape_point moulding[] = {
        { 0.00f, -0.62f }, { 0.05f, -0.60f }, { 0.05f, -0.46f }, { 0.08f, -0.44f },
        { 0.08f, -0.34f }, { 0.11f, -0.32f }, { 0.11f, -0.20f }, { 0.30f, -0.19f },
        { 0.32f, -0.12f }, { 0.36f, -0.10f }, { 0.41f, -0.06f }, { 0.44f, -0.01f },
        { 0.44f, 0.00f },  { 0.00f, 0.02f },
    };
    enum { POINTS = sizeof moulding / sizeof *moulding, DENTILS = 15 };
    shape_point scaled[POINTS];
    for (int i = 0; i < POINTS; i++)
        scaled[i] = (shape_point) { WALL + scale * moulding[i].r, scale * moulding[i].a };
    /* The cornice is no longer than the bay: corners are only as wide as a column, and longer
     * cornices would cross there. */
    shaper->material = TRIM;
    shape_sweep(shaper, scaled, POINTS, vec(0.0f, y, 0.0f), -0.5f * BAY, 0.5f * BAY);
    for (int i = 0; i < DENTILS; i++) {
        const float x = BAY * (((float)i + 0.5f) / DENTILS - 0.5f);
        shape_box(shaper, vec(x - 0.05f, y - 0.31f * scale, WALL + 0.10f * scale),
                  vec(x + 0.05f, y - 0.20f * scale, WALL + 0.21f * scale));
    }
}

void atrium_put_arcade(scene_shaper *shaper) {
    put_arch(shaper, &atrium_lower);
    put_arch(shaper, &atrium_upper);
    put_medallion(shaper, atrium_lower.springing + 1.0f);
    put_medallion(shaper, atrium_upper.springing + 1.05f);
    put_cornice(shaper, GALLERY + 0.02f, 0.75f);
    put_cornice(shaper, CORNICE + 0.02f, 1.0f);
    atrium_put_balustrade(shaper, GALLERY);
}
