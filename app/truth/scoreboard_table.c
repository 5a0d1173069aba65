/* SPDX-License-Identifier: MIT */
#include "app/scene/vector.h"
#include "app/truth/scoreboard_formula.h"

#define ALL                                                                                        \
    { true, true, true, true }
#define GLTF                                                                                       \
    { [RULER_LAMBERT] = true, [RULER_METAL] = true, [RULER_DIELECTRIC] = true }
#define LAYERS                                                                                     \
    { [RULER_METAL] = true, [RULER_DIELECTRIC] = true }

const formula formula_table[] = {
    { .name = "black", .source = "no light at all", .radiance = formula_black, .applies = ALL },
    { .name = "point",
      .source = "the light's center alone",
      .radiance = formula_point,
      .applies = ALL },
    { .name = "representative",
      .source = "Karis 2013, specular; Lagarde and de Rousiers 2014, diffuse",
      .radiance = formula_representative,
      .applies = GLTF },
    { .name = "halved",
      .source = "the same with r/2d in its normalization, as ports have it",
      .radiance = formula_halved,
      .applies = GLTF },
    { .name = "widened",
      .source = "the same with another constant in its normalization",
      .radiance = formula_widened,
      .applies = GLTF },
    { .name = "bevy",
      .source = "Bevy: Karis 2013 with r/2d, the center's cosine and diffuse part",
      .radiance = formula_bevy,
      .applies = LAYERS },
    { .name = "filament",
      .source = "Filament's sun: the disk's direction nearest to the mirror ray",
      .radiance = formula_filament,
      .applies = LAYERS },
    { .name = "godot",
      .source = "Godot: cosines greater by 1 - cos of the half angle",
      .radiance = formula_godot,
      .applies = LAYERS },
    { .name = "sphere",
      .source = "Lagarde and de Rousiers 2014, with the horizon",
      .radiance = formula_sphere,
      .applies = { [RULER_LAMBERT] = true } },
    { .name = "gaussian",
      .source = "spherical Gaussians: Wang et al. 2009; diffuse, Hill 2016",
      .radiance = formula_gaussian,
      .applies = ALL },
    { .name = "anisotropic",
      .source = "anisotropic spherical Gaussians: Xu et al. 2013",
      .radiance = formula_anisotropic,
      .applies = GLTF },
    { .name = "cosines",
      .source = "linearly transformed cosines: Heitz et al. 2016, disks and spheres 2017",
      .radiance = formula_cosines,
      .applies = GLTF },
    { .name = "published",
      .source = "the same by the table of their authors (--cosines)",
      .radiance = formula_cosines,
      .applies = LAYERS,
      .published = true },
    { .name = "irradiance",
      .source = "3 bands and a cosine, as irradiance volumes: Ramamoorthi and Hanrahan 2001",
      .radiance = formula_irradiance,
      .applies = { [RULER_LAMBERT] = true } },
#define LAMPION(NAME, METHOD, BANDS, LOBE)                                                         \
    {                                                                                              \
        .name = NAME, .source = "lmp_shade", .radiance = formula_lampion, .applies = ALL,          \
        .method = METHOD, .bands = BANDS, .reads_lobe = LOBE                                       \
    }
    LAMPION("lampion-3", LMP_SHADE_ZONAL, 3, false),
    LAMPION("lampion-5", LMP_SHADE_ZONAL, 5, false),
    LAMPION("lampion-10", LMP_SHADE_ZONAL, 10, false),
    LAMPION("lampion-20", LMP_SHADE_ZONAL, 20, false),
    LAMPION("lampion-100", LMP_SHADE_ZONAL, 100, false),
    LAMPION("preintegrated", LMP_SHADE_PREINTEGRATED, 100, true),
};
const int formula_count = sizeof formula_table / sizeof *formula_table;
_Static_assert(sizeof formula_table / sizeof *formula_table <= FORMULAS_MAX,
               "a plot holds no more");

bool formula_open(const formula *from, const cosines_table *published, formula_reads *reads,
                  base_error *error) {
    const lmp_preintegrated_lobe_desc desc = { .bands = from->bands };
    *reads = (formula_reads) { .settings = { .method = from->method, .bands = from->bands },
                               .cosines = from->published ? published : &cosines_fitted };
    if (!reads->cosines)
        return base_fail(error, from->name, "its table is read from a file: --cosines FILE");
    if (from->reads_lobe && lmp_preintegrated_lobe_create(NULL, &desc, &reads->lobe) != LMP_OK)
        return base_fail(error, NULL, "out of memory");
    reads->settings.lobe = reads->lobe;
    return true;
}

void formula_close(formula_reads *reads) {
    lmp_preintegrated_lobe_destroy(reads->lobe);
}

bool formula_applies(const formula *by, const ruler_row *row) {
    const bool disk = row->light == RULER_SPHERE || row->light == RULER_SUN;
    return by->applies[row->material] && disk && row->size < (row->light == RULER_SUN ? 90 : 1);
}

formula_query formula_query_of(const ruler_row *row) {
    const double radians = acos(-1) / 180, half_angle = ruler_half_angle(row) * radians;
    const double view = row->view_angle * radians, light = row->light_angle * radians;
    const double azimuth = row->light_azimuth * radians; /* from the side of the mirror direction */
    return (formula_query) {
        .normal = { 0, 0, 1 },
        .view = vec((float)sin(view), 0, (float)cos(view)),
        .light = vec((float)(-sin(light) * cos(azimuth)), (float)(sin(light) * sin(azimuth)),
                     (float)cos(light)),
        .sine = (float)(row->light == RULER_SPHERE ? row->size : sin(half_angle)),
        .material = row->material,
        .color = (float)row->color,
        .roughness = (float)row->roughness,
        .exponent = (float)row->exponent,
    };
}
