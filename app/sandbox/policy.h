/* SPDX-License-Identifier: MIT */
/* policy.h - what a process gives up for ever. */
#ifndef LAMPION_SANDBOX_POLICY_H
#define LAMPION_SANDBOX_POLICY_H

#include "app/cli/cli.h"

/* Leaves this process its memory, its open descriptors, messages on them and its end: no
 * capability, file, process, connection or other device. False if the kernel does not hold it to
 * that; then do nothing for anyone else. */
bool policy_enter(cli_error *error);

#endif
