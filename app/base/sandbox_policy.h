/* SPDX-License-Identifier: MIT */
/* sandbox_policy.h - the rights that a process gives up for good. */
#ifndef LAMPION_BASE_SANDBOX_POLICY_H
#define LAMPION_BASE_SANDBOX_POLICY_H

#include "app/base/error.h"

/* Leaves this process its memory, its open descriptors, messages on them and its end: no
 * capability, file, process, connection or other device. Returns false if the kernel does not
 * enforce that; then handle no untrusted input. */
bool policy_enter(base_error *error);

#endif
