/* SPDX-License-Identifier: MIT */
/* UTF-16 as UTF-8, and blanks in XML. */
#include "app/scene/load/text.h"

#include "tests/oracle/check.h"

#include <stdlib.h>
#include <string.h>

static void assert_utf8(const void *from, size_t size, const char *expected) {
    void *data = malloc(size + 1);
    assert_non_null(data);
    memcpy(data, from, size);
    assert_true(text_to_utf8(&data, &size));
    assert_int_equal(size, strlen(expected));
    assert_memory_equal(data, expected, size);
    free(data);
}

static void utf16_becomes_utf8(void **state) {
    (void)state;
    static const unsigned char little[] = { 0xff, 0xfe, 'a',  0,    0xe9, 0,
                                            0xac, 0x20, 0x3d, 0xd8, 0x00, 0xde };
    static const unsigned char big[] = { 0xfe, 0xff, 0,    'a',  0,    0xe9,
                                         0x20, 0xac, 0xd8, 0x3d, 0xde, 0x00 };
    assert_utf8(little, sizeof little, "a\u00e9\u20ac\U0001f600");
    assert_utf8(big, sizeof big, "a\u00e9\u20ac\U0001f600");
}

static void halves_of_characters_are_replaced(void **state) {
    (void)state;
    static const unsigned char high_last[] = { 0xfe, 0xff, 0xd8, 0x3d };
    static const unsigned char high_alone[] = { 0xfe, 0xff, 0xd8, 0x3d, 0, 'b' };
    static const unsigned char low_alone[] = { 0xfe, 0xff, 0xde, 0x00, 0, 'b' };
    static const unsigned char odd[] = { 0xfe, 0xff, 0, 'a', 0 };
    assert_utf8(high_last, sizeof high_last, "\ufffd");
    assert_utf8(high_alone, sizeof high_alone,
                "\ufffd"
                "b");
    assert_utf8(low_alone, sizeof low_alone,
                "\ufffd"
                "b");
    assert_utf8(odd, sizeof odd, "a");
}

static void other_bytes_stay(void **state) {
    (void)state;
    assert_utf8("", 0, "");
    assert_utf8("\xff", 1, "\xff");
    assert_utf8("\xef\xbb\xbf text", 8, "\xef\xbb\xbf text");
}

static void blanks_at_the_beginning_of_an_element_go(void **state) {
    (void)state;
    char text[] = "<a> \t\r\n1 2 </a> <b>c</b>";
    const size_t size = text_trim_xml(text, strlen(text));
    assert_int_equal(size, strlen("<a>1 2 </a><b>c</b>"));
    assert_memory_equal(text, "<a>1 2 </a><b>c</b>", size);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(utf16_becomes_utf8),
        cmocka_unit_test(halves_of_characters_are_replaced),
        cmocka_unit_test(other_bytes_stay),
        cmocka_unit_test(blanks_at_the_beginning_of_an_element_go),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
