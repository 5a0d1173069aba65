/* SPDX-License-Identifier: MIT */
/* lampion/lampion.h - the whole library. */
#ifndef LAMPION_LAMPION_H
#define LAMPION_LAMPION_H

#include <lampion/base.h>
#include <lampion/brdf.h>
#include <lampion/cpu.h>
#include <lampion/light.h>
#include <lampion/lobe.h>
#include <lampion/preintegrated.h>
#include <lampion/probe.h>
#include <lampion/sh.h>
#include <lampion/shade.h>

#endif
