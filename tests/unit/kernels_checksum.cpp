// The checksum of images: the same from every instruction set, however the bytes are handed over, and another
// one where bytes are others.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "fixed_samples.h"
#include "kernels/compiled_kernels.h"
#include "reference_checksum.h"
#include "state/checksum.h"
#include "wide_kernels.h"

using namespace lks;

namespace {

// Aligned as images are.
struct Bytes {
    std::vector<std::uint64_t> words;

    explicit Bytes(std::size_t count) : words(count) {}
    unsigned char* data() { return reinterpret_cast<unsigned char*>(words.data()); }
    std::size_t size() const { return words.size() * 8; }
    void flip(std::size_t bit) { data()[bit / 8] ^= static_cast<unsigned char>(1u << bit % 8); }
    std::uint64_t checksum(const Kernels& kernels) { return Checksum(kernels).finish(data(), size()); }
};

// Coordinates and velocities: small numbers of either sign, and zeros.
Bytes of_a_state(test::Random& random, std::size_t count) {
    Bytes bytes(count);
    for (std::uint64_t& word : bytes.words) {
        const auto value = static_cast<std::int64_t>(random.bits()) >> (8 + random.below(56));
        word = random.below(8) == 0 ? 0 : static_cast<std::uint64_t>(value);
    }
    return bytes;
}

} // namespace

TEST_CASE("kernels: every instruction set sums an image as the definition does") {
    test::Random random(31);
    Bytes bytes = of_a_state(random, 12'500);
    for (const Kernels* kernels : test::all_kernels()) {
        INFO(std::string(simd_name(kernels->level)));
        std::uint64_t different = 0;
        for (int i = 0; i < 2000; ++i) {
            const auto first = static_cast<std::size_t>(8 * random.below(64));
            const auto size = static_cast<std::size_t>(
                std::min<std::uint64_t>(random.any_magnitude(15), bytes.size() - first));
            const unsigned char* const at = bytes.data() + first;
            Checksum checksum(*kernels);
            std::size_t added = 0;
            for (std::size_t given = 0; given < size;) {
                given = static_cast<std::size_t>(
                    std::min<std::uint64_t>(size, given + 1 + random.any_magnitude(12)));
                added += checksum.add(at + added, given - added);
            }
            const std::uint64_t sum = checksum.finish(at + added, size - added);
            different += sum != test::reference_checksum(at, size) ? 1 : 0;
        }
        CHECK(different == 0);
    }
}

TEST_CASE("any bit of an image that flips changes the checksum, and so does any other byte") {
    test::Random random(32);
    Bytes bytes = of_a_state(random, 515);
    const std::uint64_t right = bytes.checksum(test::best_kernels());
    std::uint64_t unseen = 0;
    for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
        bytes.flip(bit);
        unseen += bytes.checksum(test::best_kernels()) == right ? 1 : 0;
        bytes.flip(bit);
    }
    for (std::size_t at = 0; at < bytes.size(); ++at) {
        const unsigned char was = bytes.data()[at];
        for (int other = 0; other < 256; ++other) {
            bytes.data()[at] = static_cast<unsigned char>(other);
            unseen += other != was && bytes.checksum(test::best_kernels()) == right ? 1 : 0;
        }
        bytes.data()[at] = was;
    }
    CHECK(unseen == 0);
    CHECK(bytes.checksum(test::best_kernels()) == right);
}

TEST_CASE(
    "two bits that flip change the checksum, most of all two signs, and so do words that change places") {
    test::Random random(33);
    Bytes bytes = of_a_state(random, 515);
    const std::uint64_t right = bytes.checksum(test::best_kernels());
    const auto below = [&random](std::size_t n) { return static_cast<std::size_t>(random.below(n)); };
    std::uint64_t unseen = 0;
    // In one lane, as words in different ones are summed apart.
    for (std::size_t a = 0; a < bytes.words.size(); ++a) {
        for (std::size_t b = a + 8; b < bytes.words.size(); b += 8) {
            for (const std::size_t bit : {std::size_t{63}, 63 - below(8), below(64)}) {
                const std::size_t other = below(4) == 0 ? below(64) : bit;
                bytes.flip(64 * a + bit);
                bytes.flip(64 * b + other);
                unseen += bytes.checksum(test::best_kernels()) == right ? 1 : 0;
                bytes.flip(64 * a + bit);
                bytes.flip(64 * b + other);
            }
        }
    }
    for (int i = 0; i < 20'000; ++i) {
        std::uint64_t& a = bytes.words[below(bytes.words.size())];
        std::uint64_t& b = bytes.words[below(bytes.words.size())];
        if (a != b) {
            std::swap(a, b);
            unseen += bytes.checksum(test::best_kernels()) == right ? 1 : 0;
            std::swap(a, b);
        }
    }
    CHECK(unseen == 0);
    CHECK(bytes.checksum(test::best_kernels()) == right);
}

TEST_CASE("zeros at the end, ends that are cut off and bytes that moved on change the checksum") {
    test::Random random(34);
    Bytes bytes = of_a_state(random, 515);
    std::fill(bytes.words.end() - 40, bytes.words.end(), 0);
    std::vector<std::uint64_t> seen;
    for (std::size_t size = 0; size <= bytes.size(); ++size) {
        seen.push_back(Checksum(test::best_kernels()).finish(bytes.data(), size));
    }
    for (std::size_t first = 8; first < bytes.size() - 320; first += 8) {
        seen.push_back(Checksum(test::best_kernels()).finish(bytes.data() + first, bytes.size() - first));
    }
    std::sort(seen.begin(), seen.end());
    CHECK(std::adjacent_find(seen.begin(), seen.end()) == seen.end());
}
