# SPDX-License-Identifier: MIT
# Links a caller of each variant with the library of each variant: when they are the same it links and runs,
# otherwise it does not link.
set(variants tinylqg double fused double_fused)
set(tinylqg_definitions)
set(double_definitions -DLQG_REAL_DOUBLE)
set(fused_definitions -DLQG_FUSED)
set(double_fused_definitions -DLQG_REAL_DOUBLE -DLQG_FUSED)
separate_arguments(FLAGS)

foreach(caller IN LISTS variants)
  foreach(library IN LISTS variants)
    set(program ${WORK}/${caller}_with_${library})
    execute_process(COMMAND ${COMPILER} ${FLAGS} ${${caller}_definitions} -I${INCLUDE} ${SOURCE}
                            ${${library}} ${LIBM} -o ${program}
                    RESULT_VARIABLE failed ERROR_VARIABLE complaint)
    if(caller STREQUAL library)
      if(failed)
        message(FATAL_ERROR "${caller} does not link with its own library:\n${complaint}")
      endif()
      execute_process(COMMAND ${program} COMMAND_ERROR_IS_FATAL ANY)
    elseif(NOT failed)
      message(FATAL_ERROR "${caller} links with the library of ${library}")
    elseif(NOT complaint MATCHES "lqg_lqr_control_f(32|64)")
      message(FATAL_ERROR "${caller} with ${library} failed for another reason:\n${complaint}")
    endif()
  endforeach()
endforeach()
