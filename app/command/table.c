/* SPDX-License-Identifier: MIT */
#include "app/command/command.h"

const cli_command *const command_table[] = { NULL };
