// Every instruction set hashes the same bytes to the same value, however they are handed over.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "fixed_samples.h"
#include "kernels/compiled_kernels.h"
#include "state/hash.h"
#include "wide_kernels.h"

using namespace lks;

TEST_CASE("kernels: every instruction set hashes as XXH3 does") {
    test::Random random(23);
    std::vector<unsigned char> bytes(100'000 + 64);
    for (unsigned char& byte : bytes) {
        byte = static_cast<unsigned char>(random.bits());
    }
    const int texts = test::long_run() ? 30'000 : 3000; // of 600 bytes on the average
    const std::vector<const Kernels*> all = test::all_kernels();
    for (const Kernels* kernels : all) {
        INFO(std::string(simd_name(kernels->level)));
        std::uint64_t different = 0;
        for (int i = 0; i < texts; ++i) {
            const unsigned char* first = bytes.data() + random.below(64);
            const std::size_t size = random.any_magnitude(random.below(8) == 0 ? 16 : 11);
            Hash hash(*kernels);
            for (std::size_t done = 0; done < size;) {
                const std::size_t part = std::min<std::size_t>(size - done, 1 + random.any_magnitude(12));
                hash.add_bytes(first + done, part);
                done += part;
            }
            different += hash.finish() != XXH3_64bits(first, size) ? 1 : 0;
        }
        CHECK(different == 0);
    }
}
