#include "support/allocator.h"

#include <cstdlib>

namespace support {

Allocator::~Allocator() {
    for (const auto& [address, block] : blocks_) {
        std::free(block.start);
    }
}

lks_allocator Allocator::interface() {
    lks_allocator result{};
    result.allocate = &Allocator::allocate;
    result.release = &Allocator::release;
    result.user = this;
    return result;
}

void Allocator::fail_after(std::uint64_t countdown) {
    const std::lock_guard<std::mutex> lock(mutex_);
    countdown_ = countdown;
    failing_ = true;
    refused_ = false;
}

void Allocator::never_fail() {
    const std::lock_guard<std::mutex> lock(mutex_);
    failing_ = false;
    refused_ = false;
}

std::size_t Allocator::live_blocks() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return blocks_.size();
}

void* Allocator::allocate(void* user, std::size_t size, std::size_t alignment) {
    auto& self = *static_cast<Allocator*>(user);
    const std::lock_guard<std::mutex> lock(self.mutex_);
    ++self.allocations_;
    if (size == 0 || alignment < 8 || (alignment & (alignment - 1)) != 0) {
        ++self.misuses_;
        return nullptr;
    }
    if (self.failing_) {
        if (self.countdown_ == 0) {
            self.refused_ = true;
            return nullptr;
        }
        --self.countdown_;
    }

    // Not more than the alignment asked for: a block that happens to be better aligned would hide a wrong
    // request.
    auto* start = static_cast<unsigned char*>(std::malloc(size + 2 * alignment));
    if (start == nullptr) {
        return nullptr;
    }
    const auto address = reinterpret_cast<std::uintptr_t>(start);
    std::uintptr_t aligned = (address + alignment - 1) / alignment * alignment;
    if (aligned % (2 * alignment) == 0) {
        aligned += alignment;
    }
    unsigned char* memory = start + (aligned - address);
    if (self.fill_ != Fill::none) {
        for (std::size_t i = 0; i < size; ++i) {
            self.random_ = self.random_ * 6364136223846793005u + 1442695040888963407u;
            memory[i] = self.fill_ == Fill::byte_cd ? 0xcd : static_cast<unsigned char>(self.random_ >> 56);
        }
    }
    self.blocks_[memory] = Block{size, start};
    return memory;
}

void Allocator::release(void* user, void* memory, std::size_t size) {
    auto& self = *static_cast<Allocator*>(user);
    const std::lock_guard<std::mutex> lock(self.mutex_);
    ++self.releases_;
    const auto found = self.blocks_.find(memory);
    if (found == self.blocks_.end()) {
        ++self.misuses_;
        return;
    }
    if (found->second.size != size) {
        ++self.misuses_;
    }
    std::free(found->second.start);
    self.blocks_.erase(found);
}

} // namespace support
