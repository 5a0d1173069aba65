/* SPDX-License-Identifier: MIT */
/* lampion bench - the cost of the kernels and the shaders (docs/benchmarks.md). */
#include "app/study/bench.h"
#include "app/base/cli.h"
#include "app/command/command.h"
#include "app/render/renderer/override.h"

#include <string.h>

static int run(const cli_command *command, int argc, char **argv) {
    bench_options o = { .mask = LMP_CPU_ALL };
    bool size_given;
    const cli_option options[] = {
        { "json", 0, CLI_FLAG, &o.json, NULL, "print JSON", 0, 0, NULL, NULL },
        { "full", 0, CLI_FLAG, &o.full, NULL,
          "cpu: ten times the runs; gpu: every combination of the scenes, sizes, lights and bands "
          "that no option fixes",
          0, 0, NULL, NULL },
        cli_cpu_mask(&o.mask),
        { "threads", 0, CLI_INT, &o.threads, "N",
          "cpu: most threads of the scaling rows; 0 = every CPU", 0, 1024, NULL, NULL },
        { "kernel", 0, CLI_CHOICE, &o.kernel, "KERNEL", "cpu: the rows of one kernel", 0, 0,
          bench_kernel_names(), NULL },
        { "bands", 0, CLI_INT, &o.bands, "N", "the rows of so many bands alone; 0: of several", 0,
          LMP_BANDS_MAX, NULL, NULL },
        { "device", 0, CLI_CHOICE, &o.device, "DEVICE", "gpu: the rows of one device", 0, 0,
          bench_devices(), NULL },
        { "method", 0, CLI_CHOICE, &o.method, "METHOD",
          "gpu: the rows of one method; paper is the paper's fragment shader", 0, 0,
          bench_methods(), NULL },
        { "scene", 0, CLI_TEXT, &o.scene, "SCENE",
          "gpu: the rows of one scene; without it builtin:atrium", 0, 0, NULL, NULL },
        { "lights", 0, CLI_NUMBERS, &o.lights, "N,N,N",
          "gpu: the rows of so many lights alone; of several numbers also a table of whole frames",
          1, SCENE_LIGHTS_MAX, NULL, NULL },
        { "size", 0, CLI_SIZE, o.size, "WxH", "gpu: pixels of the rows; without it 1980x995", 1,
          GPU_SIZE_MAX, NULL, &size_given },
        { "time", 0, CLI_INT, &o.seconds, "SECONDS",
          "gpu: how long the rows may take, the most telling first; 0: 180, or with --full as long "
          "as they take",
          0, 86400, NULL, NULL },
        OVERRIDE_OPTION_ROW(o.materials),
        { "gl-device", 0, CLI_TEXT, &o.gl_device, "DEVICE",
          "gpu: a number, part of a name, or software", 0, 0, NULL, NULL },
        { .name = NULL },
    };
    int count, status;
    char **operands;
    if (!cli_parse(command, options, argc, argv, &count, &operands, &status))
        return status;
    if (count == 1 && strcmp(operands[0], "gpu") == 0) {
        lmp_cpu_limit((unsigned)o.mask);
        return bench_gpu(command, &o);
    }
    if (count != 1)
        return cli_usage(command, "what to measure: %s", command->operands);
    if (strcmp(operands[0], "cpu") != 0)
        return cli_usage_operand(command, operands[0]);
    return bench_cpu(&o);
}

const cli_command command_bench = {
    .name = "bench",
    .operands = "cpu|gpu",
    .summary = "measure the batch kernels on every instruction set, or the shaders",
    .examples = "lampion bench cpu\n"
                "lampion bench cpu --cpu-mask 4 --json > avx2.json\n"
                "lampion bench cpu --kernel accumulate --bands 6\n"
                "lampion bench gpu --json > gpu.json\n"
                "lampion bench gpu --scene builtin:ball --bands 8 --size 3400x900\n"
                "lampion bench gpu --device cpu --bands 5 --lights 10,100,1000,4000\n"
                "lampion bench gpu --full --size 600x816 --method preintegrated\n"
                "lampion bench gpu --scene builtin:ball --material test_material=sgd:nickel\n",
    .run = run,
};
