/* SPDX-License-Identifier: MIT */
/* lampion_vectors FILE [ROW…] - prints a table of what the library computes, or some of its rows:
 * the same numbers as ruler/vectors/FILE.csv, whose last column bounds how far each value of a row
 * is from the truth. Inputs are exact as printed. */
#include "ruler/vectors/tables.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int main(int argc, char **argv) {
    const vectors_table *table = vectors_tables;
    while (argc > 1 && table->name && strcmp(table->name, argv[1]) != 0)
        table++;
    if (argc < 2 || !table->name) {
        fprintf(stderr, "usage: lampion_vectors FILE [ROW…]; files:");
        for (table = vectors_tables; table->name; table++)
            fprintf(stderr, " %s", table->name);
        fprintf(stderr, "\n");
        return 2;
    }
    table->print_header();
    for (int k = 2; k < argc; k++)
        table->print_row(atoi(argv[k]));
    for (int row = 1; argc == 2 && row <= table->rows; row++)
        table->print_row(row);
    flint_cleanup();
    return 0;
}
