/* SPDX-License-Identifier: MIT */
/* cli.h - what every command shares: one-line errors, options described by a table, progress. */
#ifndef LAMPION_CLI_H
#define LAMPION_CLI_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Exit statuses of the program. */
enum { CLI_OK = 0, CLI_FAILURE = 1, CLI_USAGE = 2 };

/* One line for a person: "FILE: what is wrong (what to do)". Empty text means no error. */
typedef struct cli_error {
    char text[1024];
} cli_error;

/* Writes "subject: message" (subject NULL: message alone), control characters replaced, and returns
 * false, so that a function can end in `return cli_fail(error, path, "is empty");`. */
bool cli_fail(cli_error *error, const char *subject, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Whether a failure is that memory ran out: such a one is never forgiven, whatever it lacks for. */
bool cli_is_out_of_memory(const cli_error *error);

/* Prints "lampion: text" to stderr and returns CLI_FAILURE. On a terminal the name of the program
 * is red, and in a note yellow, unless the environment has NO_COLOR. */
int cli_report(const cli_error *error);

/* Prints "lampion: subject: message" to stderr: what one should know, though it stops nothing. */
void cli_note(const char *subject, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* From now on cli_note and cli_progress are silent (--quiet, which every command takes). */
void cli_be_quiet(void);

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
    bool kernels; /* it runs the library's batch functions: it takes --cpu-mask besides its table */
} cli_command;

/* Parses argv by the table, operands and options in any order. Returns true to go on: then
 * *operands points at the *operand_count operands (argv is permuted), of which a command whose
 * .operands is "" has none. Otherwise *status is the exit status: 0 after --help, CLI_USAGE after a
 * message that names the nearest option. */
bool cli_parse(const cli_command *command, const cli_option *options, int argc, char **argv,
               int *operand_count, char ***operands, int *status);

/* cli_parse for a command that has no options of its own. */
bool cli_parse_operands(const cli_command *command, int argc, char **argv, int *operand_count,
                        char ***operands, int *status);

/* The row of --cpu-mask, which cli_parse obeys (lmp_cpu_mask) for a command that runs kernels; one
 * whose table has the row gets the number. */
cli_option cli_cpu_mask(int *mask);

/* Prints "lampion COMMAND: message" and where to find help; returns CLI_USAGE. */
int cli_usage(const cli_command *command, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* The same of a command that has nowhere to write: "-o ARGUMENT is needed". */
int cli_usage_output(const cli_command *command, const char *argument);

/* Prints the manual page of the program: its commands (NULL-terminated) and the variables of the
 * environment it heeds, pairs of name and meaning ended by NULL. */
void cli_man(const char *summary, const cli_command *const *commands,
             const char *const (*environment)[2]);

/* Fails with "subject: "word" is none of …", and the name that may be meant; names is
 * NULL-terminated. */
bool cli_fail_word(cli_error *error, const char *subject, const char *word,
                   const char *const *names);

/* Fails with "subject: no such kind: …" likewise; the names are members of an array of structs: the
 * first, the bytes from one to the next, and how many there are. */
bool cli_fail_member(cli_error *error, const char *subject, const char *kind, const char *word,
                     const char *first, size_t stride, size_t count);

/* The names of a table's rows, NULL-terminated, for the choices of an option: `first` is that of
 * the first row, stride the bytes from one row to the next; names receives count + 1 entries. */
void cli_row_names(const char *const *first, size_t stride, int count, const char **names);

/* "what: NAME HELP, NAME HELP", the help of such an option; name and help are those of the first
 * row. Returns text. */
const char *cli_row_help(const char *what, const char *const *name, const char *const *help,
                         size_t stride, int count, char *text, size_t size);

/* The same as cli_usage of an operand, which is none of what the command's operands begin with. */
int cli_usage_operand(const cli_command *command, const char *word);

/* The entry of `names` (NULL-terminated) nearest to `word`, or NULL if none is near. */
const char *cli_nearest(const char *word, const char *const *names);

/* Reads a decimal number that takes up all of `length` bytes: no blanks, hexadecimal, nan or
 * infinity, whatever a double cannot hold. */
bool cli_number(const char *text, size_t length, double *value);

/* A progress bar on stderr if that is a terminal, else silence. done in 0 … 1; call it as often as
 * you like, it draws a few times a second. cli_progress_end clears the line. */
void cli_progress(const char *what, double done);
void cli_progress_end(void);

#endif
