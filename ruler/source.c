/* SPDX-License-Identifier: MIT */
#include "ruler/source.h"

#define P RULER_PRECISION

static ruler_source *add(ruler_source *parts, int *count, bool single) {
    ruler_source *const part = &parts[(*count)++];
    ruler_angle_init(&part->angle);
    ruler_angle_set(&part->angle, 0);
    arb_init(part->strength);
    arb_one(part->strength);
    part->single = single;
    return part;
}

void ruler_source_clear(ruler_source *source) {
    ruler_angle_clear(&source->angle);
    arb_clear(source->strength);
}

/* Sets asin(r/d); a sphere that is touched covers a hemisphere, and from inside it is everywhere.
 */
static void set_sphere(ruler_angle *angle, int size) {
    if (size >= 1000) {
        ruler_angle_set(angle, size == 1000 ? 9000 : 18000);
        return;
    }
    angle->exact = false;
    arb_set_si(angle->radians, size);
    arb_div_si(angle->radians, angle->radians, 1000, P);
    arb_asin(angle->radians, angle->radians, P);
}

/* Computes saturate((cos angle - cos outer)/(cos inner - cos outer))². */
static void set_falloff(arb_t strength, int thousandths) {
    ruler_angle angle, inner, outer;
    ruler_angle *const all[] = { &angle, &inner, &outer };
    const int hundredths[] = { thousandths / 10, 100 * RULER_SPOT_INNER_DEGREES,
                               100 * RULER_SPOT_OUTER_DEGREES };
    for (int k = 0; k < 3; k++) {
        ruler_angle_init(all[k]);
        ruler_angle_set(all[k], hundredths[k]);
        arb_cos(all[k]->radians, all[k]->radians, P);
    }
    if (hundredths[0] >= hundredths[2]) {
        arb_zero(strength);
    } else if (hundredths[0] > hundredths[1]) {
        arb_sub(angle.radians, angle.radians, outer.radians, P);
        arb_sub(inner.radians, inner.radians, outer.radians, P);
        arb_div(strength, angle.radians, inner.radians, P);
        arb_sqr(strength, strength, P);
    }
    for (int k = 0; k < 3; k++)
        ruler_angle_clear(all[k]);
}

int ruler_sources(const ruler_configuration *configuration, ruler_source parts[RULER_SOURCES]) {
    int count = 0;
    ruler_source *const first = add(parts, &count, configuration->light >= RULER_POINT);
    switch (configuration->light) {
    case RULER_SPHERE:
        set_sphere(&first->angle, configuration->size);
        break;
    case RULER_SUN:
        ruler_angle_set(&first->angle, configuration->size / 10);
        break;
    case RULER_SPOT:
        set_falloff(first->strength, configuration->size);
        break;
    case RULER_HEMISPHERE: {
        ruler_angle_set(&first->angle, 9000);
        ruler_source *const ground = add(parts, &count, false);
        ruler_angle_set(&ground->angle, 18000);
        arb_set_si(ground->strength, RULER_GROUND_HUNDREDTHS);
        arb_div_si(ground->strength, ground->strength, 100, P);
        arb_sub(first->strength, first->strength, ground->strength, P);
        break;
    }
    default:
        break;
    }
    return count;
}

void ruler_pole_init(ruler_pole *pole) {
    ruler_angle_init(&pole->light);
}

void ruler_pole_clear(ruler_pole *pole) {
    ruler_angle_clear(&pole->light);
}

/* Computes the angle between light and mirror direction, by sin²(g/2) = sin²((t - v)/2) + sin t sin
 * v sin²(phi/2), where nothing cancels. */
static void set_between(ruler_angle *between, const ruler_configuration *c) {
    ruler_angle t, v, phi;
    ruler_angle *const all[] = { &t, &v, &phi };
    const int hundredths[] = { c->light_angle, c->view_angle, c->light_azimuth };
    for (int k = 0; k < 3; k++) {
        ruler_angle_init(all[k]);
        ruler_angle_set(all[k], hundredths[k]);
    }
    arb_sub(between->radians, t.radians, v.radians, P);
    arb_mul_2exp_si(between->radians, between->radians, -1);
    arb_sin(between->radians, between->radians, P);
    arb_sqr(between->radians, between->radians, P);
    arb_mul_2exp_si(phi.radians, phi.radians, -1);
    for (int k = 0; k < 3; k++)
        arb_sin(all[k]->radians, all[k]->radians, P);
    arb_sqr(phi.radians, phi.radians, P);
    arb_mul(phi.radians, phi.radians, t.radians, P);
    arb_addmul(between->radians, phi.radians, v.radians, P);
    arb_sqrt(between->radians, between->radians, P);
    arb_asin(between->radians, between->radians, P);
    arb_mul_2exp_si(between->radians, between->radians, 1);
    between->exact = false;
    for (int k = 0; k < 3; k++)
        ruler_angle_clear(all[k]);
}

void ruler_pole_set(ruler_pole *pole, const ruler_configuration *c) {
    if (c->material != RULER_PHONG)
        ruler_angle_set(&pole->light, c->light_angle);
    else if (c->light_azimuth == 0 || c->light_angle == 0 || c->view_angle == 0)
        ruler_angle_set(&pole->light, c->light_angle > c->view_angle
                                          ? c->light_angle - c->view_angle
                                          : c->view_angle - c->light_angle);
    else
        set_between(&pole->light, c);
}
