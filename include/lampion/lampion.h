/* SPDX-License-Identifier: MIT */
/* lampion/lampion.h - the whole library; each header includes those that it builds on:
 *
 *   base.h           version, results, vectors, strides, the host's hooks
 *   sh.h             spherical harmonics: basis, rotation, windows, projection, products
 *   sphere.h         spheres of light, and their projection
 *   light.h          lights of every kind
 *   lobe.h           lobes around an axis, and their responses to lights
 *   probe.h          probes: irradiance, fitting, the conventions of other software
 *   brdf.h           measured and parametric BRDFs, their files and tables
 *   preintegrated.h  lobes and BRDFs integrated over caps in advance
 *   material.h       what surfaces are made of
 *   shade.h          the light that surfaces reflect: where most programs begin
 *   field.h          thousands of lights on a grid
 *   transfer.h       light that bounces between surfaces
 *   cpu.h            instruction sets */
#ifndef LAMPION_LAMPION_H
#define LAMPION_LAMPION_H

#include <lampion/base.h>
#include <lampion/brdf.h>
#include <lampion/cpu.h>
#include <lampion/field.h>
#include <lampion/light.h>
#include <lampion/lobe.h>
#include <lampion/material.h>
#include <lampion/preintegrated.h>
#include <lampion/probe.h>
#include <lampion/sh.h>
#include <lampion/shade.h>
#include <lampion/sphere.h>
#include <lampion/transfer.h>

#endif
