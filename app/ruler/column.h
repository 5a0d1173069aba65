/* SPDX-License-Identifier: MIT */
/* column.h - what a renderer got for the rows of the ruler's table. */
#ifndef LAMPION_RULER_COLUMN_H
#define LAMPION_RULER_COLUMN_H

#include "app/ruler/table.h"

/* Reads "id,value", or the configurations' columns and "value", with a line for every row of the
 * table in any order, into values of the table's order. A column "radius" may follow, as
 * `lampion ruler --truth` prints it. Whatever is missing, repeated, more than was asked for or no
 * finite number is named. Free the values. */
bool ruler_column_read(const char *path, const ruler_table *table, double **values,
                       cli_error *error);

#endif
