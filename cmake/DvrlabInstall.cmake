# What an install prefix holds: the program, the libraries, the plugins, and the SDK that builds plugins out of tree
# (find_package(dvrlab), dvrlab_add_plugin). The prefix has the layout of the build tree, and libraries find each other
# relative to themselves. The build tree has the same package file, so that a plugin can be built against it as well.
include(CMakePackageConfigHelpers)
set(package lib/cmake/dvrlab)
set(exported dvrlab_core)
if(TARGET dvrlab_shader)
  list(APPEND exported dvrlab_shader)
endif()
if(TARGET dvrlab)
  install(TARGETS dvrlab RUNTIME DESTINATION bin)
endif()
install(TARGETS ${exported} EXPORT dvrlabTargets LIBRARY DESTINATION lib)
install(DIRECTORY ${CMAKE_BINARY_DIR}/lib/dvrlab DESTINATION lib USE_SOURCE_PERMISSIONS)

# Headers, the sources of kernel modules with the texts that they include, and the support of plugin tests.
install(DIRECTORY framework DESTINATION include/dvrlab FILES_MATCHING PATTERN "*.h" PATTERN "app" EXCLUDE)
install(DIRECTORY framework/kernel DESTINATION include/dvrlab/framework)
install(FILES ${DVRLAB_GENERATED}/framework/interfaces/abi_tag.h DESTINATION include/dvrlab/framework/interfaces)
install(FILES tests/support/render.h tests/support/render.cpp DESTINATION include/dvrlab/tests/support)

set(modules DvrlabKernelModule.cmake DvrlabPlugin.cmake DvrlabWarnings.cmake)
list(TRANSFORM modules PREPEND ${CMAKE_SOURCE_DIR}/cmake/)
install(FILES ${modules} DESTINATION ${package})
install(EXPORT dvrlabTargets NAMESPACE dvrlab:: DESTINATION ${package})
export(EXPORT dvrlabTargets NAMESPACE dvrlab:: FILE ${CMAKE_BINARY_DIR}/${package}/dvrlabTargets.cmake)

string(REGEX MATCH "^[0-9]+" compiler_major ${CMAKE_CXX_COMPILER_VERSION})
set(DVRLAB_COMPILER ${CMAKE_CXX_COMPILER_ID}-${compiler_major})
# The two trees differ in where the headers and the CMake modules lie.
set(DVRLAB_CONFIG_ROOT "\${PACKAGE_PREFIX_DIR}/include/dvrlab")
set(DVRLAB_CONFIG_MODULES "\${CMAKE_CURRENT_LIST_DIR}")
configure_package_config_file(cmake/dvrlabConfig.cmake.in ${CMAKE_BINARY_DIR}/install/dvrlabConfig.cmake
                              INSTALL_DESTINATION ${package} NO_SET_AND_CHECK_MACRO)
set(DVRLAB_CONFIG_ROOT ${CMAKE_SOURCE_DIR})
set(DVRLAB_CONFIG_MODULES ${CMAKE_SOURCE_DIR}/cmake)
configure_package_config_file(cmake/dvrlabConfig.cmake.in ${CMAKE_BINARY_DIR}/${package}/dvrlabConfig.cmake
                              INSTALL_DESTINATION ${package} INSTALL_PREFIX ${CMAKE_BINARY_DIR} NO_SET_AND_CHECK_MACRO)
# Before 1.0 a minor version may change everything.
write_basic_package_version_file(${CMAKE_BINARY_DIR}/${package}/dvrlabConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/install/dvrlabConfig.cmake
              ${CMAKE_BINARY_DIR}/${package}/dvrlabConfigVersion.cmake DESTINATION ${package})
