// lockstitch/state.h.
#include <lockstitch/state.h>

#include "api/checks.h"
#include "state/image.h"
#include "state/state_hash.h"

using namespace lks;

namespace {

constexpr std::size_t image_alignment = 8;

lks_result check_memory(const lks_world& world, const char* function, const void* memory) {
    if (memory == nullptr) {
        return world.fail(LKS_ERROR_NULL_ARGUMENT, null_argument(function, "memory"));
    }
    if (reinterpret_cast<std::uintptr_t>(memory) % image_alignment != 0) {
        return world.fail(LKS_ERROR_MISALIGNED,
                          Sentence() << "The memory given to " << function << " is "
                                     << static_cast<std::uint64_t>(reinterpret_cast<std::uintptr_t>(memory) %
                                                                   image_alignment)
                                     << " bytes off an alignment of 8.");
    }
    return LKS_OK;
}

} // namespace

extern "C" {

uint64_t lks_world_hash(const lks_world* world) {
    return world == nullptr ? 0 : hash_world(*world, false);
}

uint64_t lks_world_local_hash(const lks_world* world) {
    return world == nullptr ? 0 : hash_world(*world, true);
}

uint64_t lks_object_hash(const lks_world* world, lks_object_id object) {
    const Object* found = world == nullptr ? nullptr : world->find_object(object);
    return found == nullptr ? 0 : hash_object(*found, *world->kernels);
}

lks_result lks_world_save_size(const lks_world* world, size_t* size) {
    if (world == nullptr) {
        return LKS_ERROR_NULL_ARGUMENT;
    }
    if (size == nullptr) {
        return world->fail(LKS_ERROR_NULL_ARGUMENT, null_argument("lks_world_save_size", "size"));
    }
    *size = image_size(*world);
    return LKS_OK;
}

lks_result lks_world_save(const lks_world* world, void* memory, size_t capacity, size_t* written) {
    if (world == nullptr) {
        return LKS_ERROR_NULL_ARGUMENT;
    }
    if (const lks_result result = check_memory(*world, "lks_world_save", memory); result != LKS_OK) {
        return result;
    }
    const std::size_t size = image_size(*world);
    if (capacity < size) {
        return world->fail(LKS_ERROR_BUFFER_TOO_SMALL,
                           Sentence() << "The image needs " << static_cast<std::uint64_t>(size)
                                      << " bytes, but the buffer has " << static_cast<std::uint64_t>(capacity)
                                      << ".");
    }
    write_image(*world, static_cast<unsigned char*>(memory));
    if (written != nullptr) {
        *written = size;
    }
    return LKS_OK;
}

lks_result lks_world_load(lks_world* world, const void* memory, size_t size) {
    if (world == nullptr) {
        return LKS_ERROR_NULL_ARGUMENT;
    }
    if (world->running) {
        return world->fail(LKS_ERROR_INVALID_ARGUMENT, Sentence() << "A tick hook can't load its own world.");
    }
    if (const lks_result result = check_memory(*world, "lks_world_load", memory); result != LKS_OK) {
        return result;
    }
    return load_image(*world, static_cast<const unsigned char*>(memory), size);
}

lks_result lks_world_register_asset(lks_world* world, const lks_asset* asset) {
    if (world == nullptr) {
        return LKS_ERROR_NULL_ARGUMENT;
    }
    if (asset == nullptr) {
        return world->fail(LKS_ERROR_NULL_ARGUMENT, null_argument("lks_world_register_asset", "asset"));
    }
    return world->know_asset(*asset) == nullptr ? world->fail_out_of_memory("an asset's coefficients")
                                                : LKS_OK;
}

} // extern "C"
