# cmake --install: headers, static and shared library, a CMake package and a pkg-config file.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS lockstitch lockstitch_shared EXPORT lockstitch-targets
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
    RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/sdk/include/lockstitch DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/lockstitch)
install(EXPORT lockstitch-targets NAMESPACE lockstitch:: DESTINATION ${package_folder})
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/lockstitch-config.cmake.in
    ${PROJECT_BINARY_DIR}/lockstitch-config.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/lockstitch-config-version.cmake
    VERSION ${PROJECT_VERSION} COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/lockstitch-config.cmake ${PROJECT_BINARY_DIR}/lockstitch-config-version.cmake
    DESTINATION ${package_folder})

configure_file(${PROJECT_SOURCE_DIR}/cmake/lockstitch.pc.in ${PROJECT_BINARY_DIR}/lockstitch.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/lockstitch.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
