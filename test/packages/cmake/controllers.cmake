# SPDX-License-Identifier: MIT
# One small firmware, with its controller made in every style and real.
enable_testing()
foreach(style IN ITEMS unrolled compact)
  foreach(real IN ITEMS float double)
    set(target ${style}_${real})
    add_executable(${target} ${CMAKE_CURRENT_LIST_DIR}/regulate.c)
    target_compile_definitions(${target} PRIVATE real=${real})
    lqg_add_controller(${target} ${CMAKE_CURRENT_LIST_DIR}/../../../codegen/designs/double_integrator.toml
                       STYLE ${style} REAL ${real})
    add_test(NAME ${target} COMMAND ${target})
  endforeach()
endforeach()
