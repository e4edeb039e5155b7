# What `cmake --install` brings: the headers, the library's variants, lqgen with its manual and the design engine where
# they were built, and the package that find_package(tinylqg) finds.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

# Headers alone: all that unrolled controllers need.
add_library(tinylqg_headers INTERFACE)
add_library(tinylqg::headers ALIAS tinylqg_headers)
set_target_properties(tinylqg_headers PROPERTIES EXPORT_NAME headers)
target_include_directories(tinylqg_headers INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
                                                     $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)

set(targets tinylqg_headers tinylqg tinylqg_fused)
if(TARGET tinylqg_double)
  list(APPEND targets tinylqg_double tinylqg_double_fused)
endif()
if(LQG_BUILD_CODEGEN)
  list(APPEND targets lqgen)
endif()
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/tinylqg)

install(DIRECTORY include/lqg DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
install(TARGETS ${targets} EXPORT tinylqg)
install(EXPORT tinylqg NAMESPACE tinylqg:: FILE tinylqgTargets.cmake DESTINATION ${package_dir})

# The design engine, what is emitted as data, and the simulation, in a set of their own: they need packages that firmware does
# not. Of the engine the headers of the door only, as <design/….hpp>, and with it <controller/….hpp> and <simulate/….hpp>.
if(LQG_BUILD_CODEGEN)
  set(include_dir ${CMAKE_INSTALL_INCLUDEDIR}/tinylqg)
  file(GLOB door codegen/design/*.hpp)
  list(FILTER door EXCLUDE REGEX "solution_matrices")
  install(FILES ${door} DESTINATION ${include_dir}/design)
  install(FILES codegen/controller/bounds.hpp codegen/controller/controller.hpp codegen/controller/gate.hpp codegen/controller/recovery.hpp
          DESTINATION ${include_dir}/controller)
  install(FILES codegen/simulate/simulation.hpp DESTINATION ${include_dir}/simulate)
  install(FILES codegen/step/model.hpp codegen/step/scalar.hpp DESTINATION ${include_dir}/step)
  target_include_directories(tinylqg_design INTERFACE $<INSTALL_INTERFACE:${include_dir}>)
  install(TARGETS tinylqg_design lqg_design lqg_step lqg_controller lqg_simulate EXPORT tinylqg_design)
  install(EXPORT tinylqg_design NAMESPACE tinylqg:: FILE tinylqgDesignTargets.cmake DESTINATION ${package_dir})
  install(FILES codegen/cmake/LqgDesignDependencies.cmake DESTINATION ${package_dir})
  install(FILES codegen/lqgen.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
endif()

configure_package_config_file(codegen/cmake/tinylqgConfig.cmake.in tinylqgConfig.cmake
                              INSTALL_DESTINATION ${package_dir} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(tinylqgConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/tinylqgConfig.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/tinylqgConfigVersion.cmake
              codegen/cmake/LqgAddController.cmake
        codegen/cmake/LqgCheckArithmetic.cmake
        codegen/cmake/LqgCompareCode.cmake
        DESTINATION ${package_dir})
