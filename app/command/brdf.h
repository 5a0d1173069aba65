/* SPDX-License-Identifier: MIT */
/* brdf.h - what the files of `lampion brdf` share. */
#ifndef LAMPION_COMMAND_BRDF_H
#define LAMPION_COMMAND_BRDF_H

#include "app/command/command.h"
#include "app/scene/material.h"

typedef struct brdf_options {
    const char *output;
    int size[2];
    bool bands_given, views_given, preintegrated;
    lmp_brdf_table_desc table;
} brdf_options;

/* Plots the lobes in the plane of incidence in polar form, a row per view: f_r cos theta_i itself,
 * then its series at several numbers of bands. */
bool brdf_plot(const brdf_options *options, const material *material, base_error *error);

#endif
