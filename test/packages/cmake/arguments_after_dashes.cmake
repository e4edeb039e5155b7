# SPDX-License-Identifier: MIT
# Sets `options` to what stands after -- in the command line of a script.
set(options)
set(is_option FALSE)
math(EXPR last "${CMAKE_ARGC} - 1")
foreach(index RANGE ${last})
  if(is_option)
    list(APPEND options "${CMAKE_ARGV${index}}")
  elseif(CMAKE_ARGV${index} STREQUAL "--")
    set(is_option TRUE)
  endif()
endforeach()
