/* SPDX-License-Identifier: MIT */
/* lampion/base.h - what every other header needs: version, results, vectors, the host.
 *
 * Conventions of the whole library
 *   - A function `lmp_<topic>_<verb>` lives in `<topic>.h`. Arguments have one order: the host, the
 *     scratch or the object; how (bands, desc or settings, numbers); what is read; what is written.
 * An array is followed by its count, a result preceded by its layout and stride.
 *   - Strides are in bytes, from one element to the next, and multiples of sizeof(float). 0 repeats
 *     the same element where that is of use (lmp_vec3_array, lmp_float_array, materials); elsewhere
 *     (coefficients, images, results) it means tight.
 *   - Pure mathematics returns void or a value and allocates nothing. What allocates or reads
 *     untrusted bytes returns lmp_result and sets its out-parameter to NULL on failure. Nothing
 *     prints, nothing exits.
 *   - What a comment asks of arguments (ranges, unit and finite vectors, arrays that do not
 *     overlap) is asserted where the library was built without NDEBUG. A release build trusts its
 *     caller, and still: finite numbers whose squares are finite give finite ones; NaN gives NaN
 *     where it matters, or the least of a range that a number is clamped to; and no float, in range
 *     or not, makes it read or write outside the arrays that bands, counts and strides describe.
 *     Those it cannot check.
 *   - Arrays whose count is 0 may be NULL.
 *   - Degenerate geometry (a light that contains the point, d = 0, a zero radius) is no error: its
 *     result is documented, finite and continuous.
 *   - Every function is re-entrant; the library starts no thread and keeps no state but the table
 *     of kernels. Split the points among your own threads.
 *   - No function needs more than 64 KB of stack, at any number of bands, where the compiler
 *     optimized the library: fibers will do. What gains by more borrows it: lmp_scratch.
 *
 * lampion DOES NOT read files, compute visibility, or call a graphics API. */
#ifndef LAMPION_BASE_H
#define LAMPION_BASE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Marks what the shared library exports. */
#if defined(_WIN32)
#define LMP_API
#elif defined(__GNUC__)
#define LMP_API __attribute__((visibility("default")))
#else
#define LMP_API
#endif

/* A conversion in a macro, as C and as C++ write it. */
#ifdef __cplusplus
#define LMP_CAST(type, value) (static_cast<type>(value))
extern "C" {
#else
#define LMP_CAST(type, value) ((type)(value))
#endif

/* The one home of the version: CMake parses these three lines. */
#define LMP_VERSION_MAJOR 0
#define LMP_VERSION_MINOR 1
#define LMP_VERSION_PATCH 0

/* Every function takes 1 to LMP_BANDS_MAX bands. */
#define LMP_BANDS_MAX 128

/* What a unit vector's squared length may differ from 1 by. */
#define LMP_UNIT_TOLERANCE 1e-3f

/* A point or a direction, right-handed. Directions are unit and point away from the shaded point.
 */
typedef struct lmp_vec3 {
    float x, y, z;
} lmp_vec3;

/* Linear red, green, blue; the unit is stated where it is used. */
typedef struct lmp_rgb {
    float r, g, b;
} lmp_rgb;

/* A unit quaternion, w the real part. */
typedef struct lmp_quat {
    float x, y, z, w;
} lmp_quat;

/* Many vectors or numbers, wherever they are: stride sizeof(float) reads three planes,
 * sizeof(my_struct) the members of an array of structures, and 0 the same element for every i. */
typedef struct lmp_vec3_array {
    const float *x, *y, *z;
    size_t stride;
} lmp_vec3_array;
typedef struct lmp_float_array {
    const float *at;
    size_t stride;
} lmp_float_array;

/* An array of lmp_vec3 (NULL where there are none), and one vector for every element. */
static inline lmp_vec3_array lmp_vec3_array_of(const lmp_vec3 *vectors) {
    lmp_vec3_array array = { NULL, NULL, NULL, sizeof(lmp_vec3) };
    if (vectors) {
        array.x = &vectors->x;
        array.y = &vectors->y;
        array.z = &vectors->z;
    }
    return array;
}
static inline lmp_vec3_array lmp_vec3_array_same(const lmp_vec3 *vector) {
    const lmp_vec3_array array = { &vector->x, &vector->y, &vector->z, 0 };
    return array;
}

typedef enum lmp_result {
    LMP_OK = 0,
    LMP_ERROR_ARGUMENT, /* a value outside its documented range */
    LMP_ERROR_MEMORY,   /* the host's allocate returned NULL */
    LMP_ERROR_FORMAT,   /* bytes that are not what they claim to be */
    LMP_ERROR_VERSION,  /* a format version this library does not know */
    LMP_ERROR_CHECKSUM, /* bytes damaged since they were written */
    LMP_ERROR_CANCELLED /* lmp_host.cancelled said so */
} lmp_result;

/* What the library borrows of the program that calls it. Every function that allocates or takes
 * long has one as its first argument. NULL stands for a host all 0, and each hook left 0 for its
 * default, so set those you need and zero-initialize the rest; allocate and release go together.
 *
 * A function calls the hooks only until it returns. Objects keep allocate, release and user, and
 * call release when they are destroyed; the struct itself may go. */
typedef struct lmp_host {
    /* `size` bytes aligned for any type, or NULL; release accepts NULL. Default: malloc and free.
     * Called from every thread on which `parallel` runs tasks, at once. */
    void *(*allocate)(size_t size, void *user);
    void (*release)(void *memory, void *user);
    /* Runs task(index, data) for every index below count, in any order, on any threads, and returns
     * when all are done and what they wrote can be read. Default: one after the other, here. */
    void (*parallel)(size_t count, void (*task)(size_t index, void *data), void *data, void *user);
    /* How much is done, rising from 0 to 1. Called from any of those threads, one at a time. */
    void (*progress)(double done, void *user);
    /* True where the result is no longer wanted: the function then frees what it has made and
     * returns LMP_ERROR_CANCELLED, once the pieces under way are done (each takes milliseconds, at
     * 100 bands up to a second). Called from every thread, at once. */
    bool (*cancelled)(void *user);
    void *user; /* passed to every hook */
} lmp_host;

/* Memory that the caller lends for one call, for stacks are small: a function that has one as its
 * first argument is faster with it and gives the same bits. NULL, or one all 0, lends none. What it
 * contains means nothing before and after; calls at the same time need memory of their own. */
#define LMP_SCRATCH_ALIGNMENT 64
#define LMP_SCRATCH_SIZE      393216 /* bytes from which on more make no difference */
typedef struct lmp_scratch {
    void *memory; /* aligned to LMP_SCRATCH_ALIGNMENT */
    size_t size;  /* any; less than the 64 KB of a stack do not help */
} lmp_scratch;

/* The version the library was built as: major << 16 | minor << 8 | patch. */
LMP_API uint32_t lmp_version(void);

/* A short English text for a result, never NULL; static storage. */
LMP_API const char *lmp_result_text(lmp_result result);

#ifdef __cplusplus
}
#endif
#endif
