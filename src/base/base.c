/* SPDX-License-Identifier: MIT */
#include <lampion/base.h>

uint32_t lmp_version(void) {
    return (uint32_t)LMP_VERSION_MAJOR << 16 | (uint32_t)LMP_VERSION_MINOR << 8 |
           (uint32_t)LMP_VERSION_PATCH;
}

const char *lmp_result_text(lmp_result result) {
    switch (result) {
    case LMP_OK:
        return "ok";
    case LMP_ERROR_ARGUMENT:
        return "argument out of range";
    case LMP_ERROR_MEMORY:
        return "out of memory";
    case LMP_ERROR_FORMAT:
        return "malformed data";
    case LMP_ERROR_VERSION:
        return "unknown format version";
    case LMP_ERROR_CHECKSUM:
        return "checksum mismatch";
    case LMP_ERROR_CANCELLED:
        return "cancelled";
    }
    return "unknown result";
}
