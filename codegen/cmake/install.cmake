# SPDX-License-Identifier: MIT
# What `cmake --install` brings: the headers, the library's variants, lqgen with its manual and the design engine where
# they were built, and the package that find_package(tinylqg) finds.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

set(targets tinylqg_headers)
if(LQG_BUILD_CODEGEN)
  list(APPEND targets lqgen)
endif()
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/tinylqg)

install(DIRECTORY include/lqg DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
install(TARGETS ${targets} EXPORT tinylqg)
install(EXPORT tinylqg NAMESPACE tinylqg:: FILE tinylqgTargets.cmake DESTINATION ${package_dir})

# The library as it was compiled, and its sources for firmware of another machine.
install(TARGETS ${lqg_libraries} EXPORT tinylqg_library)
install(EXPORT tinylqg_library NAMESPACE tinylqg:: FILE tinylqgLibraryTargets.cmake DESTINATION ${package_dir})
set(sources_dir ${CMAKE_INSTALL_DATADIR}/tinylqg/src)
install(DIRECTORY src/ DESTINATION ${sources_dir} FILES_MATCHING PATTERN "*.[ch]")

# The design engine, what is emitted as data, and the simulation, in a set of their own: they need packages that
# firmware does not. Of the engine the headers of the door only, as <design/….hpp>, and with it <controller/….hpp> and
# <simulate/….hpp>.
if(LQG_BUILD_CODEGEN)
  set(include_dir ${CMAKE_INSTALL_INCLUDEDIR}/tinylqg)
  file(GLOB door codegen/design/*.hpp)
  list(FILTER door EXCLUDE REGEX "solution_matrices")
  install(FILES ${door} DESTINATION ${include_dir}/design)
  install(FILES codegen/controller/bounds.hpp codegen/controller/controller.hpp codegen/controller/gate.hpp
                codegen/controller/recovery.hpp codegen/controller/worth.hpp
          DESTINATION ${include_dir}/controller)
  install(FILES codegen/expression/tree.hpp DESTINATION ${include_dir}/expression)
  install(FILES codegen/simulate/simulation.hpp DESTINATION ${include_dir}/simulate)
  install(FILES codegen/step/equations.hpp codegen/step/model.hpp codegen/step/scalar.hpp
          DESTINATION ${include_dir}/step)
  target_include_directories(tinylqg_design INTERFACE $<INSTALL_INTERFACE:${include_dir}>)
  install(TARGETS tinylqg_design lqg_expression lqg_design lqg_step lqg_controller lqg_simulate EXPORT tinylqg_design)
  install(EXPORT tinylqg_design NAMESPACE tinylqg:: FILE tinylqgDesignTargets.cmake DESTINATION ${package_dir})
  install(FILES codegen/cmake/LqgDesignDependencies.cmake DESTINATION ${package_dir})
  install(FILES codegen/lqgen.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
endif()

configure_package_config_file(codegen/cmake/tinylqgConfig.cmake.in tinylqgConfig.cmake
                              INSTALL_DESTINATION ${package_dir} NO_SET_AND_CHECK_MACRO
                              PATH_VARS sources_dir CMAKE_INSTALL_INCLUDEDIR)
# lqgen and the headers serve every target; what does not, the package looks at itself.
write_basic_package_version_file(tinylqgConfigVersion.cmake COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/tinylqgConfig.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/tinylqgConfigVersion.cmake
              codegen/cmake/LqgAddController.cmake
              codegen/cmake/LqgCheckArithmetic.cmake
              codegen/cmake/LqgCompareCode.cmake
              codegen/cmake/LqgFindLqgen.cmake
              codegen/cmake/LqgLibrary.cmake
        DESTINATION ${package_dir})
