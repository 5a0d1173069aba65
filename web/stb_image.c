/* SPDX-License-Identifier: MIT */
/* stb_image.c - textures' decoder, which Debian has for the machine's own architecture alone. */
#define STBI_NO_STDIO
#define STB_IMAGE_IMPLEMENTATION
#include <stb_image.h>
