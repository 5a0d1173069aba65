# SPDX-License-Identifier: MIT
# What the library shows and needs: exports lmp_ names alone, has no state but the kernel table,
# and needs nothing but the mathematics, memory and string functions of C.
set -eu
. tests/checks/common.sh

kernel_table=lmp_kernel_table # the one global

archive=$WORK/../libraries/build/liblampion.a
shared=$WORK/../libraries/build/liblampion.so

# names LETTERS: of nm's output on stdin, the symbols of those kinds.
names() {
    awk -v kinds="[$1]" 'NF >= 2 && $(NF - 1) ~ "^" kinds "$" { print $NF }' | sort -u
}

strangers=$(nm --defined-only --extern-only "$archive" | names A-Z | grep -v '^lmp_' || true)
[ -z "$strangers" ] || fail "the archive exports names without lmp_:" $strangers
strangers=$(nm -D --defined-only "$shared" | names A-Z | grep -v '^lmp_' || true)
[ -z "$strangers" ] || fail "the shared library exports names without lmp_:" $strangers

# every function of the headers is exported by the shared library, and nothing else
declared=$(cat include/lampion/*.h | tr '\n' ' ' | grep -o 'LMP_API [^;(]*' | sed 's,.*[ *],,' | grep '^lmp_' | sort -u)
exported=$(nm -D --defined-only "$shared" | names A-Z)
[ "$declared" = "$exported" ] || fail "declared and exported differ (< declared, > exported):" "$(
    printf '%s\n' "$declared" >"$WORK/declared"
    printf '%s\n' "$exported" | diff "$WORK/declared" - || true
)"

# .data and .bss, of functions' statics too; constant tables of pointers lie in .data.rel.ro
state=$(objdump -t "$archive" | awk 'NF >= 5 && $(NF - 2) ~ /^\.(data|bss|tdata|tbss)/ &&
    $(NF - 2) !~ /^\.data\.rel\.ro/ && $(NF - 1) !~ /^0+$/ { print $NF }' | sort -u |
    grep -vx "$kernel_table" || true)
[ -z "$state" ] || fail "the library has mutable state:" $state

libm=$(nm -D --defined-only "$(gcc -print-file-name=libm.so.6)" | names A-Zi | sed 's/@.*//' | sort -u)
# What a hardened build puts in the place of memory functions, and calls when a guard is gone.
guards='__stack_chk_fail __memcpy_chk __memmove_chk __memset_chk'
# The compiler's own support library tells the CPU (__builtin_cpu_supports).
printf '%s\n' "$libm" __cpu_model __cpu_indicator_init $guards malloc free memcpy memmove memset memcmp strcmp strlen | sort -u >"$WORK/allowed"
nm --defined-only --extern-only "$archive" | names A-Z >"$WORK/own"
needed=$(nm --undefined-only "$archive" | names U | sort -u |
    grep -vxFf "$WORK/allowed" | grep -vxFf "$WORK/own" | grep -v '^_GLOBAL_OFFSET_TABLE_$' || true)
[ -z "$needed" ] || fail "the library needs more than mathematics and memory:" $needed

libraries=$(objdump -p "$shared" | awk '$1 == "NEEDED" && $2 !~ /^lib[mc]\.so/ { print $2 }')
[ -z "$libraries" ] || fail "the shared library needs" $libraries
