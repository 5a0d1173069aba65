/* SPDX-License-Identifier: MIT */
/* info.h - what lampion info tells of a field. */
#ifndef LAMPION_COMMAND_INFO_H
#define LAMPION_COMMAND_INFO_H

#include "app/command/command.h"

/* Whether a file is one, by its name; and what is in it. Returns the exit status. */
bool info_is_field(const char *path);
int info_print_field(const char *path, bool json);

#endif
