/* SPDX-License-Identifier: MIT */
/* escape.h - percent-escapes of URIs (RFC 3986, 2.1). */
#ifndef LAMPION_SCENE_ESCAPE_H
#define LAMPION_SCENE_ESCAPE_H

/* The next byte of a text that is not at its end: what %XX stands for, or a character. *at moves
 * past it. */
char escape_next(const char **at);

#endif
