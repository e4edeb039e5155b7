# What a Debian package has beyond an installation; cpack runs it on the files, staged in CPACK_TEMPORARY_INSTALL_DIRECTORY,
# before it packs them.
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
 The Mbed TLS Contributors
License: Expat and Apache-2.0
Comment: lqgen has SHA-256 of Mbed TLS inside.

License: Expat
 ${license}

License: Apache-2.0
 The full text is in /usr/share/common-licenses/Apache-2.0.
")

# A changelog in Debian's form, which has to have a date (SOURCE_DATE_EPOCH can set it); what has changed is TinyLQG's own text.
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
