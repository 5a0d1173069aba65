/* SPDX-License-Identifier: MIT */
/* embedded.h - files that travel inside the program (cmake/embed.cmake). */
#ifndef LAMPION_BASE_EMBEDDED_H
#define LAMPION_BASE_EMBEDDED_H

typedef struct embedded_file {
    const char *name, *text;
} embedded_file;

#endif
