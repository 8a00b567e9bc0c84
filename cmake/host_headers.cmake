# Header-only libraries of the building machine, for a cross compiler. It does not look into /usr/include, and
# must not: the C library's headers lie there too. So the few that are needed are linked into a folder of the
# build, and get the target names that find_package would have given them.

set(LOCKSTITCH_HOST_HEADERS ${CMAKE_BINARY_DIR}/host_headers)

function(lockstitch_host_header target path)
    find_path(LOCKSTITCH_HOST_${target} ${path} PATHS /usr/include /usr/local/include
        NO_DEFAULT_PATH NO_CMAKE_FIND_ROOT_PATH)
    if(NOT LOCKSTITCH_HOST_${target})
        message(STATUS "The header ${path} was not found on this machine; ${target} is left out.")
        return()
    endif()
    get_filename_component(top ${path} DIRECTORY)
    file(MAKE_DIRECTORY ${LOCKSTITCH_HOST_HEADERS}/${target})
    file(CREATE_LINK ${LOCKSTITCH_HOST_${target}}/${top} ${LOCKSTITCH_HOST_HEADERS}/${target}/${top}
        COPY_ON_ERROR SYMBOLIC)
    add_library(${target}::${target} INTERFACE IMPORTED GLOBAL)
    target_include_directories(${target}::${target} SYSTEM INTERFACE ${LOCKSTITCH_HOST_HEADERS}/${target})
endfunction()

lockstitch_host_header(CLI11 CLI/CLI.hpp)
lockstitch_host_header(doctest doctest/doctest.h)
