/* SPDX-License-Identifier: MIT */
/* lampion_ruler - writes the table of proven values; docs/ruler.md describes it. */
#include "ruler/integrate.h"
#include "ruler/value.h"

#include <flint/flint.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define ZONAL_RADIUS 1e-11 /* relative; the document promises ten times as much */
#define GGX_RADIUS   1e-8
#define DARK         1e-30 /* smaller values are printed as 0 */

typedef struct arguments {
    bool bands;
    int shard, shards;
    int first_id; /* index of the first ID in argv */
} arguments;

static bool is_zonal(const ruler_configuration *c) {
    return c->material == RULER_LAMBERT || c->material == RULER_PHONG;
}

/* Prints the double nearest to the middle; returns a bound of its error. */
static double print_middle(const arb_t value) {
    double middle = arf_get_d(arb_midref(value), ARF_RND_NEAR);
    arb_t rest;
    mag_t most;
    arb_init(rest);
    mag_init(most);
    if (fabs(middle) < DARK)
        middle = 0;
    arb_set_d(rest, middle);
    arb_sub(rest, value, rest, RULER_PRECISION);
    arb_get_mag(most, rest);
    const double radius = mag_get_d(most);
    printf(",%.17g", middle);
    arb_clear(rest);
    mag_clear(most);
    return radius > 0 && radius < DARK ? DARK : radius;
}

/* Prints two digits, rounded up. */
static void print_radius(double radius) {
    printf(",%.1e\n", radius * 1.06);
}

static void print_value(const ruler_configuration *c) {
    arb_t value;
    arb_init(value);
    ruler_value(value, c, is_zonal(c) ? ZONAL_RADIUS : GGX_RADIUS);
    ruler_configuration_print(stdout, c);
    print_radius(print_middle(value));
    fflush(stdout);
    arb_clear(value);
}

static void print_bands(const ruler_configuration *c) {
    arb_t value;
    double radius = 0;
    if (!is_zonal(c))
        return;
    arb_init(value);
    printf("%d", c->id);
    for (int k = 0; k < 2 * RULER_BAND_COUNTS; k++) {
        ruler_value_of_bands(value, c, ruler_band_counts[k % RULER_BAND_COUNTS],
                             k >= RULER_BAND_COUNTS);
        radius = fmax(radius, print_middle(value));
    }
    print_radius(radius);
    arb_clear(value);
}

static void print_header(bool bands) {
    if (!bands) {
        printf(RULER_CONFIGURATION_COLUMNS ",value,radius\n");
        return;
    }
    printf("id");
    for (int k = 0; k < 2 * RULER_BAND_COUNTS; k++)
        printf(",%s%d", k < RULER_BAND_COUNTS ? "bands" : "hanning",
               ruler_band_counts[k % RULER_BAND_COUNTS]);
    printf(",radius\n");
}

/* --- what it took, by roughness --------------------------------------------------------------- */

typedef struct effort {
    int count;
    double seconds;
} effort;
#define EFFORTS 1001 /* thousandths of roughness; zonal lobes at 0 */

static void print_efforts(const effort *efforts) {
    fprintf(stderr, "roughness  alpha   configurations  seconds\n");
    for (int k = 0; k < EFFORTS; k++)
        if (efforts[k].count)
            fprintf(stderr, "%9.3f  %.4f  %14d  %7.2f\n", k / 1e3, k * k / 1e6, efforts[k].count,
                    efforts[k].seconds);
}

static void print_one(int id, bool bands, effort *efforts) {
    const ruler_configuration c = ruler_configuration_at(id);
    const clock_t before = clock();
    (bands ? print_bands : print_value)(&c);
    efforts[c.roughness].count++;
    efforts[c.roughness].seconds += (double)(clock() - before) / CLOCKS_PER_SEC;
}

static bool parse(int argc, char **argv, arguments *a) {
    *a = (arguments) { .shard = 1, .shards = 1, .first_id = argc };
    for (int i = 1; i < argc; i++) {
        char rest;
        if (strcmp(argv[i], "--bands") == 0) {
            a->bands = true;
        } else if (strcmp(argv[i], "--shard") == 0 && i + 1 < argc) {
            if (sscanf(argv[++i], "%d/%d%c", &a->shard, &a->shards, &rest) != 2 || a->shard < 1 ||
                a->shard > a->shards)
                return false;
        } else if (atoi(argv[i]) >= 1 && atoi(argv[i]) <= ruler_configuration_count()) {
            a->first_id = i;
            return true;
        } else {
            return false;
        }
    }
    return true;
}

int main(int argc, char **argv) {
    arguments a;
    static effort efforts[EFFORTS];
    if (!parse(argc, argv, &a)) {
        fprintf(stderr, "lampion_ruler [--bands] [--shard I/N | ID…], IDs from 1 to %d\n",
                ruler_configuration_count());
        return 2;
    }
    if (a.shard == 1)
        print_header(a.bands);
    for (int i = a.first_id; i < argc; i++)
        print_one(atoi(argv[i]), a.bands, efforts);
    for (int id = a.shard; a.first_id == argc && id <= ruler_configuration_count(); id += a.shards)
        print_one(id, a.bands, efforts);
    print_efforts(efforts);
    ruler_integrate_cleanup();
    flint_cleanup();
    return fflush(stdout) == 0 ? 0 : 1;
}
