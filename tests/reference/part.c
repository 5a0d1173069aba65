/* SPDX-License-Identifier: MIT */
/* Parts of one image and their join, against sums over all samples at once, by their definitions.
 */
#include "app/truth/reference_part.h"

#include "tests/program/folder.h"

#include <math.h>

enum { WIDTH = 3, HEIGHT = 2, VALUES = 3 * WIDTH * HEIGHT, SAMPLES = 14, PARTS = 3 };

/* The rendered samples of every value, and the scene and words that they belong to. */
static double drawn[SAMPLES][VALUES];
static char block[] = "the triangles";
static scene_light light;
static scene world = { .block = block, .block_size = sizeof block, .lights = &light };
static reference_settings settings = { .width = WIDTH, .height = HEIGHT, .samples = SAMPLES };
static float mean_values[VALUES], error_values[VALUES];
static image mean = { WIDTH, HEIGHT, mean_values }, spread = { WIDTH, HEIGHT, error_values };
#define WORDS "reference a.gltf --samples 14"

/* Computes mean and standard error of every step-th sample from `first` on, summed twice. */
static void estimate(int first, int step, double means[VALUES], double errors[VALUES]) {
    const double n = (SAMPLES - first + step - 1) / step;
    for (int v = 0; v < VALUES; v++) {
        double sum = 0, squares = 0;
        for (int i = first; i < SAMPLES; i += step)
            sum += drawn[i][v];
        means[v] = sum / n;
        for (int i = first; i < SAMPLES; i += step)
            squares += (drawn[i][v] - means[v]) * (drawn[i][v] - means[v]);
        errors[v] = n > 1 ? sqrt(squares / (n - 1)) / sqrt(n) : 0;
    }
}

static int draw(void **state) {
    for (int i = 0; i < SAMPLES; i++)
        for (int v = 0; v < VALUES; v++)
            drawn[i][v] = check_random_between(0, v + 1) + 100 * (v == 4);
    return folder_make(state);
}

/* Writes `mean` and `spread` as a part of the run of those words. */
static void write_values(const char *name, const char *text) {
    char copy[128], *words[16] = { NULL };
    int count = 0;
    snprintf(copy, sizeof copy, "%s", text);
    for (char *word = strtok(copy, " "); word; word = strtok(NULL, " "))
        words[count++] = word;
    const image_layer layers[] = { { NULL, &mean }, { "stderr", &spread } };
    base_error error;
    if (!reference_part_write(in_folder(name), &settings, &world, words, layers, &error))
        fail_msg("%s", error.text);
}

/* Writes part I of N under a name, as of the run of those words. */
static void write_part_of(const char *name, int part, int parts, const char *words) {
    double means[VALUES], errors[VALUES];
    settings.shard[0] = part;
    settings.shard[1] = parts;
    estimate(part - 1, parts, means, errors);
    for (int v = 0; v < VALUES; v++) {
        mean.rgb[v] = (float)means[v];
        spread.rgb[v] = (float)errors[v];
    }
    write_values(name, words);
}

static void write_part(const char *name, int part) {
    write_part_of(name, part, PARTS, WORDS);
}

typedef struct joined {
    image mean, error;
    base_error message;
    bool ok;
} joined;

/* Joins the files of those names, at most PARTS. The caller frees the images. */
static joined join(bool partial, int count, const char *const *names) {
    static char paths[PARTS][512];
    char *list[PARTS];
    joined all;
    for (int i = 0; i < count; i++) {
        snprintf(paths[i], sizeof paths[i], "%s", in_folder(names[i]));
        list[i] = paths[i];
    }
    all.ok = reference_parts_join(list, count, partial, &all.mean, &all.error, &all.message);
    return all;
}
#define JOIN(partial, ...)                                                                         \
    join(partial, (int)(sizeof((const char *[]) { __VA_ARGS__ }) / sizeof(const char *)),          \
         (const char *[]) { __VA_ARGS__ })

static void assert_refused(joined all, const char *expected) {
    if (all.ok)
        fail_msg("joined, but: %s", expected);
    if (!strstr(all.message.text, expected))
        fail_msg("\"%s\" is not \"%s\"", all.message.text, expected);
    assert_true(!all.mean.rgb && !all.error.rgb);
}

static void assert_joined(joined all) {
    if (!all.ok)
        fail_msg("%s", all.message.text);
    image_free(&all.mean);
    image_free(&all.error);
}

static void parts_join_to_all_samples_at_once(void **state) {
    (void)state;
    double means[VALUES], errors[VALUES];
    write_part("1.exr", 1);
    write_part("2.exr", 2);
    write_part("3.exr", 3);
    joined all = JOIN(false, "2.exr", "1.exr", "3.exr");
    assert_true(all.ok && all.mean.width == WIDTH && all.mean.height == HEIGHT);
    estimate(0, 1, means, errors);
    for (int v = 0; v < VALUES; v++) {
        CHECK_WITHIN(fabs((double)all.mean.rgb[v] / means[v] - 1), 3e-7);
        CHECK_WITHIN(fabs((double)all.error.rgb[v] / errors[v] - 1), v == 4 ? 3e-5 : 3e-6);
    }
    assert_joined(all);
}

/* The values 1, 2 and 4 have a mean of 7/3, squares around it of 14/3, and an error of the root of
 * 7/9. A part of one sample has no error of its own, so its distance from the others is all there
 * is. */
static void parts_of_one_sample_each_err_by_how_they_differ(void **state) {
    (void)state;
    static const char *const names[] = { "one.exr", "two.exr", "four.exr" };
    settings.samples = 3;
    memset(error_values, 0, sizeof error_values);
    for (int i = 0; i < 3; i++) {
        for (int v = 0; v < VALUES; v++)
            mean.rgb[v] = (float)(1 << i);
        settings.shard[0] = i + 1;
        settings.shard[1] = 3;
        write_values(names[i], WORDS);
    }
    settings.samples = SAMPLES;
    joined all = join(false, 3, names);
    assert_true(all.ok);
    for (int v = 0; v < VALUES; v++) {
        CHECK_WITHIN(fabs((double)all.mean.rgb[v] - 7 / 3.0), 1e-6);
        CHECK_WITHIN(fabs((double)all.error.rgb[v] - sqrt(7 / 9.0)), 1e-6);
    }
    assert_joined(all);
    all = JOIN(true, "four.exr");
    assert_true(all.ok);
    assert_true(all.mean.rgb[VALUES - 1] == 4 && all.error.rgb[VALUES - 1] == 0);
    assert_joined(all);
}

static void a_missing_part_and_one_given_twice_are_named(void **state) {
    (void)state;
    write_part("1.exr", 1);
    write_part("2.exr", 2);
    write_part("3.exr", 3);
    assert_refused(JOIN(false, "3.exr", "1.exr"), "part 2 of 3 is missing");
    assert_refused(JOIN(false, "1.exr", "2.exr"), "part 3 of 3 is missing");
    assert_refused(JOIN(false, "2.exr", "3.exr"), "part 1 of 3 is missing");
    assert_refused(JOIN(true, "1.exr", "2.exr", "1.exr"), "is part 1 of 3, as ");
    assert_joined(JOIN(true, "3.exr", "1.exr"));
}

/* Each change of what is rendered makes another run; changes of where and how the result is written
 * do not. */
static void parts_belong_together_by_what_they_render(void **state) {
    (void)state;
    write_part("1.exr", 1);
    static const char *const others[] = { "reference a.gltf --samples 15",
                                          "reference a.gltf --samples 14 --shadows",
                                          "reference a.gltf --outputs 14" };
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        write_part_of("2.exr", 2, PARTS, others[i]);
        assert_refused(JOIN(true, "1.exr", "2.exr"), "is of another scene or other settings than");
    }
    static const char *const same[] = {
        "reference a.gltf -o b --shard 2/3 --samples 14",
        "reference -ob a.gltf --shard=2/3 --samples 14 --threads=1",
        "reference --output b a.gltf --samples 14 --threads 7",
        "reference a.gltf --output=b --samples 14 --threads",
    };
    for (size_t i = 0; i < sizeof same / sizeof *same; i++) {
        write_part_of("2.exr", 2, PARTS, same[i]);
        assert_joined(JOIN(true, "1.exr", "2.exr"));
    }
    write_part_of("2.exr", 2, 4, WORDS);
    assert_refused(JOIN(true, "1.exr", "2.exr"), "is of another scene or other settings than");
}

static void assert_another_run(void) {
    write_part("2.exr", 2);
    assert_refused(JOIN(true, "1.exr", "2.exr"), "is of another scene or other settings than");
}

static void all_that_was_read_makes_the_run(void **state) {
    (void)state;
    static float sky[6] = { 1, 1, 1, 1, 1, 1 };
    static environment around = { .light = { 2, 1, sky } };
    static const scene_material materials[1];
    static reference_material_source made[1];
    world.light_count = world.material_count = 1;
    world.materials = materials;
    settings.environment = &around;
    settings.materials = made;
    write_part("1.exr", 1);
    write_part("2.exr", 2);
    assert_joined(JOIN(true, "1.exr", "2.exr"));

    block[sizeof block - 2] = 'z';
    assert_another_run();
    block[sizeof block - 2] = 's';
    light.emitter.radius = 2;
    assert_another_run();
    light.emitter.radius = 0;
    light.hidden = 1;
    assert_another_run();
    light.hidden = 0;
    sky[5] = 2;
    assert_another_run();
    sky[5] = 1;
    around.backdrop = around.light;
    assert_another_run();
    around.backdrop.rgb = NULL;
    made[0].made_from.high = 1;
    assert_another_run();
    made[0].made_from.high = 0;
    write_part("2.exr", 2);
    assert_joined(JOIN(true, "1.exr", "2.exr"));

    world.light_count = world.material_count = 0;
    settings.environment = NULL;
    settings.materials = NULL;
}

/* Writes odd.exr, which has these numbers of samples, I and N, `value` and `error` at one position,
 * and otherwise the values of a part. */
static void write_odd(const float part[3], int at, float value, float error) {
    enum { LAYERS = 4 };
    static float values[LAYERS][VALUES];
    static const image pixels[LAYERS] = { { WIDTH, HEIGHT, values[0] },
                                          { WIDTH, HEIGHT, values[1] },
                                          { WIDTH, HEIGHT, values[2] },
                                          { WIDTH, HEIGHT, values[3] } };
    const image_layer layers[LAYERS] = { { NULL, &pixels[0] },
                                         { "stderr", &pixels[1] },
                                         { "part", &pixels[2] },
                                         { "run", &pixels[3] } };
    base_error why;
    for (int v = 0; v < VALUES; v++) {
        values[0][v] = v == at ? value : 1;
        values[1][v] = v == at ? error : 1;
        values[2][v] = part[v % 3];
        values[3][v] = 5;
    }
    assert_true(image_write_exr_layers(in_folder("odd.exr"), layers, LAYERS, &why));
}

static void numbers_that_no_part_has_are_refused(void **state) {
    (void)state;
    static const float right[][3] = { { 1, 1, 1 }, { 1e6f, 4096, 4096 }, { 7, 2, 3 } };
    for (size_t i = 0; i < sizeof right / sizeof *right; i++) {
        write_odd(right[i], 0, 2, 0);
        assert_joined(JOIN(true, "odd.exr"));
    }
    static const float wrong[][3] = { { 0, 1, 1 },    { 1e6f + 1, 1, 1 }, { 1.5f, 1, 1 },
                                      { NAN, 1, 1 },  { 7, 0, 3 },        { 7, 4, 3 },
                                      { 7, 1.5f, 3 }, { 7, NAN, 3 },      { 7, 1, 0 },
                                      { 7, 1, 4097 }, { 7, 1, 2.5f },     { 7, 1, NAN } };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        write_odd(wrong[i], 0, 2, 0);
        assert_refused(JOIN(true, "odd.exr"), "layer \"part\" is damaged");
    }
}

static void values_that_are_no_estimate_are_refused(void **state) {
    (void)state;
    static const float part[] = { 7, 1, 1 };
    static const float values[][2] = { { NAN, 1 },      { 1, NAN }, { INFINITY, 1 },
                                       { 1, INFINITY }, { 1, -1 },  { NAN, NAN } };
    for (size_t i = 0; i < sizeof values / sizeof *values; i++) {
        for (int end = 0; end < 2; end++) {
            write_odd(part, end * (VALUES - 1), values[i][0], values[i][1]);
            assert_refused(JOIN(false, "odd.exr"),
                           "values that are not finite, or negative errors");
        }
    }
    write_odd(part, 0, -1, 0);
    assert_joined(JOIN(false, "odd.exr")); /* a ringing series may be negative */
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parts_join_to_all_samples_at_once),
        cmocka_unit_test(parts_of_one_sample_each_err_by_how_they_differ),
        cmocka_unit_test(a_missing_part_and_one_given_twice_are_named),
        cmocka_unit_test(parts_belong_together_by_what_they_render),
        cmocka_unit_test(all_that_was_read_makes_the_run),
        cmocka_unit_test(numbers_that_no_part_has_are_refused),
        cmocka_unit_test(values_that_are_no_estimate_are_refused),
    };
    return cmocka_run_group_tests(tests, draw, folder_remove);
}
