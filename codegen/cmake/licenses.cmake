# SPDX-License-Identifier: MIT
# The licences of what lqgen has inside, as Debian keeps them. The variable LQG_LICENSES names a folder that has them on
# other systems: NAME.copyright for each library, and LGPL-3, GPL-3, MPL-2.0, Apache-2.0. One that is missing is an
# error: no package leaves without it.
#
#   lqg_copy_copyrights(<folder>)      NAME.copyright of all libraries
#   lqg_copy_license_texts(<folder>)   the texts that those name

function(lqg_copy_copyrights folder)
  # Debian's libboost-dev is empty: it leads to the version that is there.
  file(GLOB versions /usr/share/doc/libboost1.*-dev/copyright)
  list(POP_BACK versions boost)
  lqg_copy_license("${boost}" ${folder}/boost.copyright)
  lqg_shorten_boost(${folder}/boost.copyright)
  set(chart-js libjs-chart.js)
  set(cli11 libcli11-dev)
  set(eigen libeigen3-dev)
  set(fast-cpp-csv-parser libfccp-dev)
  set(gmp libgmp-dev)
  set(mbedtls libmbedtls-dev)
  set(mpfr libmpfr-dev)
  set(nlohmann-json nlohmann-json3-dev)
  set(tomlplusplus libtomlplusplus-dev)
  foreach(name IN ITEMS chart-js cli11 eigen fast-cpp-csv-parser gmp mbedtls mpfr nlohmann-json tomlplusplus)
    lqg_copy_license(/usr/share/doc/${${name}}/copyright ${folder}/${name}.copyright)
  endforeach()
endfunction()

function(lqg_copy_license_texts folder)
  foreach(name IN ITEMS LGPL-3 GPL-3 MPL-2.0 Apache-2.0)
    lqg_copy_license(/usr/share/common-licenses/${name} ${folder}/${name})
  endforeach()
endfunction()

# Debian says of each of Boost's 40,000 files under which licence it is; of those that are in lqgen it is the one of
# Boost.
function(lqg_shorten_boost file)
  file(READ ${file} text)
  string(FIND "${text}" "\nLicense: BSL-1.0\n Boost Software License" begin)
  if(begin EQUAL -1)
    return()
  endif()
  string(SUBSTRING "${text}" ${begin} -1 text)
  string(FIND "${text}" "\n\n" length)
  string(SUBSTRING "${text}" 1 ${length} text)
  file(WRITE ${file} "${text}")
endfunction()

function(lqg_copy_license debian to)
  set(from "${debian}")
  if(LQG_LICENSES)
    get_filename_component(name ${to} NAME)
    set(from ${LQG_LICENSES}/${name})
  endif()
  if(NOT EXISTS "${from}")
    message(FATAL_ERROR "The package needs ${to}, the licence of a library in lqgen: expected the file `${from}`, "
                        "found none. Make the package on Debian or Ubuntu, or name a folder that has the licences with "
                        "-DLQG_LICENSES=…")
  endif()
  configure_file("${from}" ${to} COPYONLY)
endfunction()
