# What `cmake --install` lays down, and the Debian packages made of it (cpack, in a build of the preset `package`).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# Before 1.0 a minor version may change the binary interface.
set(abi ${PROJECT_VERSION_MAJOR})
if(abi EQUAL 0)
  set(abi ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
endif()
set_target_properties(elastoon PROPERTIES VERSION ${PROJECT_VERSION} SOVERSION ${abi})

set(cmake_folder ${CMAKE_INSTALL_LIBDIR}/cmake/elastoon)
install(TARGETS elastoon EXPORT elastoon
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT runtime NAMELINK_COMPONENT development
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
  INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
set(not_in_it "")
if(NOT ELASTOON_SCENE)
  set(not_in_it PATTERN scene.h EXCLUDE)
endif()
install(DIRECTORY include/elastoon DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development ${not_in_it})
install(EXPORT elastoon NAMESPACE elastoon:: FILE elastoonTargets.cmake DESTINATION ${cmake_folder}
  COMPONENT development)
configure_package_config_file(cmake/elastoonConfig.cmake.in ${PROJECT_BINARY_DIR}/generated/elastoonConfig.cmake
  INSTALL_DESTINATION ${cmake_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/generated/elastoonConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/generated/elastoonConfig.cmake
  ${PROJECT_BINARY_DIR}/generated/elastoonConfigVersion.cmake DESTINATION ${cmake_folder} COMPONENT development)

# From the .pc file to the prefix, so that the tree can be moved.
file(RELATIVE_PATH up /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
configure_file(cmake/elastoon.pc.in ${PROJECT_BINARY_DIR}/generated/elastoon.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/generated/elastoon.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig
  COMPONENT development)

if(ELASTOON_APPS)
  install(TARGETS elastoon_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
  install(DIRECTORY scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/elastoon COMPONENT program PATTERN tests EXCLUDE)
endif()

# Whom a package names is whoever makes it.
set(ELASTOON_PACKAGE_CONTACT "Elastoon packager <packager@example.invalid>" CACHE STRING
  "Maintainer that the Debian packages name, as \"Name <address>\"")
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME elastoon)
set(CPACK_PACKAGE_VENDOR Elastoon)
set(CPACK_PACKAGE_CONTACT "${ELASTOON_PACKAGE_CONTACT}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL runtime development program)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR})
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME libelastoon${abi})
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/cmake/triggers)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libelastoon-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libelastoon${abi} (= ${PROJECT_VERSION}), libglm-dev")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME elastoon)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "libelastoon${abi} (= ${PROJECT_VERSION})")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS ffmpeg)
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION "cartoon squash-and-stretch, live: the shared library")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "cartoon squash-and-stretch, live: headers for C and C++, CMake and pkg-config files")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "cartoon squash-and-stretch, live: the program that simulates and draws scenes")
include(CPack)
