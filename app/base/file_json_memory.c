/* SPDX-License-Identifier: MIT */
/* file_json_memory.c - jansson's parser and printer where memory runs out. */
#include "app/base/file_json.h"

#include <setjmp.h>
#include <stdlib.h>

/* Where to jump to when memory runs out in the call of jansson that this thread is in. Without
 * memory, jansson's lexer drops characters from a token, and its printer names from an object, and
 * neither reports it; so the call is left at once and loses what it has made. */
static _Thread_local jmp_buf *out_of_memory;

static void *allocate(size_t size) {
    void *const memory = malloc(size);
    if (!memory && out_of_memory)
        longjmp(*out_of_memory, 1);
    return memory;
}

/* Seeds jansson's hashes early: the seed is read from /dev/urandom, which the sandbox would not let
 * it open later. */
__attribute__((constructor)) static void prepare(void) {
    json_set_alloc_funcs(allocate, free);
    json_object_seed(0);
}

json_t *file_json_load(const char *text, size_t size, json_error_t *error) {
    jmp_buf here;
    json_t *volatile root = NULL;
    *error = (json_error_t) { .text = "" };
    out_of_memory = &here;
    if (setjmp(here) == 0)
        root = json_loadb(
            text, size, JSON_REJECT_DUPLICATES | JSON_DECODE_ANY | JSON_DECODE_INT_AS_REAL, error);
    else
        error->text[JSON_ERROR_TEXT_LENGTH - 1] = json_error_out_of_memory;
    out_of_memory = NULL;
    return root;
}

char *file_json_dump(const json_t *root, size_t flags) {
    jmp_buf here;
    char *volatile text = NULL;
    out_of_memory = &here;
    if (setjmp(here) == 0)
        text = json_dumps(root, flags);
    out_of_memory = NULL;
    return text;
}
