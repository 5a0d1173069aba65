/* SPDX-License-Identifier: MIT */
/* lampion merge - joins the parts of a reference image that several machines have computed. */
#include "app/base/cli.h"
#include "app/command/command.h"
#include "app/truth/reference_part.h"

static int execute(const char *output, char *const *paths, int count, bool partial) {
    image radiance, standard_error;
    base_error error;
    bool ok = image_check_path(output, &error) &&
              reference_parts_join(paths, count, partial, &radiance, &standard_error, &error);
    if (ok) {
        const image_layer layers[] = { { NULL, &radiance }, { "stderr", &standard_error } };
        ok = image_write_exr_layers(output, layers, 2, &error);
        image_free(&radiance);
        image_free(&standard_error);
    }
    return ok ? BASE_OK : base_report(&error);
}

static int run(const cli_command *command, int argc, char **argv) {
    const char *output = NULL;
    bool partial = false;
    const cli_option options[] = {
        { .name = "output",
          .letter = 'o',
          .kind = CLI_TEXT,
          .target = &output,
          .argument = "FILE.exr",
          .help = "the image, with its standard error as layer \"stderr\"" },
        { .name = "partial",
          .kind = CLI_FLAG,
          .target = &partial,
          .help = "join what is there, though parts are missing" },
        { .name = NULL },
    };
    int count, status;
    char **operands;
    if (!cli_parse(command, options, argc, argv, &count, &operands, &status))
        return status;
    if (count < 1)
        return cli_usage(command, "expected the parts");
    if (!output)
        return cli_usage_output(command, "FILE.exr");
    if (image_format_of(output) != IMAGE_EXR)
        return cli_usage(command, "-o: \"%s\" is not a .exr file", output);
    return execute(output, operands, count, partial);
}

const cli_command command_merge = {
    .name = "merge",
    .operands = "PART.exr…",
    .summary = "join parts of a reference, made by reference --shard",
    .examples = "lampion reference builtin:balls --spp 64 --shard 1/2 -o 1.exr\n"
                "lampion reference builtin:balls --spp 64 --shard 2/2 -o 2.exr\n"
                "lampion merge 1.exr 2.exr -o truth.exr\n",
    .run = run,
};
