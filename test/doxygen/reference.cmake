# SPDX-License-Identifier: MIT
# cmake -DDOXYGEN=… -DROOT=… -DOUTPUT=… -P reference.cmake: makes the API reference in OUTPUT. Fails where Doxygen
# warns, or where a header has no page or no text: then the comments were not seen.
file(REMOVE_RECURSE ${OUTPUT})
file(MAKE_DIRECTORY ${OUTPUT})
file(READ ${ROOT}/include/Doxyfile settings)
file(WRITE ${OUTPUT}/Doxyfile "${settings}\nOUTPUT_DIRECTORY = ${OUTPUT}\n")
execute_process(COMMAND ${DOXYGEN} ${OUTPUT}/Doxyfile WORKING_DIRECTORY ${ROOT} RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "doxygen ended with ${status}")
endif()
file(GLOB headers RELATIVE ${ROOT}/include/lqg ${ROOT}/include/lqg/*.h)
foreach(header IN LISTS headers)
  string(REPLACE "_" "__" page ${header})  # Doxygen's own way with the names of files
  string(REGEX REPLACE "^(.*)\\.h$" "${OUTPUT}/html/\\1_8h.html" page ${page})
  if(NOT EXISTS ${page})
    message(FATAL_ERROR "${header}: expected a page ${page}, found none")
  endif()
  file(STRINGS ${page} text REGEX "name=\"details\"")
  if(NOT text)
    message(FATAL_ERROR "${header}: expected its first comment on ${page}, found none")
  endif()
endforeach()
