# WebAssembly with its 128-bit vectors.
set(LOCKSTITCH_WASM_FLAGS -msimd128)
include(${CMAKE_CURRENT_LIST_DIR}/wasm32.cmake)
