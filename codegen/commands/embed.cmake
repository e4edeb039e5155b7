# SPDX-License-Identifier: MIT
# cmake "-DSTARTERS=name=file;…" -DOUTPUT=… -P embed.cmake: the design files as strings of C++.
set(text "// Made by embed.cmake.\n#include \"commands/starters.hpp\"\n\nnamespace lqg::commands {\n\n")
string(APPEND text "const std::vector<Starter>& starters() {\n  static const std::vector<Starter> all = {\n")
foreach(starter IN LISTS STARTERS)
  string(REGEX MATCH "^([a-z]+)=(.*)$" matched "${starter}")
  set(name ${CMAKE_MATCH_1})
  file(READ "${CMAKE_MATCH_2}" content)
  string(APPEND text "      {\"${name}\", R\"toml(${content})toml\"},\n")
endforeach()
string(APPEND text "  };\n  return all;\n}\n\n}  // namespace lqg::commands\n")
file(WRITE "${OUTPUT}" "${text}")
