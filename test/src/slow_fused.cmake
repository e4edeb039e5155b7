# SPDX-License-Identifier: MIT
# Compiles the library's FILE fused, with and without the instruction for it: the compiler says that it is slow where
# the instruction is missing, and only there. LACKS is the option that takes it away, HAS the one that gives it.
foreach(real IN ITEMS "" -DLQG_REAL_DOUBLE)
  foreach(options IN ITEMS "${LACKS} -DLQG_FUSED" "${LACKS} -DLQG_FUSED -DLQG_SLOW_FUSED" "${HAS} -DLQG_FUSED"
                           "${LACKS}")
    separate_arguments(list UNIX_COMMAND "${options} ${real}")
    execute_process(COMMAND ${COMPILER} -std=c99 ${list} -I${INCLUDE} -fsyntax-only ${FILE}
                    ERROR_VARIABLE said COMMAND_ERROR_IS_FATAL ANY)
    set(expected FALSE)
    if(options STREQUAL "${LACKS} -DLQG_FUSED")
      set(expected TRUE)
    endif()
    set(found FALSE)
    if(said MATCHES "LQG_FUSED without the instruction is slow")
      set(found TRUE)
    endif()
    if(NOT expected STREQUAL found)
      message(FATAL_ERROR "${options} ${real}: message expected ${expected}, found ${found}:\n${said}")
    endif()
  endforeach()
endforeach()
