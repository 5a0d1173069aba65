/* SPDX-License-Identifier: MIT */
/* facts.c - what a .lmpf holds. The file may be anybody's: a child reads it, and hands back numbers
 * that are printed and nothing else. */
#include "app/file/file.h"
#include "app/sandbox/sandbox.h"
#include "app/volume/volume.h"

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

static bool describe(void *context, int output, cli_error *error) {
    const facts_bytes *const bytes = context;
    volume_facts facts;
    lmp_field *field;
    const lmp_result result = lmp_field_read(NULL, bytes->data, bytes->size, &field);
    if (result == LMP_ERROR_FORMAT)
        return cli_fail(error, bytes->path, "is not a field (lampion field makes them)");
    if (result != LMP_OK)
        return cli_fail(error, bytes->path, "%s", lmp_result_text(result));
    memset(&facts, 0, sizeof facts);
    facts.info = lmp_field_describe(field);
    facts.bytes = bytes->size;
    for (size_t i = 0; i < facts.info.light_count; i++)
        facts.of_kind[lmp_field_lights(field)[i].kind]++;
    lmp_field_destroy(field);
    return write(output, &facts, sizeof facts) == (ssize_t)sizeof facts;
}

bool volume_describe_field(const char *path, volume_facts *facts, cli_error *error) {
    facts_bytes bytes = { .path = path };
    void *block;
    size_t size;
    if (!file_read(path, FILE_LIMIT, &bytes.data, &bytes.size, error))
        return false;
    /* A field takes more memory than its file: coarser ones, and room for more lights. */
    const sandbox_job job = {
        .subject = path, .input_bytes = 2 * bytes.size, .context = &bytes, .work = describe
    };
    bool ok = sandbox_run(&job, &block, &size, error);
    if (ok) {
        ok = size == sizeof *facts || cli_fail(error, path, "could not be read");
        if (ok)
            memcpy(facts, block, sizeof *facts);
        munmap(block, size);
    }
    free(bytes.data);
    return ok;
}
