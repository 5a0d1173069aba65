/* SPDX-License-Identifier: MIT */
/* lampion field: its files, read by jansson, as lines of CSV, by NumPy's specification and by the
 * library, hold the same numbers; and engines' shaders find the light of the scene in them. */
#include "tests/program/volume.h"
#include "tests/oracle/engines.h"

#include <lampion/field.h>
#include <sys/wait.h>
#include <unistd.h>

static const lmp_light lights[] = {
    { .position = { 3, 4, 1 }, .radius = 0.5f, .radiance = { 10, 8, 5 } },
    { .position = { -4, 2, 2 }, .radius = 1.5f, .radiance = { 1, 2, 3 } },
};
enum { LIGHTS = sizeof lights / sizeof *lights };

/* Runs `lampion field` with arguments for the shell on a scene with a wall at x = 1.5 from z = -9
 * to 0.5; returns its status. */
static int field(const char *arguments) {
    char command[1024];
    snprintf(command, sizeof command,
             "cd '%s' && \"$LAMPION_PROGRAM\" field wall.obj --lights lights.json " GRID "%s 2>err",
             folder, arguments);
    const int status = system(command);
    assert_true(WIFEXITED(status));
    return WEXITSTATUS(status);
}

/* --- what they hold --------------------------------------------------------------------------- */

/* Finds the position of a node in the scene. */
static void node_position(int i, double position[3]) {
    position[0] = -2 + i % NX;
    position[1] = 0.75 * (i / NX % NY);
    position[2] = -1 + i / NX / NY;
}

/* Sums what the lights reflect off a white surface, by three bands or exactly; returns false where
 * the exact form does not hold, because a light is not wholly above the surface. */
static bool reflects(const double at[3], const double n[3], int c, bool exact, double *sum) {
    *sum = 0;
    for (int k = 0; k < LIGHTS; k++) {
        const lmp_vec3 center = lights[k].position;
        const double to[3] = { (double)center.x - at[0], (double)center.y - at[1],
                               (double)center.z - at[2] };
        const double d = sqrt(to[0] * to[0] + to[1] * to[1] + to[2] * to[2]);
        const double r = (double)lights[k].radius;
        const double cosine = (to[0] * n[0] + to[1] * n[1] + to[2] * n[2]) / d;
        const double radiance = (double)(&lights[k].radiance.r)[c];
        if (exact && !(cosine > r / d))
            return false;
        *sum +=
            radiance / ORACLE_PI *
            (exact ? sphere_irradiance(r, d, cosine) : sphere_irradiance_of_3_bands(r, d, cosine));
    }
    return true;
}

static void expect_positions(const probes *p, lmp_probe_engine engine) {
    for (int i = 0; i < PROBES; i++) {
        double ours[3], theirs[3];
        node_position(i, ours);
        engine_direction(engine, ours, theirs);
        for (int k = 0; k < 3; k++)
            CHECK_WITHIN(
                fabs(p->position[i][k] - theirs[k] * (engine == LMP_PROBE_UNREAL ? 100 : 1)), 1e-4);
    }
}

static void shaders_of_engines_light_surfaces_as_the_lights_do(void **state) {
    (void)state;
    static probes p;
    for (int e = 0; e < LMP_PROBE_ENGINE_COUNT; e++) {
        const lmp_probe_engine engine = (lmp_probe_engine)e;
        const char *name = lmp_probe_engine_format(engine)->name;
        char arguments[128];
        snprintf(arguments, sizeof arguments, "--preset %s -o probes.json", name);
        assert_int_equal(field(arguments), 0);
        read_json("probes.json", name, &p);
        assert_int_equal(p.value_count, 27);
        expect_positions(&p, engine);
        int judged = 0;
        for (int i = 0; i < 8 * PROBES; i++) {
            const lmp_vec3 random = check_random_direction();
            const double n[3] = { (double)random.x, (double)random.y, (double)random.z };
            double at[3], expected;
            node_position(i % PROBES, at);
            const double found = engine_reflects(engine, p.values[i % PROBES], i % 3, n);
            reflects(at, n, i % 3, false, &expected);
            CHECK_WITHIN(fabs(found - expected), 1e-5);
            if (reflects(at, n, i % 3, true, &expected) && ++judged)
                CHECK_WITHIN(fabs(found - expected), 0.1 * expected + 0.01);
        }
        assert_true(judged > PROBES / 4);
    }
}

/* Returns the least value that a probe's shader finds in many directions, relative to the largest.
 */
static double darkest(lmp_probe_engine engine, const float *values) {
    double least = HUGE_VAL, most = 0;
    for (int i = 0; i < 3 * 2000; i++) {
        const lmp_vec3 random = check_random_direction();
        const double n[3] = { (double)random.x, (double)random.y, (double)random.z };
        const double found = engine_reflects(engine, values, i % 3, n);
        least = fmin(least, found);
        most = fmax(most, found);
    }
    return least / most;
}

static void no_shader_finds_less_than_darkness_where_ringing_is_gone(void **state) {
    (void)state;
    static probes p;
    folder_write_text("one.json", "{ \"lights\": [ { \"position\": [3, 4, 1], \"radius\": 0.1, "
                                  "\"radiance\": [9, 4, 1] } ] }");
    for (int e = 0; e < LMP_PROBE_ENGINE_COUNT; e++)
        for (int damped = 0; damped < 2; damped++) {
            const lmp_probe_engine engine = (lmp_probe_engine)e;
            const char *name = lmp_probe_engine_format(engine)->name;
            char arguments[128];
            snprintf(arguments, sizeof arguments, "--lights one.json --preset %s %s -o probes.json",
                     name, damped ? "--dering" : "");
            assert_int_equal(field(arguments), 0);
            read_json("probes.json", name, &p);
            for (int i = 0; i < PROBES; i++) {
                const double least = darkest(engine, p.values[i]);
                /* the weakest window leaves the least at 0 */
                assert_true(damped ? least > -1e-6 && least < 0.01 : least < -0.02);
            }
        }
    assert_int_equal(field("--dering -o probes.lmpf"), 2);
}

static void expect_same(const probes *a, const probes *b) {
    assert_int_equal(a->value_count, b->value_count);
    for (int i = 0; i < PROBES; i++)
        for (int k = 0; k < a->value_count; k++)
            assert_true(a->values[i][k] == b->values[i][k]);
}

static void every_file_holds_the_same_numbers(void **state) {
    (void)state;
    static probes json, other;
    assert_int_equal(field("--preset filament -o probes.json"), 0);
    read_json("probes.json", "filament", &json);
    assert_int_equal(field("--preset filament -o probes.csv"), 0);
    read_csv("probes.csv", &other);
    expect_same(&json, &other);
    expect_positions(&other, LMP_PROBE_FILAMENT);
    assert_int_equal(field("--preset filament --layout planar -o planar.json"), 0);
    read_json("planar.json", "filament", &other);
    expect_same(&json, &other);
    for (int planar = 0; planar < 2; planar++) {
        assert_int_equal(field(planar ? "--preset filament --layout planar -o probes.npy"
                                      : "--preset filament -o probes.npy"),
                         0);
        read_npy("probes.npy", false, planar, &other);
        expect_same(&json, &other);
    }
}

static void light_past_every_number_is_not_written(void **state) {
    (void)state;
    static const char *const names[] = { "inf.json", "inf.csv", "inf.npy", "inf.lmpf" };
    folder_write_text("inf.json.lights",
                      "{ \"lights\": [ { \"kind\": \"point\", \"position\": [0, 0.2, 0], "
                      "\"intensity\": [3e38, 1, 1] } ] }");
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        char words[96];
        snprintf(words, sizeof words, "--lights inf.json.lights -o %s", names[i]);
        assert_int_equal(field(words), 1);
        assert_int_not_equal(access(in_folder(names[i]), F_OK), 0);
    }
}

static void half_is_the_nearest_of_16_bits(void **state) {
    (void)state;
    static probes whole, text, binary;
    assert_int_equal(field("-o probes.json"), 0);
    read_json("probes.json", "lampion", &whole);
    assert_int_equal(field("--half -o half.json"), 0);
    read_json("half.json", "lampion", &text);
    assert_int_equal(field("--half --layout planar -o half.npy"), 0);
    read_npy("half.npy", true, true, &binary);
    expect_same(&text, &binary);
    for (int i = 0; i < PROBES; i++)
        for (int k = 0; k < 27; k++)
            CHECK_WITHIN(fabsf(whole.values[i][k] - text.values[i][k]),
                         fmaxf(fabsf(whole.values[i][k]) * 0x1p-11f, 0x1p-25f));
    folder_write_text("bright.json", "{ \"lights\": [ { \"position\": [0, 1, 0], \"radius\": 1, "
                                     "\"radiance\": [1e6, 1, 1] } ] }");
    assert_int_equal(field("--lights bright.json --half -o bright.npy"), 1);
    assert_null(fopen(in_folder("bright.npy"), "rb"));
}

/* --- the library's own ------------------------------------------------------------------------ */

static void the_own_preset_keeps_coefficients_of_any_bands(void **state) {
    (void)state;
    static probes p;
    assert_int_equal(field("--bands 5 -o probes.json"), 0);
    read_json("probes.json", "lampion", &p);
    assert_int_equal(p.value_count, 75);
    for (int i = 0; i < PROBES; i++) {
        double at[3];
        float sh[75];
        node_position(i, at);
        lmp_light_project(5, lights, LIGHTS,
                          (lmp_vec3) { (float)at[0], (float)at[1], (float)at[2] }, sh);
        for (int k = 0; k < 75; k++)
            CHECK_WITHIN(fabsf(p.values[i][k] - sh[k]), 1e-6);
    }
}

static void the_library_reads_its_field(void **state) {
    (void)state;
    static probes p;
    size_t size;
    lmp_field *read;
    assert_int_equal(field("-o probes.json"), 0);
    read_json("probes.json", "lampion", &p);
    assert_int_equal(field("-o probes.lmpf"), 0);
    const char *bytes = read_text("probes.lmpf", &size);
    assert_int_equal(lmp_field_read(NULL, bytes, size, NULL, &read), LMP_OK);
    assert_int_equal(lmp_field_describe(read).light_count, LIGHTS);
    for (int i = 0; i < PROBES; i++) {
        double at[3];
        float sh[27];
        node_position(i, at);
        const lmp_vec3 point = { (float)at[0], (float)at[1], (float)at[2] };
        lmp_field_eval_n(read, lmp_vec3_array_same(&point), 1, lmp_sh_interleaved(sh, 0));
        for (int k = 0; k < 27; k++)
            CHECK_WITHIN(fabsf(p.values[i][k] - sh[k]), 1e-5);
    }
    lmp_field_destroy(read);
}

/* Runs `lampion info` with arguments for the shell; returns its status. */
static int info(const char *arguments) {
    char command[512];
    snprintf(command, sizeof command, "cd '%s' && \"$LAMPION_PROGRAM\" info %s >out 2>err", folder,
             arguments);
    const int status = system(command);
    assert_true(WIFEXITED(status));
    return WEXITSTATUS(status);
}

static void info_tells_what_a_field_holds(void **state) {
    (void)state;
    size_t size;
    assert_int_equal(field("--bands 4 -o told.lmpf"), 0);
    assert_int_equal(info("told.lmpf"), 0);
    const char *text = read_text("out", &size);
    assert_non_null(strstr(text, "4x3x5 nodes, cells of 1 0.75 1\n"));
    assert_non_null(strstr(text, "bounds     -2 0 -1 … 1 1.5 3\n"));
    assert_non_null(strstr(text, "bands      4\n"));
    assert_non_null(strstr(text, "lights     2: 2 sphere ("));
    assert_int_equal(info("--json told.lmpf"), 0);
    json_t *root = json_loads(read_text("out", &size), 0, NULL);
    json_t *nodes = json_object_get(root, "nodes");
    json_t *maximum = json_object_get(root, "maximum");
    assert_int_equal((int)number_at(nodes, 0), NX);
    assert_int_equal((int)number_at(nodes, 2), NZ);
    assert_true(number_at(maximum, 1) == 1.5);
    assert_string_equal(text_of(root, "layout"), "interleaved");
    assert_string_equal(text_of(root, "precision"), "float");
    json_decref(root);
    assert_int_equal(info("--materials told.lmpf"), 2);
    assert_int_equal(info("missing.lmpf"), 1);
    char *bytes = read_text("told.lmpf", &size);
    bytes[size / 2] ^= 1;
    folder_write("damaged.lmpf", bytes, size);
    assert_int_equal(info("damaged.lmpf"), 1);
    assert_non_null(strstr(read_text("err", &size), "damaged.lmpf: "));
    folder_write_text("none.lmpf", "{}");
    assert_int_equal(info("none.lmpf"), 1);
    assert_non_null(strstr(read_text("err", &size), "none.lmpf: is not a field"));
}

/* --- shadows ---------------------------------------------------------------------------------- */

/* The wall ends at z = 0.5: it hides the first light from the probes whose rays to it all cross x =
 * 1.5 below that, and not where they all cross above; the second light stands on the other side. */
static void walls_keep_light_from_probes(void **state) {
    (void)state;
    static probes open, shadowed;
    assert_int_equal(field("-o open.json"), 0);
    read_json("open.json", "lampion", &open);
    assert_int_equal(field("--shadows -o shadowed.json"), 0);
    read_json("shadowed.json", "lampion", &shadowed);
    int hidden = 0, seen = 0;
    for (int i = 0; i < PROBES; i++) {
        double at[3];
        float sh[27];
        node_position(i, at);
        const double cross = at[2] + (1.5 - at[0]) / (3 - at[0]) * (1 - at[2]) - 0.5;
        lmp_light_project(3, lights + 1, 1, (lmp_vec3) { (float)at[0], (float)at[1], (float)at[2] },
                          sh);
        if (fabs(cross) < 0.4)
            continue;
        for (int k = 0; k < 27; k++) {
            const float expected = cross < 0 ? sh[k] : open.values[i][k];
            CHECK_WITHIN(fabsf(shadowed.values[i][k] - expected), 1e-6);
        }
        cross < 0 ? hidden++ : seen++;
    }
    assert_true(hidden > 0 && seen > 0);
}

static void the_environment_lights_every_probe(void **state) {
    (void)state;
    static probes dark, lit;
    assert_int_equal(field("--environment none -o dark.json"), 0);
    read_json("dark.json", "lampion", &dark);
    assert_int_equal(field("--environment studio -o lit.json"), 0);
    read_json("lit.json", "lampion", &lit);
    for (int k = 0; k < 27; k++)
        for (int i = 0; i < PROBES; i++) {
            const float added = lit.values[i][k] - dark.values[i][k];
            CHECK_WITHIN(fabsf(added - (lit.values[0][k] - dark.values[0][k])), 1e-4);
            assert_true(k % 9 != 0 || added > 0.1f);
        }
    assert_int_equal(field("--environment studio -o lit.lmpf"), 1);
}

/* --- what is refused -------------------------------------------------------------------------- */

static void what_cannot_be_written_is_refused_in_one_line(void **state) {
    (void)state;
    static const struct refusal {
        const char *arguments, *text;
        int status;
    } refusals[] = {
        { "", "-o FILE is needed", 2 },
        { "--bounces 2 -o x.lmpf", "bounces", 2 },
        { "-o p.txt", "unknown kind of file", 2 },
        { "-o p.csv --layout planar", "--layout planar takes .json or .npy", 2 },
        { "-o p.lmpf --preset unity", "a .lmpf has no preset", 2 },
        { "-o p.lmpf --half", "a .lmpf has no preset", 2 },
        { "-o p.lmpf --shadows", "a .lmpf has no preset", 2 },
        { "-o p.json --preset godot --bands 4", "--bands 4: godot keeps 3", 2 },
        { "-o p.json --grid 1024x1024x1024", "more than 16777216 probes", 2 },
        { "-o p.json --minimum 5,0,0", "the grid ends before it begins: x from 5 to 1", 1 },
        { "-o p.json --maximum -2,0,-1", "the grid has no extent", 1 },
    };
    for (size_t i = 0; i < sizeof refusals / sizeof *refusals; i++) {
        size_t size;
        assert_int_equal(field(refusals[i].arguments), refusals[i].status);
        const char *said = read_text("err", &size);
        if (!strstr(said, refusals[i].text) || strchr(said, '\n') != said + size - 1)
            fail_msg("%s: %s", refusals[i].arguments, said);
    }
}

/* --- examples/read_probes.c ------------------------------------------------------------------- */

static void read_at(const double at[3], const double n[3], double rgb[3]) {
    char command[1024];
    snprintf(command, sizeof command, "'%s' '%s/probes.csv' %.9g %.9g %.9g %.9g %.9g %.9g",
             READ_PROBES, folder, at[0], at[1], at[2], n[0], n[1], n[2]);
    FILE *output = popen(command, "r");
    assert_non_null(output);
    assert_int_equal(fscanf(output, "%lf %lf %lf", &rgb[0], &rgb[1], &rgb[2]), 3);
    assert_int_equal(pclose(output), 0);
}

/* Returns what the eight nodes around a point reflect, weighted by their distance. */
static double between_nodes(const double at[3], const double n[3], int c) {
    static const double origin[3] = { -2, 0, -1 }, step[3] = { 1, 0.75, 1 };
    double sum = 0;
    for (int corner = 0; corner < 8; corner++) {
        double node[3], weight = 1, reflected;
        for (int a = 0; a < 3; a++) {
            const double cells = (at[a] - origin[a]) / step[a], fraction = cells - floor(cells);
            const int up = corner >> a & 1;
            node[a] = origin[a] + step[a] * (floor(cells) + up);
            weight *= up ? fraction : 1 - fraction;
        }
        reflects(node, n, c, false, &reflected);
        sum += weight * reflected;
    }
    return sum;
}

static void the_example_reads_probes_and_what_lies_between(void **state) {
    (void)state;
    assert_int_equal(field("--preset filament -o probes.csv"), 0);
    const double n[3] = { 0.48, 0.8, 0.36 }, at[2][3] = { { -1, 0.75, 2 }, { -1.3, 0.5, 1.4 } };
    for (int i = 0; i < 2; i++) {
        double rgb[3];
        read_at(at[i], n, rgb);
        for (int c = 0; c < 3; c++)
            CHECK_WITHIN(fabs(rgb[c] - between_nodes(at[i], n, c)), 2e-5);
    }
}

static int make_scene(void **state) {
    (void)state;
    if (!mkdtemp(folder) || !getenv("LAMPION_PROGRAM"))
        return -1;
    folder_write_text("wall.obj",
                      "v 1.5 -9 -9\nv 1.5 9 -9\nv 1.5 9 0.5\nv 1.5 -9 0.5\nf 1 2 3 4\n");
    folder_write_text("lights.json",
                      "{ \"lights\": [ { \"position\": [3, 4, 1], \"radius\": 0.5, "
                      "\"radiance\": [10, 8, 5] }, { \"position\": [-4, 2, 2], \"radius\": 1.5, "
                      "\"radiance\": [1, 2, 3] } ] }");
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shaders_of_engines_light_surfaces_as_the_lights_do),
        cmocka_unit_test(no_shader_finds_less_than_darkness_where_ringing_is_gone),
        cmocka_unit_test(every_file_holds_the_same_numbers),
        cmocka_unit_test(light_past_every_number_is_not_written),
        cmocka_unit_test(half_is_the_nearest_of_16_bits),
        cmocka_unit_test(the_own_preset_keeps_coefficients_of_any_bands),
        cmocka_unit_test(the_library_reads_its_field),
        cmocka_unit_test(info_tells_what_a_field_holds),
        cmocka_unit_test(walls_keep_light_from_probes),
        cmocka_unit_test(the_environment_lights_every_probe),
        cmocka_unit_test(what_cannot_be_written_is_refused_in_one_line),
        cmocka_unit_test(the_example_reads_probes_and_what_lies_between),
    };
    return cmocka_run_group_tests(tests, make_scene, folder_remove);
}
