# SPDX-License-Identifier: MIT
include(${CMAKE_CURRENT_LIST_DIR}/../design.cmake)
set(lqg_pil_host ${CMAKE_CURRENT_LIST_DIR})

# lqg_add_pil_host(<target>): the program with the plant; lqg_add_controller is the caller's. LQG_PIL_SAMPLES, if it is
# set, is the folder of a samples.h: what the sensors said in the design's own test takes the place of the robot.
function(lqg_add_pil_host target)
  set(pc ${lqg_pil_host}/../../pc)
  if(LQG_PIL_SAMPLES)
    set(plant ${lqg_pil_host}/plant_samples.c)
  else()
    set(plant ${lqg_pil_host}/plant_robot.c ${pc}/scenario.c ${pc}/robot.c ${pc}/noise.c)
  endif()
  add_executable(${target} ${lqg_pil_host}/main.c ${lqg_pil_host}/target.c ${lqg_pil_host}/line.c
                           ${lqg_pil_host}/timing.c ${lqg_pil_host}/../protocol.c ${pc}/chart.c ${plant})
  set_target_properties(${target} PROPERTIES C_STANDARD 99 C_EXTENSIONS OFF)
  target_compile_options(${target} PRIVATE -pedantic -Wall -Wextra -Wconversion -Wshadow -Wmissing-prototypes)
  target_include_directories(${target} PRIVATE ${LQG_PIL_SAMPLES})
  target_link_libraries(${target} PRIVATE m)
  lqg_add_pil_design(${target})
endfunction()
