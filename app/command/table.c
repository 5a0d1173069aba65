/* SPDX-License-Identifier: MIT */
#include "app/base/cli.h"
#include "app/command/command.h"

extern const cli_command command_basis;
extern const cli_command command_bench;
extern const cli_command command_brdf;
extern const cli_command command_compare;
extern const cli_command command_completion;
extern const cli_command command_doctor;
extern const cli_command command_field;
extern const cli_command command_info;
extern const cli_command command_man;
extern const cli_command command_merge;
extern const cli_command command_paper;
extern const cli_command command_project;
extern const cli_command command_reference;
extern const cli_command command_render;
extern const cli_command command_ruler;
extern const cli_command command_scoreboard;
extern const cli_command command_view;

const cli_command *const command_table[] = {
    &command_render,  &command_view,       &command_info,
    &command_project, &command_brdf,       &command_field,
    &command_basis,   &command_reference,  &command_merge,
    &command_compare, &command_ruler,      &command_scoreboard,
    &command_paper,   &command_bench,      &command_doctor,
    &command_man,     &command_completion, NULL,
};

const char command_program_summary[] =
    "lights scenes with glowing spheres through spherical harmonics";
