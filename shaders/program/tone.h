/* SPDX-License-Identifier: MIT */
/* tone.h - tone curves, for C and GLSL: what a channel (0 red, 1 green, 2 blue) of exposed
 * radiance, 0 … SHARED_TONE_MAX each, becomes in linear sRGB (clamp it to 0 … 1). Each is a
 * function here and a row in app/image/tone.c. */
#ifndef LAMPION_TONE_CURVES_H
#define LAMPION_TONE_CURVES_H

#ifdef LAMPION_SHADER
#define TONE_FUNCTION
#else
#define TONE_FUNCTION static inline
#endif

#define SHARED_TONE_MAX 65504.0f

/* --- filmic ----------------------------------------------------------------------------------- */

/* Stephen Hill's fit of ACES' reference and sRGB output transforms (BakingLab, 2016), scaled so
 * that middle gray stays 0.18. A channel follows the curve by itself, which makes bright colors
 * white as film does, but for a part FILMIC_HUE that keeps its fraction of the brightest channel.
 * Past what surfaces show that part grows to FILMIC_LAMP: a lamp shows its color however bright it
 * is. */
#define FILMIC_SCALE 1.4627f
#define FILMIC_HUE   0.4f
#define FILMIC_LAMP  0.85f
#define FILMIC_PAST  2.0f /* the level from which it grows; half of it is there at 4 times that */

/* Convert to the working primaries, along the curve (given a channel and the largest of the three),
 * and back. */
TONE_FUNCTION float filmic_in(int row, float r, float g, float b) {
    return FILMIC_SCALE * (row == 0   ? 0.59719f * r + 0.35458f * g + 0.04823f * b
                           : row == 1 ? 0.07600f * r + 0.90834f * g + 0.01566f * b
                                      : 0.02840f * r + 0.13383f * g + 0.83777f * b);
}

TONE_FUNCTION float filmic_curve(float x) {
    return (x * (x + 0.0245786f) - 0.000090537f) / (x * (0.983729f * x + 0.4329510f) + 0.238081f);
}

TONE_FUNCTION float filmic_channel(float x, float peak) {
    float past = peak > FILMIC_PAST ? peak - FILMIC_PAST : 0.0f;
    float hue = FILMIC_HUE + (FILMIC_LAMP - FILMIC_HUE) * (past / (past + 3.0f * FILMIC_PAST));
    return (1.0f - hue) * filmic_curve(x) +
           (peak > 0.0f ? hue * filmic_curve(peak) * (x / peak) : 0.0f);
}

TONE_FUNCTION float filmic_out(int row, float r, float g, float b) {
    return row == 0   ? 1.60475f * r - 0.53108f * g - 0.07367f * b
           : row == 1 ? -0.10208f * r + 1.10813f * g - 0.00605f * b
                      : -0.00327f * r - 0.07276f * g + 1.07602f * b;
}

TONE_FUNCTION float tone_filmic(int channel, float r, float g, float b) {
    float x = filmic_in(0, r, g, b), y = filmic_in(1, r, g, b), z = filmic_in(2, r, g, b);
    float larger = x > y ? x : y;
    float peak = larger > z ? larger : z;
    return filmic_out(channel, filmic_channel(x, peak), filmic_channel(y, peak),
                      filmic_channel(z, peak));
}

/* --- linear ----------------------------------------------------------------------------------- */

TONE_FUNCTION float tone_linear(int channel, float r, float g, float b) {
    return channel == 0 ? r : channel == 1 ? g : b;
}

#endif
