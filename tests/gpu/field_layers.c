/* SPDX-License-Identifier: MIT */
/* Shaders shade by a field what lobes alone cannot: tabulated materials, coats and sheen. */
#include "app/render/renderer/override.h"
#include "tests/gpu/fields.h"

#include <stdlib.h>

/* Every material is cloth, and every third lies under a coat; coats and sheen reflect what the
 * field gives there. Sheen under sums of lights would differ by more. */
static void shaders_draw_coats_and_sheen(void **state) {
    (void)state;
    override_set tables = { .count = 0 };
    base_error error = { "" };
    open_world("builtin:balls", 40);
    scene_material cloths[64];
    assert_true(world.material_count <= 64);
    for (size_t i = 0; i < world.material_count; i++) {
        scene_material *cloth = &cloths[i];
        *cloth = world.materials[i];
        cloth->sheen_color[0] = 1;
        cloth->sheen_color[1] = 0.5f;
        cloth->sheen_roughness = (float)(i + 1) / (float)world.material_count;
        cloth->coat = i % 3 == 0 ? 0.5f : 0;
    }
    world.materials = cloths;
    gpu_renderer *renderer = open_renderer(&world);
    render_frame frame = frame_of(&world, WIDTH, HEIGHT);
    frame.bands = 5;
    /* The library clamps sums that ring below 0 table by table, the shader once. */
    frame.window = LMP_WINDOW_HANNING;
    expect(override_bake_sheen(&tables, &world, frame.bands, frame.window, &error) &&
               override_apply(&tables, &world, &(any_renderer) { .gl = renderer }, &error),
           &error);
    shade_field *field = open_field_within(frame.bands, false, device.storage_max);
    const difference d = devices_differ(renderer, &frame, field);
    print_message("coats and sheen: at most %.1e of the local peak, %.1e in root mean square\n",
                  d.worst, d.rms);
    assert_true(!(d.worst > 1e-3) && !(d.rms > 3e-5));
    shade_field_destroy(field);
    gpu_renderer_destroy(renderer);
    override_free(&tables);
    scene_free(&world);
}

static lmp_brdf_table *table_of(lmp_brdf *brdf, int bands) {
    lmp_brdf_table *table = NULL;
    const lmp_brdf_table_desc desc = {
        .bands = bands, .views = 32, .azimuths = 16, .window = LMP_WINDOW_HANNING, .rings_max = 64
    };
    assert_int_equal(lmp_brdf_table_create(NULL, &desc, brdf, &table), LMP_OK);
    lmp_brdf_destroy(brdf);
    return table;
}

/* Devices interpolate tables differently; what must agree is how far a field's image is from that
 * of sums. */
static difference deviations_differ(gpu_renderer *renderer, render_frame *frame,
                                    shade_field *field) {
    image sums[2], by_field[2];
    for (int on_cpu = 0; on_cpu < 2; on_cpu++) {
        frame->cpu_shader = on_cpu ? shade_frame : NULL;
        sums[on_cpu] = render_by(renderer, frame, METHOD_ZONAL, NULL);
        by_field[on_cpu] = render_by(renderer, frame, METHOD_FIELD, field);
    }
    for (size_t i = 0; i < (size_t)3 * WIDTH * HEIGHT; i++)
        by_field[0].rgb[i] += sums[1].rgb[i] - sums[0].rgb[i];
    const difference d = differ(&by_field[0], &by_field[1]);
    for (int on_cpu = 0; on_cpu < 2; on_cpu++) {
        image_free(&sums[on_cpu]);
        image_free(&by_field[on_cpu]);
    }
    return d;
}

/* All materials share one table, and some surfaces lie outside the grid. */
static void expect_same_by_table(const char *what, lmp_brdf_table *table, int bands) {
    base_error error = { "" };
    const int uses[64] = { 0 };
    open_every_kind();
    assert_true(world.material_count <= 64);
    gpu_renderer *renderer = open_renderer(&world);
    render_frame frame = frame_of(&world, WIDTH, HEIGHT);
    frame.bands = bands;
    frame.window = LMP_WINDOW_HANNING;
    const lmp_brdf_table *const tables[] = { table };
    expect(gpu_set_tables(renderer, tables, 1, uses, &error), &error);
    for (int a = 0; a < 3; a++)
        world.maximum[a] = 0.3f * world.minimum[a] + 0.7f * world.maximum[a];
    shade_field *field = open_field_within(bands, false, device.storage_max);
    expect_same(what, deviations_differ(renderer, &frame, field));
    shade_field_destroy(field);
    gpu_renderer_destroy(renderer);
    scene_free(&world);
    lmp_brdf_table_destroy(table);
}

static void shaders_draw_tabulated_materials_by_the_field(void **state) {
    (void)state;
    const lmp_ggx brushed = { 0.6f, 0.3f, { 0.9f, 0.8f, 0.6f }, { 0.1f, 0.1f, 0.1f } };
    lmp_brdf *phong = NULL, *ggx = NULL;
    assert_int_equal(lmp_brdf_create_phong(NULL, (lmp_rgb) { 0.8f, 0.6f, 0.3f }, 5, &phong),
                     LMP_OK);
    assert_int_equal(lmp_brdf_create_ggx(NULL, &brushed, &ggx), LMP_OK);
    expect_same_by_table("a mirrored table", table_of(phong, 5), 5);
    expect_same_by_table("an anisotropic table", table_of(ggx, 5), 5);
}

int main(int count, char **arguments) {
    const struct CMUnitTest layers[] = {
        cmocka_unit_test(shaders_draw_coats_and_sheen),
    };
    const struct CMUnitTest tables[] = {
        cmocka_unit_test(shaders_draw_tabulated_materials_by_the_field),
    };
    int ran = 0, failed = 0;
    RUN_GROUP(layers);
    RUN_GROUP(tables);
    return ran > 0 ? failed : 1;
}
