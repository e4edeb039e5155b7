# SPDX-License-Identifier: MIT
# cmake -DFORM=<first line of the CMake project> -DFOLDER=… -DTINYLQG=<source tree> -P printed.cmake -- <option>…: the
# project of the README with its design, its program and what stands for the hardware, configured with the options and
# built. Nothing of the library is compiled: the controller needs none. FORM is find_package, add_subdirectory or
# FetchContent.
include(${CMAKE_CURRENT_LIST_DIR}/arguments_after_dashes.cmake)
file(READ ${TINYLQG}/README.md readme)

# Sets `variable` to the README's block that begins with the text.
function(cut_block variable begin)
  string(FIND "${readme}" "${begin}" position)
  if(position EQUAL -1)
    message(FATAL_ERROR "README.md: expected a block that begins with ${begin}")
  endif()
  string(SUBSTRING "${readme}" ${position} -1 block)
  string(REGEX REPLACE "^```[a-z]+\n" "" block "${block}")
  string(FIND "${block}" "```" end)
  string(SUBSTRING "${block}" 0 ${end} block)
  set(${variable} "${block}" PARENT_SCOPE)
endfunction()

cut_block(project "```cmake\nfind_package(tinylqg REQUIRED)\n")
if(FORM STREQUAL "add_subdirectory")
  string(FIND "${readme}" "`add_subdirectory(tinylqg)`" position)
  if(position EQUAL -1)
    message(FATAL_ERROR "README.md: expected `add_subdirectory(tinylqg)`")
  endif()
  string(REPLACE "find_package(tinylqg REQUIRED)" "add_subdirectory(tinylqg)" project "${project}")
elseif(FORM STREQUAL "FetchContent")
  cut_block(fetch "```cmake\ninclude(FetchContent)\n")
  string(REPLACE "find_package(tinylqg REQUIRED)\n" "${fetch}" project "${project}")
endif()
cut_block(design "```toml\n")
cut_block(program "```c\n")

file(REMOVE_RECURSE ${FOLDER})
file(MAKE_DIRECTORY ${FOLDER})
file(CREATE_LINK ${TINYLQG} ${FOLDER}/tinylqg SYMBOLIC)
file(WRITE ${FOLDER}/CMakeLists.txt "cmake_minimum_required(VERSION 3.22)\nproject(firmware LANGUAGES C)\n${project}")
file(WRITE ${FOLDER}/two_mass.toml "${design}")
file(WRITE ${FOLDER}/main.c "${program}
void read_sensors(float y[TWO_MASS_NY])
{
    y[0] = 1;
    y[1] = 1;
}

static float applied;

void write_actuators(const float u[TWO_MASS_NU])
{
    applied = u[0];
}

int main(void)
{
    start();
    every_sample();
    return applied < 0 ? 0 : 1;  /* both masses are on the right: the force is to the left */
}
")
execute_process(COMMAND ${CMAKE_COMMAND} -S ${FOLDER} -B ${FOLDER}/build ${options} COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build ${FOLDER}/build COMMAND_ERROR_IS_FATAL ANY)

file(GLOB_RECURSE compiled RELATIVE ${FOLDER}/build ${FOLDER}/build/*.o ${FOLDER}/build/*.obj ${FOLDER}/build/*.a)
list(FILTER compiled EXCLUDE REGEX "^CMakeFiles/(firmware|[0-9.]+/CompilerId)|^lqgen_for_this_machine/")
if(compiled)
  message(FATAL_ERROR "expected nothing but the firmware, found ${compiled}")
endif()
file(STRINGS ${FOLDER}/build/CMakeCache.txt toolchain REGEX "^CMAKE_TOOLCHAIN_FILE")
if(NOT toolchain)
  execute_process(COMMAND ${FOLDER}/build/firmware COMMAND_ERROR_IS_FATAL ANY)
endif()
