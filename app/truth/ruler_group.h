/* SPDX-License-Identifier: MIT */
/* ruler_group.h - groupings of the reference table's rows, and the start of each group. */
#ifndef LAMPION_TRUTH_RULER_GROUP_H
#define LAMPION_TRUTH_RULER_GROUP_H

#include "app/truth/ruler_table.h"

#define RULER_GROUPS_MAX 8
typedef struct ruler_grouping {
    const char *name;
    double (*of)(const ruler_row *row); /* NAN: in no group */
    int count;
    double from[RULER_GROUPS_MAX];
    const char *const *names; /* of groups that are not ranges, which are numbered from 0 */
} ruler_grouping;

enum {
    RULER_BY_MATERIAL,
    RULER_BY_EXPONENT,
    RULER_BY_ROUGHNESS,
    RULER_BY_LIGHT,
    RULER_BY_ANGLE,
    RULER_BY_DISTANCE,
    RULER_BY_VIEW,
    RULER_GROUPINGS
};
extern const ruler_grouping ruler_groupings[RULER_GROUPINGS];

bool ruler_in_group(const ruler_grouping *by, int group, const ruler_row *row);
void ruler_group_name(const ruler_grouping *by, int group, char *name, size_t size);

#endif
