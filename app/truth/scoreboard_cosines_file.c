/* SPDX-License-Identifier: MIT */
/* Tables of linearly transformed cosines: our own, and those published by others. */
#include "app/base/file.h"
#include "app/base/number.h"
#include "app/truth/scoreboard_cosines_table.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const cosines_table cosines_fitted = { COSINES_SIZE, cosines_nodes, NULL };

enum { SIZE_MAX_OF_FILE = 1 << 24, NODE = 4, SIZE_MIN = 2, SIZE_MOST = 256 };
enum { NUMBERS_MAX = NODE * SIZE_MOST * SIZE_MOST };

/* Reads the numbers between a bracket and its end, separated by commas and blanks, and sets *text
 * to what follows; returns -1, and leaves *text, if it is not a list of numbers. */
static int read_list(const char **text, float *numbers) {
    static const char apart[] = ", \t\r\n";
    const char *at = *text + 1;
    int count = 0;
    for (at += strspn(at, apart); *at != ']'; at += strspn(at, apart)) {
        const size_t length = strcspn(at, ", \t\r\n]");
        double value;
        if (count == NUMBERS_MAX || !number_read(at, length, &value) || fabs(value) > 1e30)
            return -1;
        numbers[count++] = (float)value;
        at += length;
    }
    *text = at + 1;
    return count;
}

/* Finds the first two lists long enough to be nodes, which must have equally many numbers; returns
 * how many, or 0. */
static int read_lists(const char *text, float *first, float *second) {
    float *const lists[] = { first, second };
    int found = 0, counts[2] = { 0, 0 };
    while (found < 2 && (text = strchr(text, '[')) != NULL) {
        const int count = read_list(&text, lists[found]);
        if (count < 0)
            text++;
        else if (count >= NODE * SIZE_MIN * SIZE_MIN)
            counts[found++] = count;
    }
    return found == 2 && counts[0] == counts[1] ? counts[0] : 0;
}

/* Converts the nodes of both lists to our order; returns false if a matrix has no inverse. */
static bool order(const float *first, const float *second, const cosines_table *table) {
    for (int i = 0; i < table->size; i++)
        for (int j = 0; j < table->size; j++) {
            const float *const matrix = first + NODE * (j * table->size + i);
            const float *const integrals = second + NODE * (j * table->size + i);
            float *const node = table->own[i * table->size + j];
            if (!(matrix[0] * matrix[3] - matrix[2] * matrix[1] > 0))
                return false;
            node[0] = matrix[0];
            node[1] = matrix[2];
            node[2] = matrix[1];
            node[3] = matrix[3];
            node[4] = integrals[0];
            node[5] = integrals[1];
        }
    return true;
}

bool cosines_parse(const char *path, const char *text, size_t size, cosines_table *table,
                   base_error *error) {
    float *const numbers = malloc(2 * NUMBERS_MAX * sizeof *numbers);
    *table = (cosines_table) { .size = 0 };
    if (!numbers)
        return base_fail(error, path, "out of memory");
    const int count = strlen(text) == size ? read_lists(text, numbers, numbers + NUMBERS_MAX) : 0;
    const int side = (int)sqrt(count / NODE);
    bool ok = side >= SIZE_MIN && side <= SIZE_MOST && count == NODE * side * side;
    if (ok && !(table->own = malloc((size_t)(side * side) * sizeof *table->own))) {
        free(numbers);
        return base_fail(error, path, "out of memory");
    }
    table->size = side;
    table->nodes = (const float(*)[COSINES_MEMBERS])table->own;
    ok = ok && order(numbers, numbers + NUMBERS_MAX, table);
    free(numbers);
    if (ok)
        return true;
    cosines_free(table);
    return base_fail(
        error, path,
        "is no table of linearly transformed cosines (two lists of 4 numbers a node, as "
        "ltc.js has)");
}

bool cosines_read(const char *path, cosines_table *table, base_error *error) {
    void *text;
    size_t size;
    *table = (cosines_table) { .size = 0 };
    if (!file_read(path, SIZE_MAX_OF_FILE, &text, &size, error))
        return false;
    const bool ok = cosines_parse(path, text, size, table, error);
    free(text);
    return ok;
}

void cosines_free(cosines_table *table) {
    free(table->own);
    *table = (cosines_table) { .size = 0 };
}
