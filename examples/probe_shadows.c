/* SPDX-License-Identifier: MIT */
/* probe_shadows.c - a grid of light probes under a roof: rays of Embree find how much of each light
 * reaches each probe, and the library projects that.
 *
 *     cc probe_shadows.c $(pkg-config --cflags --libs lampion) -lembree3 -lm -o probe_shadows */
#include <embree3/rtcore.h>
#include <lampion/lampion.h>

#include <math.h>
#include <stdio.h>

enum { BANDS = 4, COEFFICIENTS = BANDS * BANDS, PROBES = 9, LIGHTS = 2, RAYS = 256 };

/* A square roof of 2 x 2 at height 2. */
static float corners[4][3] = { { -1, 2, -1 }, { 1, 2, -1 }, { 1, 2, 1 }, { -1, 2, 1 } };
static unsigned triangles[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };

static RTCScene open_scene(RTCDevice device) {
    RTCScene scene = rtcNewScene(device);
    RTCGeometry roof = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(roof, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, corners, 0,
                               sizeof corners[0], 4);
    rtcSetSharedGeometryBuffer(roof, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, triangles, 0,
                               sizeof triangles[0], 2);
    rtcCommitGeometry(roof);
    rtcAttachGeometry(scene, roof);
    rtcReleaseGeometry(roof);
    rtcCommitScene(scene);
    return scene;
}

/* Whether anything lies between two points. */
static int is_hidden(RTCScene scene, lmp_vec3 from, lmp_vec3 to) {
    struct RTCIntersectContext context;
    struct RTCRay ray = { .org_x = from.x,
                          .org_y = from.y,
                          .org_z = from.z,
                          .dir_x = to.x - from.x,
                          .dir_y = to.y - from.y,
                          .dir_z = to.z - from.z,
                          .tfar = 1,
                          .mask = ~0u };
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene, &context, &ray);
    return ray.tfar < 0;
}

/* Returns the fraction of a light that a point sees, by rays to a disk as large as the light, which
 * faces the point, spread over it in a spiral. */
static float visibility_of(RTCScene scene, const lmp_light *light, lmp_vec3 point) {
    const lmp_vec3 c = light->position;
    const float x = c.x - point.x, y = c.y - point.y, z = c.z - point.z;
    const float across = hypotf(x, y), distance = hypotf(across, z);
    const lmp_vec3 u = { -y / across, x / across, 0 };
    const lmp_vec3 v = { -x * z / (across * distance), -y * z / (across * distance),
                         across / distance };
    int seen = 0;
    for (int i = 0; i < RAYS; i++) {
        const float r = light->radius * sqrtf(((float)i + 0.5f) / RAYS),
                    angle = 2.399963f * (float)i;
        const float s = r * cosf(angle), t = r * sinf(angle);
        const lmp_vec3 to = { c.x + s * u.x + t * v.x, c.y + s * u.y + t * v.y,
                              c.z + s * u.z + t * v.z };
        seen += !is_hidden(scene, point, to);
    }
    return (float)seen / RAYS;
}

int main(void) {
    const lmp_light lights[LIGHTS] = {
        { .position = { 0.1f, 4, 0 }, .radius = 0.5f, .radiance = { 20, 20, 20 } },
        { .position = { 5, 3, 0 }, .radius = 0.3f, .radiance = { 20, 20, 20 } },
    };
    const lmp_spheres spheres = lmp_spheres_of(lights);
    lmp_vec3 positions[PROBES];
    float visibility[LIGHTS][PROBES], probes[PROBES][3][COEFFICIENTS], lambda[BANDS],
        lobe[COEFFICIENTS];
    RTCDevice device = rtcNewDevice(NULL);
    RTCScene scene = open_scene(device);
    for (int p = 0; p < PROBES; p++)
        positions[p] = (lmp_vec3) { (float)(p - PROBES / 2), 0, 0 };
    for (int i = 0; i < LIGHTS; i++)
        for (int p = 0; p < PROBES; p++)
            visibility[i][p] = visibility_of(scene, &lights[i], positions[p]);
    lmp_sphere_sum_n(NULL, BANDS, &spheres, LIGHTS, &visibility[0][0], lmp_vec3_array_of(positions),
                     PROBES, lmp_sh_interleaved(&probes[0][0][0], 0));
    lmp_lobe_make_diffuse(BANDS, lambda);
    lmp_lobe_project(BANDS, lambda, (lmp_vec3) { 0, 1, 0 }, lobe);
    puts("   x  lamp above  lamp beside  irradiance");
    for (int p = 0; p < PROBES; p++)
        printf("%4.0f  %10.2f  %11.2f  %10.2f\n", (double)positions[p].x, (double)visibility[0][p],
               (double)visibility[1][p], (double)lmp_sh_dot(BANDS, probes[p][0], lobe));
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
    return 0;
}
