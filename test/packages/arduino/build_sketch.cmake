# SPDX-License-Identifier: MIT
# cmake -DBUILDER=… -DHARDWARE=… -DLIBRARIES=… -DBOARD=uno -DSKETCH=… -DFOLDER=… -P build_sketch.cmake: builds a sketch
# with arduino-builder, which fails where it does not fit the board, and says how large it is.
file(REMOVE_RECURSE ${FOLDER})
file(MAKE_DIRECTORY ${FOLDER})
set(cpu)
if(BOARD STREQUAL "nano")
  set(cpu ":cpu=atmega328")
elseif(BOARD STREQUAL "mega")
  set(cpu ":cpu=atmega2560")
endif()
# DECIMAL_DIG: the core is written for avr-gcc 7, Debian's is 5.4.
execute_process(COMMAND ${BUILDER} -compile -hardware ${HARDWARE} -hardware /usr/share/arduino-builder -tools /usr/bin
                        -tools /usr/share/arduino-builder -built-in-libraries ${HARDWARE}/arduino/avr/libraries
                        -libraries ${LIBRARIES} -fqbn arduino:avr:${BOARD}${cpu} -warnings all
                        -prefs compiler.cpp.extra_flags=-DDECIMAL_DIG=__DECIMAL_DIG__ -build-path ${FOLDER} ${SKETCH}
                RESULT_VARIABLE failed OUTPUT_VARIABLE said ERROR_VARIABLE said)
if(failed)
  message(FATAL_ERROR "${said}")
endif()
string(REGEX MATCHALL "(Sketch|Global)[^\n]*" sizes "${said}")
message("${sizes}")
string(REGEX MATCHALL "[^\n]*(TinyLQG|/sketch/)[^\n]*warning[^\n]*" warnings "${said}")
if(warnings)
  message(FATAL_ERROR "warnings of our own files: ${warnings}")
endif()
