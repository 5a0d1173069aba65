/* SPDX-License-Identifier: MIT */
/* Scene blobs as a faulty importer might return them: a valid header, then arbitrary bytes. The
 * first bytes are the numbers of items. */
#include "app/scene/blob.h"
#include "fuzz/file.h"

#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    size_t counts[BLOB_SECTIONS];
    if (size < BLOB_SECTIONS)
        return 0;
    for (int i = 0; i < BLOB_SECTIONS; i++)
        counts[i] = data[i];
    blob_header header;
    blob_layout(&header, counts);
    unsigned char *block = calloc(1, header.size);
    if (!block)
        return 0;
    memcpy(block, &header, sizeof header);
    data += BLOB_SECTIONS;
    size -= BLOB_SECTIONS;
    const size_t room = header.size - sizeof header;
    memcpy(block + sizeof header, data, size < room ? size : room);
    scene world;
    base_error error;
    if (blob_validate(block, header.size, false, "input", &error) &&
        blob_open(block, header.size, "input", &world, &error))
        scene_free(&world);
    else
        free(block);
    return 0;
}
