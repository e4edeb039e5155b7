# SPDX-License-Identifier: MIT
# cmake -DPYTHON=… -DEXAMPLE=… -P plant.cmake: plant.py prints, for the robot of the design, the plant that is in the
# design.
execute_process(COMMAND ${PYTHON} ${EXAMPLE}/plant.py OUTPUT_VARIABLE printed COMMAND_ERROR_IS_FATAL ANY)
file(READ ${EXAMPLE}/balancing_robot.toml design)
string(REGEX REPLACE "#[^\n]*" "" design "${design}")
string(REGEX MATCHALL "-?[0-9]+(\\.[0-9]+)?" printed "${printed}")
string(REGEX MATCHALL "[ABG] = [^A-Za-z]*" matrices "${design}")
string(REGEX MATCHALL "-?[0-9]+(\\.[0-9]+)?" expected "${matrices}")
if(NOT printed STREQUAL expected)
  message(FATAL_ERROR "expected the design's numbers\n${expected}\nfound\n${printed}")
endif()
