# SPDX-FileCopyrightText: The Waylode authors
# SPDX-License-Identifier: Apache-2.0
# waylode_module(<name> SOURCES <files> HEADERS <files> [TESTS <files>] [SLOW_TESTS <files>]
#                [DEPENDS <modules>] [LIBRARIES <public targets>] [PRIVATE_LIBRARIES <targets>])
# makes waylode_<name>, alias waylode::<name>, and, with tests on, the programs <name>_test and
# <name>_slow_test.
# DEPENDS is the module's row of the allowed-include table in ARCHITECTURE.md.
function(waylode_module name)
  cmake_parse_arguments(arg "" "" "SOURCES;HEADERS;TESTS;SLOW_TESTS;DEPENDS;LIBRARIES;PRIVATE_LIBRARIES" ${ARGN})
  set(target waylode_${name})
  set_property(GLOBAL APPEND PROPERTY WAYLODE_MODULES ${name})
  list(TRANSFORM arg_DEPENDS PREPEND waylode::)
  if(arg_SOURCES)
    add_library(${target} STATIC ${arg_SOURCES})
    set(visibility PUBLIC)
    set_property(GLOBAL APPEND PROPERTY WAYLODE_STATIC_LIBRARIES ${target})
    target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:waylode_warnings> ${arg_PRIVATE_LIBRARIES})
  else()
    add_library(${target} INTERFACE)
    set(visibility INTERFACE)
  endif()
  add_library(waylode::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  target_sources(${target} ${visibility} FILE_SET HEADERS
    BASE_DIRS ${PROJECT_SOURCE_DIR}/engine FILES ${arg_HEADERS})
  target_compile_features(${target} ${visibility} cxx_std_20)
  target_link_libraries(${target} ${visibility} ${arg_DEPENDS} ${arg_LIBRARIES})
  install(TARGETS ${target} EXPORT waylode_targets FILE_SET HEADERS)
  if(WAYLODE_TESTS AND arg_TESTS)
    waylode_module_test(${name}_test fast ${arg_TESTS})
  endif()
  if(WAYLODE_TESTS AND arg_SLOW_TESTS)
    waylode_module_test(${name}_slow_test slow ${arg_SLOW_TESTS})
  endif()
endfunction()

# A test program of the module that is being made, and its tests with a label.
macro(waylode_module_test program label)
  add_executable(${program} ${ARGN})
  target_link_libraries(${program} PRIVATE
    ${target} waylode_test_support waylode_warnings ${arg_PRIVATE_LIBRARIES} GTest::gmock GTest::gtest_main
    rapidcheck_gtest)
  gtest_discover_tests(${program} DISCOVERY_MODE PRE_TEST TEST_PREFIX "${name}."
    PROPERTIES LABELS ${label} ENVIRONMENT "RC_PARAMS=seed=20240501")  # Properties repeat themselves.
endmacro()
