# SPDX-License-Identifier: MIT
# What the library shows and needs: exports what the public headers declare alone, has no state but the kernel
# table, and needs nothing but the mathematics, memory and string functions of C.
set -eu
. tests/checks/common.sh

kernel_table=lmpi_kernel_table # the one global

archive=$WORK/../libraries/build/liblampion.a
shared=$WORK/../libraries/build/liblampion.so

# names LETTERS: prints the symbols of those kinds from nm's output on standard input.
names() {
    awk -v kinds="[$1]" 'NF >= 2 && $(NF - 1) ~ "^" kinds "$" { print $NF }' | sort -u
}

# The shared library exports every function of the headers, and nothing else.
declared=$(declarations include/lampion/*.h | cut -d '|' -f 2 | sort -u)
exported=$(nm -D --defined-only "$shared" | names A-Z)
[ "$declared" = "$exported" ] || fail "declared and exported differ (< declared, > exported):" "$(
    printf '%s\n' "$declared" >"$WORK/declared"
    printf '%s\n' "$exported" | diff "$WORK/declared" - || true
)"

# A static library has private names besides.
strangers=$(nm --defined-only --extern-only "$archive" | names A-Z | grep -v '^lmpi_' | grep -vxF "$declared" || true)
[ -z "$strangers" ] || fail "the archive has names that are neither declared nor begin with lmpi_:" $strangers

# State would be in .data and .bss, where functions' statics are, too; constant tables of pointers are in .data.rel.ro.
state=$(objdump -t "$archive" | awk 'NF >= 5 && $(NF - 2) ~ /^\.(data|bss|tdata|tbss)/ &&
    $(NF - 2) !~ /^\.data\.rel\.ro/ && $(NF - 1) !~ /^0+$/ { print $NF }' | sort -u |
    grep -vx "$kernel_table" || true)
[ -z "$state" ] || fail "the library has mutable state:" $state

libm=$(nm -D --defined-only "$(gcc -print-file-name=libm.so.6)" | names A-Zi | sed 's/@.*//' | sort -u)
# A hardened build replaces memory functions by these, and calls the last when a guard is damaged.
guards='__stack_chk_fail __memcpy_chk __memmove_chk __memset_chk'
# The compiler's own support library identifies the CPU (__builtin_cpu_supports).
printf '%s\n' "$libm" __cpu_model __cpu_indicator_init $guards malloc free memcpy memmove memset memcmp strcmp strlen | sort -u >"$WORK/allowed"
nm --defined-only --extern-only "$archive" | names A-Z >"$WORK/own"
needed=$(nm --undefined-only "$archive" | names U | sort -u |
    grep -vxFf "$WORK/allowed" | grep -vxFf "$WORK/own" | grep -v '^_GLOBAL_OFFSET_TABLE_$' || true)
[ -z "$needed" ] || fail "the library needs more than mathematics and memory:" $needed

libraries=$(objdump -p "$shared" | awk '$1 == "NEEDED" && $2 !~ /^lib[mc]\.so/ { print $2 }')
[ -z "$libraries" ] || fail "the shared library needs" $libraries

# The program starts without libraries that few commands need, which would take longer than most of them.
late=$(objdump -p "$PROGRAM" | awk '$1 == "NEEDED" && $2 ~ /^lib(assimp|glfw)/ { print $2 }')
[ -z "$late" ] || fail "the program starts with" $late
