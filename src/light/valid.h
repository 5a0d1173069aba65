/* SPDX-License-Identifier: MIT */
/* valid.h - which members a light's kind names, and the values they may have (lampion/light.h). */
#ifndef LAMPION_LIGHT_VALID_H
#define LAMPION_LIGHT_VALID_H

#include <lampion/light.h>

/* Whether the members that the light's kind names are in their ranges. */
bool lmpi_is_light(const lmp_light *light);
bool lmpi_are_lights(const lmp_light *lights, size_t count);

#endif
