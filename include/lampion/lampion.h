/* SPDX-License-Identifier: MIT */
/* lampion/lampion.h - the whole library, each header with all that it builds on:
 *
 *   base.h           version, results, vectors, strides, what the library asks of its host
 *   sh.h             spherical harmonics: basis, rotation, windows, projection, products
 *   light.h          lights of every kind, and their projection
 *   lobe.h           lobes around an axis, and their responses to lights
 *   probe.h          probes: irradiance, fitting, conventions of other software
 *   brdf.h           measured and parametric BRDFs, their files and tables
 *   preintegrated.h  lobes and BRDFs integrated beforehand
 *   shade.h          the light that surfaces reflect: where most programs begin
 *   field.h          thousands of lights on a grid
 *   cpu.h            instruction sets */
#ifndef LAMPION_LAMPION_H
#define LAMPION_LAMPION_H

#include <lampion/base.h>
#include <lampion/brdf.h>
#include <lampion/cpu.h>
#include <lampion/field.h>
#include <lampion/light.h>
#include <lampion/lobe.h>
#include <lampion/preintegrated.h>
#include <lampion/probe.h>
#include <lampion/sh.h>
#include <lampion/shade.h>

#endif
