/* SPDX-License-Identifier: MIT */
/* info.h - the part of lampion info for fields. */
#ifndef LAMPION_COMMAND_INFO_H
#define LAMPION_COMMAND_INFO_H

#include "app/command/command.h"

/* info_is_field tells by its name whether a file is a field; info_print_field prints its contents
 * and returns the exit status. */
bool info_is_field(const char *path);
int info_print_field(const char *path, bool json);

#endif
