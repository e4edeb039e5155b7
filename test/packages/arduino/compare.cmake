# SPDX-License-Identifier: MIT
# cmake -DCXX=… -DSKETCH=… -DLIBRARY=… -DSTAND_IN=… -DWORK=… -DUNO=… -DELF=… -P compare.cmake: the sketch prints the
# same on the simulated Uno and compiled for the PC, but for lines with #; and the motor comes to rest.
file(WRITE ${WORK}/pc.cpp "#include \"Arduino.h\"\n#include \"${SKETCH}\"\nint main() { setup(); loop(); }\n")
execute_process(COMMAND ${CXX} -std=c++11 -O2 -ffp-contract=off -I${STAND_IN} -I${LIBRARY}/src ${WORK}/pc.cpp
                        -o ${WORK}/pc
                COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${WORK}/pc OUTPUT_VARIABLE expected COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${UNO} ${ELF} OUTPUT_VARIABLE found COMMAND_ERROR_IS_FATAL ANY)
message("${found}")
foreach(text IN ITEMS expected found)
  string(REGEX REPLACE "(#|Loaded)[^\n]*\n" "" ${text} "${${text}}")
endforeach()
if(NOT found STREQUAL expected)
  message(FATAL_ERROR "expected what the PC prints:\n${expected}")
endif()
if(NOT found MATCHES "^0 1000000 " OR NOT found MATCHES "\n57 0 0\nend\n$")
  message(FATAL_ERROR "expected a motor that turns from 1 rad to 0, found:\n${found}")
endif()
