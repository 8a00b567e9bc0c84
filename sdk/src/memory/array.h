// A block of plain values in the caller's memory. Grows only when told to, never throws, tells when there is
// no memory.
#pragma once

#include <lockstitch/base.h>

#include <cstddef>
#include <cstring>
#include <type_traits>
#include <utility>

#include "memory/allocator.h"

namespace lks {

template <typename T>
class Array {
    static_assert(std::is_trivially_copyable_v<T>, "arrays are moved and saved as bytes");

public:
    Array() = default;
    explicit Array(const lks_allocator& allocator) : allocator_(allocator) {}
    Array(const Array&) = delete;
    Array& operator=(const Array&) = delete;
    Array(Array&& other) noexcept { swap(other); }
    Array& operator=(Array&& other) noexcept {
        swap(other);
        return *this;
    }
    ~Array() { free(); }

    void set_allocator(const lks_allocator& allocator) { allocator_ = allocator; }

    // Room for `capacity` values, of which the present ones are kept. False: no memory, nothing changed.
    [[nodiscard]] bool reserve(std::size_t capacity) {
        if (capacity <= capacity_) {
            return true;
        }
        if (capacity > static_cast<std::size_t>(-1) / sizeof(T)) {
            return false;
        }
        void* memory = allocate_memory(allocator_, capacity * sizeof(T), block_alignment);
        if (memory == nullptr) {
            return false;
        }
        if (size_ != 0) {
            std::memcpy(memory, data_, size_ * sizeof(T));
        }
        const std::size_t size = size_;
        free();
        data_ = static_cast<T*>(memory);
        size_ = size;
        capacity_ = capacity;
        return true;
    }

    // New values are all zero bytes, so that no state ever holds an uninitialised one.
    [[nodiscard]] bool resize(std::size_t size) {
        if (!reserve(size)) {
            return false;
        }
        if (size > size_) {
            std::memset(static_cast<void*>(data_ + size_), 0, (size - size_) * sizeof(T));
        }
        size_ = size;
        return true;
    }

    // The other's values. False: no memory, nothing changed.
    [[nodiscard]] bool copy(const Array& other) {
        if (!reserve(other.size_)) {
            return false;
        }
        if (other.size_ != 0) {
            std::memcpy(static_cast<void*>(data_), other.data_, other.bytes());
        }
        size_ = other.size_;
        return true;
    }

    // Amortised growth, for building.
    [[nodiscard]] bool push(const T& value) {
        if (size_ == capacity_) {
            const T copy = value;
            if (!reserve(capacity_ < 8 ? 8 : capacity_ * 2)) {
                return false;
            }
            data_[size_++] = copy;
            return true;
        }
        data_[size_++] = value;
        return true;
    }

    // Within the capacity: never allocates.
    void push_reserved(const T& value) { data_[size_++] = value; }
    void insert_reserved(std::size_t index, const T& value) {
        std::memmove(static_cast<void*>(data_ + index + 1), data_ + index, (size_ - index) * sizeof(T));
        data_[index] = value;
        ++size_;
    }
    void erase(std::size_t index) {
        std::memmove(static_cast<void*>(data_ + index), data_ + index + 1, (size_ - index - 1) * sizeof(T));
        --size_;
    }
    // By values that are not set yet, within the capacity.
    void extend_reserved(std::size_t count) { size_ += count; }
    void clear() { size_ = 0; }
    void free() {
        if (data_ != nullptr) {
            release_memory(allocator_, data_, capacity_ * sizeof(T));
        }
        data_ = nullptr;
        size_ = 0;
        capacity_ = 0;
    }

    void swap(Array& other) noexcept {
        std::swap(allocator_, other.allocator_);
        std::swap(data_, other.data_);
        std::swap(size_, other.size_);
        std::swap(capacity_, other.capacity_);
    }

    T* data() { return data_; }
    const T* data() const { return data_; }
    std::size_t size() const { return size_; }
    std::size_t capacity() const { return capacity_; }
    std::size_t bytes() const { return size_ * sizeof(T); }
    bool empty() const { return size_ == 0; }
    T& operator[](std::size_t index) { return data_[index]; }
    const T& operator[](std::size_t index) const { return data_[index]; }
    T* begin() { return data_; }
    T* end() { return data_ + size_; }
    const T* begin() const { return data_; }
    const T* end() const { return data_ + size_; }

private:
    static constexpr std::size_t block_alignment = 64; // a cache line, and the widest vector

    lks_allocator allocator_{};
    T* data_ = nullptr;
    std::size_t size_ = 0;
    std::size_t capacity_ = 0;
};

} // namespace lks
