/* SPDX-License-Identifier: MIT */
#include "app/base/choice.h"
#include "app/base/cli.h"
#include "app/base/option.h"
#include "app/base/terminal.h"

#include <lampion/base.h>
#include <lampion/cpu.h>

#include <stdio.h>
#include <string.h>

/* What remains of a command line. */
typedef struct arguments {
    char **next, **end;
} arguments;

typedef void (*help_printer)(const cli_command *command, const cli_option *options);

/* Returns the function that prints the help that argv asks for, or NULL. The forms with a value are
 * for `lampion man` and `lampion completion`. */
static help_printer find_help(int argc, char **argv) {
    static const struct {
        const char *word;
        help_printer print;
    } forms[] = {
        { "--help", option_help },    { "-h", option_help },
        { "--help=man", option_man }, { "--help=bash", option_bash },
        { "--help=zsh", option_zsh }, { "--help=fish", option_fish },
    };
    for (int i = 1; i < argc && strcmp(argv[i], "--") != 0; i++)
        for (size_t k = 0; k < sizeof forms / sizeof *forms; k++)
            if (strcmp(argv[i], forms[k].word) == 0)
                return forms[k].print;
    return NULL;
}

/* Returns the option that `word` names; *value is where its value begins in the word, or NULL. */
static const cli_option *find_option(const cli_option *options, char *word, char **value) {
    const bool is_long = word[1] == '-';
    const size_t length = is_long ? strcspn(word + 2, "=") : 1;
    for (; options->name; options++) {
        if (is_long ? strncmp(word + 2, options->name, length) != 0 || options->name[length] != '\0'
                    : word[1] != options->letter)
            continue;
        *value = is_long ? word + 2 + length : word + 2;
        if (**value == '\0')
            *value = NULL;
        else if (is_long)
            (*value)++;
        return options;
    }
    return NULL;
}

/* Returns the option that other programs call by this name. */
static const char *find_synonym(const char *name, const char *const *names) {
    static const char *const synonyms[][2] = {
        { "width", "size" },          { "height", "size" },    { "resolution", "size" },
        { "camera-position", "eye" }, { "look-at", "target" }, { "hdri", "environment" },
        { "spp", "samples" },         { "gpu", "device" },
    };
    for (size_t i = 0; i < sizeof synonyms / sizeof *synonyms; i++)
        for (size_t k = 0; names[k] && strcmp(name, synonyms[i][0]) == 0; k++)
            if (strcmp(names[k], synonyms[i][1]) == 0)
                return names[k];
    return NULL;
}

static int unknown_option(const cli_command *command, const cli_option *options, const char *word) {
    const char *names[OPTIONS_MAX + 1] = { NULL };
    cli_option rows[OPTIONS_MAX];
    const int count = option_rows(command, options, rows);
    for (int i = 0; i < count; i++)
        names[i] = rows[i].name;
    const int length = (int)strcspn(word, "=");
    char name[64] = "";
    if (word[1] == '-')
        snprintf(name, sizeof name, "%.*s", length - 2, word + 2);
    const char *const synonym = find_synonym(name, names);
    const char *const nearest = synonym ? synonym : choice_nearest(name, names);
    if (nearest && strcmp(nearest, name) == 0) /* --help=FORM */
        return cli_usage(command, "--%s takes no value", name);
    if (nearest)
        return cli_usage(command, "unknown option %.*s (did you mean --%s?)", length, word,
                         nearest);
    return cli_usage(command, "unknown option %.*s", length, word);
}

/* Takes one option, with its value from the next word if need be; returns BASE_OK or BASE_USAGE. */
static int take_option(const cli_command *command, const cli_option *options,
                       const cli_option *common, char *word, arguments *rest) {
    char *value = NULL;
    const cli_option *option = find_option(options, word, &value);
    if (!option)
        option = find_option(common, word, &value);
    if (!option)
        return unknown_option(command, options, word);
    if (option->kind == CLI_FLAG && value)
        return cli_usage(command, "--%s takes no value", option->name);
    if (option->kind != CLI_FLAG && !value) {
        /* in `-o --bands 3` the file was forgotten; a value that begins with "--" is written
         * --output=--bands */
        if (rest->next == rest->end || strncmp(*rest->next, "--", 2) == 0)
            return cli_usage(command, "--%s needs a value: --%s %s", option->name, option->name,
                             option->argument);
        value = *rest->next++;
    }
    base_error error;
    if (!option_store(option, value, &error))
        return cli_usage(command, "%s", error.text);
    if (option->given)
        *option->given = true;
    return BASE_OK;
}

bool cli_parse(const cli_command *command, const cli_option *options, int argc, char **argv,
               int *operand_count, char ***operands, int *status) {
    *status = BASE_OK;
    *operand_count = 0;
    *operands = argv + 1;
    const help_printer help = find_help(argc, argv);
    if (help) {
        help(command, options);
        return false;
    }
    arguments rest = { argv + 1, argv + argc };
    bool options_end = false, masked = false, quiet = false;
    int mask = LMP_CPU_ALL;
    cli_option common[] = { option_quiet(&quiet), cli_cpu_mask(&mask), { .name = NULL } };
    common[1].given = &masked;
    if (!command->kernels)
        common[1].name = NULL;
    while (rest.next < rest.end) {
        char *const word = *rest.next++;
        if (options_end || word[0] != '-' || word[1] == '\0') {
            (*operands)[(*operand_count)++] = word;
        } else if (strcmp(word, "--") == 0) {
            options_end = true;
        } else if ((*status = take_option(command, options, common, word, &rest)) != BASE_OK) {
            return false;
        }
    }
    if (*operand_count > 0 && command->operands && !command->operands[0]) {
        *status = cli_usage(command, "\"%s\" is not an option", **operands);
        return false;
    }
    if (masked)
        lmp_cpu_limit((unsigned)mask);
    if (quiet)
        terminal_be_quiet();
    return true;
}

bool cli_parse_operands(const cli_command *command, int argc, char **argv, int *operand_count,
                        char ***operands, int *status) {
    static const cli_option none[] = { { .name = NULL } };
    return cli_parse(command, none, argc, argv, operand_count, operands, status);
}
