# Unit tests that foreign targets run, too: those that need no 128-bit integers of the compiler's, and have
# not the longest of sweeps. No header is read ahead for them there, nor here: each names what it uses.
set(target_unit_tests contacts_exact.cpp fixed_authoring.cpp fixed_int128.cpp fixed_reciprocal.cpp
    kernels_chain.cpp kernels_checksum.cpp kernels_contact.cpp kernels_distance.cpp kernels_exact.cpp
    kernels_hash.cpp kernels_prediction.cpp kernels_range.cpp kernels_response.cpp kernels_tether.cpp
    response_exact.cpp state_images.cpp)
list(TRANSFORM target_unit_tests PREPEND ${PROJECT_SOURCE_DIR}/tests/unit/)
