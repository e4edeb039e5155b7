include(${CMAKE_CURRENT_LIST_DIR}/../design.cmake)
set(lqg_pil_host ${CMAKE_CURRENT_LIST_DIR})

# lqg_add_pil_host(<target>): the program that simulates the plant; lqg_add_controller is the caller's.
function(lqg_add_pil_host target)
  set(pc ${lqg_pil_host}/../../pc)
  add_executable(${target} ${lqg_pil_host}/main.c ${lqg_pil_host}/target.c ${lqg_pil_host}/line.c ${lqg_pil_host}/timing.c
                           ${lqg_pil_host}/../protocol.c ${pc}/scenario.c ${pc}/robot.c ${pc}/noise.c ${pc}/chart.c)
  set_target_properties(${target} PROPERTIES C_STANDARD 99 C_EXTENSIONS OFF)
  target_compile_options(${target} PRIVATE -pedantic -Wall -Wextra -Wconversion -Wshadow -Wmissing-prototypes)
  target_link_libraries(${target} PRIVATE m)
  lqg_add_pil_design(${target})
endfunction()
