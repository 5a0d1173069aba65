/* SPDX-License-Identifier: MIT */
/* Files hold what others counted: triangles, extent and surface. */
#include "app/scene/instance.h"
#include "tests/program/folder.h"
#include "tests/program/load.h"

#include <math.h>
#include <stdio.h>

#define PI 3.14159265358979

/* A torus around the y axis, of AROUND by ALONG flat quadrilaterals. */
enum { AROUND = 96, ALONG = 40 };
static const double torus_radius = 2.0, tube_radius = 0.75;

static void torus_vertex(int k, int i, float position[3], float normal[3]) {
    const double phi = 2 * PI * k / AROUND, theta = 2 * PI * i / ALONG;
    const double n[3] = { cos(theta) * cos(phi), sin(theta), cos(theta) * sin(phi) };
    const double middle[3] = { torus_radius * cos(phi), 0, torus_radius * sin(phi) };
    for (int c = 0; c < 3; c++) {
        normal[c] = (float)n[c];
        position[c] = (float)(middle[c] + tube_radius * n[c]);
    }
}

/* Sums trapezoids between the circles i and i + 1 of the tube. */
static double torus_area(void) {
    const double step = 2 * sin(PI / AROUND), side = 2 * tube_radius * sin(PI / ALONG);
    double area = 0;
    for (int i = 0; i < ALONG; i++) {
        const double a = step * (torus_radius + tube_radius * cos(2 * PI * i / ALONG));
        const double b = step * (torus_radius + tube_radius * cos(2 * PI * (i + 1) / ALONG));
        area += AROUND * (a + b) / 2 * sqrt(side * side - (a - b) * (a - b) / 4);
    }
    return area;
}

/* Writes the torus as an OBJ of quadrilaterals, and as a glTF of interleaved triangles, twice as
 * large. */
static void write_torus(void) {
    static float vertices[AROUND * ALONG][6];
    static uint16_t indices[AROUND * ALONG][6];
    FILE *obj = fopen(in_folder("torus.obj"), "w");
    assert_non_null(obj);
    for (int n = 0; n < AROUND * ALONG; n++) {
        float *const v = vertices[n];
        torus_vertex(n / ALONG, n % ALONG, v, v + 3);
        fprintf(obj, "v %.9g %.9g %.9g\n", (double)v[0], (double)v[1], (double)v[2]);
    }
    for (int n = 0; n < AROUND * ALONG; n++) {
        const int k = n / ALONG * ALONG, next = (k + ALONG) % (AROUND * ALONG);
        const int i = n % ALONG, j = (i + 1) % ALONG;
        const int corner[6] = { k + i, k + j, next + j, k + i, next + j, next + i };
        for (int c = 0; c < 6; c++)
            indices[n][c] = (uint16_t)corner[c];
        fprintf(obj, "f %d %d %d %d\n", k + i + 1, k + j + 1, next + j + 1, next + i + 1);
    }
    assert_int_equal(fclose(obj), 0);
    folder_write("vertices.bin", vertices, sizeof vertices);
    folder_write("indices.bin", indices, sizeof indices);
    folder_write_text(
        "torus.gltf",
        "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":["
        "{\"scale\":[2,2,2],\"children\":[1]},{\"mesh\":0,\"translation\":[10,0,0]}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":1},"
        "\"indices\":2}]}],\"accessors\":["
        "{\"bufferView\":0,\"componentType\":5126,\"count\":3840,\"type\":\"VEC3\","
        "\"min\":[-2.75,-0.75,-2.75],\"max\":[2.75,0.75,2.75]},"
        "{\"bufferView\":0,\"byteOffset\":12,\"componentType\":5126,\"count\":3840,"
        "\"type\":\"VEC3\"},"
        "{\"bufferView\":1,\"componentType\":5123,\"count\":23040,\"type\":\"SCALAR\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":92160,\"byteStride\":24},"
        "{\"buffer\":1,\"byteLength\":46080}],\"buffers\":["
        "{\"byteLength\":92160,\"uri\":\"vertices.bin\"},"
        "{\"byteLength\":46080,\"uri\":\"indices.bin\"}]}");
    FILE *facts = fopen(in_folder("facts.csv"), "w");
    assert_non_null(facts);
    fprintf(facts,
            "file,triangles,min_x,min_y,min_z,max_x,max_y,max_z,area\n"
            "torus.obj,7680,-2.75,-0.75,-2.75,2.75,0.75,2.75,%.9g\n"
            "torus.gltf,7680,14.5,-1.5,-5.5,25.5,1.5,5.5,%.9g\n",
            torus_area(), 4 * torus_area());
    assert_int_equal(fclose(facts), 0);
}

/* Checks the files that the folder's facts.csv names; returns how many there are, -1 without it. */
static int check_facts(const char *data) {
    char path[1024], line[1024];
    snprintf(path, sizeof path, "%s/facts.csv", data);
    FILE *facts = fopen(path, "r");
    int checked = 0;
    if (!facts)
        return -1;
    assert_non_null(fgets(line, sizeof line, facts));
    for (; fgets(line, sizeof line, facts); checked++) {
        char name[512];
        double lo[3], hi[3], area;
        size_t triangles;
        assert_int_equal(sscanf(line, "%511[^,],%zu,%lf,%lf,%lf,%lf,%lf,%lf,%lf", name, &triangles,
                                &lo[0], &lo[1], &lo[2], &hi[0], &hi[1], &hi[2], &area),
                         9);
        snprintf(path, sizeof path, "%s/%s", data, name);
        scene s = load(path);
        assert_int_equal(s.index_count / 3, triangles);
        /* The facts have six digits, relative to the largest extent. */
        double size = 0.0;
        for (int k = 0; k < 3; k++)
            size = fmax(size, fmax(fabs(lo[k]), fabs(hi[k])));
        for (int k = 0; k < 3; k++) {
            CHECK_WITHIN(fabs((double)s.minimum[k] - lo[k]), 1e-5 * size);
            CHECK_WITHIN(fabs((double)s.maximum[k] - hi[k]), 1e-5 * size);
        }
        CHECK_WITHIN(fabs((double)scene_area(&s) - area), 1e-5 * area);
        assert_unit_and_inside(&s);
        scene_free(&s);
    }
    fclose(facts);
    return checked;
}

/* Checks scenes of others, in the folder LAMPION_DATA, or in `data` there. */
static void check_more_facts(const char *data) {
    char below[1024];
    snprintf(below, sizeof below, "%s/data", data);
    const int checked = check_facts(data);
    if (checked < 0 && check_facts(below) < 0)
        print_message("skipped: %s has no facts.csv\n", data);
    assert_true(checked != 0);
}

static void files_hold_what_the_facts_say(void **state) {
    (void)state;
    const char *data = getenv("LAMPION_DATA");
    write_torus();
    assert_int_equal(check_facts(folder), 2);
    if (data)
        check_more_facts(data);
}

int main(void) {
    const struct CMUnitTest tests[] = { cmocka_unit_test(files_hold_what_the_facts_say) };
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
