# SPDX-License-Identifier: MIT
# Makes OUTPUT, what a controller.h (of this test or of another that runs every controller) wants to hear of the
# controller in HEADER, which lqgen has made of the design NAME in REAL.
file(READ ${HEADER} header)
string(TOUPPER ${NAME} upper_name)

# A line "    float x[NX];  /* … */" for each member of the state; brackets and semicolons mean something to CMake.
string(REGEX MATCH "typedef struct {\n([^}]*)} ${NAME}_t;" found "${header}")
string(REGEX REPLACE "/\\*[^\n]*" "" members "${CMAKE_MATCH_1}")
string(REGEX REPLACE "\\[[^\n]*\\]" "" members "${members}")
string(REGEX MATCHALL "[a-z][^;]*" members "${members}")
if(NOT members)
  message(FATAL_ERROR "${HEADER}: expected a struct ${NAME}_t with members, found none")
endif()
set(hashed_members)
set(counters)
foreach(member IN LISTS members)
  string(REGEX REPLACE ".* " "" name "${member}")
  if(member STREQUAL "${REAL} ${name}")
    string(APPEND hashed_members " HASH_MEMBER(${name})")
  elseif(member MATCHES "^unsigned (long )?${name}$")
    string(APPEND counters " COUNTER_MEMBER(${name})")
  else()
    message(FATAL_ERROR "${HEADER}: expected members of type ${REAL} or unsigned in ${NAME}_t, found \"${member}\"")
  endif()
endforeach()

set(does)
foreach(pair IN ITEMS "UPDATES: ${NAME}_update\\(" "CONTROLS: ${NAME}_control\\(" "ADVANCES: ${NAME}_advance\\("
                      "ESTIMATES: ${NAME}_estimate\\("
                      "REFERS:#define ${upper_name}_NR " "HAS_INPUT:#define ${upper_name}_NU "
                      "PREDICTS:, predictor form " "COUNTS_RESETS: resets;")
  string(REGEX MATCH "^([A-Z_]*):(.*)$" found "${pair}")
  set(macro ${CMAKE_MATCH_1})
  if(header MATCHES "${CMAKE_MATCH_2}")
    string(APPEND does "#define ${macro}\n")
  endif()
endforeach()

string(REGEX REPLACE "\\.h$" "_batch.h" batch_header "${HEADER}")
if(EXISTS ${batch_header})
  string(APPEND does "#undef BATCH_HEADER\n#define BATCH_HEADER \"${batch_header}\"\n")
endif()

file(WRITE ${OUTPUT} "#include \"${HEADER}\"
#define NAME ${NAME}
#define UPPER_NAME ${upper_name}
#define MEMBERS${hashed_members}
#define COUNTERS${counters}
${does}#include \"controller.h\"
")
