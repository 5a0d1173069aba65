/* SPDX-License-Identifier: MIT */
/* No function needs more than the 64 KB of stack that base.h promises: each is called with all the
 * bands it takes on a thread whose stack is painted, and ends at a page that cannot be written. */
#include "tests/oracle/check.h"

#include <lampion/lampion.h>

#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

enum {
    N = LMP_BANDS_MAX,
    COUNT = 17,
    LIGHTS = 9,
    BOUND = 65536,
    STACK = BOUND + 65536,
    PAGE = 4096
};

/* --- arguments -------------------------------------------------------------------------------- */

static const lmp_vec3 up = { 0, 0, 1 }, at = { 0.1f, 0.2f, 0.3f };
static const lmp_quat rotated_by = { 0.1f, 0.2f, 0.3f, 0.9f };
static const float unrotated[9] = { 1, 0, 0, 0, 1, 0, 0, 0, 1 };
static float sh[COUNT * 3 * N * N], out[COUNT * 3 * N * N], slopes[COUNT * 9 * N * N];
/* Elements of results that are stored past the caches. */
enum { LARGE = 42016 };
static float large[LARGE * 100];
static const float one_radius = 0.1f;
static const lmp_spheres one_sphere = { .center = { &up.x, &up.y, &up.z, 0 },
                                        .radius = { &one_radius, 0 } };
static float matrices[LMP_SH_ROTATION_COUNT(N)], weights[N], lambda[N], rgb[3 * COUNT];
static const double up_double[3] = { 0, 0, 1 }, turned_double[4] = { 0.1, 0.2, 0.3, 0.9 };
static double sh_double[N * N], out_double[N * N], slopes_double[3 * N * N],
    hessian_double[6 * N * N];
static double matrices_double[LMP_SH_ROTATION_COUNT(N)];
static float numbers[COUNT], texels[6 * 3 * 4 * 4];
static float ggx_texels[4 * LMP_GGX_TEXELS];
static lmp_ggx_lobes ggx;
static uint16_t halves[COUNT];
static lmp_vec3 vectors[COUNT];
static lmp_light lights[LIGHTS];
/* The area with the longest outline for its time at all bands. */
static const lmp_light area = { .kind = LMP_LIGHT_TUBE,
                                .position = { 0, 0, 30 },
                                .half = { { 1, 0, 0 } },
                                .radius = 0.5f,
                                .radiance = { 1, 1, 1 } };
/* And a disk and an area with the most corners, for the kernels. */
static const lmp_light disk = { .kind = LMP_LIGHT_DISK,
                                .position = { 0, 0, 3 },
                                .direction = { 0, 0, -1 },
                                .radius = 1,
                                .radiance = { 1, 1, 1 } };
static const lmp_light panel = { .kind = LMP_LIGHT_POLYGON,
                                 .position = { 0, 0, 3 },
                                 .two_sided = true,
                                 .corner_count = 8,
                                 .corner = { { 2, 1, 0 },
                                             { 1, 2, 0 },
                                             { -1, 2, 0 },
                                             { -2, 1, 0 },
                                             { -2, -1, 0 },
                                             { -1, -2, 0 },
                                             { 1, -2, 0 },
                                             { 2, -1, 0 } },
                                 .radiance = { 1, 1, 1 } };
static lmp_cap cap;
static lmp_spheres spheres;
static lmp_vec3_array points;
static lmp_float_array floats;
static lmp_sh_product *product;
static lmp_brdf *brdf, *read_brdf;
static lmp_sgd sgd;
static lmp_brdf_table *table, *read_table;
static lmp_preintegrated_lobe *lobe, *read_lobe;
static lmp_preintegrated_brdf *preintegrated, *read_preintegrated;
static lmp_field *field, *read_field;
static const lmp_field_desc small_field = { .bands = LMP_FIELD_BANDS_MAX, .nodes = { 4, 4, 4 } };
static lmp_transfer *transfer;
static const lmp_transfer_surfel surfel = { .normal = { 0, 0, 1 }, .radius = 1 };
static const uint32_t nothing_hit[COUNT];
static lmp_probe_constants constants;
static lmp_probe_convention convention;
static lmp_parse_error parse_error;
static double doubles[3] = { 0.6, 0, 0.8 };
static void *bytes, *merl, *rgl;
static size_t bytes_size = 1 << 24, merl_size, rgl_size;
static const lmp_brdf_table_desc small_table = { .bands = 4, .views = 2, .rings_max = 16 };
static const lmp_preintegrated_brdf_desc coarse = { .error = 0.1f };
static lmp_material material;
static lmp_surface surface = { .normal = { 0, 0, 1 }, .view = { 0.6f, 0, 0.8f } };
static lmp_surfaces surfaces;
static lmp_shade_settings settings;

static float ramp(lmp_vec3 direction, void *user) {
    (void)user;
    return direction.z;
}

static lmp_rgb gray_ramp(lmp_vec3 direction, void *user) {
    const float gray = ramp(direction, user);
    return (lmp_rgb) { gray, gray, gray };
}

/* Shades one surface by lmp_shade, or many by lmp_shade_n. */
static void shade(bool one, const lmp_light *by, size_t count) {
    if (one)
        (void)lmp_shade(&settings, &material, &surface, by, count);
    else
        lmp_shade_n(&settings, &surfaces, COUNT, by, count, (lmp_rgb_array) { rgb, 0 });
}

static void shade_all_ways(bool one) {
    const lmp_brdf_table *white[LMP_SHEEN_TABLES];
    for (int i = 0; i < LMP_SHEEN_TABLES; i++)
        white[i] = table;
    for (int method = 0; method < LMP_SHADE_METHOD_COUNT; method++)
        for (int kind = 0; kind < 4; kind++) {
            settings = (lmp_shade_settings) { .method = (lmp_shade_method)method,
                                              .bands = N,
                                              .lobe = lobe };
            material = (lmp_material) { .kind = (lmp_material_kind)kind,
                                        .diffuse = { 1, 1, 1 },
                                        .specular = { 1, 1, 1 },
                                        .exponent = 20,
                                        .roughness = 0.4f,
                                        .sheen = { { 1, 1, 1 }, 0.5f, white },
                                        .coat = { 1, 0.5f },
                                        .table = table,
                                        .preintegrated = preintegrated };
            shade(one, lights, LIGHTS);
            if (kind == LMP_MATERIAL_PREINTEGRATED ||
                (kind == LMP_MATERIAL_TABLE && method == LMP_SHADE_PREINTEGRATED))
                continue; /* areas do not shine on them */
            shade(one, &area, 1);
            if (one || method == LMP_SHADE_COEFFICIENTS)
                continue; /* all areas are projected alike, and slowly */
            shade(one, &panel, 1);
            shade(one, &disk, 1);
        }
}

/* Shades surfaces of every kind that is shaded differently under a field. */
static void shade_under_a_field(void) {
    for (int kind = 0; kind < 4; kind++) {
        material = (lmp_material) { .kind = (lmp_material_kind)kind,
                                    .diffuse = { 1, 1, 1 },
                                    .roughness = 0.4f,
                                    .table = table,
                                    .preintegrated = preintegrated };
        lmp_field_shade_n(NULL, field, &surfaces, COUNT, (lmp_rgb_array) { rgb, 0 });
    }
}

/* --- every function --------------------------------------------------------------------------- */

/* Makes an object before its use; one made before is destroyed. */
#define MAKE(destroy, object, ...) (destroy(object), (object) = NULL, (void)(__VA_ARGS__))

#define LAYOUTS(...)                                                                               \
    for (lmp_sh_layout layout = LMP_SH_INTERLEAVED; layout <= LMP_SH_PLANAR; layout++)             \
    __VA_ARGS__

/* clang-format off */
#define CALLS(X) \
    X(lmp_version, lmp_version()) \
    X(lmp_result_text, lmp_result_text(LMP_OK)) \
    X(lmp_cpu_flags, lmp_cpu_flags()) \
    X(lmp_cpu_name, lmp_cpu_name()) \
    X(lmp_sh_eval, lmp_sh_eval(N, up, sh)) \
    X(lmp_sh_eval_gradient, lmp_sh_eval_gradient(N, up, out, slopes)) \
    X(lmp_sh_combine, lmp_sh_combine(N, 1, sh, 2, sh, out)) \
    X(lmp_sh_dot, lmp_sh_dot(N, sh, sh)) \
    X(lmp_sh_reconstruct, lmp_sh_reconstruct(N, sh, up)) \
    X(lmp_sh_expand_zonal, lmp_sh_expand_zonal(N, lambda, up, out)) \
    X(lmp_sh_make_rotation, lmp_sh_make_rotation(N, rotated_by, matrices)) \
    X(lmp_sh_make_rotation_from_matrix, lmp_sh_make_rotation_from_matrix(N, unrotated, matrices)) \
    X(lmp_sh_rotate_by_matrix, lmp_sh_rotate_by_matrix(N, unrotated, sh, out)) \
    X(lmp_sh_rotate_z, lmp_sh_rotate_z(N, 0.5f, sh, out)) \
    X(lmp_sh_rotate, lmp_sh_rotate(N, matrices, sh, out)) \
    X(lmp_sh_eval_double, lmp_sh_eval_double(N, up_double, out_double)) \
    X(lmp_sh_eval_gradient_double, lmp_sh_eval_gradient_double(N, up_double, out_double, slopes_double)) \
    X(lmp_sh_eval_hessian_double, lmp_sh_eval_hessian_double(N, up_double, hessian_double)) \
    X(lmp_sh_make_rotation_double, lmp_sh_make_rotation_double(N, turned_double, matrices_double)) \
    X(lmp_sh_rotate_double, lmp_sh_rotate_double(N, matrices_double, sh_double, out_double)) \
    X(lmp_sphere_project_double, lmp_sphere_project_double(N, up_double, 0.5, turned_double, out_double)) \
    X(lmp_sh_make_window, lmp_sh_make_window(N, LMP_WINDOW_HANNING, 0, weights)) \
    X(lmp_sh_window_name, lmp_sh_window_name(LMP_WINDOW_HANNING)) \
    X(lmp_sh_make_laplacian_window, lmp_sh_make_laplacian_window(N, 0.5f, sh, weights)) \
    X(lmp_sh_apply_window, lmp_sh_apply_window(N, weights, sh, out)) \
    X(lmp_sh_project_function, lmp_sh_project_function(N, 4, ramp, NULL, out)) \
    X(lmp_sh_project_function_rgb, lmp_sh_project_function_rgb(N, 4, gray_ramp, NULL, out)) \
    X(lmp_sh_project_latlong, lmp_sh_project_latlong(N, &(lmp_latlong) { .pixels = texels, .width = 4, .height = 4, .channels = 3 }, out)) \
    X(lmp_sh_project_cubemap, lmp_sh_project_cubemap(N, &(lmp_cubemap) { .faces = { texels, texels, texels, texels, texels, texels }, .size = 4, .channels = 3 }, out)) \
    X(lmp_sh_product_create, MAKE(lmp_sh_product_destroy, product, lmp_sh_product_create(NULL, N, &product))) \
    X(lmp_sh_multiply_few, lmp_sh_multiply_few(N < LMP_SH_FEW_BANDS ? N : LMP_SH_FEW_BANDS, sh, sh, out)) \
    X(lmp_sh_multiply, lmp_sh_multiply(product, sh, sh, out)) \
    X(lmp_sh_product_destroy, lmp_sh_product_destroy(product), product = NULL) \
    X(lmp_sh_eval_n, LAYOUTS(lmp_sh_eval_n(N, points, COUNT, (lmp_sh_array) { out, 0, layout }), lmp_sh_eval_n(10, lmp_vec3_array_same(&up), LARGE, (lmp_sh_array) { large, 0, layout }))) \
    X(lmp_sh_eval_gradient_n, LAYOUTS(lmp_sh_eval_gradient_n(N, points, COUNT, (lmp_sh_array) { out, 0, layout }, (lmp_sh_array) { slopes, 0, layout }))) \
    X(lmp_sh_pack_half_n, lmp_sh_pack_half_n(sh, COUNT, halves)) \
    X(lmp_sh_unpack_half_n, lmp_sh_unpack_half_n(halves, COUNT, out)) \
    X(lmp_sh_dot_n, LAYOUTS(lmp_sh_dot_n(N, layout, 0, sh, sh, COUNT, rgb))) \
    X(lmp_sh_rotate_n, LAYOUTS(lmp_sh_rotate_n(N, matrices, sh, COUNT, (lmp_sh_array) { out, 0, layout }))) \
    X(lmp_light_find_cap, lmp_light_find_cap(lights, at, &cap)) \
    X(lmp_light_irradiance, lmp_light_irradiance(lights, LIGHTS, at, up), lmp_light_irradiance(&area, 1, at, up)) \
    X(lmp_light_project_zonal, lmp_light_project_zonal(N, lights, at, lambda, &vectors[0])) \
    X(lmp_light_project, lmp_light_project(N, lights, LIGHTS, at, out), lmp_light_project(N, &area, 1, at, out)) \
    X(lmp_light_project_channels, lmp_light_project_channels(N, lights, LIGHTS, at, out, NULL, slopes)) \
    X(lmp_sphere_project_zonal, lmp_sphere_project_zonal(N, 0.5f, 1, lambda)) \
    X(lmp_sphere_project, lmp_sphere_project(N, up, 0.5f, at, out)) \
    X(lmp_light_project_gradient, lmp_light_project_gradient(N, &area, at, out, slopes)) \
    X(lmp_sphere_project_gradient, lmp_sphere_project_gradient(N, up, 0.5f, at, out, slopes)) \
    X(lmp_sphere_project_zonal_n, LAYOUTS(lmp_sphere_project_zonal_n(N, floats, floats, COUNT, (lmp_sh_array) { out, 0, layout }))) \
    X(lmp_sphere_project_n, LAYOUTS(lmp_sphere_project_n(N, &spheres, points, LIGHTS, (lmp_sh_array) { out, 0, layout }), lmp_sphere_project_n(10, &one_sphere, lmp_vec3_array_same(&at), LARGE, (lmp_sh_array) { large, 0, layout }))) \
    X(lmp_sphere_project_all_n, LAYOUTS(lmp_sphere_project_all_n(N, &spheres, LIGHTS, points, 5, (lmp_sh_array) { out, 0, layout }))) \
    X(lmp_sphere_sum_n, LAYOUTS(lmp_sphere_sum_n(NULL, N, &spheres, LIGHTS, NULL, points, COUNT, (lmp_sh_array) { out, 0, layout }))) \
    X(lmp_sphere_sum_gradient_n, LAYOUTS(lmp_sphere_sum_gradient_n(NULL, N, &spheres, LIGHTS, points, COUNT, (lmp_sh_array) { out, 0, layout }, (lmp_sh_array) { slopes, 0, layout }))) \
    X(lmp_light_project_n, LAYOUTS(lmp_light_project_n(NULL, N, lights, LIGHTS, NULL, points, COUNT, (lmp_sh_array) { out, 0, layout }), lmp_light_project_n(NULL, N, &area, 1, NULL, points, 1, (lmp_sh_array) { out, 0, layout }))) \
    X(lmp_light_add_n, LAYOUTS(lmp_light_add_n(NULL, N, lights, LIGHTS, large, points, COUNT, (lmp_sh_array) { out, 0, layout }))) \
    X(lmp_light_range, (void)lmp_light_range(lights, 0.1f)) \
    X(lmp_sphere_power_from_radiance, lmp_sphere_power_from_radiance(1, 1)) \
    X(lmp_sphere_radiance_from_power, lmp_sphere_radiance_from_power(1, 1)) \
    X(lmp_sphere_intensity_from_radiance, lmp_sphere_intensity_from_radiance(1, 1)) \
    X(lmp_sphere_radiance_from_intensity, lmp_sphere_radiance_from_intensity(1, 1)) \
    X(lmp_light_cap_irradiance_from_radiance, lmp_light_cap_irradiance_from_radiance(1, 1)) \
    X(lmp_light_cap_radiance_from_irradiance, lmp_light_cap_radiance_from_irradiance(1, 1)) \
    X(lmp_light_power_from_radiance, lmp_light_power_from_radiance(&area, 1)) \
    X(lmp_light_radiance_from_power, lmp_light_radiance_from_power(&area, 1)) \
    X(lmp_light_intensity_from_radiance, lmp_light_intensity_from_radiance(&area, 1)) \
    X(lmp_light_radiance_from_intensity, lmp_light_radiance_from_intensity(&area, 1)) \
    X(lmp_lobe_make_diffuse, lmp_lobe_make_diffuse(N, lambda)) \
    X(lmp_lobe_make_phong, lmp_lobe_make_phong(N, 20, lambda)) \
    X(lmp_lobe_make_vmf, lmp_lobe_make_vmf(N, 20, lambda)) \
    X(lmp_lobe_project, lmp_lobe_project(N, lambda, up, out)) \
    X(lmp_lobe_response, lmp_lobe_response(N, lambda, up, lights, LIGHTS, at), lmp_lobe_response(N, lambda, up, &area, 1, at)) \
    X(lmp_lobe_response_n, LAYOUTS(lmp_lobe_response_n(N, lambda, points, &spheres, LIGHTS, points, COUNT, (lmp_rgb_array) { rgb, 0 }))) \
    X(lmp_lobe_find_ggx, lmp_lobe_find_ggx(up, up, 0.5f, &ggx)) \
    X(lmp_lobe_copy_ggx_texels, lmp_lobe_copy_ggx_texels(ggx_texels)) \
    X(lmp_probe_irradiance, lmp_probe_irradiance(N, sh, up)) \
    X(lmp_probe_irradiance_n, lmp_probe_irradiance_n(N, sh, points, COUNT, lmp_rgb_array_of((lmp_rgb *)(void *)rgb))) \
    X(lmp_probe_make_constants, lmp_probe_make_constants(N, 1, sh, &constants)) \
    X(lmp_probe_fit, lmp_probe_fit(NULL, 3, 1, &(lmp_probe_samples) { points, floats, { 0 }, COUNT }, out)) \
    X(lmp_probe_make_positive_window, lmp_probe_make_positive_window(LMP_PROBE_POSITIVE_BANDS_MAX, sh, 3, weights)) \
    X(lmp_probe_minimum, lmp_probe_minimum(3, sh)) \
    X(lmp_probe_convert, lmp_probe_convert(N, &convention, &convention, sh, out)) \
    X(lmp_probe_engine_format, lmp_probe_engine_format(LMP_PROBE_UNITY)) \
    X(lmp_probe_export, lmp_probe_export(N, lmp_probe_engine_format(LMP_PROBE_UNREAL), sh, out)) \
    X(lmp_probe_recognize, lmp_probe_recognize(N, 0.1f, sh, sh, &convention)) \
    X(lmp_brdf_create_lambert, MAKE(lmp_brdf_destroy, brdf, lmp_brdf_create_lambert(NULL, (lmp_rgb) { 1, 1, 1 }, &brdf))) \
    X(lmp_brdf_create_phong, MAKE(lmp_brdf_destroy, brdf, lmp_brdf_create_phong(NULL, (lmp_rgb) { 1, 1, 1 }, 20, &brdf))) \
    X(lmp_brdf_sgd_name, lmp_brdf_sgd_name(0)) \
    X(lmp_brdf_find_sgd, lmp_brdf_find_sgd("chrome", &sgd)) \
    X(lmp_brdf_create_sgd, MAKE(lmp_brdf_destroy, brdf, lmp_brdf_create_sgd(NULL, &sgd, &brdf))) \
    X(lmp_brdf_create_ggx, MAKE(lmp_brdf_destroy, brdf, lmp_brdf_create_ggx(NULL, &(lmp_ggx) { 0.5f, 0, { 1, 1, 1 }, { 0, 0, 0 } }, &brdf))) \
    X(lmp_brdf_create_sheen, MAKE(lmp_brdf_destroy, brdf, lmp_brdf_create_sheen(NULL, &(lmp_sheen) { 0.5f, { 1, 1, 1 }, { 0, 0, 0 } }, &brdf))) \
    X(lmp_brdf_describe, lmp_brdf_describe(brdf)) \
    X(lmp_brdf_eval, lmp_brdf_eval(brdf, up, up)) \
    X(lmp_brdf_eval_double, lmp_brdf_eval_double(brdf, doubles, doubles, (double[3]) { 0 })) \
    X(lmp_brdf_encode_merl, free(merl), (void)lmp_brdf_encode_merl(NULL, brdf, &merl, &merl_size)) \
    X(lmp_brdf_read_merl, MAKE(lmp_brdf_destroy, read_brdf, lmp_brdf_read_merl(NULL, merl, merl_size, &parse_error, &read_brdf))) \
    X(lmp_brdf_encode_rgl, free(rgl), (void)lmp_brdf_encode_rgl(NULL, brdf, &rgl, &rgl_size)) \
    X(lmp_brdf_read_rgl, MAKE(lmp_brdf_destroy, read_brdf, lmp_brdf_read_rgl(NULL, rgl, rgl_size, &parse_error, &read_brdf))) \
    X(lmp_brdf_destroy, lmp_brdf_destroy(read_brdf), read_brdf = NULL) \
    X(lmp_brdf_project, lmp_brdf_project(NULL, N, 2, brdf, up, out)) \
    X(lmp_brdf_table_create, MAKE(lmp_brdf_table_destroy, table, lmp_brdf_table_create(NULL, &small_table, brdf, &table))) \
    X(lmp_brdf_table_describe, lmp_brdf_table_describe(table)) \
    X(lmp_brdf_table_coefficients, lmp_brdf_table_coefficients(table)) \
    X(lmp_brdf_table_interpolate, lmp_brdf_table_interpolate(table, 0.5f, 0, out)) \
    X(lmp_brdf_table_find_albedo, lmp_brdf_table_find_albedo(table, 0, 0, (lmp_rgb *)(void *)rgb, (lmp_rgb *)(void *)rgb + 1)) \
    X(lmp_brdf_table_size, lmp_brdf_table_size(table)) \
    X(lmp_brdf_table_write, lmp_brdf_table_write(table, lmp_brdf_table_size(table), bytes)) \
    X(lmp_brdf_table_read, MAKE(lmp_brdf_table_destroy, read_table, lmp_brdf_table_read(NULL, bytes, lmp_brdf_table_size(table), &parse_error, &read_table))) \
    X(lmp_brdf_table_destroy, lmp_brdf_table_destroy(read_table), read_table = NULL) \
    X(lmp_preintegrated_lobe_create, MAKE(lmp_preintegrated_lobe_destroy, lobe, lmp_preintegrated_lobe_create(NULL, &(lmp_preintegrated_lobe_desc) { .bands = N, .error = 0.1f }, &lobe))) \
    X(lmp_preintegrated_lobe_describe, lmp_preintegrated_lobe_describe(lobe)) \
    X(lmp_preintegrated_lobe_eval, lmp_preintegrated_lobe_eval(lobe, 20, 0.5f, 0.5f)) \
    X(lmp_preintegrated_lobe_size, lmp_preintegrated_lobe_size(lobe)) \
    X(lmp_preintegrated_lobe_write, lmp_preintegrated_lobe_write(lobe, lmp_preintegrated_lobe_size(lobe), bytes)) \
    X(lmp_preintegrated_lobe_read, MAKE(lmp_preintegrated_lobe_destroy, read_lobe, lmp_preintegrated_lobe_read(NULL, bytes, lmp_preintegrated_lobe_size(lobe), NULL, &read_lobe))) \
    X(lmp_preintegrated_lobe_destroy, lmp_preintegrated_lobe_destroy(read_lobe), read_lobe = NULL) \
    X(lmp_preintegrated_brdf_create, MAKE(lmp_preintegrated_brdf_destroy, preintegrated, lmp_preintegrated_brdf_create(NULL, &coarse, table, &preintegrated))) \
    X(lmp_preintegrated_brdf_describe, lmp_preintegrated_brdf_describe(preintegrated)) \
    X(lmp_preintegrated_brdf_eval, lmp_preintegrated_brdf_eval(preintegrated, 0.5f, up, 0.5f)) \
    X(lmp_preintegrated_brdf_ambient, lmp_preintegrated_brdf_ambient(preintegrated, 0.5f)) \
    X(lmp_preintegrated_brdf_size, lmp_preintegrated_brdf_size(preintegrated)) \
    X(lmp_preintegrated_brdf_write, lmp_preintegrated_brdf_write(preintegrated, lmp_preintegrated_brdf_size(preintegrated), bytes)) \
    X(lmp_preintegrated_brdf_read, MAKE(lmp_preintegrated_brdf_destroy, read_preintegrated, lmp_preintegrated_brdf_read(NULL, bytes, lmp_preintegrated_brdf_size(preintegrated), NULL, &read_preintegrated))) \
    X(lmp_preintegrated_brdf_destroy, lmp_preintegrated_brdf_destroy(read_preintegrated), read_preintegrated = NULL) \
    X(lmp_shade, shade_all_ways(true)) \
    X(lmp_shade_n, shade_all_ways(false)) \
    X(lmp_shade_environment, lmp_shade_environment(&(lmp_shade_settings) { .bands = N }, &(lmp_material) { .exponent = 20 }, &(lmp_surface) { at, up, up, up, up }, &(lmp_environment) { sh, N })) \
    X(lmp_material_dielectric, (void)lmp_material_dielectric(2, 1, (lmp_rgb) { 1, 1, 1 })) \
    X(lmp_material_coat_reflectance, (void)lmp_material_coat_reflectance(&(lmp_coat) { 1, 0.5f }, up, up)) \
    X(lmp_shade_environment_n, lmp_shade_environment_n(NULL, &(lmp_surfaces) { .position = points, .normal = points, .view = points, .material = &(lmp_material) { .kind = LMP_MATERIAL_TABLE, .table = table, .coat = { 1, 0.5f } } }, COUNT, &(lmp_environment) { sh, N }, (lmp_rgb_array) { rgb, 0 })) \
    X(lmp_field_create, MAKE(lmp_field_destroy, field, lmp_field_create(NULL, &small_field, &field))) \
    X(lmp_field_describe, (void)lmp_field_describe(field)) \
    X(lmp_field_lights, (void)lmp_field_lights(field)) \
    X(lmp_field_reset, (void)lmp_field_reset(field, lights, LIGHTS)) \
    X(lmp_field_want_n, lmp_field_want_n(field, points, COUNT)) \
    X(lmp_field_compute, (void)lmp_field_compute(NULL, field)) \
    X(lmp_field_update, (void)lmp_field_update(NULL, field, lights, LIGHTS)) \
    X(lmp_field_move_n, lmp_field_move_n(NULL, field, (size_t[2]) { 1, 2 }, lights, 2)) \
    X(lmp_field_add, (void)lmp_field_add(NULL, field, lights)) \
    X(lmp_field_remove, lmp_field_remove(NULL, field, 3)) \
    X(lmp_field_eval_n, LAYOUTS(lmp_field_eval_n(field, points, COUNT, (lmp_sh_array) { out, 0, layout }))) \
    X(lmp_field_eval_lobe_n, lmp_field_eval_lobe_n(field, lambda, points, points, COUNT, lmp_rgb_array_of((lmp_rgb *)(void *)rgb))) \
    X(lmp_field_shade_n, shade_under_a_field()) \
    X(lmp_field_find_near, (void)lmp_field_find_near(field, at, 0, NULL, NULL)) \
    X(lmp_field_copy_nodes, lmp_field_copy_nodes(field, 0, 2, out)) \
    X(lmp_field_copy_lists, (void)lmp_field_copy_lists(field, 0, NULL, NULL)) \
    X(lmp_field_coarser_level, (void)lmp_field_coarser_level(field)) \
    X(lmp_field_size, (void)lmp_field_size(field)) \
    X(lmp_field_write, lmp_field_write(field, lmp_field_size(field), bytes)) \
    X(lmp_field_read, MAKE(lmp_field_destroy, read_field, lmp_field_read(NULL, bytes, lmp_field_size(field), NULL, &read_field))) \
    X(lmp_field_destroy, lmp_field_destroy(read_field), read_field = NULL) \
    X(lmp_transfer_create, MAKE(lmp_transfer_destroy, transfer, lmp_transfer_create(NULL, &(lmp_transfer_desc) { .surfels = &surfel, .surfel_count = 1, .hits = nothing_hit, .ray_count = COUNT, .links = nothing_hit, .link_count = 1, .probe_directions = vectors, .probe_hits = nothing_hit, .probe_count = 1, .probe_ray_count = COUNT, .bands = LMP_TRANSFER_BANDS_MAX }, &transfer))) \
    X(lmp_transfer_describe, (void)lmp_transfer_describe(transfer)) \
    X(lmp_transfer_update, (void)lmp_transfer_update(NULL, transfer, NULL, &(lmp_transfer_lighting) { 0 })) \
    X(lmp_transfer_reset, lmp_transfer_reset(transfer)) \
    X(lmp_transfer_irradiance, (void)lmp_transfer_irradiance(transfer, 0, at, up)) \
    X(lmp_transfer_copy_irradiance_n, lmp_transfer_copy_irradiance_n(transfer, 0, 1, lmp_rgb_array_of((lmp_rgb *)(void *)rgb))) \
    X(lmp_transfer_eval_probe_n, LAYOUTS(lmp_transfer_eval_probe_n(transfer, 0, 1, (lmp_sh_array) { out, 0, layout }))) \
    X(lmp_transfer_destroy, lmp_transfer_destroy(transfer), transfer = NULL)
/* clang-format on */

#define DEFINE(name, ...)                                                                          \
    static void call_##name(void) {                                                                \
        __VA_ARGS__;                                                                               \
    }
CALLS(DEFINE)

typedef struct call {
    const char *name;
    void (*run)(void);
} call;

#define ENTRY(name, ...) { #name, call_##name },
static const call calls[] = { CALLS(ENTRY) };
enum { CALLED = sizeof calls / sizeof *calls };

/* lmp_cpu_limit chooses the instruction set of the other calls. */
static const char *const uncalled[] = { "lmp_cpu_limit" };

/* --- the stack -------------------------------------------------------------------------------- */

enum { PAINT = 0xa5 };

static void *run_call(void *run) {
    ((const call *)run)->run();
    return NULL;
}

static void do_nothing(void) {}

/* Returns the bytes of stack that a thread takes to make one call, from its highest to the lowest
 * it wrote. */
static size_t stack_of(const call *c, unsigned char *memory) {
    pthread_attr_t attributes;
    pthread_t thread;
    size_t untouched = 0;
    unsigned char *stack = memory + PAGE;
    memset(stack, PAINT, STACK);
    assert_int_equal(pthread_attr_init(&attributes), 0);
    assert_int_equal(pthread_attr_setstack(&attributes, stack, STACK), 0);
    assert_int_equal(pthread_create(&thread, &attributes, run_call, (void *)(uintptr_t)c), 0);
    assert_int_equal(pthread_join(thread, NULL), 0);
    pthread_attr_destroy(&attributes);
    while (untouched < STACK && stack[untouched] == PAINT)
        untouched++;
    return STACK - untouched;
}

static void prepare(void) {
    for (int i = 0; i < COUNT; i++) {
        vectors[i] = check_random_direction();
        numbers[i] = 0.5f + (float)i;
    }
    for (int i = 0; i < LIGHTS; i++)
        lights[i] = (lmp_light) { .kind = (lmp_light_kind)(i % 6),
                                  .position = { 0, 1, (float)i + 2 },
                                  .direction = up,
                                  .radius = 0.5f,
                                  .angle = 0.3f,
                                  .inner = 0.3f,
                                  .outer = 3,
                                  .radiance = { 1, 1, 1 } };
    points = lmp_vec3_array_of(vectors);
    floats = (lmp_float_array) { numbers, sizeof *numbers };
    spheres = lmp_spheres_of(lights);
    surfaces = (lmp_surfaces) {
        .position = points, .normal = points, .view = points, .material = &material
    };
    lmp_lobe_make_diffuse(N, lambda);
    bytes = malloc(bytes_size);
    assert_non_null(bytes);
}

/* Whether the promise holds: only optimized code shares the stack between variables of different
 * lifetimes. */
static bool promised(void) {
#if !defined(__OPTIMIZE__) || defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    return false;
#else
    return true;
#endif
}

static void no_function_needs_more_stack_than_base_promises(void **state) {
    (void)state;
    if (!promised()) {
        check_skip("not an optimized build without sanitizers");
        return;
    }
    unsigned char *memory =
        mmap(NULL, PAGE + STACK, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    assert_true(memory != MAP_FAILED);
    assert_int_equal(mprotect(memory, PAGE, PROT_NONE), 0);
    prepare();
    const call nothing = { "nothing", do_nothing };
    const size_t thread = stack_of(&nothing, memory);
    for (unsigned flag = LMP_CPU_SCALAR; flag < LMP_CPU_ALL; flag *= 2) {
        size_t most = 0;
        const char *name = "";
        if (lmp_cpu_limit(flag) != flag)
            continue;
        for (size_t i = 0; i < CALLED; i++) {
            const size_t taken = stack_of(&calls[i], memory) - thread;
            if (taken > most) {
                most = taken;
                name = calls[i].name;
            }
            if (taken > BOUND)
                fail_msg("%s takes %zu bytes of stack (%s)", calls[i].name, taken, lmp_cpu_name());
        }
        print_message("%s: at most %zu bytes, by %s\n", lmp_cpu_name(), most, name);
    }
    lmp_cpu_limit(LMP_CPU_ALL);
    munmap(memory, PAGE + STACK);
}

static bool is_called(const char *name, size_t length) {
    for (size_t i = 0; i < CALLED; i++)
        if (strlen(calls[i].name) == length && strncmp(calls[i].name, name, length) == 0)
            return true;
    for (size_t i = 0; i < sizeof uncalled / sizeof *uncalled; i++)
        if (strlen(uncalled[i]) == length && strncmp(uncalled[i], name, length) == 0)
            return true;
    return false;
}

static void every_function_of_the_headers_is_called(void **state) {
    (void)state;
    static char text[1 << 20];
    FILE *headers = popen("cat include/lampion/*.h", "r");
    assert_non_null(headers);
    text[fread(text, 1, sizeof text - 1, headers)] = '\0';
    assert_int_equal(pclose(headers), 0);
    int declared = 0;
    for (const char *p = text; (p = strstr(p, "\nLMP_API ")); declared++) {
        const char *end = strchr(p, '('), *name = end;
        while (name[-1] == '_' || (name[-1] >= 'a' && name[-1] <= 'z'))
            name--;
        if (!is_called(name, (size_t)(end - name)))
            fail_msg("%.*s is not in this test", (int)(end - name), name);
        p = end;
    }
    assert_true(declared > 90);
}

/* Binds functions of libm before, because those bound by their first call would use the caller's
 * stack. */
static void bind_before(char *const *arguments) {
    if (getenv("LD_BIND_NOW"))
        return;
    setenv("LD_BIND_NOW", "1", 1);
    execv("/proc/self/exe", arguments);
    perror("/proc/self/exe");
    exit(1);
}

int main(int count, char **arguments) {
    (void)count;
    bind_before(arguments);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_function_of_the_headers_is_called),
        cmocka_unit_test(no_function_needs_more_stack_than_base_promises),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
