# cmake --install: headers, static and shared library, a CMake package and a pkg-config file. The installed
# tree can be moved: nothing in it names the place it was installed to.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(installed lockstitch)
if(TARGET lockstitch_shared)
    list(APPEND installed lockstitch_shared)
endif()
install(TARGETS ${installed} EXPORT lockstitch-targets
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
    RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/sdk/include/lockstitch DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/lockstitch)
install(EXPORT lockstitch-targets NAMESPACE lockstitch:: DESTINATION ${package_folder})
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/lockstitch-config.cmake.in
    ${PROJECT_BINARY_DIR}/lockstitch-config.cmake INSTALL_DESTINATION ${package_folder})
# Below 1.0 a new minor version may change the ABI.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/lockstitch-config-version.cmake
    VERSION ${PROJECT_VERSION} COMPATIBILITY SameMinorVersion)
install(FILES
    ${PROJECT_BINARY_DIR}/lockstitch-config.cmake ${PROJECT_BINARY_DIR}/lockstitch-config-version.cmake
    DESTINATION ${package_folder})

if(IS_ABSOLUTE ${CMAKE_INSTALL_LIBDIR} OR IS_ABSOLUTE ${CMAKE_INSTALL_INCLUDEDIR})
    set(pc_prefix ${CMAKE_INSTALL_PREFIX})
else()
    file(RELATIVE_PATH upwards /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
    string(REGEX REPLACE "/$" "" upwards ${upwards})
    set(pc_prefix "\${pcfiledir}/${upwards}")
endif()
foreach(folder IN ITEMS LIBDIR INCLUDEDIR)
    if(IS_ABSOLUTE ${CMAKE_INSTALL_${folder}})
        set(pc_${folder} ${CMAKE_INSTALL_${folder}})
    else()
        set(pc_${folder} "\${prefix}/${CMAKE_INSTALL_${folder}}")
    endif()
endforeach()
configure_file(${PROJECT_SOURCE_DIR}/cmake/lockstitch.pc.in ${PROJECT_BINARY_DIR}/lockstitch.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/lockstitch.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
