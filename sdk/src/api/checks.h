// What every API call checks in the same way.
#pragma once

#include "fixed/formats.h"
#include "fixed/rotation.h"
#include "solver/world.h"

namespace lks {

inline bool within(std::int64_t value, std::int64_t limit) {
    return value >= -limit && value <= limit;
}

inline bool within(const lks_vec3& value, std::int64_t limit) {
    return within(value.x, limit) && within(value.y, limit) && within(value.z, limit);
}

inline bool within(const fixed::Vec3& value, std::int64_t limit) {
    return within(value.x, limit) && within(value.y, limit) && within(value.z, limit);
}

inline fixed::Vec3 to_vec3(const lks_vec3& value) {
    return {value.x, value.y, value.z};
}

inline lks_vec3 from_vec3(const fixed::Vec3& value) {
    return {value.x, value.y, value.z};
}

inline fixed::Rotation to_rotation(const lks_rotation& value) {
    return {value.x, value.y, value.z, value.w};
}

// LKS_OK, or reported: the quaternion's length is not one.
lks_result check_rotation(const lks_world& world, const lks_rotation& rotation);

// A number with its range, and what to call it; the unit begins with a space.
struct Number {
    const char* name;
    const char* unit;
    std::int64_t value; // World
    std::int64_t least;
    std::int64_t greatest;
};

// LKS_OK, or reported: the first one that is out of its range.
lks_result check_numbers(const lks_world& world, const Number* numbers, std::size_t count);

template <std::size_t count>
lks_result check_numbers(const lks_world& world, const Number (&numbers)[count]) {
    return check_numbers(world, numbers, count);
}

// "The velocity (0, 100000, 0) m/s lies outside its range of plus or minus 1000 on each axis."
Sentence out_of_range(const char* name, const lks_vec3& value, const char* unit, std::int64_t limit);
Sentence out_of_range(const char* name, std::int64_t value, const char* unit, std::int64_t low,
                      std::int64_t high);
Sentence null_argument(const char* function, const char* name);
Sentence wrong_struct_size(const char* type, std::uint32_t given, std::size_t expected);

// Whether a call named lks_world_add_ and this has a world, a definition and a place for the new id: LKS_OK,
// or reported where there is a world to report to.
lks_result check_addition_arguments(const lks_world* world, const char* what, bool has_def, bool has_id);

// The same, and whether the definition was made by this library.
template <typename Def, typename Id>
lks_result check_addition(const lks_world* world, const char* what, const Def* def, const Id* id) {
    const lks_result result = check_addition_arguments(world, what, def != nullptr, id != nullptr);
    if (result != LKS_OK || def->struct_size == sizeof(Def)) {
        return result;
    }
    const Sentence type = Sentence() << what << "_def";
    return world->fail(LKS_ERROR_STRUCT_SIZE, wrong_struct_size(type.text(), def->struct_size, sizeof(Def)));
}

// The object; null, with the result, where there is no world, or reported where the id is stale.
Object* require_object(const lks_world* world, lks_object_id id, lks_result& result);

// LKS_OK, or reported: `index` is no vertex of the object.
lks_result check_vertex(const lks_world& world, const Object& object, std::uint32_t vertex);

// The object; null, with the result, where that is stale, or the buffer null, or where it has not these
// vertices.
Object* require_vertices(const lks_world* world, lks_object_id id, std::uint32_t first, std::uint32_t count,
                         const void* buffer, const char* function, lks_result& result);

} // namespace lks
