/* SPDX-License-Identifier: MIT */
/* The rule of --method auto: by the bands, then a field where it halves the cost of that many
 * lights. */
#include "app/render/method.h"
#include "tests/oracle/check.h"

static method_kind chosen(size_t lights, int bands, double pixels) {
    const method_work work = { lights, bands, pixels };
    return method_for_lights(method_chosen(0, bands), &work);
}

static void few_lights_are_summed_and_thousands_are_a_field(void **state) {
    (void)state;
    const double pixels[] = { 640 * 360, 1280 * 720, 3840 * 2160 };
    for (int p = 0; p < 3; p++)
        for (int bands = 3; bands <= 10; bands++) {
            assert_int_equal(chosen(3, bands, pixels[p]), METHOD_ZONAL);
            assert_int_equal(chosen(30, bands, pixels[p]), METHOD_ZONAL);
            assert_int_equal(chosen(4000, bands, pixels[p]), METHOD_FIELD);
        }
    assert_int_equal(chosen(4000, 11, pixels[0]), METHOD_ZONAL);
    assert_int_equal(chosen(3, 33, pixels[0]), METHOD_PREINTEGRATED);
    assert_int_equal(chosen(4000, 33, pixels[0]), METHOD_PREINTEGRATED);
    assert_int_equal(chosen(1000, 5, 16), METHOD_ZONAL); /* nodes outnumber pixels */
}

static void estimates_rise_with_lights_bands_and_pixels(void **state) {
    (void)state;
    static const method_kind kinds[] = { METHOD_ZONAL, METHOD_PREINTEGRATED, METHOD_FIELD };
    const method_work least = { 100, 5, 1e6 }, more[] = { { 200, 5, 1e6 }, { 100, 5, 2e6 } };
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 2; i++)
            assert_true(method_estimate(kinds[k], &more[i]) > method_estimate(kinds[k], &least));
    const method_work bands = { 100, 6, 1e6 }, too_many = { 100, 11, 1e6 };
    assert_true(method_estimate(METHOD_ZONAL, &bands) > method_estimate(METHOD_ZONAL, &least));
    assert_true(method_estimate(METHOD_FIELD, &bands) > method_estimate(METHOD_FIELD, &least));
    assert_true(method_estimate(METHOD_FIELD, &too_many) == 0);
    assert_true(method_estimate(METHOD_COEFFICIENTS, &least) == 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(few_lights_are_summed_and_thousands_are_a_field),
        cmocka_unit_test(estimates_rise_with_lights_bands_and_pixels),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
