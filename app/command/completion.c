/* SPDX-License-Identifier: MIT */
/* completion.c - lampion completion: prints the completion of the program's command lines for a
 * shell. The frame is here; the part of each command comes from its option table
 * (app/base/cli_complete.c). */
#include "app/base/cli.h"
#include "app/command/command.h"
#include "app/scene/scene.h"

#include <lampion/brdf.h>

#include <stdio.h>
#include <string.h>

/* --- names ------------------------------------------------------------------------------------ */

static void print_commands(void) {
    for (size_t i = 0; command_table[i]; i++)
        printf("%s ", command_table[i]->name);
}

static void print_scenes(void) {
    for (size_t i = 0; scene_builtin_name(i); i++)
        printf("%sbuiltin:%s", i ? " " : "", scene_builtin_name(i));
}

static void print_materials(void) {
    for (size_t i = 0; lmp_brdf_sgd_name(i); i++)
        printf("%ssgd:%s", i ? " " : "", lmp_brdf_sgd_name(i));
}

/* Prints a line 'NAME<between>SUMMARY' for each command. */
static void print_summaries(const char *before, const char *between) {
    for (size_t i = 0; command_table[i]; i++) {
        printf("%s'%s%s", before, command_table[i]->name, between);
        for (const char *c = command_table[i]->summary; *c; c++)
            printf(*c == '\'' ? "’" : "%c", *c);
        printf("'\n");
    }
}

/* --- shells ----------------------------------------------------------------------------------- */

/* Prints the start of bash's completion. It splits the line into words again, because bash splits
 * at : and = as well. Materials are those of the scenes that the line names so far. */
static void begin_bash(void) {
    printf("# bash completion of lampion, printed by `lampion completion bash`\n"
           "_lampion_overrides() { # BEGUN WORD…: NAME= of the materials that begin so\n"
           "    local begun=$1 word name\n"
           "    for word in \"${@:2}\"; do\n"
           "        [[ $word == builtin:* || -f $word ]] || continue\n"
           "        while read -r name; do\n"
           "            [[ $name == \"$begun\"* ]] && printf '%%q=\\n' \"$name\"\n"
           "        done < <(lampion info --materials \"$word\" 2>/dev/null)\n"
           "    done\n"
           "}\n\n"
           "_lampion_begun() { # WORDS LINE: whether one of the words is in the line\n"
           "    local word\n"
           "    for word in $1; do [[ $2 == *\" $word \"* ]] && return; done\n"
           "    return 1\n"
           "}\n\n"
           "_lampion() {\n"
           "    local commands='");
    print_commands();
    printf("help' scenes='");
    print_scenes();
    printf("' materials='");
    print_materials();
    printf("'\n"
           "    local line=${COMP_LINE:0:COMP_POINT} kind=nothing words= options= operand=\n"
           "    local -a typed\n"
           "    read -ra typed <<<\"$line\"\n"
           "    [[ $line == *[[:blank:]] ]] && typed+=('')\n"
           "    local word=${typed[-1]} previous=${typed[-2]}\n"
           "    local begun=\" ${typed[*]:2:${#typed[@]}-3} \"\n"
           "    [[ $word == --*=* ]] && previous=${word%%%%=*} word=${word#*=}\n"
           "    ((${#typed[@]} == 2)) && typed[1]=\n"
           "    case ${typed[1]} in\n"
           "    '') kind=commands options='--help --version' operand=yes ;;\n"
           "    help) kind=commands ;;\n");
}

static void end_bash(void) {
    puts("    esac\n"
         "    [[ $operand && $word == -* ]] && kind=nothing words=$options\n"
         "    case $kind in\n"
         "    commands) words=$commands ;;\n"
         "    scenes) words=\"$words $scenes\" kind=files ;;\n"
         "    materials) words=$materials kind=files ;;\n"
         "    overrides) [[ $word == *=* ]] && words=$materials kind=files word=${word#*=} ;;\n"
         "    esac\n"
         "    local -a files\n"
         "    mapfile -t COMPREPLY < <(\n"
         "        compgen -W \"$words\" -- \"$word\"\n"
         "        [[ $kind == overrides ]] && _lampion_overrides \"$word\" \"${typed[@]:2}\"\n"
         "    )\n"
         "    case $kind in\n"
         "    files) mapfile -t files < <(compgen -f -- \"$word\") ;;\n"
         "    folders) mapfile -t files < <(compgen -d -- \"$word\") ;;\n"
         "    overrides) compopt -o nospace 2>/dev/null ;;\n"
         "    esac\n"
         "    # names of files are anything: readline quotes them, though not well after a colon\n"
         "    if [[ $word == *[\\\"\\']* ]]; then\n"
         "        compopt -o filenames 2>/dev/null || files=()\n"
         "    elif [[ ${#COMPREPLY[@]} -gt 0 || $word == *:* ]] ||\n"
         "        ! compopt -o filenames 2>/dev/null; then\n"
         "        ((${#files[@]})) && mapfile -t files < <(printf '%q\\n' \"${files[@]}\")\n"
         "    fi\n"
         "    COMPREPLY+=(\"${files[@]}\")\n"
         "    if [[ $word == *:* && $COMP_WORDBREAKS == *:* ]]; then\n"
         "        local before=${word%\"${word##*:}\"}\n"
         "        COMPREPLY=(\"${COMPREPLY[@]#\"$before\"}\")\n"
         "    fi\n"
         "}\n\n"
         "complete -F _lampion lampion");
}

static void begin_zsh(void) {
    printf("#compdef lampion\n"
           "# zsh completion of lampion, printed by `lampion completion zsh`\n"
           "_lampion_commands() {\n"
           "    local -a commands=(\n");
    print_summaries("        ", ":");
    printf("        'help:show the help of a command'\n"
           "    )\n"
           "    _describe command commands\n"
           "}\n\n"
           "_lampion_scenes() {\n"
           "    compadd -- ");
    print_scenes();
    printf("\n"
           "    _files\n"
           "}\n\n"
           "_lampion_materials() {\n"
           "    compadd -- ");
    print_materials();
    printf("\n"
           "    _files\n"
           "}\n\n"
           "_lampion_overrides() { # materials of the scenes that the line names, then what they "
           "become\n"
           "    local word\n"
           "    local -a names\n"
           "    compset -P '*=' && _lampion_materials && return\n"
           "    for word in \"${(@Q)words[2,CURRENT-1]}\"; do\n"
           "        [[ $word == builtin:* || -f $word ]] &&\n"
           "            names+=(\"${(@f)$(lampion info --materials $word 2>/dev/null)}\")\n"
           "    done\n"
           "    compadd -S = -- $names\n"
           "}\n\n"
           "_lampion() {\n"
           "    if ((CURRENT == 2)); then\n"
           "        _lampion_commands\n"
           "        return\n"
           "    fi\n"
           "    local command=$words[2]\n"
           "    shift words\n"
           "    ((CURRENT--))\n"
           "    case $command in\n"
           "    help) _lampion_commands ;;\n");
}

static void end_zsh(void) {
    puts("    esac\n"
         "}\n\n"
         "if [[ $funcstack[1] == _lampion ]]; then\n"
         "    _lampion \"$@\"\n"
         "else\n"
         "    compdef _lampion lampion\n"
         "fi");
}

static void begin_fish(void) {
    printf("# fish completion of lampion, printed by `lampion completion fish`\n"
           "function __lampion_scenes\n"
           "    string split ' ' '");
    print_scenes();
    printf("'\n"
           "end\n\n"
           "function __lampion_materials\n"
           "    string split ' ' '");
    print_materials();
    printf("'\n"
           "end\n\n"
           "function __lampion_overrides # a material of the scene, then what it becomes\n"
           "    set -l name (string match -r '^[^=]*=' -- (commandline -ct))\n"
           "    and printf '%%s\\n' $name(__lampion_materials)\n"
           "    and return\n"
           "    for word in (commandline -opc)[3..-1]\n"
           "        if string match -q 'builtin:*' -- $word; or test -f $word\n"
           "            lampion info --materials $word 2>/dev/null | string replace -r '$' =\n"
           "        end\n"
           "    end\n"
           "end\n\n"
           "function __lampion_commands\n");
    print_summaries("    echo ", "\t");
    printf("end\n\n"
           "function __lampion_is # COMMAND: whether it is the command of the line\n"
           "    set -l words (commandline -opc)\n"
           "    test \"$words[2]\" = \"$argv[1]\"\n"
           "end\n\n"
           "complete -c lampion -f\n"
           "complete -c lampion -n '__lampion_is \"\"' -a '(__lampion_commands) help'\n"
           "complete -c lampion -n '__lampion_is \"\"' -l help -s h -d 'list the commands'\n"
           "complete -c lampion -n '__lampion_is \"\"' -l version -d 'print the version'\n"
           "complete -c lampion -n '__lampion_is help' -a '(__lampion_commands)'\n");
}

static const struct {
    const char *name, *form;
    void (*begin)(void), (*end)(void);
} shells[] = {
    { "bash", "--help=bash", begin_bash, end_bash },
    { "zsh", "--help=zsh", begin_zsh, end_zsh },
    { "fish", "--help=fish", begin_fish, NULL },
};

static int run(const cli_command *command, int argc, char **argv) {
    int count, status;
    char **operands;
    if (!cli_parse_operands(command, argc, argv, &count, &operands, &status))
        return status;
    if (count != 1)
        return cli_usage(command, "needs one shell: %s", command->operands);
    for (size_t i = 0; i < sizeof shells / sizeof *shells; i++) {
        if (strcmp(operands[0], shells[i].name) != 0)
            continue;
        shells[i].begin();
        for (size_t k = 0; command_table[k]; k++)
            command_print_help(command_table[k], shells[i].form);
        if (shells[i].end)
            shells[i].end();
        return BASE_OK;
    }
    return cli_usage_operand(command, operands[0]);
}

const cli_command command_completion = {
    .name = "completion",
    .operands = "bash|zsh|fish",
    .summary = "print what completes command lines in a shell",
    .examples = "lampion completion bash > ~/.local/share/bash-completion/completions/lampion\n"
                "lampion completion zsh > ~/.local/share/zsh/site-functions/_lampion\n"
                "lampion completion fish > ~/.config/fish/completions/lampion.fish\n",
    .run = run,
};
