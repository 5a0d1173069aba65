# Builds one source once per instruction set (src/kernels/build_tmpl.h). It is not auto-vectorized: the kernels state
# what is a vector, and the scalar build is the one to compare with.
set(lampion_kernel_options -fno-tree-vectorize -fno-tree-slp-vectorize)
if(CMAKE_C_COMPILER_ID MATCHES Clang)
  set(lampion_kernel_options -fno-vectorize -fno-slp-vectorize)
endif()
# The bands determine the length of arrays, and no foreign bytes are read: stack guards would only cost. Guarded memcpy
# hides from clang that a copy is a register's load or store, so that each register would go through the stack.
list(APPEND lampion_kernel_options -fno-stack-protector -U_FORTIFY_SOURCE)
if(LAMPION_FUZZ)
  # No foreign bytes are read here, and instrumenting unrolled kernels takes the compiler minutes.
  list(APPEND lampion_kernel_options -O0)
endif()
set(kernels ${PROJECT_SOURCE_DIR}/src/kernels)
if(LAMPION_SANITIZE MATCHES address)
  # The preset ubsan judges the kernels' behavior: both at once took gcc minutes for each instruction set.
  list(APPEND lampion_kernel_options -fno-sanitize=undefined)
endif()
set_source_files_properties(${kernels}/scalar.c ${kernels}/single_scalar.c PROPERTIES COMPILE_OPTIONS "${lampion_kernel_options}")

# Asks the compiler for its target, because CMAKE_SYSTEM_PROCESSOR is what a toolchain file or a cross build claims, and
# with -m32 or -arch not even that.
include(CheckCSourceCompiles)
foreach(target x86_64 aarch64 wasm32)
  check_c_source_compiles("
    #ifndef __${target}__
    #error
    #endif
    int main(void) { return 0; }" LAMPION_FOR_${target})
endforeach()

set(lampion_kernel_builds "")
if(LAMPION_SIMD AND (LAMPION_FOR_x86_64 OR LAMPION_FOR_aarch64 OR LAMPION_FOR_wasm32))
  set(lampion_kernel_builds LMPI_KERNELS_VECTOR)
  set(options ${lampion_kernel_options})
  if(LAMPION_FOR_wasm32)
    list(APPEND options -msimd128)
  endif()
  set_source_files_properties(${kernels}/vector.c ${kernels}/single_vector.c PROPERTIES COMPILE_OPTIONS "${options}")
else()
  list(REMOVE_ITEM lampion_sources ${kernels}/vector.c ${kernels}/single_vector.c)
endif()
if(LAMPION_SIMD AND LAMPION_FOR_x86_64)
  list(APPEND lampion_kernel_builds LMPI_KERNELS_X86)
  set_source_files_properties(${kernels}/avx2.c ${kernels}/single_avx2.c PROPERTIES
    COMPILE_OPTIONS "${lampion_kernel_options};-mavx2;-mf16c")
  set_source_files_properties(${kernels}/avx512.c ${kernels}/single_avx512.c PROPERTIES
    COMPILE_OPTIONS "${lampion_kernel_options};-mavx512f;-mavx512vl;-mavx512dq;-mprefer-vector-width=512")
else()
  list(REMOVE_ITEM lampion_sources ${kernels}/avx2.c ${kernels}/avx512.c ${kernels}/single_avx2.c ${kernels}/single_avx512.c)
endif()
if(NOT LAMPION_SCALAR AND lampion_kernel_builds)
  list(REMOVE_ITEM lampion_sources ${kernels}/scalar.c ${kernels}/single_scalar.c)
  list(APPEND lampion_kernel_builds LMPI_KERNELS_NO_SCALAR)
endif()
set_source_files_properties(${kernels}/dispatch.c PROPERTIES
  COMPILE_DEFINITIONS "${lampion_kernel_builds}")

# In straight-line code of few bands, for one direction at a time, what gcc packs into vectors it must take apart again
# to store.
set(lampion_straight_options $<IF:$<C_COMPILER_ID:Clang>,-fno-slp-vectorize,-fno-tree-slp-vectorize>)
set_source_files_properties(${PROJECT_SOURCE_DIR}/src/sh/eval.c PROPERTIES
  COMPILE_OPTIONS "${lampion_straight_options}")
