/* SPDX-License-Identifier: MIT */
/* Shell completion of one command, from the table that makes its --help. `lampion completion`
 * prints what surrounds it, and the functions it calls for names of scenes and commands. */
#include "app/base/cli.h"
#include "app/base/option.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

/* What can complete a word: literal words, and one of these kinds. */
typedef enum kind { NOTHING, FILES, FOLDERS, SCENES, COMMANDS, MATERIALS, OVERRIDES } kind;
typedef struct candidates {
    char words[1024]; /* separated by blanks */
    kind kind;
} candidates;

static kind kind_of(const char *name, size_t length) {
    static const struct {
        const char *name;
        kind kind;
    } known[] = {
        { "FILE", FILES },          { "DIR", FOLDERS },        { "SCENE", SCENES },
        { "IMAGE", FILES },         { "REFERENCE", FILES },    { "MATERIAL", MATERIALS },
        { "MATERIAL…", MATERIALS }, { "[COMMAND]", COMMANDS }, { "NAME=MATERIAL", OVERRIDES },
    };
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (strlen(known[i].name) == length && memcmp(known[i].name, name, length) == 0)
            return known[i].kind;
    return NOTHING;
}

static void add_word(candidates *p, const char *word, size_t length) {
    const size_t used = strlen(p->words);
    snprintf(p->words + used, sizeof p->words - used, "%s%.*s", used ? " " : "", (int)length, word);
}

/* Reads alternatives such as orbit|bounce|FILE, up to a blank: one that begins with a small letter
 * is a literal word. Returns the text after them. */
static const char *read_candidates(const char *text, candidates *p) {
    *p = (candidates) { .kind = NOTHING };
    while (*text && *text != ' ') {
        const size_t length = strcspn(text, "| ");
        if (islower((unsigned char)*text))
            add_word(p, text, length);
        else if (p->kind == NOTHING)
            p->kind = kind_of(text, length);
        text += length + (text[length] == '|');
    }
    return text + strspn(text, " ");
}

static candidates candidates_of_value(const cli_option *option) {
    candidates p;
    read_candidates(option->argument, &p);
    for (int i = 0; option->choices && option->choices[i]; i++)
        add_word(&p, option->choices[i], strlen(option->choices[i]));
    return p;
}

/* Finds the candidates of the first operand and of the others. */
static void candidates_of_operands(const cli_command *command, candidates *first,
                                   candidates *rest) {
    const char *const text = read_candidates(command->operands, first);
    *rest = *first;
    if (*text)
        read_candidates(text, rest);
    if (!*text && first->words[0])
        *rest = (candidates) { .kind = NOTHING };
}

/* Prints text with a backslash before each of the `special` characters and with quotes as
 * `quote`. */
static void print_escaped(const char *text, const char *special, const char *quote) {
    for (; *text; text++) {
        if (*text == '\'')
            fputs(quote, stdout);
        else
            printf(strchr(special, *text) ? "\\%c" : "%c", *text);
    }
}

/* --- bash ------------------------------------------------------------------------------------- */

/* Whether there is anything to complete the option's value with. */
static bool offers(const cli_option *option) {
    const candidates value = candidates_of_value(option);
    return value.kind != NOTHING || value.words[0];
}

static void print_bash_candidates(const candidates *p) {
    static const char *const kinds[] = { "nothing",  "files",     "folders",  "scenes",
                                         "commands", "materials", "overrides" };
    if (p->kind != NOTHING)
        printf("kind=%s ", kinds[p->kind]);
    if (p->words[0])
        printf("words='%s' ", p->words);
}

static void print_bash_names(const cli_option *option) {
    if (option->letter)
        printf("-%c | ", option->letter);
    printf("--%s", option->name);
}

/* Prints the cases of options whose values can be completed, then of those whose values cannot. */
static void print_bash_values(const cli_option *rows, int count) {
    bool some = false;
    for (int i = 0; i < count; i++) {
        if (rows[i].kind == CLI_FLAG || !offers(&rows[i]))
            continue;
        const candidates value = candidates_of_value(&rows[i]);
        printf("        ");
        print_bash_names(&rows[i]);
        printf(") ");
        print_bash_candidates(&value);
        printf(";;\n");
    }
    for (int i = 0; i < count; i++) {
        if (rows[i].kind == CLI_FLAG || offers(&rows[i]))
            continue;
        printf(some ? " | " : "        ");
        print_bash_names(&rows[i]);
        some = true;
    }
    if (some)
        printf(") ;;\n");
}

void option_bash(const cli_command *command, const cli_option *options) {
    cli_option rows[OPTIONS_MAX];
    const int count = option_rows(command, options, rows);
    candidates first, rest;
    printf("    %s)\n        options='", command->name);
    for (int i = 0; i < count; i++)
        printf("%s--%s", i ? " " : "", rows[i].name);
    printf("'\n        case $previous in\n");
    print_bash_values(rows, count);
    candidates_of_operands(command, &first, &rest);
    printf("        *) ");
    print_bash_candidates(&first);
    printf("operand=yes ;;\n        esac\n");
    if (first.words[0]) {
        printf("        if [[ $operand ]] && _lampion_begun \"$words\" \"$begun\"; then words= ");
        print_bash_candidates(&rest);
        printf("; fi\n");
    }
    printf("        ;;\n");
}

/* --- zsh -------------------------------------------------------------------------------------- */

static void print_zsh_candidates(const char *name, const candidates *p) {
    static const char *const kinds[] = { " ",
                                         "_files",
                                         "_files -/",
                                         "_lampion_scenes",
                                         "_lampion_commands",
                                         "_lampion_materials",
                                         "_lampion_overrides" };
    putchar(':');
    print_escaped(name, ":[]", "'\\''");
    if (p->words[0])
        printf(p->kind == FILES ? ":{compadd -- %s; _files}" : ":(%s)", p->words);
    else
        printf(":%s", kinds[p->kind]);
}

void option_zsh(const cli_command *command, const cli_option *options) {
    cli_option rows[OPTIONS_MAX];
    const int count = option_rows(command, options, rows);
    candidates first, rest;
    printf("    %s) _arguments -s : \\\n", command->name);
    for (int i = 0; i < count; i++) {
        const cli_option *const o = &rows[i];
        const char *const more = o->kind == CLI_LIST ? "*" : "";
        const char *const attached = o->kind == CLI_FLAG ? "" : "=";
        if (o->letter && o->kind == CLI_LIST)
            printf("        '*'{-%c+,--%s=}'[", o->letter, o->name);
        else if (o->letter)
            printf("        '(-%c --%s)'{-%c%s,--%s%s}'[", o->letter, o->name, o->letter,
                   o->kind == CLI_FLAG ? "" : "+", o->name, attached);
        else
            printf("        '%s--%s%s[", more, o->name, attached);
        print_escaped(o->help, "[]", "'\\''");
        putchar(']');
        if (o->kind != CLI_FLAG) {
            const candidates value = candidates_of_value(o);
            print_zsh_candidates(o->argument, &value);
        }
        printf("' \\\n");
    }
    candidates_of_operands(command, &first, &rest);
    printf("        '1");
    print_zsh_candidates(command->operands, &first);
    printf("' \\\n        '*");
    print_zsh_candidates(command->operands, &rest);
    printf("' ;;\n");
}

/* --- fish ------------------------------------------------------------------------------------- */

static void print_fish_candidates(const candidates *p) {
    static const char *const kinds[] = { " -x",
                                         " -r -F",
                                         " -x -a '(__fish_complete_directories)'",
                                         " -r -F -a '(__lampion_scenes)'",
                                         " -x -a '(__lampion_commands)'",
                                         " -r -F -a '(__lampion_materials)'",
                                         " -x -a '(__lampion_overrides)'" };
    fputs(kinds[p->kind], stdout);
    if (p->words[0])
        printf(" -a '%s'", p->words);
}

void option_fish(const cli_command *command, const cli_option *options) {
    cli_option rows[OPTIONS_MAX];
    const int count = option_rows(command, options, rows);
    candidates first, rest;
    for (int i = 0; i < count; i++) {
        printf("complete -c lampion -n '__lampion_is %s' -l %s", command->name, rows[i].name);
        if (rows[i].letter)
            printf(" -s %c", rows[i].letter);
        if (rows[i].kind != CLI_FLAG) {
            const candidates value = candidates_of_value(&rows[i]);
            print_fish_candidates(&value);
        }
        printf(" -d '");
        print_escaped(rows[i].help, "\\", "\\'");
        printf("'\n");
    }
    candidates_of_operands(command, &first, &rest);
    if (first.words[0])
        printf("complete -c lampion -n '__lampion_is %s; and not "
               "__fish_seen_subcommand_from %s' -a '%s'\n",
               command->name, first.words, first.words);
    if (rest.kind != NOTHING) {
        printf("complete -c lampion -n '__lampion_is %s'", command->name);
        print_fish_candidates(&rest);
        putchar('\n');
    }
}
