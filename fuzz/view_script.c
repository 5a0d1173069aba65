/* SPDX-License-Identifier: MIT */
/* Scripts of the viewer: what is read has ascending times and known events. */
#include "app/view/script.h"
#include "fuzz/file.h"

#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    view_script script;
    base_error error;
    char path[64];
    if (!fuzz_file_write(data, size, ".txt", path))
        abort();
    if (view_script_read(path, &script, &error)) {
        for (size_t i = 0; i < script.count; i++)
            if (!(script.lines[i].seconds >= 0) ||
                (i > 0 && script.lines[i].seconds < script.lines[i - 1].seconds) ||
                script.lines[i].event.text != script.lines[i].text)
                abort();
        view_script_free(&script);
    }
    unlink(path);
    return 0;
}
