#include "rigid/contact_mark.h"

#include <algorithm>
#include <bit>

#include "rigid/contact_points.h"

namespace lks {

using fixed::Vec3;

namespace {

// Levers are no longer than this and weights below that: the sum of four products fits.
constexpr std::int64_t greatest_lever = std::int64_t{256} << world_fraction_bits;
constexpr int weight_bits = 12;

// From a's centre of mass, half way between the surfaces. Along them the side counts that is round, of which
// the core is known exactly: where it met the other one at the beginning of the tick it may have left.
// Shorter than any body is long, unless its contact came apart within the substep at a speed that no body
// keeps.
Vec3 lever_between(const Contact& contact, const ContactPoint& point, const Body& a, const Body& b) {
    const Levers levers = surfaces_of(contact, cores_now(point, a, b));
    const Vec3 gap = (b.position - a.position) + levers.b - levers.a;
    const Vec3 half_open = fixed::scale(contact.normal(), fixed::dot(contact.normal(), gap) / 2);
    Vec3 lever = contact.radius_a > contact.radius_b   ? levers.a + half_open
                 : contact.radius_a < contact.radius_b ? levers.a + gap - half_open
                                                       : levers.a + Vec3{gap.x / 2, gap.y / 2, gap.z / 2};
    clamp_vector(lever, greatest_lever);
    return lever;
}

// weight(point): 0 .. 2^weight_bits; false where all are 0.
template <typename Weight>
bool find_middle(const Contact& contact, const Body& a, const Body& b, const Weight& weight, Vec3& place) {
    Vec3 sum{0, 0, 0};
    std::int64_t whole = 0;
    for (std::uint32_t i = 0; i < contact.count; ++i) {
        const std::int64_t part = weight(contact.points[i]);
        if (part != 0) {
            const Vec3 lever = lever_between(contact, contact.points[i], a, b);
            sum = sum + Vec3{lever.x * part, lever.y * part, lever.z * part};
            whole += part;
        }
    }
    if (whole != 0) {
        place = a.position + Vec3{sum.x / whole, sum.y / whole, sum.z / whole};
    }
    return whole != 0;
}

} // namespace

Vec3 place_of(const Contact& contact, const Body& a, const Body& b) {
    std::int64_t most = 0;
    for (std::uint32_t i = 0; i < contact.count; ++i) {
        most = std::max(most, contact.points[i].push.normal);
    }
    const int down =
        std::max(0, static_cast<int>(std::bit_width(static_cast<std::uint64_t>(most))) - weight_bits);
    const auto pushes = [down](const ContactPoint& point) { return point.push.normal >> down; };
    const auto is_active = [](const ContactPoint& point) { return point.active ? 1 : 0; };
    const auto any = [](const ContactPoint&) { return 1; };
    Vec3 place = a.position;
    static_cast<void>(find_middle(contact, a, b, pushes, place) ||
                      find_middle(contact, a, b, is_active, place) || find_middle(contact, a, b, any, place));
    return place;
}

} // namespace lks
