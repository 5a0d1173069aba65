/* SPDX-License-Identifier: MIT */
/* Command lines, one word per line. */
#include "app/base/cli.h"

#include <stdlib.h>
#include <string.h>

#define WORDS_MAX 128

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static const char *const choices[] = { "one", "two", NULL };
    bool flag = false, given = false;
    int count = 1, pixels[2] = { 1, 1 }, grid[3] = { 1, 1, 1 }, range[2] = { 0, 0 },
        part[2] = { 1, 1 }, choice = 0;
    uint64_t seed = 0;
    float number = 0, color[3] = { 0 };
    double eye[3] = { 0 };
    const char *name = NULL;
    cli_list list = { .count = 0 };
    cli_numbers numbers = { .count = 0 };
    const cli_option options[] = {
        { "flag", 'f', CLI_FLAG, &flag, NULL, "help", 0, 0, NULL, &given },
        { "count", 'c', CLI_INT, &count, "N", "help", 1, 9, NULL, NULL },
        { "pixels", 0, CLI_SIZE, pixels, "WxH", "help", 0, 0, NULL, NULL },
        { "grid", 0, CLI_GRID, grid, "XxYxZ", "help", 1, 9, NULL, NULL },
        { "range", 0, CLI_RANGE, range, "N|A-B", "help", 0, 99, NULL, NULL },
        { "numbers", 0, CLI_NUMBERS, &numbers, "N,N", "help", 1, 9, NULL, NULL },
        { "part", 0, CLI_PART, part, "I/N", "help", 1, 99, NULL, NULL },
        { "choice", 0, CLI_CHOICE, &choice, "WORD", "help", 0, 0, choices, NULL },
        { "seed", 0, CLI_SEED, &seed, "N", "help", 0, 0, NULL, NULL },
        { "number", 'n', CLI_FLOAT, &number, "R", "help", 0, 0, NULL, NULL },
        { "color", 0, CLI_VEC3, color, "R,G,B", "help", 0, 0, NULL, NULL },
        { "eye", 0, CLI_POSITION, eye, "X,Y,Z", "help", 0, 0, NULL, NULL },
        { "name", 0, CLI_TEXT, &name, "NAME", "help", 0, 0, NULL, NULL },
        { "list", 'l', CLI_LIST, &list, "NAME", "help", 0, 0, NULL, NULL },
        { NULL, 0, CLI_FLAG, NULL, NULL, NULL, 0, 0, NULL, NULL },
    };
    const cli_command command = { "fuzz", "", "fuzzes", "", NULL, true };
    char command_name[] = "fuzz";
    char *const text = malloc(size + 1);
    if (!text)
        return 0;
    memcpy(text, data, size);
    text[size] = '\0';
    char *words[WORDS_MAX] = { command_name };
    int word_count = 1;
    for (char *word = strtok(text, "\n"); word && word_count < WORDS_MAX; word = strtok(NULL, "\n"))
        words[word_count++] = word;
    char **operands;
    int operand_count, status;
    if (cli_parse(&command, options, word_count, words, &operand_count, &operands, &status) &&
        (count < 1 || count > 9 || choice < 0 || choice > 1 || grid[2] < 1 || grid[2] > 9 ||
         range[0] < 0 || range[1] > 99 || range[1] < range[0] || part[0] < 1 || part[0] > part[1] ||
         operand_count > word_count - 1 || numbers.count > CLI_NUMBERS_MAX ||
         (numbers.count > 0 && (numbers.values[0] < 1 || numbers.values[0] > 9))))
        abort();
    free(text);
    return 0;
}
