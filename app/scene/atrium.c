/* SPDX-License-Identifier: MIT */
/* atrium.c - builtin:atrium, a two-storey colonnaded court under a coffered barrel vault, with
 * lanterns. Metres, y up; the court runs along z. One bay is made in a frame whose x runs along the
 * wall and whose z points into the court, and set all round. */
#include "app/scene/builtin.h"
#include "app/scene/random.h"
#include "app/scene/shape.h"
#include "app/scene/vector.h"

#include <math.h>
#include <string.h>

#define BAY         3.0f /* from column to column */
#define BAYS_LONG   8    /* along the court, times the parameter tiles */
#define BAYS_ACROSS 3
#define HALF_WIDTH  (0.5f * BAY * BAYS_ACROSS)
#define WALL        0.3f /* half the arcade's thickness */
#define AISLE       3.2f /* from the arcade's plane to the outer wall */
#define GALLERY     5.0f /* height of the upper floor */
#define CORNICE     9.3f /* where the vault springs */

/* A storey: heights above its floor. */
typedef struct storey_plan {
    float floor, springing, top; /* of the arches, and of the wall over them */
    float opening;               /* half the arch's width */
} storey_plan;

static const storey_plan lower = { 0.0f, 3.20f, GALLERY, 1.14f };
static const storey_plan upper = { GALLERY, GALLERY + 2.55f, CORNICE, 1.22f };

typedef enum stone {
    LIMESTONE, /* walls and arches */
    MARBLE,    /* columns */
    TRIM,      /* mouldings */
    PLASTER,   /* vaults */
    FRESCO,    /* blind arches */
    DADO,
    BRONZE, /* lanterns */
    BALUSTER,
    TERRACOTTA,
    GROUT,
    TILE_LIGHT, /* four degrees of gloss each */
    TILE_DARK = TILE_LIGHT + 4,
    TILE_ACCENT = TILE_DARK + 4,
    STONES
} stone;

typedef struct court_plan {
    scene_shaper shaper;
    int bays; /* along z */
    float half_length;
    uint64_t random;
} court_plan;

static void add_material(scene_builder *builder, const char *name, float r, float g, float b,
                         float roughness, float metallic) {
    scene_material *material = builder_material(builder, name);
    if (!material)
        return;
    vec_store(vec(r, g, b), material->base_color);
    material->roughness = roughness;
    material->metallic = metallic;
}

/* In the order of `stone`. */
static void add_materials(scene_builder *builder) {
    static const char *const gloss_names[3][4] = {
        { "tile light polished", "tile light honed", "tile light worn", "tile light matte" },
        { "tile dark polished", "tile dark honed", "tile dark worn", "tile dark matte" },
        { "tile accent polished", "tile accent honed", "tile accent worn", "tile accent matte" },
    };
    static const float tile_colors[3][3] = { { 0.62f, 0.56f, 0.47f },
                                             { 0.055f, 0.07f, 0.075f },
                                             { 0.36f, 0.075f, 0.05f } };
    static const float gloss[4] = { 0.36f, 0.42f, 0.50f, 0.72f };
    /* Part metal, or Schlick's 0.04 would hide the lamps in the floor at the bands of real time. */
    static const float sheen[4] = { 0.60f, 0.45f, 0.25f, 0.0f };
    add_material(builder, "limestone", 0.46f, 0.38f, 0.29f, 0.85f, 0.0f);
    add_material(builder, "marble", 0.64f, 0.59f, 0.52f, 0.42f, 0.0f);
    add_material(builder, "trim", 0.56f, 0.48f, 0.38f, 0.65f, 0.0f);
    add_material(builder, "plaster", 0.40f, 0.38f, 0.36f, 0.95f, 0.0f);
    add_material(builder, "fresco", 0.42f, 0.09f, 0.06f, 0.7f, 0.0f);
    add_material(builder, "dado", 0.10f, 0.17f, 0.16f, 0.38f, 0.0f);
    add_material(builder, "bronze", 0.52f, 0.33f, 0.16f, 0.45f, 1.0f);
    add_material(builder, "baluster", 0.70f, 0.66f, 0.59f, 0.5f, 0.0f);
    add_material(builder, "terracotta", 0.40f, 0.19f, 0.11f, 0.6f, 0.0f);
    add_material(builder, "grout", 0.16f, 0.14f, 0.12f, 0.95f, 0.0f);
    for (int color = 0; color < 3; color++)
        for (int i = 0; i < 4; i++)
            add_material(builder, gloss_names[color][i], tile_colors[color][0],
                         tile_colors[color][1], tile_colors[color][2], gloss[i], sheen[i]);
}

/* --- columns and balusters ----------------------------------------------------------------------
 */

static void turn(scene_shaper *shaper, const shape_point *profile, int point_count, lmp_vec3 origin,
                 int segments) {
    shape_turn(shaper, &(shape_turning) { .profile = profile,
                                          .point_count = point_count,
                                          .origin = origin,
                                          .axis = 'y',
                                          .segments = segments });
}

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

static void put_column(scene_shaper *shaper, lmp_vec3 foot, float radius, float height,
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
    turn(shaper, scaled, base_count, foot, 32);
    /* The shaft swells a little before it tapers: entasis. */
    for (int i = 0; i <= RINGS; i++) {
        const float t = (float)i / RINGS;
        scaled[i] = (shape_point) { radius * (1.0f - 0.14f * t * t), base + (capital - base) * t };
    }
    shape_turn(shaper, &(shape_turning) { .profile = scaled,
                                          .point_count = RINGS + 1,
                                          .origin = foot,
                                          .axis = 'y',
                                          .segments = flutes ? 4 * flutes : 28,
                                          .flutes = flutes,
                                          .depth = 0.055f });
    const int astragal_count = sizeof astragal / sizeof *astragal;
    for (int i = 0; i < astragal_count; i++)
        scaled[i] = (shape_point) { astragal[i].r * radius, capital + astragal[i].a * radius };
    turn(shaper, scaled, astragal_count, foot, 32);
    const int bell_count = sizeof bell / sizeof *bell;
    for (int i = 0; i < bell_count; i++)
        scaled[i] = (shape_point) { bell[i].r * radius, capital + bell[i].a * radius };
    shape_turn(shaper, &(shape_turning) { .profile = scaled,
                                          .point_count = bell_count,
                                          .origin = foot,
                                          .axis = 'y',
                                          .segments = 80,
                                          .flutes = 16,
                                          .depth = 0.10f });
    box_at(shaper, foot, 1.38f * radius, height - 0.26f * radius, height - 0.08f * radius);
    box_at(shaper, foot, 1.48f * radius, height - 0.09f * radius, height);
}

static void put_balustrade(scene_shaper *shaper, float floor) {
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
        turn(shaper, baluster, sizeof baluster / sizeof *baluster, vec(x, floor, 0.05f), 12);
    }
    const float end = 0.5f * BAY - 0.2f;
    shaper->material = TRIM;
    shape_box(shaper, vec(-end, floor, -0.07f), vec(end, floor + 0.10f, 0.17f));
    shape_sweep(shaper, rail, sizeof rail / sizeof *rail, vec(0.0f, floor, 0.05f), -end, end);
}

/* --- arches -------------------------------------------------------------------------------------
 */

/* A half ring round (0, y, 0) in the plane of the wall. */
static void turn_arch(scene_shaper *shaper, const shape_point *profile, int point_count, float y,
                      int segments) {
    shape_turn(shaper, &(shape_turning) { .profile = profile,
                                          .point_count = point_count,
                                          .origin = vec(0.0f, y, 0.0f),
                                          .axis = 'z',
                                          .from = 0.0f,
                                          .to = PI,
                                          .segments = segments });
}

/* One face of the wall around an arch, at depth z, seen from +z (or from -z if `back`). */
static void put_spandrels(scene_shaper *shaper, const storey_plan *s, float z, bool back) {
    enum { STEPS = 24 };
    const float half = 0.5f * BAY, r = s->opening;
    for (int i = 0; i < STEPS; i++) {
        const float from = PI * (float)i / STEPS, to = PI * (float)(i + 1) / STEPS;
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
    turn_arch(shaper, soffit, 2, s->springing, 32);
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
    turn_arch(shaper, archivolt, sizeof archivolt / sizeof *archivolt, s->springing, 32);
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

/* A round medallion on the wall over a column. */
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
        shape_turn(shaper, &(shape_turning) { .profile = parts[i].profile,
                                              .point_count = parts[i].count,
                                              .origin = vec(-0.5f * BAY, y, WALL),
                                              .axis = 'z',
                                              .segments = 32 });
    }
}

/* A cornice along the bay whose top is at y, with dentils under it. */
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
    /* Longer than the bay by its own depth would cross at the corners: they are columns' width. */
    shaper->material = TRIM;
    shape_sweep(shaper, scaled, POINTS, vec(0.0f, y, 0.0f), -0.5f * BAY, 0.5f * BAY);
    for (int i = 0; i < DENTILS; i++) {
        const float x = BAY * (((float)i + 0.5f) / DENTILS - 0.5f);
        shape_box(shaper, vec(x - 0.05f, y - 0.31f * scale, WALL + 0.10f * scale),
                  vec(x + 0.05f, y - 0.20f * scale, WALL + 0.21f * scale));
    }
}

/* --- aisles -------------------------------------------------------------------------------------
 */

/* One of the four shells of a groin vault: t runs across the shell, s from its tip outwards. The
 * vault is the upper of two crossing half cylinders. */
static void put_groin_shell(scene_shaper *shaper, lmp_vec3 center, float half_x, float half_z,
                            float rise, int side) {
    enum { STEPS = 10 };
    lmp_vec3 points[2][STEPS + 1], normals[2][STEPS + 1];
    for (int i = 0; i <= STEPS; i++) {
        lmp_vec3 *out = points[i & 1], *out_normals = normals[i & 1];
        const lmp_vec3 *in = points[~i & 1], *in_normals = normals[~i & 1];
        const float s = (float)i / STEPS;
        for (int k = 0; k <= STEPS; k++) {
            const float t = s * (2.0f * (float)k / STEPS - 1.0f);
            const float height = sqrtf(fmaxf(0.0f, 1.0f - t * t));
            const float along = side & 1 ? -s : s, across = side & 1 ? -t : t;
            const bool turned = side & 2;
            out[k] = vec_add(center, vec(half_x * (turned ? -across : along), rise * height,
                                         half_z * (turned ? along : across)));
            out_normals[k] = vec(turned ? across / half_x : 0.0f, -height / rise,
                                 turned ? 0.0f : -across / half_z);
        }
        for (int k = 0; i > 0 && k < STEPS; k++) {
            const lmp_vec3 corners[4] = { in[k], out[k], out[k + 1], in[k + 1] };
            const lmp_vec3 corner_normals[4] = { in_normals[k], out_normals[k], out_normals[k + 1],
                                                 in_normals[k + 1] };
            shape_quad_smooth(shaper, corners, corner_normals);
        }
    }
}

static void put_groin_vault(scene_shaper *shaper, lmp_vec3 center, float half_x, float half_z,
                            float rise) {
    shaper->material = PLASTER;
    for (int side = 0; side < 4; side++)
        put_groin_shell(shaper, center, half_x, half_z, rise, side);
}

static float vault_rise(const storey_plan *s) {
    return s->top - s->springing - 0.25f;
}

/* The bay of an aisle behind the arcade: floor, vault, outer wall with a blind arch. */
static void put_aisle(scene_shaper *shaper, const storey_plan *s) {
    const float half = 0.5f * BAY, back = -AISLE;
    put_groin_vault(shaper, vec(0.0f, s->springing, 0.5f * (back - WALL)), half,
                    0.5f * (AISLE - WALL), vault_rise(s));
    shaper->material = LIMESTONE;
    shape_quad(shaper, vec(-half, s->floor, back), vec(half, s->floor, back),
               vec(half, s->top, back), vec(-half, s->top, back));
    shaper->material = DADO;
    shape_box(shaper, vec(-half, s->floor, back), vec(half, s->floor + 0.95f, back + 0.05f));
    shaper->material = TRIM;
    shape_box(shaper, vec(-half, s->floor + 0.95f, back),
              vec(half, s->floor + 1.05f, back + 0.09f));
    shape_box(shaper, vec(-half, s->floor, back), vec(half, s->floor + 0.14f, back + 0.08f));
    /* pilaster at the bay's edge */
    shape_box(shaper, vec(-half - 0.22f, s->floor, back),
              vec(-half + 0.22f, s->springing - 0.12f, back + 0.16f));
    shape_box(shaper, vec(-half - 0.28f, s->springing - 0.12f, back),
              vec(-half + 0.28f, s->springing, back + 0.22f));
    /* blind arch */
    const float r = 0.72f, y = s->springing - 0.55f, z = back + 0.02f;
    const shape_point disc[] = { { r, z }, { 0.0f, z } };
    const shape_point frame[] = { { r + 0.12f, back },
                                  { r + 0.12f, back + 0.07f },
                                  { r + 0.07f, back + 0.10f },
                                  { r, back + 0.07f },
                                  { r, back } };
    shaper->material = FRESCO;
    turn_arch(shaper, disc, 2, y, 32);
    shape_quad(shaper, vec(-r, s->floor + 1.05f, z), vec(r, s->floor + 1.05f, z), vec(r, y, z),
               vec(-r, y, z));
    shaper->material = TRIM;
    turn_arch(shaper, frame, 5, y, 32);
    for (int side = 0; side < 2; side++) {
        const float x = side ? r : -r - 0.12f;
        shape_box(shaper, vec(x, s->floor + 1.05f, back), vec(x + 0.12f, y, back + 0.08f));
    }
}

/* --- the court ----------------------------------------------------------------------------------
 */

static void put_bay(scene_shaper *shaper) {
    put_arch(shaper, &lower);
    put_arch(shaper, &upper);
    put_medallion(shaper, lower.springing + 1.0f);
    put_medallion(shaper, upper.springing + 1.05f);
    put_cornice(shaper, GALLERY + 0.02f, 0.75f);
    put_cornice(shaper, CORNICE + 0.02f, 1.0f);
    put_balustrade(shaper, GALLERY);
    put_aisle(shaper, &lower);
    put_aisle(shaper, &upper);
    shaper->material = TERRACOTTA;
    const float half = 0.5f * BAY;
    for (int storey = 0; storey < 2; storey++) {
        const float y = storey ? GALLERY : 0.0f;
        shape_quad(shaper, vec(-half, y, WALL), vec(half, y, WALL), vec(half, y, -AISLE),
                   vec(-half, y, -AISLE));
    }
    put_column(shaper, vec(-half, lower.floor, 0.0f), 0.27f, lower.springing - lower.floor, 20);
    put_column(shaper, vec(-half, upper.floor, 0.0f), 0.20f, upper.springing - upper.floor, 0);
}

/* Where two aisles meet, behind the left end of a side: origin at the court's corner. */
static void put_corner(scene_shaper *shaper) {
    static const storey_plan *const storeys[] = { &lower, &upper };
    const float half = 0.5f * AISLE;
    for (int i = 0; i < 2; i++) {
        const storey_plan *s = storeys[i];
        put_groin_vault(shaper, vec(-half, s->springing, -half), half, half, vault_rise(s));
        shaper->material = TERRACOTTA;
        shape_quad(shaper, vec(-AISLE, s->floor, 0.0f), vec(0.0f, s->floor, 0.0f),
                   vec(0.0f, s->floor, -AISLE), vec(-AISLE, s->floor, -AISLE));
        shaper->material = LIMESTONE;
        shape_quad(shaper, vec(-AISLE, s->floor, -AISLE), vec(0.0f, s->floor, -AISLE),
                   vec(0.0f, s->top, -AISLE), vec(-AISLE, s->top, -AISLE));
        shape_quad(shaper, vec(-AISLE, s->floor, 0.0f), vec(-AISLE, s->floor, -AISLE),
                   vec(-AISLE, s->top, -AISLE), vec(-AISLE, s->top, 0.0f));
    }
}

static void put_bays(court_plan *court) {
    scene_shaper *shaper = &court->shaper;
    for (int side = 0; side < 4; side++) {
        const bool end = side % 2 == 0;
        const int count = end ? BAYS_ACROSS : court->bays;
        for (int i = 0; i < count; i++) {
            const float along = BAY * ((float)i - 0.5f * (float)(count - 1));
            /* side 0 looks to +z from the far end, 1 to +x from the left, and so on round. */
            shaper->quarters = side;
            shaper->origin = side == 0   ? vec(along, 0.0f, -court->half_length)
                             : side == 1 ? vec(-HALF_WIDTH, 0.0f, along)
                             : side == 2 ? vec(along, 0.0f, court->half_length)
                                         : vec(HALF_WIDTH, 0.0f, along);
            put_bay(shaper);
        }
        shaper->origin = vec(side < 2 ? -HALF_WIDTH : HALF_WIDTH, 0.0f,
                             side == 1 || side == 2 ? court->half_length : -court->half_length);
        put_corner(shaper);
    }
    shaper->quarters = 0;
    shaper->origin = vec(0.0f, 0.0f, 0.0f);
}

/* Bevelled tiles in a checker with a border, every tile of its own gloss. */
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

/* The barrel vault: shell, transverse ribs over the columns and ribs along it make coffers. */
static void put_vault(court_plan *court) {
    scene_shaper *shaper = &court->shaper;
    const float r = HALF_WIDTH - 0.1f, length = court->half_length;
    enum { RIBS_ALONG = 9 };
    const shape_point shell[] = { { r, length }, { r, -length } };
    shaper->material = PLASTER;
    turn_arch(shaper, shell, 2, CORNICE, 64);
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
        turn_arch(shaper, rib, sizeof rib / sizeof *rib, CORNICE, 64);
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

/* Four bars from the hub, and a ring between each two. */
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
        shape_turn(shaper, &(shape_turning) { .profile = ring,
                                              .point_count = sizeof ring / sizeof *ring,
                                              .origin = vec_add(center, between),
                                              .axis = 'z',
                                              .segments = 32 });
    }
}

/* The half discs that close the vault, with a round window's frame and spokes. */
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
        turn_arch(shaper, wall, 2, CORNICE, 64);
        const lmp_vec3 center = vec(0.0f, CORNICE + 1.95f, 0.0f);
        const struct {
            const shape_point *profile;
            int count;
            uint32_t stone;
        } parts[] = { { ring, 7, TRIM }, { hub, 4, TRIM }, { glass, 2, FRESCO } };
        for (int i = 0; i < 3; i++) {
            shaper->material = parts[i].stone;
            shape_turn(shaper, &(shape_turning) { .profile = parts[i].profile,
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

/* --- lanterns -----------------------------------------------------------------------------------
 */

/* A round paper lantern: bamboo rings, two collars and a cord around a glowing sphere. */
static void put_lantern(court_plan *court, lmp_vec3 center, float radius, float ceiling) {
    scene_shaper *shaper = &court->shaper;
    const shape_point top[] = { { 0.36f * radius, 0.93f * radius },
                                { 0.36f * radius, 1.06f * radius },
                                { 0.28f * radius, 1.12f * radius },
                                { 0.06f * radius, 1.18f * radius } };
    const shape_point bottom[] = { { 0.0f, -1.24f * radius },
                                   { 0.06f * radius, -1.16f * radius },
                                   { 0.28f * radius, -1.10f * radius },
                                   { 0.34f * radius, -1.04f * radius },
                                   { 0.34f * radius, -0.94f * radius } };
    const shape_point cord[] = { { 0.010f, 1.1f * radius }, { 0.010f, ceiling - center.y } };
    shaper->material = BRONZE;
    turn(shaper, top, sizeof top / sizeof *top, center, 24);
    turn(shaper, bottom, sizeof bottom / sizeof *bottom, center, 24);
    turn(shaper, cord, 2, center, 6);
    enum { RINGS = 7 };
    for (int i = 0; i < RINGS; i++) {
        const float height = 0.78f * radius * (2.0f * (float)i / (RINGS - 1) - 1.0f);
        const float wide = 1.004f * sqrtf(radius * radius - height * height);
        const shape_point ring[] = { { wide, height - 0.009f * radius },
                                     { wide + 0.012f * radius, height },
                                     { wide, height + 0.009f * radius } };
        turn(shaper, ring, 3, center, 32);
    }
}

static void add_light(court_plan *court, lmp_vec3 center, float radius, float power,
                      float warm_fraction) {
    const lmp_rgb color = builtin_light_color(&court->random, warm_fraction);
    scene_light *light = builder_append(court->shaper.builder, BLOB_LIGHTS, 1);
    if (!light)
        return;
    light->emitter = (lmp_light) {
        .position = center,
        .radius = radius,
        .radiance = rgb_scale(color, lmp_sphere_radiance_from_power(power, radius)),
    };
}

/* One over the court: down its length, left, middle, right, at changing heights. */
static void hang_in_court(court_plan *court, int number, int count) {
    uint64_t *random = &court->random;
    const float t = ((float)number + 0.5f) / (float)count;
    const float z = (court->half_length - 1.5f) * (1.0f - 2.0f * t);
    const float x = (float)(number % 3 - 1) * 2.2f + random_between(random, -0.6f, 0.6f);
    const lmp_vec3 center =
        vec(x, random_between(random, 4.6f, 8.4f), z + random_between(random, -0.3f, 0.3f));
    const float radius = random_between(random, 0.24f, 0.38f), r = HALF_WIDTH - 0.1f;
    put_lantern(court, center, radius, CORNICE + sqrtf(r * r - x * x));
    add_light(court, center, radius, 230.0f, 0.85f);
}

/* One in a bay of an aisle, on either storey; neighbors come far apart. */
static void hang_in_aisle(court_plan *court, int number) {
    uint64_t *random = &court->random;
    const int slot = (int)(67u * (unsigned)number % (4u * (unsigned)court->bays));
    const storey_plan *s = slot & 1 ? &upper : &lower;
    const float side = slot & 2 ? 1.0f : -1.0f;
    const float z = BAY * ((float)(slot / 4) - 0.5f * (float)(court->bays - 1));
    const lmp_vec3 center = vec(side * (HALF_WIDTH + 1.6f + random_between(random, -0.2f, 0.2f)),
                                s->springing - random_between(random, 0.2f, 0.9f),
                                z + random_between(random, -0.3f, 0.3f));
    const float radius = random_between(random, 0.17f, 0.26f);
    put_lantern(court, center, radius, s->springing + vault_rise(s));
    add_light(court, center, radius, 190.0f, 0.25f);
}

static void hang_lanterns(court_plan *court, int count) {
    const int over_court = (2 * count + 4) / 5;
    for (int i = 0; i < over_court; i++)
        hang_in_court(court, i, over_court);
    for (int i = over_court; i < count; i++)
        hang_in_aisle(court, i - over_court);
}

void builtin_atrium(const builtin_parameters *parameters, scene_builder *builder) {
    court_plan court = { .shaper = { .builder = builder },
                         .bays = BAYS_LONG * parameters->tiles,
                         .random = parameters->seed };
    court.half_length = 0.5f * BAY * (float)court.bays;
    add_materials(builder);
    put_bays(&court);
    put_floor(&court);
    put_vault(&court);
    put_lunettes(&court);
    hang_lanterns(&court, parameters->lanterns);
    shaper_finish(&court.shaper);
    scene_camera *camera = builder_append(builder, BLOB_CAMERAS, 1);
    if (!camera)
        return;
    builder_name(camera->name, "down the court");
    vec_store(vec(-1.1f, 2.3f, court.half_length - 1.4f), camera->eye);
    vec_store(vec(0.35f, 3.9f, court.half_length - 16.0f), camera->target);
    camera->up[1] = 1.0f;
    camera->fov = 0.92f;
    camera->aspect = 1.6f;
}
