/* SPDX-License-Identifier: MIT */
/* angle.h - acos(1 - y) = sqrt(y) LMP_ANGLE(1 - y) for y in 0 … 1, to 3e-8, and relatively as exact
 * for small y (Abramowitz and Stegun 4.4.46); of floats and of lanes. */
#ifndef LAMPION_KERNELS_ANGLE_H
#define LAMPION_KERNELS_ANGLE_H

#define LMP_ANGLE(x)                                                                               \
    (((((((-0.0012624911f * (x) + 0.0066700901f) * (x)-0.0170881256f) * (x) + 0.0308918810f) *     \
        (x)-0.0501743046f) *                                                                       \
           (x) +                                                                                   \
       0.0889789874f) *                                                                            \
      (x)-0.2145988016f) *                                                                         \
         (x) +                                                                                     \
     1.5707963050f)

#endif
