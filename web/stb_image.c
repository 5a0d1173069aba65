/* SPDX-License-Identifier: MIT */
/* stb_image.c - the decoder of textures, which Debian has only for the machine's own architecture.
 */
#define STBI_NO_STDIO
#define STB_IMAGE_IMPLEMENTATION
#include <stb_image.h>
