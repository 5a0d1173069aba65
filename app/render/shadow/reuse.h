/* SPDX-License-Identifier: MIT */
/* reuse.h - shadows of one sample of a pixel for another, less than a pixel beside it. */
#ifndef LAMPION_SHADOW_REUSE_H
#define LAMPION_SHADOW_REUSE_H

#include "app/render/frame/surfaces.h"
#include "app/render/shadow/planes.h"

/* Multiplies a row's radiance by what filtered planes say of their pixels on the same surface. */
void shadow_reuse_row(const shadow_planes *planes, const render_tile *row, int y, float *rgba);

#endif
