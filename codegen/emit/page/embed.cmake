# SPDX-License-Identifier: MIT
# cmake "-DTEXTS=name=file;…" -DCHART_JS=… -DLICENSE=… -DOUTPUT=… -P embed.cmake: what the page brings along as strings
# of C++: its own files, and Chart.js with the licence under which it is handed on. LICENSE: a file with the words of
# the MIT licence.
set(text "// Made by embed.cmake.\n#include \"emit/page/embedded.hpp\"\n\nnamespace lqg::emit::embedded {\n\n")

# add(<name> <content>): in pieces, for compilers limit the length of a literal.
function(add name content)
  foreach(never IN ITEMS "<script" "</script" "</style" "<!--" "http://" "https://" ")embedded\"")
    string(FIND "${content}" "${never}" found)
    if(NOT found EQUAL -1)
      message(FATAL_ERROR "${name} has `${never}`, which a page without a network cannot have")
    endif()
  endforeach()
  string(LENGTH "${content}" length)
  set(at 0)
  set(pieces)
  while(at LESS length)
    string(SUBSTRING "${content}" ${at} 12000 piece)
    string(APPEND pieces "\n    R\"embedded(${piece})embedded\"")
    math(EXPR at "${at} + 12000")
  endwhile()
  set(text "${text}const char* const ${name} =${pieces};\n\n" PARENT_SCOPE)
endfunction()

foreach(entry IN LISTS TEXTS)
  string(REGEX MATCH "^([a-z_]+)=(.*)$" matched "${entry}")
  set(name ${CMAKE_MATCH_1})
  file(READ "${CMAKE_MATCH_2}" content)
  string(REGEX REPLACE "^// SPDX[^\n]*\n" "" content "${content}")
  add(${name} "${content}")
endforeach()

# The addresses in its comments are no part of its notices.
file(READ "${CHART_JS}" chart_js)
string(REGEX REPLACE "\n \\* https?://[^\n]*" "" chart_js "${chart_js}")
string(REGEX REPLACE "https?://[A-Za-z0-9./_#-]*" "" chart_js "${chart_js}")
string(REGEX REPLACE "//# sourceMappingURL[^\n]*" "" chart_js "${chart_js}")
file(READ "${LICENSE}" license)
string(REGEX REPLACE "^.*Copyright \\(c\\) [^\n]*\n+" "" license "${license}")
add(chart_js "/*! The MIT licence of Chart.js and of what it has inside:\n\n${license}*/\n${chart_js}")

file(WRITE "${OUTPUT}" "${text}}  // namespace lqg::emit::embedded\n")
