/* SPDX-License-Identifier: MIT */
/* Lights files that are truncated or state the impossible. */
#include "tests/program/refused.h"

static void assert_lights_refused(const char *json, const char *expected) {
    char path[512], pixels[512];
    folder_write_text("lights.json", json);
    snprintf(path, sizeof path, "%s", in_folder("lights.json"));
    snprintf(pixels, sizeof pixels, "%s", in_folder("image.png"));
    const char *const arguments[] = { "lampion", "render", "builtin:ball", "--lights",
                                      path,      "-o",     pixels,         NULL };
    const int before = count_entries(folder);
    assert_one_line(run_program(arguments), json, expected);
    assert_int_equal(count_entries(folder), before);
}

#define GOOD "{\"position\":[0,1,0],\"radius\":1,\"radiance\":[1,1,1]}"
static const struct {
    const char *json, *expected;
} refusals[] = {
    { "", "lights.json" },
    { "{\"lights\":[" GOOD, "line 1, column 61: ']' expected near end of file" },
    { "{\n\"lights\":\n[NaN]}", "is not valid JSON: line 3, column 4: invalid token near 'NaN'" },
    { "{'lights':[]}", "line 1, column 2: string or '}' expected near ''' (names and texts stand "
                       "in double quotes)" },
    { "{lights:[]}", "string or '}' expected near 'lights'" },
    { "{\"lights\":[] // none\n}", "JSON has no comments" },
    { "{\"lights\" []}", "line 1, column 11: ':' expected near '['" },
    { "{\"lights\":[" GOOD "]} more", "is not valid JSON" },
    { "{\"lights\\u0000zzz\":[" GOOD "]}", "is not valid JSON: line 1" },
    { "{\"lights\":[{\"position\":[0,01,0],\"radius\":1,\"power\":1}]}", "invalid token near '0'" },
    { "\xef\xbb\xbf{\"lights\":[" GOOD "]}", "byte-order mark" },
    { "[]", "has no array" },
    { "{\"lights\":{}}", "has no array" },
    { "{\"lights\":[],\"lamps\":[]}", "has keys other" },
    { "{\"lights\":[" GOOD ",3]}", "lights[1] is not an object" },
    { "{\"lights\":[" GOOD ",{\"position\":[0,1],\"radius\":1,\"power\":1}]}",
      "lights[1].position is not three numbers" },
    { "{\"lights\":[{\"position\":[0,1,0],\"radius\":-1,\"power\":1}]}",
      "lights[0].radius is not above 0" },
    { "{\"lights\":[{\"position\":[0,1,0],\"radius\":0,\"power\":1}]}",
      "lights[0].radius is not above 0" },
    { "{\"lights\":[{\"position\":[0,1,0],\"radius\":1e999,\"power\":1}]}",
      "is not valid JSON: line 1, column 45: real number overflow near '1e999'" },
    { "{\"lights\":[{\"position\":[0,1,0],\"radius\":2e17,\"power\":1}]}",
      "lights[0].radius is not above 0, or above 1e17" },
    { "{\"lights\":[{\"position\":[0,1,2e17],\"radius\":1,\"power\":1}]}",
      "lights[0].position is not finite, or beyond 1e17" },
    { "{\"lights\":[{\"position\":[0,1e999,0],\"radius\":1,\"power\":1}]}",
      "real number overflow near '1e999'" },
    { "{\"lights\":[{\"position\":[0,1,0],\"radius\":1,\"power\":-1}]}",
      "lights[0].power is negative" },
    { "{\"lights\":[{\"position\":[0,1,0],\"radius\":1,\"power\":[1,1e60,1]}]}",
      "lights[0].power is negative, not finite or above 1e19" },
    { "{\"lights\":[{\"position\":[0,1,0],\"radius\":1,\"radiance\":[1,2e19,1]}]}",
      "lights[0].radiance is negative, not finite or above 1e19" },
    { "{\"lights\":[{\"position\":[0,1,0],\"radius\":1e-9,\"power\":1e3}]}",
      "lights[0].power is negative, not finite or above 1e19" },
    { "{\"lights\":[{\"kind\":\"directional\",\"direction\":[0,1,0],\"irradiance\":3e38}]}",
      "lights[0].irradiance is negative, not finite or above 1e19" },
    { "{\"lights\":[{\"kind\":\"hemisphere\",\"direction\":[0,1,0],\"radiance\":1,"
      "\"ground\":1e28}]}",
      "lights[0].ground is negative, not finite or above 1e19" },
    { "{\"lights\":[{\"position\":[0,1,0],\"radius\":1,\"power\":\"much\"}]}",
      "lights[0].power is not a number or three" },
    { "{\"lights\":[{\"position\":[0,1,0],\"radius\":1}]}",
      "lights[0] needs one of radiance, power, intensity" },
    { "{\"lights\":[{\"position\":[0,1,0],\"radius\":1,\"power\":1,\"radiance\":1}]}",
      "lights[0] needs one of radiance, power, intensity" },
    { "{\"lights\":[{\"position\":[0,1,0],\"radius\":1,\"color\":1}]}",
      "unknown key \"color\" (a sphere light has position, radius, "
      "radiance, power, intensity)" },
    { "{\"lights\":[{\"position\":[0,1,0],\"radius\":1,\"radius\":2,\"power\":1}]}",
      "duplicate object key near '\"radius\"'" },
    { "{\"lights\":[{\"kind\":\"cone\"}]}", "lights[0].kind is not one of sphere, point, " },
    { "{\"lights\":[{\"kind\":\"point\",\"position\":[0,1,0],\"radius\":1,"
      "\"intensity\":1}]}",
      "unknown key \"radius\" (a point light has position, intensity)" },
    { "{\"lights\":[{\"kind\":\"point\",\"position\":[0,1,0]}]}", "lights[0] needs intensity" },
    { "{\"lights\":[{\"kind\":\"cap\",\"direction\":[0,1,0],\"angle\":4,"
      "\"radiance\":1}]}",
      "lights[0].angle is not in 0 to pi" },
    { "{\"lights\":[{\"kind\":\"directional\",\"direction\":[0,0,0],"
      "\"irradiance\":1}]}",
      "lights[0].direction is not a direction" },
    { "{\"lights\":[{\"kind\":\"spot\",\"position\":[0,1,0],"
      "\"direction\":[0,-1,0],\"inner\":0.5,\"outer\":0.4,\"intensity\":1}]}",
      "lights[0].inner is above the outer angle" },
    { "{\"lights\":[{\"position\":[0,1,0],\"radius\":1,\"power\":1,"
      "\"hidden\":1}]}",
      "lights[0].hidden is neither true nor false" },
    { "{\"lights\":[{\"kind\":\"rectangle\",\"position\":[0,1,0],\"half_width\":[1,0,0],"
      "\"half_height\":[-2,0,0],\"power\":1}]}",
      "lights[0].half_height is parallel to .half_width" },
    { "{\"lights\":[{\"kind\":\"rectangle\",\"position\":[0,1,0],\"half_width\":[0,0,0],"
      "\"half_height\":[2,0,0],\"power\":1}]}",
      "lights[0].half_width is 0" },
    { "{\"lights\":[{\"kind\":\"disk\",\"position\":[0,1,0],\"direction\":[0,1,0],"
      "\"radius\":1,\"two_sided\":1,\"power\":1}]}",
      "lights[0].two_sided is not true or false" },
    { "{\"lights\":[{\"kind\":\"tube\",\"position\":[0,1,0],\"half_axis\":[0,1,0],"
      "\"power\":1}]}",
      "lights[0] needs radius" },
    { "{\"lights\":[{\"kind\":\"polygon\",\"position\":[0,1,0],"
      "\"corners\":[[0,0,0],[1,0,0]],\"power\":1}]}",
      "lights[0].corners is not a list of 3 to 8 corners, three numbers each" },
    { "{\"lights\":[{\"kind\":\"polygon\",\"position\":[0,1,0],"
      "\"corners\":[[0,0,0],[1,0,0],[2,0,0]],\"power\":1}]}",
      "lights[0].corners bound no area" },
    { "{\"lights\":[{\"kind\":\"polygon\",\"position\":[0,1,0],"
      "\"corners\":[[0,0,0],[1,0,0],[1,1,0.1],[0,1,0]],\"power\":1}]}",
      "lights[0].corners are not in a plane" },
    { "{\"lights\":[{\"kind\":\"polygon\",\"position\":[0,1,0],"
      "\"corners\":[[0,0,0],[2,2,0],[3,0,0],[0,1,0]],\"power\":1}]}",
      "lights[0].corners are in an order in which sides cross" },
};

static void faulty_lights_files_are_refused_by_the_light_s_number(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof refusals / sizeof *refusals; i++)
        assert_lights_refused(refusals[i].json, refusals[i].expected);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(faulty_lights_files_are_refused_by_the_light_s_number),
    };
    return cmocka_run_group_tests(tests, make_refused_folder, folder_remove);
}
