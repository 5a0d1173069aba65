/* SPDX-License-Identifier: MIT */
#include "app/image/figure.h"
#include "app/study/paper.h"

#include <lampion/light.h>

#include <math.h>

enum { BANDS = 6, CELL = 300, KINDS = 5 };

/* Five lights as one point sees them, all but the last from the same direction. */
static const struct {
    const char *name;
    lmp_light light;
} lights[KINDS] = {
    { "point", { .kind = LMP_LIGHT_POINT, .position = { 1, 0, 1 }, .intensity = { 2, 2, 2 } } },
    { "spot",
      { .kind = LMP_LIGHT_SPOT,
        .position = { 1, 0, 1 },
        .direction = { -0.70710678f, 0, -0.70710678f },
        .inner = 0.3f,
        .outer = 0.6f,
        .intensity = { 2, 2, 2 } } },
    { "directional",
      { .kind = LMP_LIGHT_DIRECTIONAL,
        .direction = { 0.70710678f, 0, 0.70710678f },
        .irradiance = { 1, 1, 1 } } },
    { "sphere",
      { .kind = LMP_LIGHT_SPHERE,
        .position = { 1, 0, 1 },
        .radius = 0.7f,
        .radiance = { 1, 1, 1 } } },
    { "hemisphere",
      { .kind = LMP_LIGHT_HEMISPHERE, .direction = { 0, 0, 1 }, .radiance = { 1, 1, 1 } } },
};

typedef struct series {
    float sh[3 * LMP_SH_COUNT(BANDS)];
    float scale;
} series;

static float value(lmp_vec3 direction, const void *user) {
    const series *s = user;
    return s->scale * lmp_sh_reconstruct(BANDS, s->sh, direction);
}

static float peak(const series *s) {
    float largest = 0;
    for (int i = 0; i < 200; i++)
        for (int k = 0; k < 200; k++) {
            const float theta = (float)M_PI * (float)i / 199,
                        phi = 2 * (float)M_PI * (float)k / 200;
            const lmp_vec3 d = { sinf(theta) * cosf(phi), sinf(theta) * sinf(phi), cosf(theta) };
            largest = fmaxf(largest, fabsf(value(d, s)));
        }
    return largest;
}

static bool draw(image *pixels, base_error *error) {
    figure_fill(pixels, (figure_box) { 0, 0, KINDS * CELL, CELL }, (lmp_rgb) { 1, 1, 1 });
    for (int i = 0; i < KINDS; i++) {
        series s = { .scale = 1 };
        lmp_light_project(BANDS, &lights[i].light, 1, (lmp_vec3) { 0, 0, 0 }, s.sh);
        s.scale = 1 / (1.02f * peak(&s));
        const figure_lobe lobe = { value, &s, { 0.72f, 0.045f, 0.035f }, { 0.05f, 0.4f, 0.075f } };
        if (!figure_draw_lobe(pixels, (figure_box) { i * CELL, 0, CELL, CELL }, &lobe, error))
            return false;
    }
    return true;
}

/* Returns the largest relative difference of a Dirac's coefficients from strength times Y_lm. */
static double dirac_error(const lmp_light *light, float strength) {
    float sh[3 * LMP_SH_COUNT(BANDS)], y[LMP_SH_COUNT(BANDS)];
    double worst = 0, largest = 0;
    lmp_light_project(BANDS, light, 1, (lmp_vec3) { 0, 0, 0 }, sh);
    lmp_sh_eval(BANDS, (lmp_vec3) { 0.70710678f, 0, 0.70710678f }, y);
    for (size_t i = 0; i < LMP_SH_COUNT(BANDS); i++) {
        worst = fmax(worst, fabs((double)sh[i] - (double)strength * (double)y[i]));
        largest = fmax(largest, fabs((double)strength * (double)y[i]));
    }
    return worst / largest;
}

bool paper_step_lights(paper *p, base_error *error) {
    image pixels;
    if (!image_create(&pixels, KINDS * CELL, CELL, error))
        return false;
    const bool ok = draw(&pixels, error) && image_write_figure(&pixels, "figure3.png", error);
    image_free(&pixels);
    if (!ok)
        return false;
    page_image(&p->page, "figure3.png",
               "Incoming radiance of a point, a spot, a directional, a sphere and a hemisphere "
               "light, rebuilt from 6 bands; each scaled to its peak. The first three are the "
               "paper's: a Dirac each, so their shape is the same.");
    page_text(&p->page,
              "Diracs project to the basis itself, scaled: the coefficients of the point, spot and "
              "directional light equal strength × Y<sub>lm</sub> within %.1e, %.1e and %.1e.",
              dirac_error(&lights[0].light, 1), dirac_error(&lights[1].light, 1),
              dirac_error(&lights[2].light, 1));
    return true;
}
