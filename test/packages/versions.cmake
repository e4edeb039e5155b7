# SPDX-License-Identifier: MIT
# cmake -DPACKAGES=… -DVERSION=… -P versions.cmake: every manifest names the version of include/lqg/version.h, and no
# template was left unfilled.
function(expect_version file pattern)
  file(READ ${PACKAGES}/${file} text)
  if(NOT text MATCHES "${pattern}")
    message(SEND_ERROR "${file}: found no version")
  elseif(NOT CMAKE_MATCH_1 STREQUAL VERSION)
    message(SEND_ERROR "${file}: expected version ${VERSION}, found ${CMAKE_MATCH_1}")
  endif()
endfunction()
expect_version(arduino/TinyLQG/library.properties "\nversion=([^\n]*)\n")
expect_version(esp-idf/tinylqg/idf_component.yml "version: \"([^\"]*)\"")
expect_version(platformio/library.json "\"version\": \"([^\"]*)\"")
expect_version(single-header/tinylqg.h "TinyLQG ([0-9.]+) in one file")

file(GLOB_RECURSE files ${PACKAGES}/*.h ${PACKAGES}/*.json ${PACKAGES}/*.yml ${PACKAGES}/*.md ${PACKAGES}/*.properties)
foreach(file IN LISTS files)
  file(STRINGS ${file} unfilled REGEX "@[A-Z]+@")
  if(unfilled)
    message(SEND_ERROR "${file}: ${unfilled}")
  endif()
endforeach()
