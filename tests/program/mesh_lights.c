/* SPDX-License-Identifier: MIT */
/* How many lights a glowing mesh becomes, and how well they stand for it. Prints the table of
 * docs/areas.md on bent meshes. */
#include "tests/program/folder.h"
#include "tests/program/load.h"

static const int counts[] = { 8, 40, 200 };
enum { COUNTS = 3, TEXT = 1 << 16 };

static const float radiance = 3;

/* A mesh around the z axis from -1 to 1, of strips that shine outward. */
typedef struct bent {
    const char *name;
    int strips;
    double part;  /* of the whole way around */
    bool divided; /* strips are pieces of their own */
} bent;

static const bent meshes[] = {
    { "arch of 32 strips", 32, 0.5, false },
    { "arch of 160 strips", 160, 0.5, false },
    { "160 panels around a column", 160, 1, true },
};
enum { MESHES = sizeof meshes / sizeof *meshes };

static double angle_of(const bent *b, double strip) {
    return 2 * M_PI * b->part * (strip / b->strips - 0.5);
}

/* Writes the mesh as an OBJ. Each strip has four corners of its own; those of a whole surface meet
 * exactly. */
static void write_bent(const bent *b) {
    static char text[TEXT];
    size_t used = (size_t)snprintf(text, sizeof text, "mtllib m.mtl\nusemtl m\n");
    for (int i = 0; i < b->strips; i++)
        for (int k = 0; k < 4; k++) {
            const double angle = angle_of(b, i + (k % 3 ? (b->divided ? 0.9 : 1) : 0));
            used += (size_t)snprintf(text + used, sizeof text - used, "v %.6f %.6f %d\n",
                                     cos(angle), sin(angle), k < 2 ? -1 : 1);
        }
    for (int i = 0; i < b->strips; i++)
        used += (size_t)snprintf(text + used, sizeof text - used, "f %d %d %d %d\n", 4 * i + 1,
                                 4 * i + 2, 4 * i + 3, 4 * i + 4);
    assert_true(used < sizeof text - 1);
    folder_write_text("m.mtl", "newmtl m\nKe 3 3 3\n");
    folder_write_text("bent.obj", text);
}

static scene load_bent(int most) {
    scene s;
    base_error error = { 0 };
    const scene_options options = { .mesh_lights = most };
    if (!scene_load(in_folder("bent.obj"), &options, &s, &error))
        fail_msg("%s", error.text);
    return s;
}

static double power_of(const scene *s) {
    double sum = 0;
    for (size_t i = 0; i < s->light_count; i++) {
        const lmp_light *l = &s->lights[i].emitter;
        sum += l->kind == LMP_LIGHT_SPHERE
                   ? 4 * M_PI * M_PI * pow((double)l->radius, 2) * (double)l->radiance.g
                   : (double)lmp_light_power_from_radiance(l, l->radiance.g);
    }
    return sum;
}

/* Whatever the number is, it is not exceeded and the power stays; the cache knows one number from
 * another. */
static void a_mesh_becomes_no_more_lights_than_asked_for(void **state) {
    (void)state;
    static const size_t expected[MESHES][COUNTS] = { { 1, 32, 32 }, { 1, 1, 160 }, { 8, 40, 160 } };
    for (int m = 0; m < MESHES; m++) {
        const bent *b = &meshes[m];
        write_bent(b);
        const double width =
            2 * sin(0.5 * fabs(angle_of(b, b->divided ? 0.9 : 1) - angle_of(b, 0)));
        const double power = M_PI * (double)radiance * b->strips * 2 * width;
        for (int round = 0; round < 2; round++)
            for (int i = 0; i < COUNTS; i++) {
                scene s = load_bent(counts[i]);
                assert_int_equal(s.cached, round);
                assert_int_equal(s.light_count, expected[m][i]);
                CHECK_WITHIN(fabs(power_of(&s) / power - 1), 1e-4);
                scene_free(&s);
            }
        scene s = load_bent(0);
        assert_int_equal(s.light_count, expected[m][1]);
        scene_free(&s);
    }
}

/* Returns the irradiance at a point, by the definition: of small parts of every strip. */
static double true_irradiance(const bent *b, const double at[3], const double normal[3]) {
    enum { PARTS = 64 };
    double sum = 0;
    for (int i = 0; i < b->strips; i++) {
        const double from = angle_of(b, i), to = angle_of(b, i + (b->divided ? 0.9 : 1));
        const double middle = 0.5 * (from + to), height = cos(0.5 * (to - from));
        const double out[3] = { cos(middle), sin(middle), 0 };
        for (int k = 0; k < PARTS; k++) {
            const double z = (2 * k + 1.0) / PARTS - 1;
            const double way[3] = { height * out[0] - at[0], height * out[1] - at[1], z - at[2] };
            double front = 0, received = 0, square = 0;
            for (int c = 0; c < 3; c++) {
                front -= out[c] * way[c];
                received += normal[c] * way[c];
                square += way[c] * way[c];
            }
            if (front > 0 && received > 0)
                sum +=
                    front * received / (square * square) * 2 * sin(0.5 * (to - from)) * 2 / PARTS;
        }
    }
    return (double)radiance * sum;
}

/* Finds the rms and the largest error of the irradiance of surfaces that face the middle of a mesh
 * from two of its radii away, in parts of the largest irradiance. */
static void measure(const bent *b, const scene *s, double *rms, double *most) {
    enum { POINTS = 200 };
    double largest = 0;
    *rms = *most = 0;
    for (int i = 0; i < POINTS; i++) {
        const double up = (2 * i + 1.0) / POINTS - 1, around = 2.39996322972865332 * i;
        const double normal[3] = { sqrt(1 - up * up) * cos(around), sqrt(1 - up * up) * sin(around),
                                   up };
        const double at[3] = { -2 * normal[0], -2 * normal[1], -2 * normal[2] };
        double sum = 0;
        for (size_t k = 0; k < s->light_count; k++)
            sum += (double)lmp_light_irradiance(
                       &s->lights[k].emitter, 1,
                       (lmp_vec3) { (float)at[0], (float)at[1], (float)at[2] },
                       (lmp_vec3) { (float)normal[0], (float)normal[1], (float)normal[2] })
                       .g;
        const double exact = true_irradiance(b, at, normal), error = fabs(sum - exact);
        largest = fmax(largest, exact);
        *rms += error * error / POINTS;
        *most = fmax(*most, error);
    }
    *rms = sqrt(*rms) / largest;
    *most /= largest;
}

/* One light per strip is exact but for the sum that judges it. */
static void more_lights_are_closer_to_the_mesh(void **state) {
    (void)state;
    print_message("table areas.bent\n| mesh | 8 lights | 40 | 200 |\n|---|---|---|---|\n");
    for (int m = 0; m < MESHES; m++) {
        double rms[COUNTS], most[COUNTS];
        write_bent(&meshes[m]);
        for (int i = 0; i < COUNTS; i++) {
            scene s = load_bent(counts[i]);
            measure(&meshes[m], &s, &rms[i], &most[i]);
            scene_free(&s);
        }
        print_message("| %s | %.3f %.3f | %.3f %.3f | %.3f %.3f |\n", meshes[m].name, rms[0],
                      most[0], rms[1], most[1], rms[2], most[2]);
        CHECK_WITHIN(rms[2], 1e-3);
        CHECK_WITHIN(rms[1], rms[0]);
    }
}

static int prepare(void **state) {
    return folder_make(state) != 0 || setenv("XDG_CACHE_HOME", in_folder("cache"), 1) != 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_mesh_becomes_no_more_lights_than_asked_for),
        cmocka_unit_test(more_lights_are_closer_to_the_mesh),
    };
    return cmocka_run_group_tests(tests, prepare, folder_remove);
}
