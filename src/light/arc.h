/* SPDX-License-Identifier: MIT */
/* arc.h - arcs of circles in space, as seen from the origin, and the nodes by which functions are
 * integrated along them. */
#ifndef LAMPION_LIGHT_ARC_H
#define LAMPION_LIGHT_ARC_H

#include "src/light/angle.h"
#include "src/light/vector.h"

#include <stdbool.h>

/* The points center + (1-t²)/(1+t²) middle + 2t/(1+t²) side for -end <= t <= end, seen from the
 * origin; middle and side are perpendicular and equally long. `end` is the tangent of a quarter of
 * the arc, at most 1. A straight edge has its ends, of any length, its pole, middle x side, and its
 * angle; once closed also center 0, unit vectors, and the cosine and sine of half the angle. */
typedef struct lmpi_arc {
    lmpi_vector center, middle, side;
    double end;
    bool straight;
    lmpi_vector from, to, pole;
    double across, along; /* the length of from x to, and from · to */
    double angle, cosine, sine;
} lmpi_arc;

/* Returns the point at t. */
lmpi_vector lmpi_arc_at(const lmpi_arc *arc, double t);

enum { LMPI_ARC_PAIRS = 8 };

/* Gauss-Legendre nodes of a part of an arc, by pairs: their directions w, g = w x dw, of which the
 * integral is the sum, and 1 over their distances. */
typedef struct lmpi_arc_nodes {
    int pairs;
    lmpi_pair w[3][LMPI_ARC_PAIRS], g[3][LMPI_ARC_PAIRS], near[LMPI_ARC_PAIRS];
} lmpi_arc_nodes;

/* Hands over the nodes of low <= t <= high, in parts that a rule integrates for `bands` bands. */
typedef void lmpi_arc_nodes_user(const lmpi_arc_nodes *nodes, void *user);
void lmpi_arc_visit(const lmpi_arc *arc, double low, double high, int bands,
                    lmpi_arc_nodes_user *use, void *user);

#endif
