/* SPDX-License-Identifier: MIT */
/* scoreboard_cosines.h - a disk of directions over a linearly transformed cosine. */
#ifndef LAMPION_TRUTH_SCOREBOARD_COSINES_H
#define LAMPION_TRUTH_SCOREBOARD_COSINES_H

/* Returns the irradiance over pi of a disk of directions around `axis`, which `rows`, the inverse
 * matrix B of the form in cosines_table.h, turn into an ellipse, clipped by the horizon. */
typedef double cosines_vector[3];
float cosines_over_disk(cosines_vector rows[3], const cosines_vector axis, double sin2);

#endif
