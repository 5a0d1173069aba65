/* SPDX-License-Identifier: MIT */
/* lampion/base.h - what every other header needs: version, results, vectors, the host.
 *
 * Conventions of the whole library
 *   - A function `lmp_<topic>_<verb>` lives in `<topic>.h`; one that returns a value may be named
 *     after it. Arguments come in one order: the host, the scratch or the object; how (bands, desc
 *     or settings, numbers); what is read; what is written. An array is followed by its count.
 *   - A function ending in `_n` does for many elements what its twin does for one, with one result
 *     per element.
 *   - A `desc` says how to make an object, `settings` how to compute; zero is every member's
 *     default. Counts of elements and bytes are size_t; bands, and numbers with a maximum, are int.
 *   - Strides are in bytes, from one element to the next, and multiples of sizeof(float). 0 repeats
 *     the same element where that is useful (lmp_vec3_array, lmp_float_array, materials); elsewhere
 *     (coefficients, images, results) it means tight.
 *   - Pure mathematics returns void or a value and allocates nothing. What allocates or reads
 *     untrusted bytes returns lmp_result and sets its out-parameter to NULL on failure. Nothing
 *     prints, nothing exits.
 *   - What a comment requires of arguments (ranges, unit and finite vectors, arrays that do not
 *     overlap) is asserted if the library was built without NDEBUG. A release build trusts its
 *     caller, and still promises this: finite numbers whose squares are finite give finite results;
 *     NaN gives NaN where it matters, or the lower end of a range that a number is clamped to; and
 *     no float, in range or not, makes it read or write outside the arrays that bands, counts and
 *     strides describe. Bands, counts and strides themselves it cannot check.
 *   - Arrays whose count is 0 may be NULL.
 *   - Degenerate geometry (a light that contains the point, d = 0, a zero radius) is not an error:
 *     its result is documented, finite and continuous.
 *   - Every function is re-entrant; the library starts no thread and keeps no state but the table
 *     of kernels. Split the points among your own threads.
 *   - No function needs more than 64 KB of stack, at any number of bands, in an optimized build of
 *     the library, so a fiber will do. Functions that gain from more memory borrow it: lmp_scratch.
 *
 * lampion DOES NOT read files, compute visibility, or call a graphics API. */
#ifndef LAMPION_BASE_H
#define LAMPION_BASE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Marks what the shared library exports. A program that links to the DLL on Windows defines
 * LMP_DLL, which CMake's target does for it; LMP_DLL_BUILD is for building the library itself. */
#if defined(_WIN32) && defined(LMP_DLL_BUILD)
#define LMP_API __declspec(dllexport)
#elif defined(_WIN32) && defined(LMP_DLL)
#define LMP_API __declspec(dllimport)
#elif defined(__GNUC__)
#define LMP_API __attribute__((visibility("default")))
#else
#define LMP_API
#endif

/* Marks what may still change in a minor version: how tables are stored, what shaders take. */
#define LMP_EXPERIMENTAL

/* Casts a value in a macro the way that C and C++ each accept. */
#ifdef __cplusplus
#define LMP_CAST(type, value) (static_cast<type>(value))
extern "C" {
#else
#define LMP_CAST(type, value) ((type)(value))
#endif

/* The version is defined here alone: CMake parses these three lines. */
#define LMP_VERSION_MAJOR 0
#define LMP_VERSION_MINOR 2
#define LMP_VERSION_PATCH 0

/* Every function takes 1 to LMP_BANDS_MAX bands. */
#define LMP_BANDS_MAX 128

/* The largest difference from 1 that the squared length of a unit vector may have. */
#define LMP_UNIT_TOLERANCE 1e-3f

/* A point or a direction in a right-handed frame. Directions are unit and point away from the
 * shaded point. */
typedef struct lmp_vec3 {
    float x, y, z;
} lmp_vec3;

/* Linear red, green, blue; the unit is stated where it is used. */
typedef struct lmp_rgb {
    float r, g, b;
} lmp_rgb;

/* A unit quaternion; w is the real part. */
typedef struct lmp_quat {
    float x, y, z, w;
} lmp_quat;

/* Many vectors or numbers in any memory layout: stride sizeof(float) reads three planes,
 * sizeof(my_struct) the members of an array of structures, and 0 the same element for every i. */
typedef struct lmp_vec3_array {
    const float *x, *y, *z;
    size_t stride;
} lmp_vec3_array;
typedef struct lmp_float_array {
    const float *at;
    size_t stride;
} lmp_float_array;

/* Where colors go: red, green and blue side by side, `stride` bytes from one color's red to the
 * next one's; 0 means tight, an array of lmp_rgb. */
typedef struct lmp_rgb_array {
    float *at;
    size_t stride;
} lmp_rgb_array;

/* Describe an array of lmp_vec3, which may be NULL if it is empty, and one vector that serves every
 * element. */
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

/* Describes an array of colors, which may be NULL if it is empty. */
static inline lmp_rgb_array lmp_rgb_array_of(lmp_rgb *colors) {
    const lmp_rgb_array array = { colors ? &colors->r : NULL, sizeof(lmp_rgb) };
    return array;
}

/* What a function that can fail returns. */
typedef enum lmp_result {
    LMP_OK = 0,
    LMP_ERROR_ARGUMENT, /* a value outside its documented range */
    LMP_ERROR_MEMORY,   /* the host's allocate returned NULL */
    LMP_ERROR_FORMAT,   /* bytes that are not what they claim to be */
    LMP_ERROR_VERSION,  /* a format version this library does not know */
    LMP_ERROR_CHECKSUM, /* bytes damaged since they were written */
    LMP_ERROR_CANCELLED /* lmp_host.cancelled returned true */
} lmp_result;

/* Tells a person what is wrong with the bytes that a reader was given: text without a file name,
 * and the offset of the first byte concerned. Every reader fills it on any failure; pass NULL if it
 * is not wanted. */
typedef struct lmp_parse_error {
    size_t offset;
    char text[200];
} lmp_parse_error;

/* What the library borrows from the program that calls it. Every function that allocates or takes
 * long receives one as its first argument. NULL means a host of zeros, and a hook that is 0 means
 * its default: set the hooks you need and zero-initialize the rest. Set allocate and release
 * together or not at all.
 *
 * A function calls the hooks only until it returns. Objects keep allocate, release and user, and
 * call release when they are destroyed; the struct itself may go. */
typedef struct lmp_host {
    /* `size` bytes aligned for any type, or NULL; release accepts NULL. Default: malloc and free.
     * Both are called concurrently from every thread on which `parallel` runs tasks. */
    void *(*allocate)(size_t size, void *user);
    void (*release)(void *memory, void *user);
    /* Runs task(index, data) for every index below count, in any order, on any threads, and returns
     * when all are done and what they wrote can be read. Default: one after the other, on the
     * calling thread. */
    void (*parallel)(size_t count, void (*task)(size_t index, void *data), void *data, void *user);
    /* Receives the fraction done, rising from 0 to 1. Called from any thread that runs tasks, never
     * from two at once. */
    void (*progress)(double done, void *user);
    /* Returns true once the result is no longer wanted: the function then frees what it has made
     * and returns LMP_ERROR_CANCELLED, once the pieces under way are done (each takes milliseconds,
     * at 100 bands up to a second). Called concurrently from every thread that runs tasks. */
    bool (*cancelled)(void *user);
    void *user; /* passed to every hook */
} lmp_host;

/* Memory that the caller lends for one call, because stacks are small: a function whose first
 * argument is a scratch is faster with it and gives the same bits. NULL and a scratch of zeros lend
 * none. Its contents mean nothing before and after the call; concurrent calls each need memory of
 * their own. */
#define LMP_SCRATCH_ALIGNMENT 64
#define LMP_SCRATCH_SIZE      393216 /* bytes; more makes no difference */
typedef struct lmp_scratch {
    void *memory; /* aligned to LMP_SCRATCH_ALIGNMENT */
    size_t size;  /* in bytes; less than the stack's 64 KB does not help */
} lmp_scratch;

/* Returns the version that the library was built as: major << 16 | minor << 8 | patch. */
LMP_API uint32_t lmp_version(void);

/* Returns a short English text for a result, in static storage; never NULL. */
LMP_API const char *lmp_result_text(lmp_result result);

#ifdef __cplusplus
}
#endif
#endif
