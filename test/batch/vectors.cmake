# SPDX-License-Identifier: MIT
# COMPILER, which is GCC, says that it has made vectors of the loop over the lanes of each NAME_batch.h in
# FOLDER/<batch>, of BATCHES: "<name>_<style>_<real>".
file(MAKE_DIRECTORY ${WORK})
set(failed)
foreach(batch IN LISTS BATCHES)
  string(REGEX REPLACE "_[a-z]*_[a-z]*$" "" name ${batch})
  set(header ${FOLDER}/${batch}/${name}_batch.h)
  file(READ ${header} text)
  string(REPLACE ";" "," text "${text}")
  string(FIND "${text}" "\n    LQG_LANES\n" before)
  string(SUBSTRING "${text}" 0 ${before} text)
  string(REGEX MATCHALL "\n" ends "${text}")
  list(LENGTH ends line)
  math(EXPR line "${line} + 3")  # of the loop, which is two lines below the one where the text ends

  file(WRITE ${WORK}/${batch}.c "#include \"${header}\"\nstatic ${name}_batch_t batch;\n"
       "void *keep(void);\nvoid *keep(void) { ${name}_batch_init(&batch); return (void *)${name}_batch_step; }\n")
  execute_process(COMMAND ${COMPILER} -std=c99 -O2 -mavx2 -mfma -fopt-info-vec -I${ROOT}/include
                          -S -o ${WORK}/${batch}.s ${WORK}/${batch}.c
                  RESULT_VARIABLE result ERROR_VARIABLE said)
  if(NOT result EQUAL 0 OR NOT said MATCHES "${name}_batch.h:${line}:[0-9]*: optimized: loop vectorized")
    list(APPEND failed "${batch}: expected a loop with vectors in line ${line}, found\n${said}\n")
  endif()
endforeach()
if(failed OR NOT BATCHES)
  message(FATAL_ERROR ${failed})
endif()
