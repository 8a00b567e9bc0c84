# WebAssembly by emscripten, run by node: 32-bit pointers, no threads, and every program is one file of
# JavaScript that carries its WebAssembly with it.
find_program(LOCKSTITCH_EM_CONFIG em-config REQUIRED)
find_program(LOCKSTITCH_NODE NAMES node nodejs REQUIRED)
execute_process(COMMAND ${LOCKSTITCH_EM_CONFIG} EMSCRIPTEN_ROOT OUTPUT_VARIABLE emscripten_root
    OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)

# Tests and demos throw; the SDK itself is compiled without exceptions everywhere.
set(CMAKE_C_FLAGS_INIT "${LOCKSTITCH_WASM_FLAGS}")
set(CMAKE_CXX_FLAGS_INIT "${LOCKSTITCH_WASM_FLAGS} -fexceptions")
# Golden files are read from the machine's own disk. EXIT_RUNTIME flushes what was printed.
set(CMAKE_EXE_LINKER_FLAGS_INIT
    "-sSINGLE_FILE=1 -sNODERAWFS=1 -sALLOW_MEMORY_GROWTH=1 -sEXIT_RUNTIME=1")
set(EMSCRIPTEN_SYSTEM_PROCESSOR wasm32)
set(CMAKE_CROSSCOMPILING_EMULATOR ${LOCKSTITCH_NODE})
# Debian keeps the packages that emcc's JavaScript passes need where only its own node looks for them.
set_property(GLOBAL PROPERTY RULE_LAUNCH_LINK "${CMAKE_COMMAND} -E env NODE_PATH=/usr/share/nodejs")

include(${emscripten_root}/cmake/Modules/Platform/Emscripten.cmake)
