# SPDX-License-Identifier: MIT
# The target `unity`: Unity >= 2.6 that can compare doubles. An installed one if it can, else upstream's
# release, built here. Without a network: -DFETCHCONTENT_SOURCE_DIR_UNITY=<folder with Unity's sources>.
include(CheckCSourceCompiles)
include(FetchContent)

find_package(unity 2.6 QUIET CONFIG)
if(unity_FOUND)
  # Unity leaves doubles out unless it is told otherwise; then the function below is missing at link time.
  set(CMAKE_REQUIRED_LIBRARIES unity::framework)
  set(CMAKE_REQUIRED_DEFINITIONS -DUNITY_INCLUDE_DOUBLE)
  check_c_source_compiles("#include <unity.h>
    void setUp(void) {}
    void tearDown(void) {}
    int main(void) { TEST_ASSERT_DOUBLE_WITHIN(1.0, 0.0, 0.0); return 0; }" UNITY_HAS_DOUBLES)
  unset(CMAKE_REQUIRED_LIBRARIES)
  unset(CMAKE_REQUIRED_DEFINITIONS)
endif()

if(unity_FOUND AND UNITY_HAS_DOUBLES)
  add_library(unity INTERFACE)
  target_link_libraries(unity INTERFACE unity::framework)
  target_compile_definitions(unity INTERFACE UNITY_INCLUDE_DOUBLE)
else()
  if(POLICY CMP0135)
    cmake_policy(SET CMP0135 NEW)  # what is unpacked is as new as the unpacking
  endif()
  # SOURCE_SUBDIR names a folder without a CMakeLists.txt: the sources are fetched, Unity's own project is
  # left alone.
  FetchContent_Declare(unity
    URL      https://github.com/ThrowTheSwitch/Unity/archive/refs/tags/v2.6.1.tar.gz
    URL_HASH SHA256=b41a66d45a6b99758fb3202ace6178177014d52fc524bf1f72687d93e9867292
    SOURCE_SUBDIR src)
  FetchContent_MakeAvailable(unity)
  add_library(unity STATIC ${unity_SOURCE_DIR}/src/unity.c)
  target_include_directories(unity SYSTEM PUBLIC ${unity_SOURCE_DIR}/src)
  target_compile_definitions(unity PUBLIC UNITY_INCLUDE_DOUBLE)
endif()
