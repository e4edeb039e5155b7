# SPDX-License-Identifier: MIT
# cmake -DPACKAGE=… -DROOT=… -DCC=… -DCXX=… -DFLAGS=… -DWORK=… -Dtinylqg=<library> -Ddouble=… -Dfused=… -Ddouble_fused=…
# -P single_header.cmake: tinylqg.h in all four variants, as C and as C++, with all warnings, finds the bits of the
# library. The names of the library's private functions stay its own.
separate_arguments(FLAGS)
set(warnings -pedantic -Wall -Wextra -Wconversion -Wshadow -Werror)
set(c ${CC} -std=c99 -Wmissing-prototypes -Wdouble-promotion)
set(cxx ${CXX} -x c++ -std=c++11)
file(MAKE_DIRECTORY ${WORK})
file(WRITE ${WORK}/implementation.c
  "#include \"tinylqg.h\"\n#define LQG_IMPLEMENTATION\n#include \"tinylqg.h\"\n#include \"tinylqg.h\"\n"
  "int copy, begin, law, limit, is_finite, multiply_add, subtract;\n")
set(print_bits ${ROOT}/test/src/print_bits.c ${ROOT}/test/src/bits.c)

set(options_tinylqg)
set(options_double -DLQG_REAL_DOUBLE)
set(options_fused -DLQG_FUSED)
set(options_double_fused -DLQG_REAL_DOUBLE -DLQG_FUSED)
foreach(variant IN ITEMS tinylqg double fused double_fused)
  set(options -O2 ${FLAGS} ${options_${variant}})
  execute_process(COMMAND ${CC} -std=c99 ${options} -I${ROOT}/include ${print_bits} ${${variant}} -lm -o ${WORK}/library
                  COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${WORK}/library OUTPUT_VARIABLE expected COMMAND_ERROR_IS_FATAL ANY)
  foreach(compiler IN ITEMS c cxx)
    execute_process(COMMAND ${${compiler}} ${options} ${warnings} -I${PACKAGE} -c ${WORK}/implementation.c
                            -o ${WORK}/implementation.o
                    COMMAND_ERROR_IS_FATAL ANY)
    # <lqg/….h> of the package leads to tinylqg.h
    execute_process(COMMAND ${CC} -std=c99 ${options} -I${PACKAGE} ${print_bits} ${WORK}/implementation.o -lm
                            -o ${WORK}/package COMMAND_ERROR_IS_FATAL ANY)
    execute_process(COMMAND ${WORK}/package OUTPUT_VARIABLE found COMMAND_ERROR_IS_FATAL ANY)
    if(NOT found STREQUAL expected)
      message(FATAL_ERROR "${compiler} ${variant}: expected the library's bits ${expected}, found ${found}")
    endif()
  endforeach()
endforeach()
