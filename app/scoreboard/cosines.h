/* SPDX-License-Identifier: MIT */
/* cosines.h - glTF's GGX as linearly transformed cosines, fitted by generate/cosines.c. */
#ifndef LAMPION_SCOREBOARD_COSINES_H
#define LAMPION_SCOREBOARD_COSINES_H

/* Row i is roughness i / (COSINES_SIZE - 1), column j the view of cosine 1 - (j / (COSINES_SIZE -
 * 1))². Of a node: four members of the inverse matrix whose middle one is 1,
 *
 *     a 0 b
 *     0 1 0    in a frame of x toward the viewer's side and z the normal,
 *     c 0 d
 *
 * then the integrals of D V cos and of the same times (1 - v·h)^5. */
#define COSINES_SIZE    32
#define COSINES_MEMBERS 6
extern const float cosines_table[COSINES_SIZE][COSINES_SIZE][COSINES_MEMBERS];

/* The irradiance over pi of a disk of directions around `axis` once `rows`, the inverse matrix B of
 * the form above, have made it an ellipse, clipped by the horizon. */
typedef double cosines_vector[3];
float cosines_over_disk(cosines_vector rows[3], const cosines_vector axis, double sin2);

#endif
