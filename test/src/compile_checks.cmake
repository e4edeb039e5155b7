# SPDX-License-Identifier: MIT
# What the compiler has to say: each header stands alone, in C99 and in C++; the library is C++ too; -ffast-math
# is refused; variants and arguments do not mix; contraction changes no bit.
set(warnings -pedantic -Wall -Wextra -Wconversion -Wshadow -Werror)
file(GLOB headers RELATIVE ${include_folder} CONFIGURE_DEPENDS ${include_folder}/lqg/*.h)
file(GLOB library_sources CONFIGURE_DEPENDS ${library_folder}/*.c)

foreach(header IN LISTS headers)
  string(MAKE_C_IDENTIFIER ${header} name)
  set(alone "#include \"${header}\"\nextern int not_empty;\n")
  file(CONFIGURE OUTPUT ${name}.c CONTENT "${alone}" @ONLY)
  file(CONFIGURE OUTPUT ${name}.cpp CONTENT "${alone}" @ONLY)
  list(APPEND alone_in_c ${CMAKE_CURRENT_BINARY_DIR}/${name}.c)
  list(APPEND alone_in_cxx ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
endforeach()

add_library(headers_alone_in_c OBJECT ${alone_in_c})
set_target_properties(headers_alone_in_c PROPERTIES C_STANDARD 99 C_EXTENSIONS OFF)
target_include_directories(headers_alone_in_c PRIVATE ${include_folder})
target_compile_options(headers_alone_in_c PRIVATE ${warnings} -Wmissing-prototypes -Wdouble-promotion)

if(CMAKE_CXX_COMPILER)
  set_source_files_properties(${library_sources} PROPERTIES LANGUAGE CXX)
  add_library(all_as_cxx OBJECT ${alone_in_cxx} ${library_sources})
  target_include_directories(all_as_cxx PRIVATE ${include_folder})
  target_compile_options(all_as_cxx PRIVATE ${warnings})
endif()

foreach(flag -ffast-math -ffinite-math-only)
  add_test(NAME src.refuses${flag} COMMAND ${CMAKE_C_COMPILER} ${flag} -I${include_folder} -fsyntax-only
                                           ${CMAKE_CURRENT_SOURCE_DIR}/variant_caller.c)
  set_tests_properties(src.refuses${flag} PROPERTIES
                       PASS_REGULAR_EXPRESSION "cannot be compiled with -ffast-math")
endforeach()

add_test(NAME src.variants_do_not_mix
         COMMAND ${CMAKE_COMMAND} -DCOMPILER=${CMAKE_C_COMPILER} "-DFLAGS=${CMAKE_C_FLAGS}"
                 -DINCLUDE=${include_folder} -DSOURCE=${CMAKE_CURRENT_SOURCE_DIR}/variant_caller.c
                 -DWORK=${CMAKE_CURRENT_BINARY_DIR}
                 -Dtinylqg=$<TARGET_FILE:tinylqg> -Ddouble=$<TARGET_FILE:tinylqg_double>
                 -Dfused=$<TARGET_FILE:tinylqg_fused> -Ddouble_fused=$<TARGET_FILE:tinylqg_double_fused>
                 -DLIBM=$<$<BOOL:${UNIX}>:-lm> -P ${CMAKE_CURRENT_SOURCE_DIR}/mix_variants.cmake)

add_test(NAME src.swaps_do_not_compile
         COMMAND ${CMAKE_COMMAND} -DCOMPILER=${CMAKE_C_COMPILER} -DLANGUAGE=c -DINCLUDE=${include_folder}
                 -DWORK=${CMAKE_CURRENT_BINARY_DIR}/swaps_c -P ${CMAKE_CURRENT_SOURCE_DIR}/swaps.cmake)
if(CMAKE_CXX_COMPILER)
  add_test(NAME src.swaps_do_not_compile_in_cxx
           COMMAND ${CMAKE_COMMAND} -DCOMPILER=${CMAKE_CXX_COMPILER} -DLANGUAGE=cpp -DINCLUDE=${include_folder}
                   -DWORK=${CMAKE_CURRENT_BINARY_DIR}/swaps_cxx -P ${CMAKE_CURRENT_SOURCE_DIR}/swaps.cmake)
endif()

# Contraction needs a processor that multiplies and adds at once; AArch64 always does, x86-64 when it has FMA.
include(CheckCSourceRuns)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  set(fma_flag -mfma)
  check_c_source_runs("int main(void) { return !__builtin_cpu_supports(\"fma\"); }" LQG_PROCESSOR_HAS_FMA)
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "aarch64|arm64")
  set(LQG_PROCESSOR_HAS_FMA TRUE)
endif()

if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  add_test(NAME src.slow_fused_is_told
           COMMAND ${CMAKE_COMMAND} -DCOMPILER=${CMAKE_C_COMPILER} -DLACKS=-mno-fma -DHAS=-mfma
                   -DINCLUDE=${include_folder} -DFILE=${library_folder}/kernel.c
                   -P ${CMAKE_CURRENT_SOURCE_DIR}/slow_fused.cmake)
endif()

if(UNIX)
  set(allow_fma)
  if(LQG_PROCESSOR_HAS_FMA)
    set(allow_fma ${fma_flag})
  endif()
  add_test(NAME src.bits_are_the_same_with_all_options
           COMMAND ${CMAKE_COMMAND} -DCOMPILER=${CMAKE_C_COMPILER} -DFMA=${allow_fma} -DLIBRARY=${library_folder}
                   -DTESTS=${CMAKE_CURRENT_SOURCE_DIR} -DINCLUDE=${include_folder} -DWORK=${CMAKE_CURRENT_BINARY_DIR}
                   -P ${CMAKE_CURRENT_SOURCE_DIR}/bits_everywhere.cmake)
endif()

if(LQG_PROCESSOR_HAS_FMA)
  # What each compiler does of itself in gnu99; clang lets no pragma overrule an explicit "fast".
  set(allowed fast)
  if(CMAKE_C_COMPILER_ID MATCHES "Clang")
    set(allowed on)
  endif()
  # The library is compiled into the program, as its options are what is tried.
  foreach(source IN LISTS library_sources)
    cmake_path(GET source FILENAME name)
    file(CONFIGURE OUTPUT contraction_${name} CONTENT "#include \"${source}\"\n" @ONLY)
    list(APPEND contraction_sources ${CMAKE_CURRENT_BINARY_DIR}/contraction_${name})
  endforeach()
  foreach(real float double)
    foreach(contract ${allowed} off)
      set(program contraction_${real}_${contract})
      add_executable(${program} contraction.c bits.c ${contraction_sources})
      set_target_properties(${program} PROPERTIES C_STANDARD 99 C_EXTENSIONS ON)
      target_include_directories(${program} PRIVATE ${include_folder} ${library_folder})
      target_compile_definitions(${program} PRIVATE $<$<STREQUAL:${real},double>:LQG_REAL_DOUBLE>)
      target_compile_options(${program} PRIVATE -O2 ${fma_flag} -ffp-contract=${contract})
    endforeach()
    add_test(NAME src.contraction_changes_no_bit.${real}
             COMMAND ${CMAKE_COMMAND} -DCONTRACTED=$<TARGET_FILE:contraction_${real}_${allowed}>
                     -DPLAIN=$<TARGET_FILE:contraction_${real}_off>
                     -P ${CMAKE_CURRENT_SOURCE_DIR}/compare_contraction.cmake)
  endforeach()
endif()
