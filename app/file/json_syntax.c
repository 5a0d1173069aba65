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
