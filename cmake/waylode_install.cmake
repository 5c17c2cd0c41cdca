# SPDX-FileCopyrightText: The Waylode authors
# SPDX-License-Identifier: Apache-2.0
# The package that find_package(waylode) finds; the modules install themselves, see waylode_module.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)
get_property(modules GLOBAL PROPERTY WAYLODE_MODULES)
list(TRANSFORM modules PREPEND waylode_)
add_library(waylode_all INTERFACE)
target_link_libraries(waylode_all INTERFACE ${modules})
add_library(waylode::waylode ALIAS waylode_all)
set_target_properties(waylode_all PROPERTIES EXPORT_NAME waylode)
install(TARGETS waylode_all EXPORT waylode_targets)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/waylode)
install(EXPORT waylode_targets NAMESPACE waylode:: FILE waylode_targets.cmake
  DESTINATION ${package_folder})
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/waylodeConfig.cmake.in
  ${PROJECT_BINARY_DIR}/waylodeConfig.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/waylodeConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/waylodeConfig.cmake
  ${PROJECT_BINARY_DIR}/waylodeConfigVersion.cmake DESTINATION ${package_folder})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/NOTICE
  DESTINATION ${CMAKE_INSTALL_DOCDIR})
