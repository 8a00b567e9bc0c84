// The caller's allocator, or the C library's where both functions are null.
#pragma once

#include <lockstitch/base.h>

#include <cstddef>
#include <new>
#include <utility>

namespace lks {

void* allocate_memory(const lks_allocator& allocator, std::size_t size, std::size_t alignment);
void release_memory(const lks_allocator& allocator, void* memory, std::size_t size);

// Both functions or none.
bool allocator_is_valid(const lks_allocator& allocator);

template <typename T, typename... Arguments>
T* create(const lks_allocator& allocator, Arguments&&... arguments) {
    void* memory = allocate_memory(allocator, sizeof(T), alignof(T) < 8 ? 8 : alignof(T));
    return memory == nullptr ? nullptr : ::new (memory) T(std::forward<Arguments>(arguments)...);
}

template <typename T>
void destroy(const lks_allocator& allocator, T* object) {
    if (object != nullptr) {
        object->~T();
        release_memory(allocator, object, sizeof(T));
    }
}

} // namespace lks
