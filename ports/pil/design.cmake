# The design of controller.h.
set(lqg_pil_design ${CMAKE_CURRENT_LIST_DIR}/../../codegen/designs/balancing_robot.toml)
set(lqg_pil_folder ${CMAKE_CURRENT_LIST_DIR})

# lqg_add_pil_design(<target>): controller.h, protocol.h and the design's SHA-256 for a program of target or host; its header it
# gets elsewhere.
function(lqg_add_pil_design target)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${lqg_pil_design})
  file(SHA256 ${lqg_pil_design} digest)
  string(REGEX REPLACE "(..)" "0x\\1," digest ${digest})
  target_compile_definitions(${target} PRIVATE DESIGN_DIGEST=${digest})
  target_include_directories(${target} PRIVATE ${lqg_pil_folder})
endfunction()
