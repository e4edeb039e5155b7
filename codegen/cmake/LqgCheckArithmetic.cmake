# SPDX-License-Identifier: MIT
# lqg_check_arithmetic(<target>): <target> is only built if its compiler, with its options, computes as lqg/arithmetic.h
# says. lqg_add_controller calls it for its target.
#
# With the options that <target> has at the end of this folder's CMakeLists.txt, in each of its languages, a small
# program is built of lqg/check.h and run. For another machine it is only compiled; clang's options, which
# lqg/arithmetic.h cannot all see or overrule, are then judged by what it makes of them: the same code as with strict
# options after them. Options of single sources are not looked at, nor those of targets that link to <target>.
include_guard(GLOBAL)

function(lqg_check_arithmetic target)
  get_property(is_checked GLOBAL PROPERTY lqg_arithmetic_of_${target}_is_checked)
  if(NOT is_checked)
    set_property(GLOBAL PROPERTY lqg_arithmetic_of_${target}_is_checked TRUE)
    cmake_language(EVAL CODE "cmake_language(DEFER CALL lqg_check_arithmetic_now [[${target}]])")
  endif()
endfunction()

function(lqg_check_arithmetic_now target)
  lqg_find_languages(languages ${target})
  foreach(language IN LISTS languages)
    set(check ${target}_arithmetic_in_${language})
    if(NOT CMAKE_CROSSCOMPILING)
      lqg_add_check(${check} ${language} ${target} EXECUTABLE)
      add_custom_command(TARGET ${check} POST_BUILD COMMAND ${check} VERBATIM)
    elseif(CMAKE_${language}_COMPILER_ID MATCHES "Clang")
      lqg_compare_code(${check} ${language} ${target})
    else()
      lqg_add_check(${check} ${language} ${target} OBJECT)
    endif()
    add_dependencies(${target} ${check})
  endforeach()
endfunction()

# Sets `variable` to those of C and CXX in which the target has sources; to one of them where it has none.
function(lqg_find_languages variable target)
  get_property(enabled GLOBAL PROPERTY ENABLED_LANGUAGES)
  get_target_property(sources ${target} SOURCES)
  set(extension_C "\\.c$")
  set(extension_CXX "\\.(C|M|c\\+\\+|cc|cpp|cxx|mm|CPP)$")
  set(found)
  set(possible)
  foreach(language IN ITEMS C CXX)
    if(language IN_LIST enabled)
      list(APPEND possible ${language})
      if("${sources}" MATCHES "${extension_${language}}" OR "${sources}" MATCHES "${extension_${language}};")
        list(APPEND found ${language})
      endif()
    endif()
  endforeach()
  if(NOT found AND possible)
    list(GET possible 0 found)
  endif()
  set(${variable} ${found} PARENT_SCOPE)
endfunction()

# A target `check` of the kind EXECUTABLE or OBJECT with the options of `target`, and more options after them.
function(lqg_add_check check language target kind)
  set(extension_C c)
  set(extension_CXX cpp)
  set(source ${CMAKE_CURRENT_BINARY_DIR}/lqg/${target}_check.${extension_${language}})
  file(CONFIGURE OUTPUT ${source} @ONLY CONTENT [[
#include <stdio.h>

#include "lqg/check.h"

int main(void)
{
    const char *wrong = lqg_arithmetic_check();
    if (wrong)
        puts(wrong);
    return wrong != NULL;
}
]])
  get_target_property(type ${target} TYPE)
  if(kind STREQUAL "EXECUTABLE")
    add_executable(${check} EXCLUDE_FROM_ALL ${source})
    if(type STREQUAL "EXECUTABLE")
      target_link_options(${check} PRIVATE $<TARGET_PROPERTY:${target},LINK_OPTIONS>)
    endif()
  else()
    add_library(${check} OBJECT EXCLUDE_FROM_ALL ${source})
  endif()
  target_link_libraries(${check} PRIVATE tinylqg::headers)
  set(property COMPILE_OPTIONS)
  if(type STREQUAL "INTERFACE_LIBRARY")
    set(property INTERFACE_COMPILE_OPTIONS)
  endif()
  target_compile_options(${check} PRIVATE $<TARGET_PROPERTY:${target},${property}> ${ARGN})
  foreach(copied IN ITEMS COMPILE_FLAGS ${language}_STANDARD ${language}_EXTENSIONS INTERPROCEDURAL_OPTIMIZATION)
    get_target_property(value ${target} ${copied})
    if(NOT value MATCHES "-NOTFOUND$")
      set_target_properties(${check} PROPERTIES ${copied} "${value}")
    endif()
  endforeach()
  set_target_properties(${check} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/lqg)
endfunction()

# Adds the target `check`, which fails where the options of `target` give other code than strict ones after them. NaNs
# that are forgotten are an error of the compiler's from -O1 on.
function(lqg_compare_code check language target)
  set(as_text -g0 -fno-lto -S)
  lqg_add_check(${check}_optimized ${language} ${target} OBJECT -O1)
  lqg_add_check(${check}_given ${language} ${target} OBJECT ${as_text})
  lqg_add_check(${check}_strict ${language} ${target} OBJECT ${as_text} -fno-fast-math -ffp-contract=off)
  set_target_properties(${check}_given ${check}_strict PROPERTIES INTERPROCEDURAL_OPTIMIZATION OFF)
  add_custom_target(${check}
    COMMAND ${CMAKE_COMMAND} -DGIVEN=$<TARGET_OBJECTS:${check}_given> -DSTRICT=$<TARGET_OBJECTS:${check}_strict>
            -DTARGET=${target} -P ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/LqgCompareCode.cmake
    DEPENDS $<TARGET_OBJECTS:${check}_optimized> $<TARGET_OBJECTS:${check}_given> $<TARGET_OBJECTS:${check}_strict>
    VERBATIM)
  add_dependencies(${check} ${check}_optimized ${check}_given ${check}_strict)
endfunction()
