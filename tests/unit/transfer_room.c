/* SPDX-License-Identifier: MIT */
/* Transfers whose rays are cast: closed forms of what surfaces see of each other and of the sky,
 * and the light that points read, against many rays from the point itself. */
#include "tests/unit/rooms.h"

static const double pi = 3.14159265358979323846;

static void update(lmp_transfer *transfer, int iterations, const lmp_transfer_lighting *lighting) {
    const lmp_transfer_settings settings = { .iterations = iterations };
    assert_int_equal(lmp_transfer_update(NULL, transfer, &settings, lighting), LMP_OK);
}

static double irradiance_of(const lmp_transfer *transfer, size_t surfel) {
    lmp_rgb e;
    lmp_transfer_copy_irradiance_n(transfer, surfel, 1, lmp_rgb_array_of(&e));
    return (double)e.g;
}

/* --- closed forms ----------------------------------------------------------------------------- */

/* Returns the fraction of the light from a square that arrives at the same square opposite, their
 * distance apart: the view factor of parallel rectangles (Howell, C-11). */
static double square_view_factor(void) {
    const double root = sqrt(2.0);
    return 2 / pi * (log(sqrt(4.0 / 3)) + 2 * root * atan(1 / root) - 2 * atan(1.0));
}

static void a_square_lights_the_one_opposite(void **test) {
    room_model squares = { .count = 0 };
    (void)test;
    room_add(&squares, (room_vec) { 0, 0, 0 }, (room_vec) { 0, 0, 1 }, (room_vec) { 1, 0, 0 }, 0,
             0.05);
    room_add(&squares, (room_vec) { 0, 1, 0 }, (room_vec) { 1, 0, 0 }, (room_vec) { 0, 0, 1 }, 0,
             0.05);
    room_lists lists = room_make_lists(&squares, 256, 0, 1.5);
    lmp_transfer *transfer = room_transfer(&squares, &lists);
    lmp_rgb *emission = room_allocate(squares.surfel_count * sizeof *emission);
    const size_t half = squares.surfel_count / 2;
    double below = 0, above = 0;
    for (size_t i = 0; i < squares.surfel_count; i++)
        emission[i] = i < half ? (lmp_rgb) { 3, 3, 3 } : (lmp_rgb) { 0, 0, 0 };
    const lmp_transfer_lighting lighting = { .emission = emission };
    update(transfer, 2, &lighting);
    for (size_t i = 0; i < half; i++) {
        below += irradiance_of(transfer, i) / (double)half;
        above += irradiance_of(transfer, half + i) / (double)half;
    }
    CHECK_WITHIN(below, 0);
    /* Of 102 400 rays a fifth hit: drawn one by one they would deviate by 0.6 %. */
    CHECK_WITHIN(fabs(above / (3 * pi * square_view_factor()) - 1), 0.006);
    free(emission);
    lmp_transfer_destroy(transfer);
    room_free(&lists);
}

/* The points of a Fibonacci lattice on the unit sphere. */
static room_vec lattice(size_t i, size_t count) {
    const double z = 1 - (2 * (double)i + 1) / (double)count, s = sqrt(1 - z * z);
    const double azimuth = 2 * pi * 0.6180339887498949 * (double)i;
    return (room_vec) { s * cos(azimuth), s * sin(azimuth), z };
}

/* From any point inside a sphere, rays distributed as the cosine are uniform on its surface: E is
 * the same everywhere, rho / (1 - rho) times the mean of the direct light. */
static void inside_a_sphere_light_spreads_evenly(void **test) {
    enum { COUNT = 1000, RAYS = 200 };
    static lmp_transfer_surfel surfels[COUNT];
    static uint32_t hits[COUNT * RAYS];
    static lmp_rgb direct[COUNT];
    static room_vec points[COUNT];
    const double rho = 0.6;
    (void)test;
    for (size_t i = 0; i < COUNT; i++)
        points[i] = lattice(i, COUNT);
    for (size_t i = 0; i < COUNT; i++) {
        const room_vec at = points[i], none = { 0, 0, 0 };
        const room_vec inward = room_along(none, -1, at);
        const float light = (float)(1 + at.z);
        surfels[i] = (lmp_transfer_surfel) {
            room_floats(at), room_floats(inward), { (float)rho, (float)rho, (float)rho }, 0.1f
        };
        direct[i] = (lmp_rgb) { light, light, light };
        for (size_t k = 0; k < RAYS; k++) {
            const room_vec w = room_cosine_direction(inward, k, 0, 0.1 * (double)i);
            const room_vec met = room_along(at, -2 * room_dot(at, w), w);
            size_t nearest = 0;
            for (size_t j = 1; j < COUNT; j++)
                if (room_dot(met, points[j]) > room_dot(met, points[nearest]))
                    nearest = j;
            hits[i * RAYS + k] = (uint32_t)nearest;
        }
    }
    const lmp_transfer_desc desc = {
        .surfels = surfels, .surfel_count = COUNT, .hits = hits, .ray_count = RAYS
    };
    const lmp_transfer_lighting lighting = { .direct = direct };
    lmp_transfer *transfer;
    double mean = 0, squares = 0;
    assert_int_equal(lmp_transfer_create(NULL, &desc, &transfer), LMP_OK);
    update(transfer, 40, &lighting);
    for (size_t i = 0; i < COUNT; i++) {
        const double error = irradiance_of(transfer, i) / (rho / (1 - rho)) - 1;
        mean += error / COUNT;
        squares += error * error / COUNT;
    }
    CHECK_WITHIN(fabs(mean), 0.0005);
    CHECK_WITHIN(sqrt(squares), 0.005);
    lmp_transfer_destroy(transfer);
}

/* The sky a + b w.y in bands of equal height gives a surface pi a + 2/3 pi b n.y, and a probe the
 * coefficients of the function itself. */
static void a_sky_lights_surfels_and_probes(void **test) {
    enum { BANDS = 400, COUNT = 3, RAYS = 4096, PROBE_RAYS = 4000 };
    static uint32_t hits[COUNT * RAYS], probe_hits[PROBE_RAYS];
    static lmp_vec3 directions[PROBE_RAYS];
    const double a = 2, b = 1.5;
    const room_vec normals[COUNT] = { { 0, 1, 0 }, { 0, -1, 0 }, { 0.6, 0.8, 0 } };
    lmp_transfer_surfel surfels[COUNT];
    lmp_rgb sky[BANDS];
    (void)test;
    for (int i = 0; i < BANDS; i++) {
        const float radiance = (float)(a + b * (2 * (i + 0.5) / BANDS - 1));
        sky[i] = (lmp_rgb) { radiance, radiance, radiance };
    }
    for (size_t i = 0; i < COUNT; i++) {
        surfels[i] =
            (lmp_transfer_surfel) { { 0, 0, 0 }, room_floats(normals[i]), { 0.5f, 0.5f, 0.5f }, 1 };
        for (size_t k = 0; k < RAYS; k++)
            hits[i * RAYS + k] =
                COUNT +
                (uint32_t)((room_cosine_direction(normals[i], k, 0.5, 0.5).y + 1) / 2 * BANDS);
    }
    for (size_t k = 0; k < PROBE_RAYS; k++) {
        const room_vec w = lattice(k, PROBE_RAYS);
        directions[k] = (lmp_vec3) { (float)w.x, (float)w.y, (float)w.z };
        probe_hits[k] = COUNT + (uint32_t)((w.y + 1) / 2 * BANDS);
    }
    const lmp_transfer_desc desc = { .surfels = surfels,
                                     .surfel_count = COUNT,
                                     .sky_count = BANDS,
                                     .hits = hits,
                                     .ray_count = RAYS,
                                     .probe_directions = directions,
                                     .probe_hits = probe_hits,
                                     .probe_count = 1,
                                     .probe_ray_count = PROBE_RAYS };
    const lmp_transfer_lighting lighting = { .sky = sky };
    lmp_transfer *transfer;
    float sh[27];
    assert_int_equal(lmp_transfer_create(NULL, &desc, &transfer), LMP_OK);
    update(transfer, 1, &lighting);
    for (size_t i = 0; i < COUNT; i++) {
        const double exact = pi * a + 2 * pi / 3 * b * normals[i].y;
        CHECK_WITHIN(fabs(irradiance_of(transfer, i) / exact - 1), 1e-3);
    }
    lmp_transfer_eval_probe_n(transfer, 0, 1, lmp_sh_interleaved(sh, 0));
    double expected[27] = { 0 };
    for (int c = 0; c < 3; c++) {
        expected[9 * c] = 2 * sqrt(pi) * a;
        expected[9 * c + 1] = -sqrt(4 * pi / 3) * b;
    }
    CHECK_WITHIN(check_error(27, expected, sh), 1e-4);
    lmp_transfer_destroy(transfer);
}

/* --- reading ---------------------------------------------------------------------------------- */

/* Returns the weighted mean of transfer.h in double. */
static double mean_at(const lmp_transfer_surfel *surfels, const double *e, const uint32_t *read,
                      size_t count, lmp_vec3 point, lmp_vec3 normal) {
    double sum = 0, weights = 0;
    for (size_t i = 0; i < count; i++) {
        const lmp_transfer_surfel *s = &surfels[read[i]];
        const double x = (double)point.x - (double)s->position.x,
                     y = (double)point.y - (double)s->position.y,
                     z = (double)point.z - (double)s->position.z, r = (double)s->radius;
        const double inside = 1 - (x * x + y * y + z * z) / (r * r);
        const double cosine = (double)normal.x * (double)s->normal.x +
                              (double)normal.y * (double)s->normal.y +
                              (double)normal.z * (double)s->normal.z;
        const double weight = inside > 0 && cosine > 0 ? inside * inside * cosine : 0;
        sum += weight * e[read[i]];
        weights += weight;
    }
    return sum / weights;
}

/* A strip of surfels with different light and normals, each linked with the two beside it. */
static void a_point_reads_a_surfel_and_its_links(void **test) {
    enum { COUNT = 20, LINKS = 3 };
    lmp_transfer_surfel surfels[COUNT];
    uint32_t hits[COUNT], links[COUNT * LINKS];
    lmp_rgb sky[COUNT];
    double e[COUNT];
    (void)test;
    for (uint32_t i = 0; i < COUNT; i++) {
        const float light = 1 + (float)(i * i % 7);
        const double angle = 0.1 * i;
        surfels[i] = (lmp_transfer_surfel) { .position = { (float)i, 0, 0 },
                                             .normal = { 0, (float)cos(angle), (float)sin(angle) },
                                             .radius = 1.5f };
        hits[i] = COUNT + i;
        sky[i] = (lmp_rgb) { light, 2 * light, 3 * light };
        e[i] = pi * (double)light;
        links[LINKS * i] = i > 0 ? i - 1 : LMP_TRANSFER_NONE;
        links[LINKS * i + 1] = LMP_TRANSFER_NONE;
        links[LINKS * i + 2] = i + 1 < COUNT ? i + 1 : LMP_TRANSFER_NONE;
    }
    const lmp_transfer_desc desc = { .surfels = surfels,
                                     .surfel_count = COUNT,
                                     .sky_count = COUNT,
                                     .hits = hits,
                                     .ray_count = 1,
                                     .links = links,
                                     .link_count = LINKS };
    const lmp_transfer_lighting lighting = { .sky = sky };
    lmp_transfer *transfer;
    assert_int_equal(lmp_transfer_create(NULL, &desc, &transfer), LMP_OK);
    update(transfer, 1, &lighting);
    for (int n = 0; n < 1000; n++) {
        const lmp_vec3 point = { (float)check_random_between(0.6, COUNT - 1.6),
                                 (float)check_random_between(0, 0.3), 0 };
        const lmp_vec3 normal = { 0, 0.8f, 0.6f };
        const uint32_t nearest = (uint32_t)(point.x + 0.5f);
        const uint32_t read[] = { nearest - 1, nearest, nearest + 1 };
        const double expected = mean_at(surfels, e, read, 3, point, normal);
        const lmp_rgb found = lmp_transfer_irradiance(transfer, nearest, point, normal);
        CHECK_WITHIN(fabs((double)found.r / expected - 1), 1e-5);
        CHECK_WITHIN(fabs((double)found.g / expected - 2), 2e-5);
        CHECK_WITHIN(fabs((double)found.b / expected - 3), 3e-5);
    }
    /* at the end, far away, seen from behind, and nowhere: the surfel itself */
    const lmp_vec3 up = { 0, 1, 0 }, down = { 0, -1, 0 }, far = { 0, 1e18f, 0 };
    const lmp_vec3 ends[][2] = { { far, up }, { surfels[0].position, down } };
    for (int i = 0; i < 2; i++)
        CHECK_WITHIN(
            fabs((double)lmp_transfer_irradiance(transfer, 0, ends[i][0], ends[i][1]).r - e[0]),
            1e-6 * e[0]);
    lmp_transfer_destroy(transfer);
}

/* --- two rooms -------------------------------------------------------------------------------- */

/* Adds the faces of a wall 0.1 thick between the two rooms, in pieces around a door, or whole. */
static void add_wall(room_model *room, bool door, double spacing) {
    const double low = 3.95, high = 4.05, from = 1.5, to = 2.5, top = 2;
    const double z[] = { 0, from, to, 4 };
    for (int i = 0; i < 3; i++) {
        const double bottom = i == 1 && door ? top : 0;
        const room_vec up = { 0, 3 - bottom, 0 }, along = { 0, 0, z[i + 1] - z[i] };
        room_add(room, (room_vec) { low, bottom, z[i] }, along, up, 0.5, spacing);
        room_add(room, (room_vec) { high, bottom, z[i] }, up, along, 0.5, spacing);
    }
    if (!door)
        return;
    const room_vec thick = { high - low, 0, 0 }, up = { 0, top, 0 }, wide = { 0, 0, to - from };
    room_add(room, (room_vec) { low, 0, from }, thick, up, 0.5, spacing);
    room_add(room, (room_vec) { low, 0, to }, up, thick, 0.5, spacing);
    room_add(room, (room_vec) { low, top, from }, thick, wide, 0.5, spacing);
}

/* Two rooms of 4 x 3 x 4 m with a floating box in each, connected by a door if there is one. */
static room_model make_rooms(bool door, double spacing) {
    room_model rooms = { .count = 0 };
    room_add_box(&rooms, (room_vec) { 0, 0, 0 }, (room_vec) { 8, 3, 4 }, true, 0.7, spacing);
    room_add_box(&rooms, (room_vec) { 1, 0.2, 0.5 }, (room_vec) { 2, 1, 1.5 }, false, 0.4, spacing);
    room_add_box(&rooms, (room_vec) { 5.5, 0.2, 2.5 }, (room_vec) { 6.5, 0.8, 3.5 }, false, 0.6,
                 spacing);
    add_wall(&rooms, door, spacing);
    return rooms;
}

/* The light of a sphere in the left room, with the shadows of its center. */
static lmp_rgb direct_at(const room_model *rooms, room_vec lamp, lmp_vec3 at, lmp_vec3 normal) {
    const lmp_light light = { .position = room_floats(lamp),
                              .radius = 0.1f,
                              .radiance = { 100, 100, 100 } };
    const room_vec from = { (double)at.x, (double)at.y, (double)at.z };
    if (!room_sees(rooms, from, lamp))
        return (lmp_rgb) { 0, 0, 0 };
    return lmp_light_irradiance(&light, 1, at, normal);
}

static const room_vec lamp_at_rest = { 2, 2.6, 2.5 };

/* A room's surfels and their light after many bounces. */
typedef struct lit_room {
    room_model rooms;
    room_lists lists;
    lmp_rgb *direct;
    lmp_transfer *transfer;
} lit_room;

static void move_lamp(lit_room *lit, room_vec lamp) {
    for (size_t i = 0; i < lit->rooms.surfel_count; i++)
        lit->direct[i] = direct_at(&lit->rooms, lamp, lit->lists.surfels[i].position,
                                   lit->lists.surfels[i].normal);
}

static void light_room(bool door, double spacing, size_t rays, size_t links, lit_room *lit) {
    lit->rooms = make_rooms(door, spacing);
    lit->lists = room_make_lists(&lit->rooms, rays, links, 1.5);
    lit->transfer = room_transfer(&lit->rooms, &lit->lists);
    lit->direct = room_allocate(lit->rooms.surfel_count * sizeof *lit->direct);
    move_lamp(lit, lamp_at_rest);
    const lmp_transfer_lighting lighting = { .direct = lit->direct };
    update(lit->transfer, 60, &lighting);
}

static void free_room(lit_room *lit) {
    lmp_transfer_destroy(lit->transfer);
    room_free(&lit->lists);
    free(lit->direct);
}

/* A point of a surface, and what it receives. */
typedef struct room_point {
    const room_rectangle *rectangle;
    room_vec at;
    double s, t;
} room_point;

static bool is_in_wall(double x) {
    return x > 3.94 && x < 4.06;
}

/* Draws a point a little above a rectangle, any of which is as likely; not where the wall stands.
 */
static room_point draw_point(const room_model *rooms) {
    room_point point = { &rooms->rectangles[(int)(check_random() * rooms->count)],
                         { 0, 0, 0 },
                         check_random(),
                         check_random() };
    const room_rectangle *r = point.rectangle;
    point.at = room_along(room_along(r->corner, point.s, r->u), point.t, r->v);
    point.at = room_along(point.at, 1e-5, room_normal(r));
    return r < rooms->rectangles + 6 && is_in_wall(point.at.x) ? draw_point(rooms) : point;
}

/* Returns what many rays from the point itself find. */
static double gather(const lit_room *lit, const room_point *point, size_t rays) {
    const room_vec normal = room_normal(point->rectangle);
    const double u = check_random(), v = check_random();
    double sum = 0;
    for (size_t k = 0; k < rays; k++) {
        const uint32_t s =
            room_cast(&lit->rooms, point->at, room_cosine_direction(normal, k, u, v)).source;
        if (s != LMP_TRANSFER_NONE)
            sum += (double)lit->lists.surfels[s].albedo.g *
                   ((double)lit->direct[s].g + irradiance_of(lit->transfer, s));
    }
    return sum / (double)rays;
}

/* Reads a point that was drawn in rooms of the same rectangles. */
static double read_at(const lit_room *lit, const room_model *rooms, const room_point *point) {
    const int n = (int)(point->rectangle - rooms->rectangles);
    const uint32_t nearest = room_cell(&lit->rooms.rectangles[n], point->s, point->t);
    return (double)lmp_transfer_irradiance(lit->transfer, nearest, room_floats(point->at),
                                           room_floats(room_normal(point->rectangle)))
        .g;
}

enum { WAYS = 6 };
static const struct {
    double spacing;
    size_t rays, links;
} ways[WAYS] = {
    { 0.4, 64, 0 },   { 0.4, 64, 24 },  { 0.25, 64, 0 },
    { 0.25, 64, 24 }, { 0.25, 256, 0 }, { 0.25, 256, 24 },
};

/* Prints the relative squared error of each way to read, error² / (value² + 1e-4 mean²), in the lit
 * room and behind the door. */
static void links_err_less_than_the_nearest_surfel_alone(void **test) {
    const int count = check_count(600, 3000);
    lit_room exact;
    room_point *points = room_allocate((size_t)count * sizeof *points);
    double *values = room_allocate((size_t)count * sizeof *values);
    double means[2] = { 0 }, errors[WAYS][2] = { { 0 } };
    int counts[2] = { 0 };
    (void)test;
    light_room(true, check_count(160, 125) / 1000.0, 256, 0, &exact);
    for (int i = 0; i < count; i++) {
        points[i] = draw_point(&exact.rooms);
        values[i] = gather(&exact, &points[i], (size_t)check_count(1024, 4096));
        means[points[i].at.x > 4] += values[i];
        counts[points[i].at.x > 4]++;
    }
    print_message(
        "table transfer.reading\n| surfels | rays | read from | KB | lit room | dark room |\n"
        "|---|---|---|---|---|---|\n");
    for (int w = 0; w < WAYS; w++) {
        lit_room lit;
        light_room(true, ways[w].spacing, ways[w].rays, ways[w].links, &lit);
        for (int i = 0; i < count; i++) {
            const int dark = points[i].at.x > 4;
            const double error = read_at(&lit, &exact.rooms, &points[i]) - values[i];
            const double mean = means[dark] / counts[dark];
            errors[w][dark] +=
                error * error / (values[i] * values[i] + 1e-4 * mean * mean) / counts[dark];
        }
        print_message("| %.2f m: %zu | %zu | %s | %zu | %.4f | %.4f |\n", ways[w].spacing,
                      lit.rooms.surfel_count, ways[w].rays,
                      ways[w].links ? "the nearest and links" : "the nearest",
                      lmp_transfer_describe(lit.transfer).bytes / 1000, errors[w][0], errors[w][1]);
        free_room(&lit);
    }
    for (int w = 0; w < WAYS; w += 2)
        for (int dark = 0; dark < 2; dark++)
            assert_true(errors[w + 1][dark] < errors[w][dark]);
    free_room(&exact);
    free(points);
    free(values);
}

/* Finds the mean E of each room. */
static void find_means(const lit_room *lit, double means[2]) {
    int counts[2] = { 0 };
    means[0] = means[1] = 0;
    for (size_t i = 0; i < lit->rooms.surfel_count; i++) {
        const int dark = lit->lists.surfels[i].position.x > 4;
        means[dark] += irradiance_of(lit->transfer, i);
        counts[dark]++;
    }
    means[0] /= counts[0];
    means[1] /= counts[1];
}

/* Each iteration adds the light of one more bounce, so E rises to its limit from below; behind the
 * door the first bounces are missing. */
static void iterations_add_bounces(void **test) {
    enum { LAST = 16 };
    lit_room lit;
    double limit[2], before[2] = { 0 }, means[2];
    (void)test;
    light_room(true, 0.4, 64, 0, &lit);
    const lmp_transfer_lighting lighting = { .direct = lit.direct }, dark = { 0 };
    find_means(&lit, limit);
    update(lit.transfer, 400, &dark);
    print_message(
        "table transfer.iterations\n| iterations | lit room | dark room |\n|---|---|---|\n");
    for (int n = 1; n <= LAST; n++) {
        update(lit.transfer, 1, &lighting);
        find_means(&lit, means);
        for (int room = 0; room < 2; room++) {
            assert_true(means[room] > before[room] && means[room] < limit[room]);
            before[room] = means[room];
        }
        if (n == 1 || n == 2 || n == 4 || n % 8 == 0)
            print_message("| %d | %.1f %% | %.1f %% |\n", n, 100 * means[0] / limit[0],
                          100 * means[1] / limit[1]);
    }
    CHECK_WITHIN(fabs(means[0] / limit[0] - 1), 0.001);
    free_room(&lit);
}

/* Updates that begin with the last frame's light keep up with a lamp that moves by a meter in a
 * second of 60 frames: prints how far the mean of each room lags behind its limit. */
static void frames_follow_a_light_that_moves(void **test) {
    static const int iterations[] = { 1, 2, 4 };
    lit_room lit;
    (void)test;
    light_room(true, 0.4, 64, 0, &lit);
    const lmp_transfer_lighting lighting = { .direct = lit.direct };
    for (int i = 0; i < 3; i++) {
        double means[2], limit[2], lag[2] = { 0 };
        for (int frame = 0; frame <= 60; frame++) {
            move_lamp(&lit, (room_vec) { 1.5 + frame / 60.0, 2.6, 2.5 });
            update(lit.transfer, frame == 0 ? 60 : iterations[i], &lighting);
            find_means(&lit, means);
            lmp_transfer *exact = room_transfer(&lit.rooms, &lit.lists);
            lmp_transfer *const followed = lit.transfer;
            update(exact, 60, &lighting);
            lit.transfer = exact;
            find_means(&lit, limit);
            lit.transfer = followed;
            lmp_transfer_destroy(exact);
            for (int room = 0; room < 2; room++)
                lag[room] = fmax(lag[room], fabs(means[room] / limit[room] - 1));
        }
        print_message("%d iterations a frame: at most %.2f %% and %.2f %% from the limit\n",
                      iterations[i], 100 * lag[0], 100 * lag[1]);
        CHECK_WITHIN(lag[0], 0.01 / iterations[i]);
        CHECK_WITHIN(lag[1], 0.03 / iterations[i]);
    }
    free_room(&lit);
}

/* Without a door the dark room stays dark, to the bit. */
static void nothing_leaks_through_a_wall(void **test) {
    lit_room lit;
    (void)test;
    light_room(false, 0.4, 64, 24, &lit);
    for (int i = 0; i < 2000; i++) {
        const room_point point = draw_point(&lit.rooms);
        const double e = read_at(&lit, &lit.rooms, &point);
        if (point.at.x > 4)
            CHECK_WITHIN(fabs(e), 0);
        else
            assert_true(e > 0);
    }
    free_room(&lit);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_square_lights_the_one_opposite),
        cmocka_unit_test(inside_a_sphere_light_spreads_evenly),
        cmocka_unit_test(a_sky_lights_surfels_and_probes),
        cmocka_unit_test(a_point_reads_a_surfel_and_its_links),
        cmocka_unit_test(links_err_less_than_the_nearest_surfel_alone),
        cmocka_unit_test(iterations_add_bounces),
        cmocka_unit_test(frames_follow_a_light_that_moves),
        cmocka_unit_test(nothing_leaks_through_a_wall),
    };
    cmocka_set_test_filter(getenv("LAMPION_TEST"));
    return cmocka_run_group_tests(tests, NULL, NULL);
}
