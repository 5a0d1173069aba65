/* SPDX-License-Identifier: MIT */
/* Shaders draw by a field what is more than lobes: tabulated materials, coats and sheen. */
#include "app/override/override.h"
#include "tests/gpu/fields.h"

#include <stdlib.h>

/* Every material is cloth, and every third lies under a coat: coats and fibers reflect what the
 * field gives there. Fibers that sum lights are off by more. */
static void shaders_draw_coats_and_sheen(void **state) {
    (void)state;
    override_set tables = { .count = 0 };
    cli_error error = { "" };
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
    /* Sums that ring below 0 are clamped table by table by the library, once by the shader. */
    frame.window = LMP_WINDOW_HANNING;
    expect(override_bake_fibers(&tables, &world, frame.bands, frame.window, &error) &&
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

/* Devices interpolate tables differently: what is the same is by how much a field's image is off
 * from that of sums. */
static difference deviations_differ(gpu_renderer *renderer, render_frame *frame,
                                    shade_field *field) {
    image sums[2], by_field[2];
    for (int host = 0; host < 2; host++) {
        frame->host = host ? shade_frame : NULL;
        sums[host] = render_by(renderer, frame, METHOD_ZONAL, NULL);
        by_field[host] = render_by(renderer, frame, METHOD_FIELD, field);
    }
    for (size_t i = 0; i < (size_t)3 * WIDTH * HEIGHT; i++)
        by_field[0].rgb[i] += sums[1].rgb[i] - sums[0].rgb[i];
    const difference d = differ(&by_field[0], &by_field[1]);
    for (int host = 0; host < 2; host++) {
        image_free(&sums[host]);
        image_free(&by_field[host]);
    }
    return d;
}

/* Every material by one table, and some surfaces outside of the grid. */
static void expect_same_by_table(const char *what, lmp_brdf_table *table, int bands) {
    cli_error error = { "" };
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
