/* SPDX-License-Identifier: MIT */
/* shares.h - which lights make what is under the pointer (docs/aiming.md): each light's share of
 * the radiance there, by the sums that shade it. */
#ifndef LAMPION_VIEW_SHARES_H
#define LAMPION_VIEW_SHARES_H

#include "app/view/compositor.h"

/* What one light, or another source, gives. */
typedef struct view_share {
    int light;        /* its number, or -1 */
    const char *name; /* of its kind, or "environment", "bounces", "emission" */
    lmp_rgb radiance; /* below 0 in a channel where its truncated series rings */
    double percent;   /* of the luminance of all */
} view_share;

/* The shares of a pixel, the largest first, without those that give nothing; zero: none were asked
 * for. Free with view_shares_free. */
typedef struct view_shares {
    int x, y, side;
    lmp_rgb radiance; /* the sum; what is shown is 0 where it is negative */
    view_share *of;
    size_t count; /* 0: there is no surface */
} view_shares;

/* Finds the shares of a pixel of a side, and frees those in *shares. */
bool view_shares_find(view_compositor *compositor, const view_settings *settings, int side, int x,
                      int y, view_shares *shares, base_error *error);
void view_shares_free(view_shares *shares);

/* Writes the largest shares as a message. */
void view_shares_describe(const view_shares *shares, char *text, size_t size);

struct json_t;
struct json_t *view_shares_to_json(const view_shares *shares);

#endif
