/* SPDX-License-Identifier: MIT */
/* PNG, CSV and JSON as the program writes them, read by a few lines of the formats' own
 * specifications and by zlib: every byte, float and letter is what was in memory. */
#include "app/base/error.h"
#include "app/base/file.h"
#include "app/base/file_json.h"
#include "app/image/png.h"
#include "app/scene/scene.h"
#include "tests/program/folder.h"

#include <jansson.h>
#include <lampion/light.h>
#include <zlib.h>

enum { SIDE_MAX = 40, PIXELS_MAX = 3 * SIDE_MAX * SIDE_MAX };

static char *read_file(const char *name, size_t *size) {
    void *bytes;
    base_error error;
    if (!file_read(in_folder(name), 1 << 24, &bytes, size, &error))
        fail_msg("%s", error.text);
    return bytes;
}

/* --- PNG (ISO/IEC 15948) ---------------------------------------------------------------------- */

typedef struct png_file {
    uint32_t width, height;
    unsigned char packed[1 << 16], text[1 << 16];
    size_t packed_size, text_size;
} png_file;

static uint32_t big_endian(const unsigned char *at) {
    return (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 | (uint32_t)at[2] << 8 | at[3];
}

static void take_chunk(png_file *png, const char *name, const unsigned char *data, size_t size) {
    if (strcmp(name, "IHDR") == 0) {
        assert_int_equal(size, 13);
        png->width = big_endian(data);
        png->height = big_endian(data + 4);
        assert_memory_equal(data + 8, "\10\2\0\0\0", 5); /* 8 bits, RGB, not interlaced */
    } else if (strcmp(name, "IDAT") == 0) {
        assert_true(png->packed_size + size <= sizeof png->packed);
        memcpy(png->packed + png->packed_size, data, size);
        png->packed_size += size;
    } else if (strcmp(name, "iTXt") == 0) {
        assert_true(size <= sizeof png->text);
        memcpy(png->text, data, size);
        png->text_size = size;
    }
}

static void take_apart(const char *name, png_file *png) {
    size_t size;
    char last[5] = "";
    unsigned char *const bytes = (unsigned char *)read_file(name, &size);
    *png = (png_file) { .width = 0 };
    assert_memory_equal(bytes, "\x89PNG\r\n\x1a\n", 8);
    for (size_t at = 8; at < size;) {
        assert_true(size - at >= 12);
        const size_t length = big_endian(bytes + at);
        assert_true(length <= size - at - 12);
        const unsigned char *const data = bytes + at + 8;
        assert_int_equal(crc32(0, data - 4, (uInt)length + 4), big_endian(data + length));
        memcpy(last, data - 4, 4);
        take_chunk(png, last, data, length);
        at += 12 + length;
    }
    assert_string_equal(last, "IEND");
    free(bytes);
}

static int paeth(int a, int b, int c) {
    const int p = a + b - c, pa = abs(p - a), pb = abs(p - b), pc = abs(p - c);
    return pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
}

/* Reverses the filter of a row. */
static void unfilter(const unsigned char *row, size_t width, const unsigned char *above,
                     unsigned char *out) {
    for (size_t i = 0; i < 3 * width; i++) {
        const int left = i >= 3 ? out[i - 3] : 0, up = above ? above[i] : 0;
        const int corner = above && i >= 3 ? above[i - 3] : 0;
        const int predictions[5] = { 0, left, up, (left + up) / 2, paeth(left, up, corner) };
        assert_true(row[0] < 5);
        out[i] = (unsigned char)(row[1 + i] + predictions[row[0]]);
    }
}

static void expect_pixels(const png_file *png, const unsigned char *rgb8, int width, int height) {
    static unsigned char rows[PIXELS_MAX + SIDE_MAX], pixels[PIXELS_MAX];
    uLongf size = sizeof rows;
    const size_t row = 3 * (size_t)width;
    assert_int_equal(png->width, width);
    assert_int_equal(png->height, height);
    assert_int_equal(uncompress(rows, &size, png->packed, png->packed_size), Z_OK);
    assert_int_equal(size, (row + 1) * (size_t)height);
    for (size_t y = 0; y < (size_t)height; y++)
        unfilter(rows + (row + 1) * y, (size_t)width, y > 0 ? pixels + row * (y - 1) : NULL,
                 pixels + row * y);
    assert_memory_equal(pixels, rgb8, row * (size_t)height);
}

static void expect_text(const png_file *png, const char *key, const char *text) {
    char found[4096] = "";
    uLongf size = sizeof found - 1;
    const size_t before = strlen(key) + 1;
    assert_true(png->text_size > before + 4);
    assert_memory_equal(png->text, key, before);
    assert_memory_equal(png->text + before, "\1\0", 2); /* deflated */
    size_t at = before + 2;
    for (int i = 0; i < 2; i++) /* its language, and the keyword in that language */
        at += strlen((const char *)png->text + at) + 1;
    assert_int_equal(uncompress((Bytef *)found, &size, png->text + at, png->text_size - at), Z_OK);
    assert_string_equal(found, text);
}

static void every_pixel_of_a_png_is_found(void **state) {
    (void)state;
    static unsigned char rgb8[PIXELS_MAX];
    static png_file png;
    const image_text text = { "lampion", "{\"name\": \"Z\u00fcrich \u2603\"}" };
    const int step = check_count(7, 1);
    int tried = 0;
    for (int width = 1; width <= SIDE_MAX; width += step)
        for (int height = 1; height <= SIDE_MAX; height += step, tried++) {
            base_error error;
            const double noise = check_random(); /* the rest is smooth: other filters are chosen */
            for (int i = 0; i < 3 * width * height; i++)
                rgb8[i] = (unsigned char)(check_random() < noise ? 256 * check_random()
                                                                 : i / width + i % width);
            if (!image_write_png8(rgb8, width, height, in_folder("plain.png"), &error))
                fail_msg("%s", error.text);
            take_apart("plain.png", &png);
            expect_pixels(&png, rgb8, width, height);
            if (!image_write_png8_text(rgb8, width, height, &text, in_folder("text.png"), &error))
                fail_msg("%s", error.text);
            take_apart("text.png", &png);
            expect_pixels(&png, rgb8, width, height);
            expect_text(&png, text.key, text.text);
        }
    printf("tried: %d sizes of PNG read by zlib alone\n", tried);
}

/* --- CSV (RFC 4180) --------------------------------------------------------------------------- */

/* Writes the program's output to a file of the folder. */
static void run(const char *arguments, const char *name) {
    char command[2048];
    snprintf(command, sizeof command, "'%s' %s >'%s'", getenv("LAMPION_PROGRAM"), arguments,
             in_folder(name));
    assert_int_equal(system(command), 0);
}

static void every_float_of_a_csv_is_found(void **state) {
    (void)state;
    enum { BANDS = 7, VALUES = BANDS * BANDS, ROWS = 200 };
    static lmp_light lights[ROWS];
    char arguments[640];
    FILE *const table = fopen(in_folder("lights.csv"), "w");
    assert_non_null(table);
    fprintf(table, "light_x,light_y,light_z,radius,recv_x,recv_y,recv_z\n");
    for (int i = 0; i < ROWS; i++) {
        const lmp_vec3 way = check_random_direction();
        lights[i].position = (lmp_vec3) { 3 * way.x, 3 * way.y, 3 * way.z };
        lights[i].radius = (float)check_random_between(1e-6, 4);
        fprintf(table, "%.9g,%.9g,%.9g,%.9g,0,0,0\n", (double)lights[i].position.x,
                (double)lights[i].position.y, (double)lights[i].position.z,
                (double)lights[i].radius);
    }
    assert_int_equal(fclose(table), 0);
    snprintf(arguments, sizeof arguments, "project --bands %d --batch '%s'", BANDS,
             in_folder("lights.csv"));
    run(arguments, "sh.csv");
    size_t size;
    char *const text = read_file("sh.csv", &size), *at = text + strcspn(text, "\n") + 1;
    static float expected[ROWS * VALUES];
    const lmp_spheres spheres = lmp_spheres_of(lights);
    const lmp_vec3 origin = { 0, 0, 0 };
    lmp_sphere_project_n(BANDS, &spheres, lmp_vec3_array_same(&origin), ROWS,
                         lmp_sh_interleaved(expected, 0));
    for (int i = 0; i < ROWS * VALUES; i++) {
        char *end;
        const float found = strtof(at, &end);
        assert_true(end > at && *end == (i % VALUES == VALUES - 1 ? '\n' : ','));
        if (found != expected[i])
            fail_msg("row %d: %.9g is not %.9g", i / VALUES, (double)found, (double)expected[i]);
        at = end + 1;
    }
    assert_int_equal(at - text, size);
    free(text);
}

/* --- JSON (RFC 8259) -------------------------------------------------------------------------- */

/* Returns what follows the value that begins here; the test fails where it is not a value. */
static const char *skip_value(const char *at);

static const char *skip_space(const char *at) {
    return at + strspn(at, " \t\r\n");
}

static const char *skip_string(const char *at) {
    assert_true(*at == '"');
    for (at++; *at != '"'; at++) {
        assert_true((unsigned char)*at >= 0x20);
        at += *at == '\\';
    }
    return at + 1;
}

static const char *skip_items(const char *at, char end, bool named) {
    at = skip_space(at + 1);
    if (*at == end)
        return at + 1;
    for (;;) {
        if (named) {
            at = skip_space(skip_string(at));
            assert_true(*at++ == ':');
        }
        at = skip_space(skip_value(skip_space(at)));
        if (*at == end)
            return at + 1;
        assert_true(*at++ == ',');
        at = skip_space(at);
    }
}

static const char *skip_value(const char *at) {
    static const char *const words[] = { "true", "false", "null" };
    char *end;
    if (*at == '"')
        return skip_string(at);
    if (*at == '[' || *at == '{')
        return skip_items(at, *at == '[' ? ']' : '}', *at == '{');
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strncmp(at, words[i], strlen(words[i])) == 0)
            return at + strlen(words[i]);
    assert_true(strchr("-0123456789", *at) != NULL);
    strtod(at, &end);
    return end;
}

/* Returns the value of a name in the object that begins here. */
static const char *member(const char *at, const char *name) {
    assert_true(*at == '{');
    for (at = skip_space(at + 1); *at == '"';) {
        const char *const end = skip_string(at);
        const char *const value = skip_space(skip_space(end) + 1);
        const size_t length = (size_t)(end - at) - 2;
        if (strlen(name) == length && memcmp(at + 1, name, length) == 0)
            return value;
        at = skip_space(skip_value(value));
        at = skip_space(at + (*at == ','));
    }
    fail_msg("there is no \"%s\"", name);
    return NULL;
}

static void expect_floats(const char *at, const float *numbers, int count) {
    for (int i = 0; i < count; i++) {
        char *end;
        at = skip_space(at + strspn(at, "[,"));
        const float found = strtof(at, &end);
        assert_true(end > at);
        if (found != numbers[i])
            fail_msg("%.9g is not %.9g", (double)found, (double)numbers[i]);
        at = skip_space(end);
    }
}

static void every_number_of_a_json_is_found(void **state) {
    (void)state;
    scene world;
    base_error error;
    size_t size;
    assert_true(scene_load("builtin:atrium", NULL, &world, &error));
    run("info --json builtin:atrium", "info.json");
    char *const text = read_file("info.json", &size);
    assert_true(*skip_space(skip_value(text)) == '\0');
    expect_floats(member(text, "minimum"), world.minimum, 3);
    const char *at = skip_space(member(text, "lights") + 1);
    for (size_t i = 0; i < world.light_count; i++) {
        const lmp_light *const light = &world.lights[i].emitter;
        expect_floats(member(at, "position"), &light->position.x, 3);
        expect_floats(member(at, "radius"), &light->radius, 1);
        expect_floats(member(at, "radiance"), &light->radiance.r, 3);
        at = skip_space(skip_value(at));
        at = skip_space(at + (*at == ','));
    }
    assert_true(world.light_count > 0 && *at == ']');
    at = skip_space(member(text, "materials") + 1);
    for (size_t i = 0; i < world.material_count; i++) {
        expect_floats(member(at, "base_color"), world.materials[i].base_color, 4);
        expect_floats(member(at, "roughness"), &world.materials[i].roughness, 1);
        at = skip_space(skip_value(at));
        at = skip_space(at + (*at == ','));
    }
    assert_true(*at == ']');
    free(text);
    scene_free(&world);
}

/* Decodes the bytes of a JSON string, up to U+FFFF. */
static void decode(const char *at, char *out) {
    static const char escaped[] = "\"\\/bfnrt", meant[] = "\"\\/\b\f\n\r\t";
    for (at++; *at != '"'; at++) {
        if (*at != '\\') {
            *out++ = *at;
        } else if (*++at == 'u') {
            char digits[5] = "";
            memcpy(digits, at + 1, 4);
            const unsigned long letter = strtoul(digits, NULL, 16);
            assert_true(letter < 0x80); /* others are written literally */
            *out++ = (char)letter;
            at += 4;
        } else {
            const char *const found = strchr(escaped, *at);
            assert_non_null(found);
            *out++ = meant[found - escaped];
        }
    }
    *out = '\0';
}

static void every_letter_of_a_json_is_found(void **state) {
    (void)state;
    char name[160] = "", found[160];
    base_error error;
    for (char c = 1; c < 127; c++)
        name[c - 1] = c;
    strcat(name, "\x7f Z\u00fcrich \u2603 \U0001f3ee");
    json_t *root = json_pack("{s:s}", "name", name);
    char *const text = file_json_text(root, true, "text", &error);
    assert_non_null(text);
    assert_true(*skip_space(skip_value(text)) == '\0');
    decode(member(text, "name"), found);
    assert_string_equal(found, name);
    free(text);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_pixel_of_a_png_is_found),
        cmocka_unit_test(every_float_of_a_csv_is_found),
        cmocka_unit_test(every_number_of_a_json_is_found),
        cmocka_unit_test(every_letter_of_a_json_is_found),
    };
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
