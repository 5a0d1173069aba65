/* SPDX-License-Identifier: MIT */
/* Single calls beside those of DirectXMath's SHMath, of which peer.sh says where it lies: medians of
 * pairs of runs, ours and theirs in turns. Both get the same inputs from arrays that stay in the
 * first cache, and write where the next call does not read. */
#include <lampion/cpu.h>
#include <lampion/light.h>
#include <lampion/sh.h>

#include <DirectXMath.h>

#include <DirectXSH.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

enum { INPUTS = 32, MOST = LMP_SH_COUNT(6), PAIRS = 31, CALLS = 512 };

struct inputs {
    lmp_vec3 direction[INPUTS];
    float matrix[INPUTS][9], angle[INPUTS], a[INPUTS][MOST], b[INPUTS][MOST];
    DirectX::XMMATRIX peer_matrix[INPUTS];
    DirectX::XMVECTOR peer_direction[INPUTS], peer_position[INPUTS], peer_color;
    lmp_light sphere[INPUTS], sun[INPUTS], cap[INPUTS];
    lmp_sh_product *product[7];
    float out[3 * MOST], sum[3 * MOST];
};

inputs in;
const lmp_vec3 origin = { 0, 0, 0 };

float random_between(float low, float high) {
    return low + (high - low) * static_cast<float>(std::rand()) / static_cast<float>(RAND_MAX);
}

lmp_vec3 random_direction() {
    const float z = random_between(-1, 1), phi = random_between(0, 6.2831853f);
    const float s = std::sqrt(1 - z * z);
    return { s * std::cos(phi), s * std::sin(phi), z };
}

lmp_vec3 cross(lmp_vec3 a, lmp_vec3 b) {
    return { a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

/* The rows x, y, z, of which z is given. */
void fill_rotation(lmp_vec3 z, int i) {
    const lmp_vec3 other = random_direction(), side = cross(other, z);
    const float per = 1 / std::sqrt(side.x * side.x + side.y * side.y + side.z * side.z);
    const lmp_vec3 x = { side.x * per, side.y * per, side.z * per }, y = cross(z, x);
    const float rows[9] = { x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z };
    std::memcpy(in.matrix[i], rows, sizeof rows);
    in.peer_matrix[i] = DirectX::XMMatrixSet(x.x, y.x, z.x, 0, x.y, y.y, z.y, 0, x.z, y.z, z.z, 0, 0,
                                             0, 0, 1);
}

void fill_inputs() {
    in.peer_color = DirectX::XMVectorSet(3, 2, 1, 1);
    for (int i = 0; i < INPUTS; i++) {
        const lmp_vec3 w = random_direction();
        const float distance = random_between(1, 4), radius = random_between(0.1f, 0.9f);
        const lmp_vec3 at = { distance * w.x, distance * w.y, distance * w.z };
        in.direction[i] = w;
        in.angle[i] = random_between(-3, 3);
        in.peer_direction[i] = DirectX::XMVectorSet(w.x, w.y, w.z, 0);
        in.peer_position[i] = DirectX::XMVectorSet(at.x, at.y, at.z, 0);
        fill_rotation(w, i);
        for (int k = 0; k < MOST; k++) {
            in.a[i][k] = random_between(-1, 1);
            in.b[i][k] = random_between(-1, 1);
        }
        lmp_light light = {};
        light.radiance = { 3, 2, 1 };
        light.position = at;
        light.radius = radius;
        in.sphere[i] = light;
        light.direction = w;
        light.kind = LMP_LIGHT_DIRECTIONAL;
        in.sun[i] = light;
        light.kind = LMP_LIGHT_CAP;
        light.angle = radius;
        in.cap[i] = light;
    }
    for (int bands = 1; bands <= 6; bands++)
        lmp_sh_product_create(nullptr, bands, &in.product[bands]);
}

/* --- the calls -------------------------------------------------------------------------------- */

size_t order_of(int bands) {
    return static_cast<size_t>(bands);
}

struct call {
    const char *name;
    void (*ours)(int bands, int i);
    void (*peer)(int bands, int i);
    int each; /* calls of the peer, or lights, that one of our calls stands for */
};

float *channel(int bands, int c) {
    return in.out + static_cast<size_t>(c) * LMP_SH_COUNT(bands);
}

void peer_sphere(int bands, int i, float *red, float *green, float *blue) {
    DirectX::XMSHEvalSphericalLight(order_of(bands), in.peer_position[i], in.sphere[i].radius,
                                    in.peer_color, red, green, blue);
}

/* A sum of 32 lights as its users write it. */
void peer_probe(int bands, int) {
    std::memset(in.sum, 0, sizeof in.sum);
    for (int k = 0; k < 32; k++) {
        peer_sphere(bands, k, channel(bands, 0), channel(bands, 1), channel(bands, 2));
        for (int c = 0; c < 3; c++) {
            float *sum = in.sum + static_cast<size_t>(c) * LMP_SH_COUNT(bands);
            DirectX::XMSHAdd(sum, order_of(bands), sum, channel(bands, c));
        }
    }
}

void peer_multiply(int bands, int i) {
    float *(*const of[])(float *, const float *, const float *) = {
        DirectX::XMSHMultiply2, DirectX::XMSHMultiply3, DirectX::XMSHMultiply4,
        DirectX::XMSHMultiply5, DirectX::XMSHMultiply6
    };
    of[bands - 2](in.out, in.a[i], in.b[i]);
}

lmp_vec3_array point_of(const lmp_vec3 *points) {
    return { &points->x, &points->y, &points->z, sizeof *points };
}

void one_sphere_n(int bands, int i) {
    lmp_light_project_n(nullptr, bands, &in.sphere[i], 1, nullptr, point_of(&origin), 1, lmp_sh_planar(in.out, 0));
}

/* One point by the batch stands beside one light by the call. */
void one_sphere(int bands, int i) {
    lmp_light_project(bands, &in.sphere[i], 1, origin, in.out);
}

const call calls[] = {
    { "evaluate a direction", [](int n, int i) { lmp_sh_eval(n, in.direction[i], in.out); },
      [](int n, int i) {
          DirectX::XMSHEvalDirection(in.out, order_of(n), in.peer_direction[i]);
      },
      1 },
    { "dot", [](int n, int i) { in.out[0] = lmp_sh_dot(n, in.a[i], in.b[i]); },
      [](int n, int i) { in.out[0] = DirectX::XMSHDot(order_of(n), in.a[i], in.b[i]); }, 1 },
    { "add", [](int n, int i) { lmp_sh_combine(n, 1, in.a[i], 1, in.b[i], in.out); },
      [](int n, int i) { DirectX::XMSHAdd(in.out, order_of(n), in.a[i], in.b[i]); }, 1 },
    { "multiply", [](int n, int i) { lmp_sh_multiply(in.product[n], in.a[i], in.b[i], in.out); },
      peer_multiply, 1 },
    { "rotate by a matrix",
      [](int n, int i) { lmp_sh_rotate_by_matrix(n, in.matrix[i], in.a[i], in.out); },
      [](int n, int i) { DirectX::XMSHRotate(in.out, order_of(n), in.peer_matrix[i], in.a[i]); },
      1 },
    { "rotate around z", [](int n, int i) { lmp_sh_rotate_z(n, in.angle[i], in.a[i], in.out); },
      [](int n, int i) { DirectX::XMSHRotateZ(in.out, order_of(n), in.angle[i], in.a[i]); }, 1 },
    { "directional light in RGB",
      [](int n, int i) { lmp_light_project(n, &in.sun[i], 1, origin, in.out); },
      [](int n, int i) {
          DirectX::XMSHEvalDirectionalLight(order_of(n), in.peer_direction[i], in.peer_color,
                                            channel(n, 0), channel(n, 1), channel(n, 2));
      },
      1 },
    { "sphere in RGB", one_sphere,
      [](int n, int i) { peer_sphere(n, i, channel(n, 0), channel(n, 1), channel(n, 2)); }, 1 },
    { "sphere of one color",
      [](int n, int i) {
          lmp_sphere_project(n, in.sphere[i].position, in.sphere[i].radius, origin, in.out);
      },
      [](int n, int i) { peer_sphere(n, i, in.out, nullptr, nullptr); }, 1 },
    { "cone in RGB", [](int n, int i) { lmp_light_project(n, &in.cap[i], 1, origin, in.out); },
      [](int n, int i) {
          DirectX::XMSHEvalConeLight(order_of(n), in.peer_direction[i], in.cap[i].angle,
                                     in.peer_color, channel(n, 0), channel(n, 1), channel(n, 2));
      },
      1 },
    { "32 spheres in RGB: one of them",
      [](int n, int) { lmp_light_project(n, in.sphere, 32, origin, in.sum); }, peer_probe, 32 },
    { "a point by _n; the call beside it", one_sphere_n, one_sphere, 1 },
};

/* --- times ------------------------------------------------------------------------------------ */

double run(void (*call)(int, int), int bands, int count) {
    const auto start = std::chrono::steady_clock::now();
    for (int k = 0; k < count; k++)
        call(bands, k % INPUTS);
    const std::chrono::duration<double, std::nano> taken = std::chrono::steady_clock::now() - start;
    return taken.count() / count;
}

double median(double *values, int count) {
    std::sort(values, values + count);
    return values[count / 2];
}

void measure(const call &c, int bands) {
    double ours[PAIRS], peer[PAIRS], ratio[PAIRS];
    const int count = CALLS / c.each + 1;
    for (int pair = -1; pair < PAIRS; pair++) {
        const int at = pair < 0 ? 0 : pair; /* the first pair warms up */
        ours[at] = run(c.ours, bands, count) / c.each;
        peer[at] = run(c.peer, bands, count) / c.each;
        ratio[at] = peer[at] / ours[at];
    }
    const double our_median = median(ours, PAIRS), peer_median = median(peer, PAIRS);
    std::printf("%s,%d,%.2f,%.2f,%.2f\n", c.name, bands, our_median, peer_median,
                median(ratio, PAIRS));
}

} // namespace

/* calls [WORD [FLAGS]]: those whose name has the word in it, by instruction sets of these
 * lmp_cpu_flag bits. */
int main(int argc, char **argv) {
    if (argc > 2)
        lmp_cpu_limit(static_cast<unsigned>(std::atoi(argv[2])));
    fill_inputs();
    std::printf("call,bands,ours_ns,peer_ns,peer_over_ours\n");
    for (const call &c : calls)
        for (int bands = 2; bands <= 6; bands++)
            if (argc < 2 || std::strstr(c.name, argv[1]))
                measure(c, bands);
    for (lmp_sh_product *product : in.product)
        lmp_sh_product_destroy(product);
}
