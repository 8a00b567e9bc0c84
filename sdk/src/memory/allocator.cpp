#include "memory/allocator.h"

#include <cstdint>
#include <cstdlib>

namespace lks {
namespace {

// malloc aligns to max_align_t only; a wider block keeps the distance to its start just before itself.
// Neither aligned_alloc nor posix_memalign exists everywhere.
void* allocate_from_c_library(std::size_t size, std::size_t alignment) {
    const std::size_t header = sizeof(void*);
    if (size > static_cast<std::size_t>(-1) - alignment - header) {
        return nullptr;
    }
    auto* start = static_cast<unsigned char*>(std::malloc(size + alignment + header));
    if (start == nullptr) {
        return nullptr;
    }
    const auto address = reinterpret_cast<std::uintptr_t>(start) + header;
    const std::uintptr_t aligned = (address + alignment - 1) & ~static_cast<std::uintptr_t>(alignment - 1);
    unsigned char* block = start + (aligned - reinterpret_cast<std::uintptr_t>(start));
    ::new (block - header) void*(start);
    return block;
}

void release_to_c_library(void* memory) {
    auto* block = static_cast<unsigned char*>(memory);
    std::free(*reinterpret_cast<void**>(block - sizeof(void*)));
}

} // namespace

void* allocate_memory(const lks_allocator& allocator, std::size_t size, std::size_t alignment) {
    if (allocator.allocate != nullptr) {
        return allocator.allocate(allocator.user, size, alignment);
    }
    return allocate_from_c_library(size, alignment);
}

void release_memory(const lks_allocator& allocator, void* memory, std::size_t size) {
    if (memory == nullptr) {
        return;
    }
    if (allocator.release != nullptr) {
        allocator.release(allocator.user, memory, size);
        return;
    }
    release_to_c_library(memory);
}

bool allocator_is_valid(const lks_allocator& allocator) {
    return (allocator.allocate == nullptr) == (allocator.release == nullptr);
}

} // namespace lks
