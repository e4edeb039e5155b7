# SPDX-License-Identifier: MIT
# Makes OUTPUT, which defines lqg::emit::templates::<name> for each <name>.c.in of FOLDER, as it is.
file(GLOB files ${FOLDER}/*.c.in)
set(source "// Made by embed.cmake of the .c.in beside it.\n#include \"emit/c/templates.hpp\"\n")
foreach(file IN LISTS files)
  get_filename_component(name ${file} NAME_WE)
  file(READ ${file} text)
  string(REPLACE "\r\n" "\n" text "${text}")
  string(APPEND source "\nconst char lqg::emit::templates::${name}[] = R\"c_in(${text})c_in\";\n")
endforeach()
file(WRITE ${OUTPUT} "${source}")
