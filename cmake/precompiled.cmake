# lockstitch_precompile(target [headers...]): headers that most sources of the target include, read once.
# Those of the standard library take a third of the SDK's time to compile. Not in a game's build, whose own
# such headers may be others, and not for ccache, which would store nothing.
function(lockstitch_precompile target)
    if(NOT PROJECT_IS_TOP_LEVEL OR LOCKSTITCH_CCACHE OR NOT CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
        return()
    endif()
    set(headers ${ARGN})
    if(NOT headers)
        set(headers <algorithm> <cmath> <cstdint> <cstdio> <functional> <memory> <string> <vector>)
    endif()
    target_precompile_headers(${target} PRIVATE ${headers})
endfunction()
