/* SPDX-License-Identifier: MIT */
/* atrium_bay.c - one bay of a wall, in a frame whose x runs along the wall and whose z points into
 * the court; on all four sides, and the corners between. */
#include "app/scene/builtin/atrium.h"

#include "app/scene/vector.h"

#include <math.h>

/* Adds one of the four shells of a groin vault: t runs across the shell, s from its tip outwards.
 * The vault is the upper of two crossing half cylinders. */
static void put_groin_shell(scene_shaper *shaper, lmp_vec3 center, float half_x, float half_z,
                            float rise, int side) {
    enum { STEPS_MAX = 10 };
    const int steps = shaper_steps(shaper, STEPS_MAX);
    lmp_vec3 points[2][STEPS_MAX + 1], normals[2][STEPS_MAX + 1];
    for (int i = 0; i <= steps; i++) {
        lmp_vec3 *out = points[i & 1], *out_normals = normals[i & 1];
        const lmp_vec3 *in = points[~i & 1], *in_normals = normals[~i & 1];
        const float s = (float)i / (float)steps;
        for (int k = 0; k <= steps; k++) {
            const float t = s * (2.0f * (float)k / (float)steps - 1.0f);
            const float height = sqrtf(fmaxf(0.0f, 1.0f - t * t));
            const float along = side & 1 ? -s : s, across = side & 1 ? -t : t;
            const bool rotated = side & 2;
            out[k] = vec_add(center, vec(half_x * (rotated ? -across : along), rise * height,
                                         half_z * (rotated ? along : across)));
            out_normals[k] = vec(rotated ? across / half_x : 0.0f, -height / rise,
                                 rotated ? 0.0f : -across / half_z);
        }
        for (int k = 0; i > 0 && k < steps; k++) {
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

float atrium_vault_rise(const storey_plan *s) {
    return s->top - s->springing - 0.25f;
}

/* Adds the bay of an aisle behind the arcade: floor, vault, outer wall with a blind arch. */
static void put_aisle(scene_shaper *shaper, const storey_plan *s) {
    const float half = 0.5f * BAY, back = -AISLE;
    put_groin_vault(shaper, vec(0.0f, s->springing, 0.5f * (back - WALL)), half,
                    0.5f * (AISLE - WALL), atrium_vault_rise(s));
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
    atrium_revolve_arch(shaper, disc, 2, y, 32);
    shape_quad(shaper, vec(-r, s->floor + 1.05f, z), vec(r, s->floor + 1.05f, z), vec(r, y, z),
               vec(-r, y, z));
    shaper->material = TRIM;
    atrium_revolve_arch(shaper, frame, 5, y, 32);
    for (int side = 0; side < 2; side++) {
        const float x = side ? r : -r - 0.12f;
        shape_box(shaper, vec(x, s->floor + 1.05f, back), vec(x + 0.12f, y, back + 0.08f));
    }
}

static void put_bay(scene_shaper *shaper) {
    atrium_put_arcade(shaper);
    put_aisle(shaper, &atrium_lower);
    put_aisle(shaper, &atrium_upper);
    shaper->material = TERRACOTTA;
    const float half = 0.5f * BAY;
    for (int storey = 0; storey < 2; storey++) {
        const float y = storey ? GALLERY : 0.0f;
        shape_quad(shaper, vec(-half, y, WALL), vec(half, y, WALL), vec(half, y, -AISLE),
                   vec(-half, y, -AISLE));
    }
    atrium_put_column(shaper, vec(-half, atrium_lower.floor, 0.0f), 0.27f,
                      atrium_lower.springing - atrium_lower.floor, 20);
    atrium_put_column(shaper, vec(-half, atrium_upper.floor, 0.0f), 0.20f,
                      atrium_upper.springing - atrium_upper.floor, 0);
}

/* Adds the corner where two aisles meet, behind the left end of a side: origin at the court's
 * corner. */
static void put_corner(scene_shaper *shaper) {
    static const storey_plan *const storeys[] = { &atrium_lower, &atrium_upper };
    const float half = 0.5f * AISLE;
    for (int i = 0; i < 2; i++) {
        const storey_plan *s = storeys[i];
        put_groin_vault(shaper, vec(-half, s->springing, -half), half, half, atrium_vault_rise(s));
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

void atrium_put_bays(court_plan *court) {
    scene_shaper *shaper = &court->shaper;
    for (int side = 0; side < 4; side++) {
        const bool end = side % 2 == 0;
        const int count = end ? BAYS_ACROSS : court->bays;
        for (int i = 0; i < count; i++) {
            const float along = BAY * ((float)i - 0.5f * (float)(count - 1));
            /* side 0 looks to +z from the far end, 1 to +x from the left, and so on. */
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
