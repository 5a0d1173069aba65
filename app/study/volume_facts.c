/* SPDX-License-Identifier: MIT */
/* volume_facts.c - the properties of a .lmpf. The file is untrusted: a child reads it and returns
 * nothing but the numbers that are printed. */
#include "app/base/file.h"
#include "app/base/sandbox.h"
#include "app/study/volume.h"

#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#define FILE_LIMIT ((size_t)1 << 32)

typedef struct facts_bytes {
    const char *path;
    void *data;
    size_t size;
} facts_bytes;

static bool describe(void *context, int output, base_error *failure) {
    const facts_bytes *const bytes = context;
    volume_facts facts;
    lmp_field *field;
    lmp_parse_error error;
    const lmp_result result = lmp_field_read(NULL, bytes->data, bytes->size, &error, &field);
    if (result == LMP_ERROR_FORMAT && error.offset == 0)
        return base_fail(failure, bytes->path, "is not a field (lampion field makes them)");
    if (result != LMP_OK)
        return base_fail(failure, bytes->path, "%s (byte %zu)", error.text, error.offset);
    memset(&facts, 0, sizeof facts);
    facts.info = lmp_field_describe(field);
    facts.bytes = bytes->size;
    for (size_t i = 0; i < facts.info.light_count; i++)
        facts.of_kind[lmp_field_lights(field)[i].kind]++;
    lmp_field_destroy(field);
    return write(output, &facts, sizeof facts) == (ssize_t)sizeof facts;
}

bool volume_describe_field(const char *path, volume_facts *facts, base_error *error) {
    facts_bytes bytes = { .path = path };
    void *block;
    size_t size;
    if (!file_read(path, FILE_LIMIT, &bytes.data, &bytes.size, error))
        return false;
    /* A field takes more memory than its file: for coarser levels, and room for more lights. */
    const sandbox_job job = {
        .subject = path, .input_bytes = 2 * bytes.size, .context = &bytes, .work = describe
    };
    bool ok = sandbox_run(&job, &block, &size, error);
    if (ok) {
        ok = size == sizeof *facts || base_fail(error, path, "could not be read");
        if (ok)
            memcpy(facts, block, sizeof *facts);
        munmap(block, size);
    }
    free(bytes.data);
    return ok;
}
