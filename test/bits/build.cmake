# Builds the controllers in CONTROLLERS and the library of ROOT with COMPILER and OPTIONS in WORK, and compares their
# bits with HASHES. With CONTRACTS the build has to be one that contracts a*b + c.
separate_arguments(options UNIX_COMMAND "${OPTIONS}")
list(APPEND options -w -I${ROOT}/include)
file(REMOVE_RECURSE ${WORK})
file(GLOB library ${ROOT}/src/*.c)
list(FILTER library EXCLUDE REGEX "/(ekf|rls|status)\\.c$")  # lqgen calls none of them
file(GLOB controllers ${CONTROLLERS}/*.c)

foreach(variant IN ITEMS "-DPLAIN=float" "-DLQG_REAL_DOUBLE" "-DLQG_FUSED" "-DLQG_REAL_DOUBLE;-DLQG_FUSED")
  string(MAKE_C_IDENTIFIER "${variant}" folder)
  file(MAKE_DIRECTORY ${WORK}/${folder})
  execute_process(COMMAND ${COMPILER} ${options} ${variant} -c ${library}
                  WORKING_DIRECTORY ${WORK}/${folder} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
file(MAKE_DIRECTORY ${WORK}/controllers)
execute_process(COMMAND ${COMPILER} ${options} -DWITH_plain_float -DWITH_plain_double -DWITH_fused_float -DWITH_fused_double
                        -I${CONTROLLERS} -I${ROOT}/test/bits -I${ROOT}/test/src -c ${ROOT}/test/bits/main.c
                        ${controllers}
                WORKING_DIRECTORY ${WORK}/controllers COMMAND_ERROR_IS_FATAL ANY)
file(GLOB objects ${WORK}/*/*.o)
list(REMOVE_ITEM options -x c++)
execute_process(COMMAND ${COMPILER} ${options} ${objects} -lm -o ${WORK}/bits COMMAND_ERROR_IS_FATAL ANY)

set(PROGRAM ${WORK}/bits)
set(BUILD "${COMPILER} ${OPTIONS}")
set(KINDS "plain_float|plain_double|fused_float|fused_double")
include(${CMAKE_CURRENT_LIST_DIR}/compare.cmake)
