/* SPDX-License-Identifier: MIT */
/* codecs.c - stands in for libraries that Debian has only for the machine's own architecture: a
 * page decodes PNG and JPEG by stb_image, and reports other formats as not read. */
#include "app/image/texels.h"
#include "app/scene/gltf/draco.h"
#include "app/scene/gltf/meshopt.h"

#include <stdio.h>
#include <string.h>

static bool begins_png(const unsigned char *data, size_t size) {
    return size >= 8 && memcmp(data, "\x89PNG\r\n\x1a\n", 8) == 0;
}

static bool begins_jpeg(const unsigned char *data, size_t size) {
    return size >= 3 && memcmp(data, "\xff\xd8\xff", 3) == 0;
}

static bool begins_webp(const unsigned char *data, size_t size) {
    return size >= 12 && memcmp(data, "RIFF", 4) == 0 && memcmp(data + 8, "WEBP", 4) == 0;
}

static bool refuse(const unsigned char *data, size_t size, int *width, int *height,
                   texels_reason *reason) {
    (void)data, (void)size, (void)width, (void)height;
    snprintf(reason->text, sizeof reason->text, "WebP is not read in a page");
    return false;
}

const texels_decoder texels_png = { begins_png, texels_stb_measure, texels_stb_decode };
const texels_decoder texels_jpeg = { begins_jpeg, texels_stb_measure, texels_stb_decode };
const texels_decoder texels_webp = { begins_webp, refuse, NULL };

void *meshopt_decode(const meshopt_layout *layout, const unsigned char *data, size_t size,
                     const char **wrong) {
    (void)layout, (void)data, (void)size;
    *wrong = "is compressed by meshoptimizer, which is not read in a page";
    return NULL;
}

/* There are no meshes, so nothing else is asked of one. */
draco_mesh *draco_mesh_decode(const void *data, size_t size) {
    (void)data, (void)size;
    return NULL;
}
