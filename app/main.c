/* SPDX-License-Identifier: MIT */
#include "app/command/command.h"

#include <stdio.h>

int main(int argc, char **argv) {
    (void)argc;
    (void)argv;
    for (size_t i = 0; command_table[i]; i++)
        printf("%s  %s\n", command_table[i]->name, command_table[i]->summary);
    return CLI_OK;
}
