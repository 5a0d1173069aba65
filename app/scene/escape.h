/* SPDX-License-Identifier: MIT */
/* escape.h - percent-escapes of URIs (RFC 3986, 2.1). */
#ifndef LAMPION_SCENE_ESCAPE_H
#define LAMPION_SCENE_ESCAPE_H

/* Decodes the next byte of a text that is not at its end: %XX, or a plain character. Moves *at past
 * it. */
char escape_next(const char **at);

#endif
