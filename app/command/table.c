/* SPDX-License-Identifier: MIT */
#include "app/command/command.h"

#include <lampion/sh.h>

extern const cli_command command_basis;
extern const cli_command command_bench;
extern const cli_command command_brdf;
extern const cli_command command_compare;
extern const cli_command command_doctor;
extern const cli_command command_info;
extern const cli_command command_paper;
extern const cli_command command_project;
extern const cli_command command_reference;
extern const cli_command command_render;

const cli_command *const command_table[] = {
    &command_render,  &command_info,  &command_project,
    &command_brdf,    &command_basis, &command_reference,
    &command_compare, &command_paper, &command_bench,
    &command_doctor,  NULL,
};

const char *const command_windows[] = {
    [LMP_WINDOW_NONE] = "none",
    [LMP_WINDOW_HANNING] = "hanning",
    [LMP_WINDOW_LANCZOS] = "lanczos",
    NULL,
};
