/* SPDX-License-Identifier: MIT */
#include "app/render/method.h"
#include "app/base/choice.h"

#include <lampion/field.h>

#include <stdio.h>

/* Drivers take minutes to compile the coefficients of more bands. */
#define GPU_COEFFICIENTS_MAX 20

/* The most bands of a method on the GPU and on the CPU. */
#define BANDS(gpu, cpu)                                                                            \
    { [DEVICE_AUTO] = (gpu) > (cpu) ? (gpu) : (cpu), [DEVICE_GPU] = (gpu), [DEVICE_CPU] = (cpu) }

const method_row method_table[METHODS_TIMED] = {
    [METHOD_ZONAL] = { .name = "zonal",
                       .help = "is fast",
                       .method = LMP_SHADE_ZONAL,
                       .bands_max = BANDS(METHOD_GPU_BANDS_MAX, LMP_BANDS_MAX),
                       .batched = true,
                       .sums_areas = true,
                       .tabulated = true,
                       .shader = "shade.comp",
                       .function = "lmp_shade_zonal",
                       .speedup = "zonal_speedup",
                       .compared = METHOD_COEFFICIENTS,
                       .cost = { .pixel = 100, .light = 0.9f, .light_band = 0.1f } },
    [METHOD_COEFFICIENTS] = { .name = "coefficients",
                              .help = "is the paper's",
                              .method = LMP_SHADE_COEFFICIENTS,
                              .bands_max = BANDS(GPU_COEFFICIENTS_MAX, LMP_BANDS_MAX),
                              .sums_areas = true,
                              .tabulated = true,
                              .shader = "shade.comp",
                              .function = "lmp_shade_coefficients",
                              .defines = "#define SHADE_WINDOWS_DIFFUSE\n" },
    [METHOD_PREINTEGRATED] = { .name = "preintegrated",
                               .help = "costs the same at any number of bands",
                               .method = LMP_SHADE_PREINTEGRATED,
                               .bands_max = BANDS(LMP_BANDS_MAX, LMP_BANDS_MAX),
                               .batched = true,
                               .tabulated = true,
                               .reads = METHOD_READS_PREINTEGRATED,
                               .shader = "shade.comp",
                               .function = "lmp_shade_preintegrated",
                               .defines = "#define SHADE_PREINTEGRATED\n",
                               .cost = { .pixel = 100, .light = 8 } },
    [METHOD_FIELD] = { .name = "field",
                       .help = "costs nearly the same for thousands of lights",
                       .method = LMP_SHADE_ZONAL,
                       .bands_max = BANDS(LMP_FIELD_BANDS_MAX, LMP_FIELD_BANDS_MAX),
                       .batched = true,
                       .tabulated = true,
                       .reads = METHOD_READS_FIELD,
                       .shader = "shade.comp",
                       .function = "lmp_shade_field",
                       .defines = "#define SHADE_FIELD\n",
                       .speedup = "field_speedup",
                       .compared = METHOD_ZONAL,
                       .cost = { .pixel = 90,
                                 .pixel_value = 2,
                                 .light = 0.01f,
                                 .frame_value = 0.8f,
                                 .frame_light = 0.0013f } },
    [METHOD_PAPER] = { .name = "paper",
                       .baseline = true,
                       .bands_max = BANDS(GPU_COEFFICIENTS_MAX, 0),
                       .shader = "paper.frag",
                       .fragment = true,
                       .function = "paper_shade" },
    [METHOD_TABULATED_Z] = { .name = "tabulated-z",
                             .bands_max = BANDS(GPU_COEFFICIENTS_MAX, 0),
                             .reads = METHOD_READS_TABULATED_Z,
                             .shader = "shade.comp",
                             .function = "lmp_shade_coefficients",
                             .defines = "#define SHADE_TABULATED_Z\n"
                                        "#define SHADE_WINDOWS_DIFFUSE\n" },
};

const char *const *method_window_names(void) {
    static const char *names[LMP_WINDOW_COUNT + 1];
    for (int window = 0; window <= LMP_WINDOW_COUNT; window++)
        names[window] = lmp_sh_window_name((lmp_window)window);
    return names;
}

const char *const *method_names(void) {
    static const char *names[METHODS + 1];
    choice_names(&method_table[0].name, sizeof *method_table, METHODS, names);
    return names;
}

const char *const *method_choices(void) {
    static const char *names[METHODS + 2] = { "auto" };
    choice_names(&method_table[0].name, sizeof *method_table, METHODS, names + 1);
    return names;
}

method_kind method_chosen(int choice, int bands) {
    if (choice != 0)
        return (method_kind)(choice - 1);
    return bands <= method_table[METHOD_ZONAL].bands_max[DEVICE_GPU] ? METHOD_ZONAL
                                                                     : METHOD_PREINTEGRATED;
}

double method_estimate(method_kind method, const method_work *work) {
    const method_row *row = &method_table[method];
    const method_cost c = row->cost;
    const double lights = (double)work->lights, bands = work->bands, values = bands * bands;
    if (work->bands > row->bands_max[DEVICE_CPU])
        return 0;
    const double light = (double)c.light + (double)c.light_band * bands;
    const double pixel = (double)c.pixel + (double)c.pixel_value * values + lights * light;
    return 1e-6 * work->pixels * pixel +
           values * ((double)c.frame_value + (double)c.frame_light * lights);
}

method_kind method_for_lights(method_kind chosen, const method_work *work) {
    const double by_field = method_estimate(METHOD_FIELD, work);
    return by_field > 0 && 2 * by_field <= method_estimate(chosen, work) ? METHOD_FIELD : chosen;
}

const char *method_help(void) {
    static char text[768];
    size_t used = (size_t)snprintf(text, sizeof text,
                                   "how to shade; auto is zonal to %d bands, then preintegrated, "
                                   "and in render field where it halves the cost of so many lights",
                                   method_table[METHOD_ZONAL].bands_max[DEVICE_GPU]);
    for (int m = 0; m < METHODS; m++) {
        const method_row *row = &method_table[m];
        used += (size_t)snprintf(text + used, sizeof text - used, "%s%s %s", m ? ", " : "; ",
                                 row->name, row->help);
        if (row->bands_max[DEVICE_CPU] < LMP_BANDS_MAX)
            used += (size_t)snprintf(text + used, sizeof text - used, " (to %d bands)",
                                     row->bands_max[DEVICE_CPU]);
        if (row->bands_max[DEVICE_GPU] == 0)
            used += (size_t)snprintf(text + used, sizeof text - used, " (on the CPU alone)");
        else if (row->bands_max[DEVICE_GPU] < row->bands_max[DEVICE_CPU])
            used += (size_t)snprintf(text + used, sizeof text - used, " (on the GPU to %d bands)",
                                     row->bands_max[DEVICE_GPU]);
    }
    return text;
}

device_kind method_device(method_kind method, device_kind wanted, const method_needs *needs) {
    const method_row *row = &method_table[method];
    if (wanted != DEVICE_AUTO)
        return wanted;
    if (needs->bands > row->bands_max[DEVICE_CPU])
        return DEVICE_GPU;
    const bool too_much = needs->bands > row->bands_max[DEVICE_GPU] ||
                          (needs->tables && needs->bands > METHOD_GPU_BANDS_MAX);
    const bool on_cpu = too_much || needs->areas || (needs->software && row->batched);
    return on_cpu ? DEVICE_CPU : DEVICE_GPU;
}
