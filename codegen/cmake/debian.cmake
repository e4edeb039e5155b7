# SPDX-License-Identifier: MIT
# What a Debian package has beyond an installation; cpack runs it on the files, staged in
# CPACK_TEMPORARY_INSTALL_DIRECTORY, before it packs them.
set(share ${CPACK_TEMPORARY_INSTALL_DIRECTORY}${CPACK_PACKAGING_INSTALL_PREFIX}/share)
set(documents ${share}/doc/${CPACK_PACKAGE_NAME})

# The licence in Debian's form: its words, each line one blank in, an empty line as a dot.
file(READ ${CPACK_RESOURCE_FILE_LICENSE} license)
string(REGEX MATCH "Copyright \\(c\\) ([^\n]*)" ignored "${license}")
set(holder "${CMAKE_MATCH_1}")
string(REGEX REPLACE "^.*Copyright \\(c\\) [^\n]*\n+" "" license "${license}")
string(STRIP "${license}" license)
string(REPLACE "\n\n" "\n.\n" license "${license}")
string(REPLACE "\n" "\n " license "${license}")
file(WRITE ${documents}/copyright "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: TinyLQG
Upstream-Contact: ${CPACK_PACKAGE_CONTACT}

Files: *
Copyright: ${holder}
License: Expat

Files: usr/bin/lqgen
Copyright: ${holder}
 and those whom libraries/NAME.copyright beside this file names
License: Expat and Apache-2.0 and MPL-2.0 and BSL-1.0 and BSD-3-clause
Comment: lqgen has parts of these libraries inside: Mbed TLS (Apache-2.0),
 Eigen (MPL-2.0), Boost (BSL-1.0), CLI11 and Fast C++ CSV
 Parser (BSD-3-clause), toml++, JSON for Modern C++ and Chart.js (Expat).
 It uses the shared libraries of MPFR and GMP (LGPL-3+), which are in
 packages of their own. What Debian says of each of them stands in
 libraries/NAME.copyright beside this file.

License: Expat
 ${license}

License: Apache-2.0
 The full text is in /usr/share/common-licenses/Apache-2.0.

License: MPL-2.0
 The full text is in /usr/share/common-licenses/MPL-2.0. The source of Eigen
 is in Debian's package libeigen3-dev.

License: BSL-1.0
 The full text is in libraries/boost.copyright beside this file.

License: BSD-3-clause
 The full texts are in libraries/cli11.copyright and
 libraries/fast-cpp-csv-parser.copyright beside this file.
")
include(${CMAKE_CURRENT_LIST_DIR}/licenses.cmake)
lqg_copy_copyrights(${documents}/libraries)

# A changelog in Debian's form, which has to have a date (SOURCE_DATE_EPOCH can set it); what has changed is TinyLQG's
# own text.
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(WRITE ${documents}/changelog "${CPACK_PACKAGE_NAME} (${CPACK_PACKAGE_VERSION}) unstable; urgency=medium

  * What has changed stands in NEWS.gz.

 -- ${CPACK_PACKAGE_CONTACT}  ${date}
")
file(COPY_FILE ${CPACK_TINYLQG_CHANGELOG} ${documents}/NEWS)

# Policy: texts and the manual are compressed, without a time stamp.
foreach(file IN ITEMS ${documents}/changelog ${documents}/NEWS ${share}/man/man1/lqgen.1)
  if(EXISTS ${file})
    execute_process(COMMAND gzip -9 --no-name --force ${file} COMMAND_ERROR_IS_FATAL ANY)
  endif()
endforeach()
