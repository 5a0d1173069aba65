/* SPDX-License-Identifier: MIT */
/* Values are read strictly: the whole token, decimal, finite and in range, or not at all. */
#include "app/base/choice.h"
#include "app/base/cli.h"
#include "app/base/number.h"
#include "app/base/option.h"

#include <errno.h>
#include <float.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define DIGITS "0123456789"

void option_limits(const cli_option *option, double *minimum, double *maximum) {
    *minimum = option->minimum;
    *maximum = option->maximum;
    if (*minimum != 0.0 || *maximum != 0.0)
        return;
    switch (option->kind) {
    case CLI_RANGE:
        *minimum = 0;
        *maximum = INT_MAX;
        break;
    case CLI_INT:
    case CLI_NUMBERS:
        *minimum = INT_MIN;
        *maximum = INT_MAX;
        break;
    case CLI_SIZE:
    case CLI_GRID:
    case CLI_PART:
        *minimum = 1;
        *maximum = INT_MAX;
        break;
    default:
        *minimum = -(double)FLT_MAX;
        *maximum = (double)FLT_MAX;
    }
}

int option_digits(const cli_option *option) {
    return option->kind == CLI_INT || option->kind == CLI_NUMBERS ? 10 : 7;
}

/* Reads a number made of `characters`, up to the character `end`. */
static bool read_number(const char **text, const char *characters, char end, double *value) {
    const char *const number = *text;
    const size_t length = strspn(number, characters);
    *text += length + (end != '\0');
    return number[length] == end && number_read(number, length, value);
}

static bool out_of_range(const cli_option *option, const char *text, base_error *error) {
    double minimum, maximum;
    option_limits(option, &minimum, &maximum);
    const int digits = option_digits(option);
    return base_fail(error, NULL, "--%s: %s is out of range (%.*g to %.*g)", option->name, text,
                     digits, minimum, digits, maximum);
}

static bool in_range(const cli_option *option, double value) {
    double minimum, maximum;
    option_limits(option, &minimum, &maximum);
    return value >= minimum && value <= maximum;
}

/* How the numbers of one kind of option are written and stored. */
typedef struct number_form {
    const char *characters;
    int count;
    char between;
    enum { AS_INT, AS_FLOAT, AS_DOUBLE } kept;
    const char *name;
} number_form;

static number_form form_of(cli_kind kind) {
    switch (kind) {
    case CLI_INT:
        return (number_form) { "+-" DIGITS, 1, 0, AS_INT, "a whole number" };
    case CLI_SIZE:
        return (number_form) { DIGITS, 2, 'x', AS_INT, "a size such as 1920x1080" };
    case CLI_GRID:
        return (number_form) { DIGITS, 3, 'x', AS_INT, "a grid such as 32x16x32" };
    case CLI_VEC3:
    case CLI_POSITION:
        return (number_form) { "+-.eE" DIGITS, 3, ',', kind == CLI_VEC3 ? AS_FLOAT : AS_DOUBLE,
                               "three numbers such as 0,1.5,-2" };
    default:
        return (number_form) { "+-.eE" DIGITS, 1, 0, AS_FLOAT, "a number" };
    }
}

static bool store_numbers(const cli_option *option, const char *text, base_error *error) {
    const number_form form = form_of(option->kind);
    double values[3];
    const char *rest = text;
    for (int i = 0; i < form.count; i++) {
        const char end = i == form.count - 1 ? '\0' : form.between;
        if (!read_number(&rest, form.characters, end, &values[i]))
            return base_fail(error, NULL, "--%s: \"%s\" is not %s", option->name, text, form.name);
        if (!in_range(option, values[i]))
            return out_of_range(option, text, error);
    }
    for (int i = 0; i < form.count; i++) {
        if (form.kept == AS_INT)
            ((int *)option->target)[i] = (int)values[i];
        else if (form.kept == AS_DOUBLE)
            ((double *)option->target)[i] = values[i];
        else
            ((float *)option->target)[i] = (float)values[i];
    }
    return true;
}

static bool store_list(const cli_option *option, const char *text, base_error *error) {
    cli_numbers read = { .count = 0 };
    const char *rest = text;
    for (bool more = true; more;) {
        double value;
        const char end = strchr(rest, ',') ? ',' : '\0';
        if (read.count == CLI_NUMBERS_MAX)
            return base_fail(error, NULL, "--%s: more than %d numbers", option->name,
                             CLI_NUMBERS_MAX);
        if (!read_number(&rest, "+-" DIGITS, end, &value))
            return base_fail(error, NULL, "--%s: \"%s\" is not a list such as 10,100,1000",
                             option->name, text);
        if (!in_range(option, value))
            return out_of_range(option, text, error);
        read.values[read.count++] = (int)value;
        more = end == ',';
    }
    *(cli_numbers *)option->target = read;
    return true;
}

/* Stores FIRST-LAST, or a COUNT as the range from 0 to COUNT-1. */
static bool store_range(const cli_option *option, const char *text, base_error *error) {
    const bool both = strchr(text, '-') != NULL;
    const char *rest = text;
    double first = 0.0, last;
    if ((both && !read_number(&rest, DIGITS, '-', &first)) ||
        !read_number(&rest, DIGITS, '\0', &last) || (both && last < first))
        return base_fail(error, NULL,
                         "--%s: \"%s\" is neither a count such as 48 nor a range such as"
                         " 0-47",
                         option->name, text);
    last -= both ? 0.0 : 1.0;
    if (!in_range(option, first) || !in_range(option, last))
        return out_of_range(option, text, error);
    ((int *)option->target)[0] = (int)first;
    ((int *)option->target)[1] = (int)last;
    return true;
}

static bool store_part(const cli_option *option, const char *text, base_error *error) {
    const char *rest = text;
    double part, count;
    if (!read_number(&rest, DIGITS, '/', &part) || !read_number(&rest, DIGITS, '\0', &count) ||
        part < 1.0 || part > count)
        return base_fail(error, NULL, "--%s: \"%s\" is not a part such as 3/8", option->name, text);
    if (!in_range(option, count))
        return out_of_range(option, text, error);
    ((int *)option->target)[0] = (int)part;
    ((int *)option->target)[1] = (int)count;
    return true;
}

static bool store_seed(const cli_option *option, const char *text, base_error *error) {
    errno = 0;
    const unsigned long long value = strtoull(text, NULL, 10);
    if (text[0] == '\0' || text[strspn(text, DIGITS)] != '\0' || errno == ERANGE)
        return base_fail(error, NULL, "--%s: \"%s\" is not a whole number from 0 to 2^64 - 1",
                         option->name, text);
    *(uint64_t *)option->target = value;
    return true;
}

static bool store_choice(const cli_option *option, const char *text, base_error *error) {
    for (int i = 0; option->choices[i]; i++)
        if (strcmp(text, option->choices[i]) == 0) {
            *(int *)option->target = i;
            return true;
        }
    char name[64];
    snprintf(name, sizeof name, "--%s", option->name);
    return choice_fail(error, name, text, option->choices);
}

static bool store_item(const cli_option *option, const char *text, base_error *error) {
    cli_list *const list = option->target;
    const int room = (int)(sizeof list->items / sizeof list->items[0]);
    if (list->count == room)
        return base_fail(error, NULL, "--%s: given more than %d times", option->name, room);
    list->items[list->count++] = text;
    return true;
}

bool option_store(const cli_option *option, const char *text, base_error *error) {
    switch (option->kind) {
    case CLI_FLAG:
        *(bool *)option->target = true;
        return true;
    case CLI_RANGE:
        return store_range(option, text, error);
    case CLI_NUMBERS:
        return store_list(option, text, error);
    case CLI_PART:
        return store_part(option, text, error);
    case CLI_SEED:
        return store_seed(option, text, error);
    case CLI_TEXT:
        *(const char **)option->target = text;
        return true;
    case CLI_CHOICE:
        return store_choice(option, text, error);
    case CLI_LIST:
        return store_item(option, text, error);
    default:
        return store_numbers(option, text, error);
    }
}
