/* SPDX-License-Identifier: MIT */
/* bake_brdf.c - a BRDF baked to a table of SH coefficients, stored, read back and lit.
 *
 *     cc bake_brdf.c $(pkg-config --cflags --libs lampion) -lm -o bake_brdf
 *     ./bake_brdf brass.lmpt */
#include <lampion/lampion.h>

#include <stdio.h>
#include <stdlib.h>

static lmp_brdf_table *bake(void) {
    const lmp_ggx brass = { .alpha_x = 0.3f, .f0 = { 0.89f, 0.79f, 0.43f } };
    const lmp_brdf_table_desc desc = { .bands = 10, .views = 64, .window = LMP_WINDOW_HANNING };
    lmp_brdf *brdf;
    lmp_brdf_table *table = NULL;
    if (lmp_brdf_create_ggx(NULL, &brass, &brdf) == LMP_OK)
        lmp_brdf_table_create(NULL, &desc, brdf, &table);
    lmp_brdf_destroy(brdf);
    return table;
}

/* Writes the table to a file and reads it back; the library itself touches no files. */
static lmp_brdf_table *store_and_load(const lmp_brdf_table *table, const char *path) {
    const size_t size = lmp_brdf_table_size(table);
    void *const bytes = malloc(size);
    lmp_brdf_table *loaded = NULL;
    lmp_parse_error error = { .text = "out of memory" };
    FILE *file = fopen(path, "w+b");
    if (bytes && file) {
        lmp_brdf_table_write(table, lmp_brdf_table_size(table), bytes);
        fwrite(bytes, 1, size, file);
        rewind(file);
        const size_t got = fread(bytes, 1, size, file);
        lmp_brdf_table_read(NULL, bytes, got, &error, &loaded);
    }
    if (file)
        fclose(file);
    if (loaded)
        printf("%s: %zu bytes\n", path, size);
    else
        fprintf(stderr, "%s: %s\n", path, error.text);
    free(bytes);
    return loaded;
}

int main(int argc, char **argv) {
    lmp_brdf_table *const baked = bake();
    lmp_brdf_table *const table = store_and_load(baked, argc > 1 ? argv[1] : "brass.lmpt");
    lmp_brdf_table_destroy(baked);
    if (!table)
        return 1;

    const lmp_brdf_table_info info = lmp_brdf_table_describe(table);
    printf("%d bands, %d views, %zu coefficients a view and channel\n", info.bands, info.views,
           info.count);
    puts("degrees  reflects  its series");
    for (int view = 0; view < info.views; view += 16) {
        lmp_rgb exact, series;
        lmp_brdf_table_find_albedo(table, view, 0, &exact, &series);
        printf("%7.1f  %8.3f  %10.3f\n", (double)(info.theta_step * (float)view) * 57.29578,
               (double)exact.g, (double)series.g);
    }

    const lmp_light lamp = { .position = { -1, 2, 0 }, .radius = 0.3f, .radiance = { 10, 10, 10 } };
    const lmp_surface surface = { .normal = { 0, 1, 0 }, .view = { 0.447214f, 0.894427f, 0 } };
    const lmp_material brass = { .kind = LMP_MATERIAL_TABLE, .table = table };
    const lmp_rgb color = lmp_shade(NULL, &brass, &surface, &lamp, 1);
    printf("under a lamp: %.3f %.3f %.3f\n", (double)color.r, (double)color.g, (double)color.b);
    lmp_brdf_table_destroy(table);
    return 0;
}
