# SPDX-License-Identifier: MIT
# Compiles one call after the other with COMPILER in its LANGUAGE: those as they should be, and those with arguments
# swapped, which must not compile.
set(right
    "lqg_kalman_steady_init(&steady, &steady_state)"
    "lqg_kalman_steady_update(&steady, &steady_state, y)"
    "lqg_kalman_steady_partial_update(&steady, &steady_state, y, used, &watch)"
    "lqg_kalman_steady_update_output(&steady, &steady_state, &y_i, i, &watch)"
    "lqg_kalman_steady_predict(&steady, &steady_state, u)"
    "lqg_kalman_plain_update(&plain, &plain_state, y)"
    "lqg_kalman_ud_update(&ud, &ud_state, y)"
    "lqg_kalman_ud_partial_update(&ud, &ud_state, y, used, NULL)"
    "lqg_kalman_ud_update_output(&ud, &ud_state, &y[1], i, NULL)"
    "lqg_kalman_ud_predict(&ud, &ud_state, u)"
    "lqg_ekf_update(&ekf, &ekf_state, y, u)"
    "lqg_ekf_partial_update(&ekf, &ekf_state, y, u, used, &watch)"
    "lqg_rls_update(&rls, &rls_state, y_i, phi)"
    "lqg_servo_observe(&servo, &servo_state, y)"
    "lqg_servo_control(&servo, &servo_state, x, u)"
    "lqg_servo_advance(&servo, &servo_state, u)"
    "lqg_loop_ud_step(&loop, &loop_state, y)"
    "lqg_lqr_control(&lqr, x, u)")

set(swapped
    # description and state
    "lqg_kalman_steady_init(&steady_state, &steady)"
    "lqg_kalman_steady_update(&steady_state, &steady, y)"
    "lqg_kalman_plain_update(&plain_state, &plain, y)"
    "lqg_kalman_ud_update(&ud_state, &ud, y)"
    "lqg_kalman_ud_predict(&ud_state, &ud, u)"
    "lqg_ekf_update(&ekf_state, &ekf, y, u)"
    "lqg_rls_update(&rls_state, &rls, y_i, phi)"
    "lqg_servo_control(&servo_state, &servo, x, u)"
    "lqg_loop_ud_step(&loop_state, &loop, y)"
    # of another filter
    "lqg_kalman_ud_update(&plain, &ud_state, y)"
    "lqg_kalman_ud_update(&ud, &plain_state, y)"
    "lqg_kalman_plain_predict(&plain, &ud_state, u)"
    "lqg_kalman_steady_update(&steady, &ekf_state, y)"
    "lqg_ekf_update(&ekf, &ud_state, y, u)"
    "lqg_rls_update(&rls, &ekf_state, y_i, phi)"
    "lqg_servo_advance(&servo, &loop_state, u)"
    "lqg_loop_ud_step(&loop, &ud_state, y)"
    "lqg_lqr_control(&servo, x, u)"
    # an array and a state
    "lqg_kalman_ud_update(&ud, y, &ud_state)"
    "lqg_kalman_ud_update(&ud, y, ud_state.x)"
    "lqg_kalman_ud_predict(&ud, u, &ud_state)"
    "lqg_servo_observe(&servo, y, &servo_state)"
    "lqg_ekf_update(&ekf, y, u, &ekf_state)"
    # what is read and what is written
    "lqg_lqr_control(&lqr, u, x)"
    "lqg_servo_control(&servo, &servo_state, u, x)"
    # a number and an array
    "lqg_rls_update(&rls, &rls_state, phi, y_i)"
    "lqg_kalman_ud_update_output(&ud, &ud_state, i, &y_i, NULL)"
    "lqg_kalman_ud_update_output(&ud, &ud_state, y_i, i, NULL)"
    "lqg_kalman_ud_partial_update(&ud, &ud_state, used, y, NULL)"
    "lqg_kalman_ud_partial_update(&ud, &ud_state, y, &watch, used)"
    "lqg_kalman_ud_partial_update(&ud, &ud_state, &watch, used, y)")

function(compiles expression result)
  file(WRITE ${WORK}/swap.${LANGUAGE}
       "#include <stddef.h>\n\n#include \"swaps.h\"\n\nvoid call(void)\n{\n    (void)${expression};\n}\n")
  execute_process(COMMAND ${COMPILER} -pedantic-errors -I${INCLUDE} -I${CMAKE_CURRENT_LIST_DIR} -fsyntax-only
                          ${WORK}/swap.${LANGUAGE}
                  RESULT_VARIABLE failed ERROR_VARIABLE complaint)
  set(complaint "${complaint}" PARENT_SCOPE)
  if(failed)
    set(${result} FALSE PARENT_SCOPE)
  else()
    set(${result} TRUE PARENT_SCOPE)
  endif()
endfunction()

file(MAKE_DIRECTORY ${WORK})
foreach(expression IN LISTS right)
  compiles("${expression}" does)
  if(NOT does)
    message(FATAL_ERROR "${expression} does not compile:\n${complaint}")
  endif()
endforeach()
foreach(expression IN LISTS swapped)
  compiles("${expression}" does)
  if(does)
    message(FATAL_ERROR "${expression} compiles")
  elseif(NOT complaint MATCHES "swap\\.${LANGUAGE}:7:[0-9]+: error")
    message(FATAL_ERROR "${expression} failed for another reason:\n${complaint}")
  endif()
endforeach()
