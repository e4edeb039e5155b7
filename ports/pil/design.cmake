# SPDX-License-Identifier: MIT
# The design of controller.h: LQG_PIL_DESIGN, default the balancing robot's.
set(LQG_PIL_DESIGN ${CMAKE_CURRENT_LIST_DIR}/../../codegen/designs/balancing_robot.toml CACHE FILEPATH "Design file")
set(lqg_pil_design ${LQG_PIL_DESIGN})
set(lqg_pil_folder ${CMAKE_CURRENT_LIST_DIR})
include(${CMAKE_CURRENT_LIST_DIR}/../../codegen/cmake/LqgAddController.cmake)

# lqg_add_pil_design(<target>): controller.h, protocol.h, the design's name and SHA-256 for a program of target or host;
# its header it gets elsewhere.
function(lqg_add_pil_design target)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${lqg_pil_design})
  lqg_read_design_key(name ${lqg_pil_design} name "" "[a-z][a-z0-9_]*")
  string(TOUPPER ${name} in_capitals)
  file(SHA256 ${lqg_pil_design} digest)
  string(REGEX REPLACE "(..)" "0x\\1," digest ${digest})
  target_compile_definitions(${target} PRIVATE DESIGN_DIGEST=${digest} CONTROLLER=${name}
                                               CONTROLLER_IN_CAPITALS=${in_capitals}
                                               "CONTROLLER_HEADER=\"${name}.h\"")
  target_include_directories(${target} PRIVATE ${lqg_pil_folder})
endfunction()
