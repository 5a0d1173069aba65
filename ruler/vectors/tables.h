/* SPDX-License-Identifier: MIT */
/* tables.h - the tables of ruler/vectors, each described by one row. */
#ifndef LAMPION_VECTORS_TABLES_H
#define LAMPION_VECTORS_TABLES_H

#include <arb.h>

typedef struct vectors_table {
    const char *name;
    int rows;
    void (*print_header)(void);
    void (*print_row)(int row); /* row counts from 1 */
} vectors_table;
extern const vectors_table vectors_tables[]; /* ended by a name of NULL */

/* --- what the tables are printed with --------------------------------------------------------- */

/* Prints "prefix_0,prefix_1,…,". */
void vectors_print_names(const char *prefix, int count);
void vectors_print_inputs(const double *inputs, int count);

/* Print values as the nearest doubles, and widen `bound` to cover them; then the bound and a
 * newline. */
void vectors_print_value(const arb_t value, mag_t bound);
void vectors_print_bound(mag_t bound);

/* Returns number k of a row: a fraction of 20 bits in 0 … 1, the same on every machine. */
double vectors_fraction(int row, int k);

void vectors_basis_header(void), vectors_basis_row(int row);
void vectors_basis_128_header(void), vectors_basis_128_row(int row);
void vectors_sphere_header(void), vectors_sphere_row(int row);
void vectors_inside_header(void), vectors_inside_row(int row);
void vectors_gradient_header(void), vectors_gradient_row(int row);
void vectors_sphere_128_header(void), vectors_sphere_128_row(int row);
void vectors_zonal_header(void), vectors_zonal_row(int row);
void vectors_rotation_header(void), vectors_rotation_row(int row);
void vectors_rotation_128_header(void), vectors_rotation_128_row(int row);
void vectors_product_header(void), vectors_product_row(int row);
void vectors_product_12_header(void), vectors_product_12_row(int row);
void vectors_lobe_header(void), vectors_lobe_row(int row);
void vectors_table_header(void), vectors_table_row(int row);

#endif
