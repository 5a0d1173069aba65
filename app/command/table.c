/* SPDX-License-Identifier: MIT */
#include "app/command/command.h"

extern const cli_command command_project;

const cli_command *const command_table[] = { &command_project, NULL };
