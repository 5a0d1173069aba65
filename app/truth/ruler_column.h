/* SPDX-License-Identifier: MIT */
/* ruler_column.h - a renderer's values for the rows of the reference table. */
#ifndef LAMPION_TRUTH_RULER_COLUMN_H
#define LAMPION_TRUTH_RULER_COLUMN_H

#include "app/truth/ruler_table.h"

/* Reads "id,value", or the configurations' columns and "value", with a line for every row of the
 * table in any order, into values in the table's order. A column "radius" may follow, as `lampion
 * ruler --truth` prints it. The error names what is missing, repeated, superfluous or not a finite
 * number. Free the values. */
bool ruler_column_read(const char *path, const ruler_table *table, double **values,
                       base_error *error);

#endif
