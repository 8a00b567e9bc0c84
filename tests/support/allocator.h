// An allocator that counts, remembers, fails on demand and fills what it hands out with rubbish.
#pragma once

#include <lockstitch/lockstitch.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>

namespace support {

class Allocator {
public:
    enum class Fill { none, byte_cd, random };

    explicit Allocator(Fill fill = Fill::none) : fill_(fill) {}
    Allocator(const Allocator&) = delete;
    Allocator& operator=(const Allocator&) = delete;
    ~Allocator();

    // For the `allocator` member of a definition; valid while this object lives.
    lks_allocator interface();

    // The `countdown`-th allocation from now on (0: the next) and all later ones return null.
    void fail_after(std::uint64_t countdown);
    void never_fail();

    std::uint64_t allocations() const { return allocations_; }
    std::uint64_t releases() const { return releases_; }
    // Blocks that were handed out and not yet given back.
    std::size_t live_blocks() const;
    bool refused_any() const { return refused_; }
    // Unknown addresses, wrong sizes, sizes of 0 and alignments that the header rules out.
    std::uint64_t misuses() const { return misuses_; }

private:
    struct Block {
        std::size_t size;
        void* start;
    };

    static void* allocate(void* user, std::size_t size, std::size_t alignment);
    static void release(void* user, void* memory, std::size_t size);

    Fill fill_;
    mutable std::mutex mutex_;
    std::map<void*, Block> blocks_;
    std::uint64_t allocations_ = 0;
    std::uint64_t releases_ = 0;
    std::uint64_t misuses_ = 0;
    std::uint64_t countdown_ = 0;
    std::uint64_t random_ = 0x243f6a8885a308d3u;
    bool failing_ = false;
    bool refused_ = false;
};

} // namespace support
