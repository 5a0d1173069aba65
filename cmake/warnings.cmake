# lampion_flags: the flags that every target of this tree is compiled with.
add_library(lampion_flags INTERFACE)
target_compile_options(lampion_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wdouble-promotion -Wfloat-conversion
  -Wshadow -Wundef -Wvla -Wcast-qual -Wwrite-strings
  $<$<COMPILE_LANGUAGE:C>:-Wstrict-prototypes> $<$<COMPILE_LANGUAGE:C>:-Wmissing-prototypes>
  $<$<COMPILE_LANGUAGE:C>:-Wold-style-definition> -Wformat=2)
if(LAMPION_WERROR)
  target_compile_options(lampion_flags INTERFACE -Werror)
endif()
# By the letter of C11 gcc computes floats as doubles for s390x, which rounds twice and gives other bits than elsewhere.
include(CheckCSourceCompiles)
check_c_source_compiles("
  #ifndef __s390__
  #error
  #endif
  int main(void) { return 0; }" LAMPION_FOR_s390)
if(LAMPION_FOR_s390 AND CMAKE_C_COMPILER_ID STREQUAL GNU)
  target_compile_options(lampion_flags INTERFACE -fexcess-precision=fast)
endif()
# Hardens the program, which opens files that others made, as Debian hardens its packages (dpkg-buildflags,
# hardening=+all), with shadow stacks. Sanitizers and debuggers have their own ways, and other systems' C libraries lack
# what hardened code calls: an archive for Windows would ask its users for __stack_chk_fail.
include(CheckCCompilerFlag)
check_c_compiler_flag(-fcf-protection LAMPION_HAS_CF_PROTECTION)
if(CMAKE_BUILD_TYPE STREQUAL Release AND CMAKE_SYSTEM_NAME STREQUAL Linux AND NOT LAMPION_SANITIZE)
  target_compile_options(lampion_flags INTERFACE
    -U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=2 -fstack-protector-strong)
  if(LAMPION_HAS_CF_PROTECTION)
    target_compile_options(lampion_flags INTERFACE -fcf-protection)
  endif()
  target_link_options(lampion_flags INTERFACE -Wl,-z,relro,-z,now,-z,noexecstack)
endif()
if(LAMPION_SANITIZE)
  target_compile_options(lampion_flags INTERFACE
    -fsanitize=${LAMPION_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(lampion_flags INTERFACE -fsanitize=${LAMPION_SANITIZE})
endif()
if(LAMPION_COVERAGE)
  target_compile_options(lampion_flags INTERFACE --coverage)
  target_link_options(lampion_flags INTERFACE --coverage)
endif()
if(LAMPION_FUZZ)
  # Instrumented loops are not vectorized, although simd pragmas ask for it.
  target_compile_options(lampion_flags INTERFACE -fsanitize=fuzzer-no-link -Wno-pass-failed)
endif()
