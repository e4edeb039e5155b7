# SPDX-License-Identifier: MIT
# lqg_add_controller(<target> <design.toml> [STYLE unrolled|compact|auto] [REAL float|double] [OUTPUT_DIR
# <folder>])
#
# Runs lqgen on the design when <target> is built, and again whenever the design or lqgen has changed; puts
# the header NAME.h, NAME being the design's `name`, on the include path of <target>; links what the header
# needs: nothing but lqg/*.h where the code is unrolled and no limits are foreseen, else the variant of the
# library that has the design's `real` and `arithmetic`.
#
#   STYLE, REAL   instead of the design's own `style` and `real`
#   OUTPUT_DIR    where NAME.h goes; default: lqg/<target> in the current binary folder
#
# <target> is only built if its compiler, with its options, computes as lqg/arithmetic.h says
# (LqgCheckArithmetic.cmake).
#
# lqgen runs on the machine that builds; which one it is says LqgFindLqgen.cmake.
include_guard(GLOBAL)
include(${CMAKE_CURRENT_LIST_DIR}/LqgCheckArithmetic.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/LqgFindLqgen.cmake)

function(lqg_add_controller target design)
  cmake_parse_arguments(PARSE_ARGV 2 arg "" "STYLE;REAL;OUTPUT_DIR" "")
  lqg_check_controller_arguments()
  get_filename_component(design "${design}" ABSOLUTE BASE_DIR "${CMAKE_CURRENT_SOURCE_DIR}")
  if(NOT EXISTS "${design}" OR IS_DIRECTORY "${design}")
    message(FATAL_ERROR "lqg_add_controller: no design file ${design}")
  endif()

  # Name and library are decided here, when CMake configures: configure again when the design changes.
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${design}")
  lqg_read_design_key(name "${design}" name "" "[a-z][a-z0-9_]*")
  if(NOT name)
    message(FATAL_ERROR "lqg_add_controller: ${design} has no line name = \"…\" "
                        "with a C identifier in lower case")
  endif()
  lqg_find_lqgen(lqgen)
  if(NOT arg_OUTPUT_DIR)
    set(arg_OUTPUT_DIR "lqg/${target}")
  endif()
  get_filename_component(folder "${arg_OUTPUT_DIR}" ABSOLUTE BASE_DIR "${CMAKE_CURRENT_BINARY_DIR}")
  set(options)
  if(arg_STYLE)
    list(APPEND options --style ${arg_STYLE})
  endif()
  if(arg_REAL)
    list(APPEND options --real ${arg_REAL})
  endif()

  file(MAKE_DIRECTORY "${folder}")
  lqg_find_style(style "${design}" "${arg_STYLE}" "${lqgen}" "${folder}" ${options})
  lqg_find_library_variant(library "${design}" "${style}" "${arg_REAL}")
  add_custom_command(
    OUTPUT "${folder}/${name}.h"
    COMMAND "${lqgen}" "${design}" -o "${folder}" --only h --quiet ${options}
    DEPENDS "${design}" "${lqgen}"
    COMMENT "Designing ${name}.h"
    VERBATIM)
  add_custom_target(${target}_${name}_header DEPENDS "${folder}/${name}.h")
  add_dependencies(${target} ${target}_${name}_header)

  set(scope PUBLIC)
  get_target_property(type ${target} TYPE)
  if(type STREQUAL "INTERFACE_LIBRARY")
    set(scope INTERFACE)
  endif()
  target_include_directories(${target} ${scope} "$<BUILD_INTERFACE:${folder}>")
  target_link_libraries(${target} ${scope} ${library})
  lqg_check_arithmetic(${target})
endfunction()

# Stops with a sentence where the call's arguments make no sense.
macro(lqg_check_controller_arguments)
  if(NOT TARGET ${target})
    message(FATAL_ERROR "lqg_add_controller: ${target} is not a target")
  endif()
  if(arg_UNPARSED_ARGUMENTS OR arg_KEYWORDS_MISSING_VALUES)
    message(FATAL_ERROR "lqg_add_controller: do not know what to do with "
                        "\"${arg_UNPARSED_ARGUMENTS}${arg_KEYWORDS_MISSING_VALUES}\"")
  endif()
  if(arg_STYLE AND NOT arg_STYLE MATCHES "^(unrolled|compact|auto)$")
    message(FATAL_ERROR "lqg_add_controller: STYLE is unrolled, compact or auto, not ${arg_STYLE}")
  endif()
  if(arg_REAL AND NOT arg_REAL MATCHES "^(float|double)$")
    message(FATAL_ERROR "lqg_add_controller: REAL is float or double, not ${arg_REAL}")
  endif()
endmacro()

# Sets `variable` to the first value of `key` in the design file that is a string of the form `values`, else
# to `default`. lqgen reads the file properly; here it is enough to find what decides names and libraries.
function(lqg_read_design_key variable design key default values)
  file(READ "${design}" text)
  string(REGEX REPLACE "#[^\n]*" "" text "\n${text}")
  if(text MATCHES "[^A-Za-z0-9_-][\"']?${key}[\"']?[ \t]*=[ \t]*[\"'](${values})[\"']")
    set(${variable} "${CMAKE_MATCH_1}" PARENT_SCOPE)
  else()
    set(${variable} "${default}" PARENT_SCOPE)
  endif()
endfunction()

# Sets `variable` to the style of the header: unrolled or compact. What `auto` comes to says lqgen, if it is there
# already; else, and where it refuses the design (the build will say so), it stays `auto`.
function(lqg_find_style variable design style lqgen folder)
  if(NOT style)
    lqg_read_design_key(style "${design}" style auto "unrolled|compact|auto")
  endif()
  if(style STREQUAL "auto" AND EXISTS "${lqgen}")
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${lqgen}")
    set(made "${folder}/configured")
    lqg_read_design_key(name "${design}" name "" "[a-z][a-z0-9_]*")
    set(json "${made}/${name}.json")
    if("${design}" IS_NEWER_THAN "${json}" OR "${lqgen}" IS_NEWER_THAN "${json}")
      file(MAKE_DIRECTORY "${made}")
      file(REMOVE "${json}")
      execute_process(COMMAND "${lqgen}" "${design}" -o "${made}" --only json --quiet ${ARGN} OUTPUT_QUIET ERROR_QUIET)
    endif()
    if(EXISTS "${json}")
      file(READ "${json}" text)
      string(JSON style GET "${text}" code style)
    endif()
  endif()
  set(${variable} ${style} PARENT_SCOPE)
endfunction()

# Sets `variable` to whether limits are foreseen: the library has the solver, whatever the style.
function(lqg_foresees variable design)
  set(table)
  set(foresees FALSE)
  file(STRINGS ${design} lines)
  foreach(line IN LISTS lines)
    if(line MATCHES "^[ \t]*\\[+[ \t]*([A-Za-z0-9_.]+)[ \t]*\\]")
      set(table ${CMAKE_MATCH_1})
    elseif((table STREQUAL "limits" AND line MATCHES "^[ \t]*horizon[ \t]*=[ \t]*[1-9]") OR
           line MATCHES "^[ \t]*limits[ \t]*[.=][^#]*horizon[ \t]*=[ \t]*[1-9]")
      set(foresees TRUE)
    endif()
  endforeach()
  set(${variable} ${foresees} PARENT_SCOPE)
endfunction()

# Sets `variable` to what a controller of `design` in this style has to be linked with.
function(lqg_find_library_variant variable design style real)
  lqg_read_design_key(design_real "${design}" real float "float|double")
  lqg_read_design_key(arithmetic "${design}" arithmetic plain "plain|fused")
  if(NOT real)
    set(real ${design_real})
  endif()

  lqg_foresees(foresees ${design})
  if(style STREQUAL "unrolled" AND NOT foresees)
    set(libraries tinylqg::headers)
    if(arithmetic STREQUAL "fused" AND NOT MSVC)
      list(APPEND libraries m)  # fma() where the processor has none
    endif()
  else()
    set(variants_float_plain tinylqg::tinylqg)
    set(variants_double_plain tinylqg::double)
    set(variants_float_fused tinylqg::fused)
    set(variants_double_fused tinylqg::double_fused)
    set(libraries ${variants_${real}_${arithmetic}})
  endif()
  set(${variable} ${libraries} PARENT_SCOPE)
endfunction()
