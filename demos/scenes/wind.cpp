#include "scenes/wind.h"

#include "scenes/time_curves.h"

namespace lks_demo {
namespace {

struct Vector {
    std::int64_t x, y, z;
};

// a - b, with 40 - bits fraction bits.
Vector difference(lks_vec3 a, lks_vec3 b, int bits) {
    return {(a.x - b.x) >> bits, (a.y - b.y) >> bits, (a.z - b.z) >> bits};
}

std::int64_t dot(const Vector& a, const Vector& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

// The square root, rounded down, digit by digit.
std::int64_t square_root(std::int64_t value) {
    std::int64_t root = 0;
    for (std::int64_t bit = std::int64_t{1} << 30; bit != 0; bit >>= 1) {
        if ((root | bit) * (root | bit) <= value) {
            root |= bit;
        }
    }
    return root;
}

} // namespace

Wind::Wind(lks_fixed pressure, const lks_asset* asset) : pressure_(pressure) {
    triangles_.resize(std::size_t{3} * lks_asset_triangle_count(asset));
    lks_asset_triangles(asset, triangles_.data(), triangles_.size());
    positions_.resize(lks_asset_vertex_count(asset));
    velocities_.resize(positions_.size());
    impulses_.resize(positions_.size());
}

lks_result Wind::blow(lks_world* world, lks_object_id object, lks_fixed seconds, lks_vec3 origin) {
    const auto count = static_cast<std::uint32_t>(positions_.size());
    lks_result result = lks_object_positions(world, object, 0, count, positions_.data());
    if (result == LKS_OK) {
        result = lks_object_velocities(world, object, 0, count, velocities_.data());
    }
    impulses_.assign(count, lks_vec3{});
    for (std::size_t i = 0; i < triangles_.size(); i += 3) {
        push_triangle(&triangles_[i], seconds, origin, lks_world_tick_rate(world));
    }
    for (std::uint32_t i = 0; i < count && result == LKS_OK; ++i) {
        result = lks_object_apply_impulse(world, object, i, impulses_[i]);
    }
    return result;
}

lks_vec3 Wind::air_at(lks_vec3 place, lks_fixed seconds) const {
    // Gusts: two slow waves that don't repeat together.
    const lks_fixed gust = sine_of_turns(seconds / 3) + sine_of_turns(seconds * 4 / 7 + place.x / 9);
    // Eddies: as long as half the flag, carried along at 4 m/s, and leaning with the height.
    const lks_fixed eddy = sine_of_turns(seconds * 3 - place.x * 3 / 4 + place.y / 5);
    const lks_fixed roll = sine_of_turns(seconds * 9 / 7 - place.y / 2 - place.x / 3);
    return {LKS_FIXED(9) + gust, roll / 2, coarse_product(eddy, millimetres(2000)) + gust / 2};
}

void Wind::push_triangle(const std::uint32_t* corners, lks_fixed seconds, lks_vec3 origin,
                         std::int64_t tick_rate) {
    const lks_vec3& a = positions_[corners[0]];
    const Vector ab = difference(positions_[corners[1]], a, 20);
    const Vector ac = difference(positions_[corners[2]], a, 20);
    // Twice the area along the normal: 40 fraction bits, and 30 are enough for triangles up to a square
    // metre.
    const Vector area = {(ab.y * ac.z - ab.z * ac.y) >> 10, (ab.z * ac.x - ab.x * ac.z) >> 10,
                         (ab.x * ac.y - ab.y * ac.x) >> 10};
    const std::int64_t length = square_root(dot(area, area));
    if (length == 0) {
        return;
    }
    lks_vec3 velocity{};
    for (int i = 0; i < 3; ++i) {
        velocity.x += velocities_[corners[i]].x / 3;
        velocity.y += velocities_[corners[i]].y / 3;
        velocity.z += velocities_[corners[i]].z / 3;
    }
    const lks_vec3 place = {a.x - origin.x, a.y - origin.y, a.z - origin.z};
    const Vector wind = difference(air_at(place, seconds), velocity, 24); // 16 fraction bits
    const std::int64_t normal_speed = dot(wind, area) / length;
    // A sixth of the doubled area's impulse goes to each corner.
    const std::int64_t share = (pressure_ >> 24) * normal_speed / (6 * tick_rate); // 32 fraction bits
    // And along the sheet, an eighth as strong, whatever the direction.
    const std::int64_t skin = ((pressure_ >> 24) * length >> 22) / (8 * 6 * tick_rate); // 24 fraction bits
    for (int i = 0; i < 3; ++i) {
        lks_vec3& impulse = impulses_[corners[i]];
        impulse.x += ((share >> 8) * area.x >> 14) + skin * wind.x;
        impulse.y += ((share >> 8) * area.y >> 14) + skin * wind.y;
        impulse.z += ((share >> 8) * area.z >> 14) + skin * wind.z;
    }
}

} // namespace lks_demo
