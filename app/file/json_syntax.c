/* SPDX-License-Identifier: MIT */
/* The grammar of RFC 8259, which cJSON takes loosely: it accepts leading zeros, control characters
 * in strings, an escaped NUL that ends a name early, and whatever follows the value. */
#include "app/file/file.h"

#include <string.h>

#define DEPTH_MAX 1000 /* arrays and objects in one another */

typedef struct scanner {
    const char *at, *end;
    int depth;
} scanner;

static bool take(scanner *s, char c) {
    if (s->at == s->end || *s->at != c)
        return false;
    s->at++;
    return true;
}

static void skip_space(scanner *s) {
    while (s->at < s->end && (*s->at == ' ' || *s->at == '\t' || *s->at == '\n' || *s->at == '\r'))
        s->at++;
}

static bool scan_digits(scanner *s) {
    const char *first = s->at;
    while (s->at < s->end && *s->at >= '0' && *s->at <= '9')
        s->at++;
    return s->at > first;
}

static bool scan_number(scanner *s) {
    take(s, '-');
    if (!take(s, '0') && !scan_digits(s))
        return false;
    if (take(s, '.') && !scan_digits(s))
        return false;
    if (!take(s, 'e') && !take(s, 'E'))
        return true;
    if (!take(s, '+'))
        take(s, '-');
    return scan_digits(s);
}

static bool scan_unicode(scanner *s) {
    unsigned value = 0;
    for (int i = 0; i < 4; i++, s->at++) {
        const char *digits = "0123456789abcdefABCDEF";
        const char *digit = s->at < s->end && *s->at ? strchr(digits, *s->at) : NULL;
        if (!digit)
            return false;
        value |= (unsigned)(digit - digits);
    }
    return value != 0;
}

static bool scan_string(scanner *s) {
    if (!take(s, '"'))
        return false;
    while (s->at < s->end && *s->at != '"') {
        if ((unsigned char)*s->at < 0x20)
            return false;
        if (*s->at++ != '\\')
            continue;
        if (s->at == s->end || !*s->at || !strchr("\"\\/bfnrtu", *s->at))
            return false;
        if (*s->at++ == 'u' && !scan_unicode(s))
            return false;
    }
    return take(s, '"');
}

static bool scan_word(scanner *s, const char *word) {
    const size_t length = strlen(word);
    if ((size_t)(s->end - s->at) < length || memcmp(s->at, word, length) != 0)
        return false;
    s->at += length;
    return true;
}

static bool scan_value(scanner *s);

static bool scan_entries(scanner *s, char close, bool named) {
    s->at++;
    skip_space(s);
    if (take(s, close))
        return true;
    do {
        skip_space(s);
        if (named) {
            if (!scan_string(s))
                return false;
            skip_space(s);
            if (!take(s, ':'))
                return false;
        }
        if (!scan_value(s))
            return false;
    } while (take(s, ','));
    return take(s, close);
}

/* A value with the space around it. */
static bool scan_value(scanner *s) {
    bool ok;
    skip_space(s);
    if (s->at == s->end || s->depth == DEPTH_MAX)
        return false;
    s->depth++;
    switch (*s->at) {
    case '{':
        ok = scan_entries(s, '}', true);
        break;
    case '[':
        ok = scan_entries(s, ']', false);
        break;
    case '"':
        ok = scan_string(s);
        break;
    case 't':
        ok = scan_word(s, "true");
        break;
    case 'f':
        ok = scan_word(s, "false");
        break;
    case 'n':
        ok = scan_word(s, "null");
        break;
    default:
        ok = scan_number(s);
    }
    s->depth--;
    skip_space(s);
    return ok;
}

const char *file_json_wrong(const char *text, size_t size) {
    scanner s = { text, text + size, 0 };
    return scan_value(&s) && s.at == s.end ? NULL : s.at;
}

/* The byte before `at` that is no white space, or 0. */
static char before(const char *text, const char *at) {
    while (at > text && strchr(" \t\r\n", at[-1]))
        at--;
    return at > text ? at[-1] : '\0';
}

const char *file_json_cause(const char *text, size_t size, const char *wrong) {
    if (wrong == text + size)
        return "it ends too early";
    if (wrong > text && !file_json_wrong(text, (size_t)(wrong - text)))
        return "something stands after its end";
    const char c = *wrong, last = before(text, wrong);
    if (wrong == text && c == '\xEF')
        return "a byte-order mark stands before it";
    if ((c == '}' || c == ']') && last == ',')
        return "a comma stands before the bracket that closes";
    if (c == '\'')
        return "names and texts stand in double quotes";
    if (c == '/' || c == '#')
        return "JSON has no comments";
    if (c == '+' || c == '.' || c == 'N' || c == 'I')
        return "a number begins with a digit or - (and there is no NaN or Infinity)";
    if (c >= '0' && c <= '9' && wrong > text && wrong[-1] == '0')
        return "a number does not begin with 0";
    if (last == ',' || last == '{' || last == '[' || last == ':' || !last)
        return "neither a value nor a name in double quotes begins here";
    return "a comma, colon or bracket is missing here";
}
