# SPDX-License-Identifier: MIT
# cmake -DROOT=<source folder> -P check.cmake: fails where a file includes what its room or floor may not know.

cmake_minimum_required(VERSION 3.22)

set(standard_c "^(assert|errno|fenv|float|limits|math|stdarg|stdbool|stddef|stdint|stdio|stdlib|string)\\.h$")
set(standard_cpp "^[a-z_]+$")
set(posix "^(fcntl|unistd|sys/[a-z]+)\\.h$")
set(problems)
set(checked)

# check(<folder> <regex of what is allowed>…): every #include in the folder's own files has to match one of
# them.
function(check folder)
  file(GLOB files "${ROOT}/${folder}/*.[ch]" "${ROOT}/${folder}/*.[ch]pp")
  foreach(file IN LISTS files)
    file(STRINGS "${file}" lines REGEX "^[ \t]*#[ \t]*include")
    foreach(line IN LISTS lines)
      string(REGEX REPLACE ".*#[ \t]*include[ \t]*[<\"]([^>\"]*)[>\"].*" "\\1" included "${line}")
      set(allowed FALSE)
      foreach(pattern IN LISTS ARGN)
        if(included MATCHES "${pattern}")
          set(allowed TRUE)
        endif()
      endforeach()
      if(NOT allowed)
        file(RELATIVE_PATH name "${ROOT}" "${file}")
        list(APPEND problems "${name} may not include ${included}")
      endif()
    endforeach()
  endforeach()
  set(problems "${problems}" PARENT_SCOPE)
  set(checked ${checked} ${folder} PARENT_SCOPE)
endfunction()

# check_floors(<room> <words> <floors> <regex of what all may include>…): of a room's folders each knows itself and
# those before it. <words>: regex of the room's own headers that each floor may know.
function(check_floors room words floors)
  set(below)
  foreach(floor IN LISTS floors)
    list(APPEND below "^${room}/${floor}/")
    check(${room_folder}/${floor} ${ARGN} "${words}" ${below})
  endforeach()
  set(problems "${problems}" PARENT_SCOPE)
  set(checked ${checked} PARENT_SCOPE)
endfunction()

check(include/lqg "${standard_c}" "^lqg/[a-z_]+\\.h$")
file(GLOB private RELATIVE "${ROOT}/src" "${ROOT}/src/*.h")
list(TRANSFORM private REPLACE "(.*)\\.h" "^\\1\\\\.h$")
check(src "${standard_c}" "^lqg/[a-z_]+\\.h$" ${private})

set(any_room "${standard_cpp}" "${posix}" "^Eigen/" "^lqg/(version|functions)\\.h$")
set(digits "^boost/multiprecision/" "^boost/math/" "^mpfr\\.h$")

# The door of design holds what everybody may say (a problem, a solution, a finding …) and, above all floors, who
# solves.
set(room_folder codegen/design)
string(CONCAT design_words "^design/(problem|equations_of_motion|linearise|scenario|exact_matrix|solution|"
                            "solution_matrices|finding|real|rounding|progress)\\.hpp$")
check_floors(design "${design_words}" "numeric;motion;equations;order;limits;sampled;checks;loop;gains;run" ${any_room}
             ${digits} "^expression/")
check(codegen/design "^expression/" ${any_room} ${digits} "^design/")

check(codegen/expression ${any_room} "^expression/" "^boost/spirit/")
check(codegen/step  ${any_room} "^step/" "^expression/")
check(codegen/trace ${any_room} "^trace/")
check(codegen/input ${any_room} "^input/" "^design/" "^expression/" "^toml\\+\\+/" "^csv\\.h$")
check(codegen/controller ${any_room} "^controller/" "^design/" "^step/" "^expression/")
check(codegen/simulate ${any_room} "^boost/math/" "^boost/numeric/odeint" "^expression/" "^simulate/" "^controller/"
      "^design/" "^step/")

set(room_folder codegen/emit)
set(below_emit "^expression/" "^controller/" "^simulate/" "^design/" "^step/" "^trace/")
check_floors(emit "^emit/controller\\.hpp$" "text;page;recorded;vectors;plan;c;proof;unit_test;report"
             ${any_room} ${digits} ${below_emit} "^nlohmann/" "^mbedtls/")
check(codegen/emit ${any_room} "^controller/" "^design/")
check(codegen/reference ${any_room} "^reference/" "^input/" "^design/problem\\.hpp$" "^nlohmann/")
check(codegen/commands ${any_room} "^commands/" "^input/" "^emit/" "^controller/" "^simulate/" "^design/" "^step/"
      "^nlohmann/" "^lqg/status\\.h$")
check(codegen/serve ${any_room} "^serve/" "^boost/(asio|beast)/")
check(codegen/view ${any_room} "^view/" "^serve/" "^emit/" "^simulate/" "^controller/" "^input/" "^design/"
      "^nlohmann/")
check(codegen ${any_room} "^commands/" "^view/(watch|compare)\\.hpp$" "^input/" "^reference/documents\\.hpp$" "^emit/"
      "^design/(solve|orders|number_memory)\\.hpp$"
      "^CLI/" "^watch\\.hpp$")

# A folder that nobody has given a place has to be given one.
file(GLOB_RECURSE all RELATIVE "${ROOT}" "${ROOT}/codegen/*.[ch]pp" "${ROOT}/src/*.[ch]" "${ROOT}/include/*.h")
foreach(file IN LISTS all)
  get_filename_component(folder ${file} DIRECTORY)
  if(NOT folder IN_LIST checked)
    list(APPEND problems "${file} lies on no floor: say in test/layering/check.cmake what ${folder} may include")
  endif()
endforeach()

foreach(problem IN LISTS problems)
  message("${problem}")
endforeach()
if(problems)
  message(FATAL_ERROR "an arrow between rooms or floors is broken")
endif()
