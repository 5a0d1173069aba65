/* SPDX-License-Identifier: MIT */
/* angle.h - angles in double, alike on every machine. */
#ifndef LAMPION_LIGHT_ANGLE_H
#define LAMPION_LIGHT_ANGLE_H

/* Two numbers, computed at once. */
typedef double lmpi_pair __attribute__((vector_size(16)));

/* Returns the angle of the direction (x, y), -pi … pi, or 0 for (0, 0). */
double lmpi_angle(double y, double x);

/* The angles of two directions, in less time than one after the other. */
lmpi_pair lmpi_angles(lmpi_pair y, lmpi_pair x);

#endif
