/* SPDX-License-Identifier: MIT */
/* cli.h - the command line: a table describes the options; parsing, help, manual pages and
 * completion follow from it. */
#ifndef LAMPION_BASE_CLI_H
#define LAMPION_BASE_CLI_H

#include "app/base/error.h"

#include <stddef.h>
#include <stdint.h>

typedef enum cli_kind {
    CLI_FLAG,     /* bool */
    CLI_INT,      /* int, minimum … maximum */
    CLI_SEED,     /* uint64_t */
    CLI_FLOAT,    /* float, minimum … maximum, finite */
    CLI_VEC3,     /* float[3] as X,Y,Z, finite */
    CLI_POSITION, /* double[3] as X,Y,Z, finite */
    CLI_SIZE,     /* int[2] as WIDTHxHEIGHT, minimum … maximum each */
    CLI_GRID,     /* int[3] as XxYxZ, minimum … maximum each */
    CLI_RANGE,    /* int[2], first and last, as FIRST-LAST, or COUNT for 0 to COUNT-1 */
    CLI_NUMBERS,  /* cli_numbers: whole numbers as N,N,…, minimum … maximum each */
    CLI_PART,     /* int[2] as I/N, 1 <= I <= N <= maximum */
    CLI_TEXT,     /* const char * */
    CLI_CHOICE,   /* int: index into choices */
    CLI_LIST      /* cli_list: a text option that may be repeated */
} cli_kind;

/* The values of a CLI_LIST option, in order; items points into argv. */
typedef struct cli_list {
    const char *items[64];
    int count;
} cli_list;

/* The numbers of a CLI_NUMBERS option, in order. */
enum { CLI_NUMBERS_MAX = 16 };
typedef struct cli_numbers {
    int values[CLI_NUMBERS_MAX];
    int count;
} cli_numbers;

/* One row of a command's option table; also the source of its --help. */
typedef struct cli_option {
    const char *name; /* "bands" for --bands; NULL ends the table */
    char letter;      /* 'o' for -o, or 0 */
    cli_kind kind;
    void *target;         /* left alone when the option is absent: initialize it to the default */
    const char *argument; /* "N" in the help */
    const char *help;
    double minimum, maximum;    /* of numbers; both 0 = no limits */
    const char *const *choices; /* of CLI_CHOICE, NULL-terminated */
    bool *given; /* set to true if the option was there; may be NULL (then --help shows *target) */
} cli_option;

/* A command: `lampion NAME …`. run gets argv[0] = NAME and returns the exit status. */
typedef struct cli_command {
    const char *name;
    const char *operands; /* "SCENE" in the usage line, or "" */
    const char *summary;  /* one line */
    const char *examples; /* lines for --help, e.g. "lampion info builtin:atrium" */
    int (*run)(const struct cli_command *command, int argc, char **argv);
    bool kernels; /* runs the library's batch functions, so it also takes --cpu-mask */
} cli_command;

/* Parses argv by the table, operands and options in any order. Returns true to go on: then
 * *operands points at the *operand_count operands (argv is permuted), of which a command whose
 * .operands is "" has none. Otherwise *status is the exit status: 0 after --help, BASE_USAGE after
 * a message that names the nearest option. */
bool cli_parse(const cli_command *command, const cli_option *options, int argc, char **argv,
               int *operand_count, char ***operands, int *status);

/* Parses the operands of a command that has no options of its own, as cli_parse does. */
bool cli_parse_operands(const cli_command *command, int argc, char **argv, int *operand_count,
                        char ***operands, int *status);

/* Returns the row of --cpu-mask. cli_parse obeys the option (lmp_cpu_limit) in every command that
 * runs kernels; a command whose table has the row also gets the number. */
cli_option cli_cpu_mask(int *mask);

/* Prints "lampion COMMAND: message" and where to find help; returns BASE_USAGE. */
int cli_usage(const cli_command *command, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Reports, as cli_usage does, that a command has nowhere to write: "-o ARGUMENT is needed". */
int cli_usage_output(const cli_command *command, const char *argument);

/* Prints the manual page of the program: its commands (NULL-terminated) and the environment
 * variables it reads, pairs of name and meaning ended by NULL. */
void cli_man(const char *summary, const cli_command *const *commands,
             const char *const (*environment)[2]);

/* Reports, as cli_usage does, that an operand is none of those the command's usage begins with. */
int cli_usage_operand(const cli_command *command, const char *word);

#endif
