#include "api/checks.h"

namespace lks {

Sentence out_of_range(const char* name, const lks_vec3& value, const char* unit, std::int64_t limit) {
    Sentence sentence;
    (sentence << "The " << name << " (").world_value(value.x) << ", ";
    sentence.world_value(value.y) << ", ";
    sentence.world_value(value.z) << ") " << unit << " lies outside its range of plus or minus ";
    return sentence.world_value(limit) << " on each axis.";
}

Sentence out_of_range(const char* name, std::int64_t value, const char* unit, std::int64_t low,
                      std::int64_t high) {
    Sentence sentence;
    (sentence << "The " << name << " ").world_value(value) << unit << " lies outside its range from ";
    sentence.world_value(low) << " to ";
    return sentence.world_value(high) << ".";
}

Sentence null_argument(const char* function, const char* name) {
    return Sentence() << function << " needs " << name << ", which is null.";
}

Sentence wrong_struct_size(const char* type, std::uint32_t given, std::size_t expected) {
    return Sentence() << "struct_size of " << type << " is " << given << " instead of "
                      << static_cast<std::uint64_t>(expected)
                      << "; start from lks_default_ and the type's name.";
}

lks_result check_addition_arguments(const lks_world* world, const char* what, bool has_def, bool has_id) {
    if (world == nullptr) {
        return LKS_ERROR_NULL_ARGUMENT;
    }
    if (has_def && has_id) {
        return LKS_OK;
    }
    const Sentence function = Sentence() << "lks_world_add_" << what;
    return world->fail(LKS_ERROR_NULL_ARGUMENT, null_argument(function.text(), has_def ? what : "def"));
}

lks_result check_numbers(const lks_world& world, const Number* numbers, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        const Number& n = numbers[i];
        if (n.value < n.least || n.value > n.greatest) {
            return world.fail(LKS_ERROR_INVALID_ARGUMENT,
                              out_of_range(n.name, n.value, n.unit, n.least, n.greatest));
        }
    }
    return LKS_OK;
}

lks_result check_rotation(const lks_world& world, const lks_rotation& rotation) {
    if (fixed::is_nearly_unit(to_rotation(rotation))) {
        return LKS_OK;
    }
    return world.fail(LKS_ERROR_INVALID_ARGUMENT,
                      Sentence() << "The rotation (" << rotation.x << ", " << rotation.y << ", " << rotation.z
                                 << ", " << rotation.w
                                 << ") / 2^30 is not a unit quaternion: its length must be 1 within 1e-4.");
}

lks_result check_vertex(const lks_world& world, const Object& object, std::uint32_t vertex) {
    if (vertex < object.count()) {
        return LKS_OK;
    }
    return world.fail(LKS_ERROR_INVALID_ARGUMENT, Sentence() << "Vertex " << vertex
                                                             << " does not exist: the object has "
                                                             << object.count() << " vertices.");
}

Object* require_object(const lks_world* world, lks_object_id id, lks_result& result) {
    if (world == nullptr) {
        result = LKS_ERROR_NULL_ARGUMENT;
        return nullptr;
    }
    Object* object = world->find_object(id);
    result = LKS_OK;
    if (object == nullptr) {
        result = world->fail(LKS_ERROR_STALE_ID, Sentence() << "There is no object with index " << id.index
                                                            << " and generation " << id.generation
                                                            << " in this world.");
    }
    return object;
}

Object* require_vertices(const lks_world* world, lks_object_id id, std::uint32_t first, std::uint32_t count,
                         const void* buffer, const char* function, lks_result& result) {
    Object* object = require_object(world, id, result);
    if (object == nullptr) {
        return nullptr;
    }
    if (buffer == nullptr) {
        result = world->fail(LKS_ERROR_NULL_ARGUMENT, null_argument(function, "a buffer"));
        return nullptr;
    }
    if (first > object->count() || count > object->count() - first) {
        result = world->fail(LKS_ERROR_INVALID_ARGUMENT, Sentence() << count << " vertices from " << first
                                                                    << " do not exist: the object has "
                                                                    << object->count() << ".");
        return nullptr;
    }
    return object;
}

} // namespace lks
