/* SPDX-License-Identifier: MIT */
/* caps.h - what caps of radiance 1 give by GGX and by Phong lobes, for the generator of the lobes.
 */
#ifndef LAMPION_LOBE_GENERATE_CAPS_H
#define LAMPION_LOBE_GENERATE_CAPS_H

/* Prepares the quadratures. Call it before all else. */
void caps_start(void);

/* glTF's specular BRDF seen from (-sine, 0, z). masking: sqrt(alpha² + (1 - alpha²) z²). */
typedef struct ggx_view {
    double alpha, z, sine, masking;
} ggx_view;

/* Integrate f_r cos over the cap of half angle a around (sin t cos p, sin t sin p, cos t), and over
 * the whole sky. value receives the integral with Fresnel's factor 1 - (1 - v·h)^5, the one with (1
 * - v·h)^5, and the latter factor applied to what a white diffuse surface reflects. */
void caps_ggx(const ggx_view *view, double t, double p, double a, double value[3]);
void caps_ggx_sky(const ggx_view *view, double value[3]);

/* Returns the integral of cosine / pi over a cap at angle t from the normal. */
double caps_cosine(double t, double a);

/* Returns ∫ (1 - v·h)^5 cos / pi over the sky: what a diffuse surface loses of F90 - F0. */
double caps_diffuse(double z);

/* What Phong lobes (e+1)/(2 pi) max(t, 0)^e of one alpha give over a cap of one half angle, as a
 * table. Exponents are given by the log of their spread, 1 / (e alpha²). */
#define CAPS_SPREAD_LOG_MIN (-5.0)
#define CAPS_SPREAD_LOG_MAX 6.0
enum { CAPS_ANGLES = 256, CAPS_SPREADS = 48 };
typedef struct caps_table {
    double angle_max, value[CAPS_ANGLES][CAPS_SPREADS];
} caps_table;
void caps_table_fill(caps_table *table, double alpha, double a);

/* Evaluates the table at an angle between axis and cap. result receives the value, and its
 * derivatives by the angle and by the log of the spread. */
void caps_table_at(const caps_table *table, double angle, double spread_log, double result[3]);

#endif
