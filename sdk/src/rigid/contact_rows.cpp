// What a contact's pushes do to its bodies.
#include "rigid/contact.h"
#include "rigid/contact_points.h"

namespace lks {
namespace {

using fixed::Direction;
using fixed::Vec3;

// Of one side, along the first `count` directions; their weights are added to.
void make_side(const Body& body, std::int32_t share, const Direction* directions, int count,
               const Vec3& lever, ContactRowSide& side, std::int64_t (&weights)[3]) {
    if (share == 0) {
        side = {};
        return;
    }
    const UnitLever unit = to_unit(body, lever);
    side.turn_shift = unit.turn_shift;
    side.arm_shift = unit.arm_shift;
    for (int i = 0; i < count; ++i) {
        side.rows[i] = push_row(body, share, directions[i], unit, weights[i]);
    }
}

const ContactRowSide& side_of(const ContactRows& rows, bool is_a) {
    return is_a ? rows.a : rows.b;
}

// What a point's pushes do to one of its bodies.
void add_pushes_of(const Contact& contact, const ContactPoint& point, const ContactPush& push, bool to_a,
                   Move& move) {
    const std::int32_t share = to_a ? contact.shares.a : contact.shares.b;
    if (share == 0 || push.normal == 0) {
        return;
    }
    const ContactRowSide& side = side_of(point.rows, to_a);
    const std::int64_t along[3] = {push.normal, push.across[0], push.across[1]};
    for (int i = 0; i < 3; ++i) {
        if (along[i] != 0) {
            add_push(move, side.rows[i], share, side.turn_shift,
                     fixed::scale(contact.directions[i], along[i]), along[i], to_a ? -1 : 1);
        }
    }
}

} // namespace

void fill_rows(const Contact& contact, const ContactBodies& bodies, const Levers& levers, int count,
               ContactRows& rows) {
    std::int64_t weights[3] = {};
    make_side(bodies.a, contact.shares.a, contact.directions, count, levers.a, rows.a, weights);
    make_side(bodies.b, contact.shares.b, contact.directions, count, levers.b, rows.b, weights);
    for (int i = 0; i < count; ++i) {
        rows.inverses[i] = invert(weights[i]);
    }
}

void make_rows(Contact& contact, ContactBodies bodies) {
    Levers sum{{0, 0, 0}, {0, 0, 0}};
    contact.active_count = 0;
    for (std::uint32_t i = 0; i < contact.count; ++i) {
        ContactPoint& point = contact.points[i];
        const Levers cores = cores_now(point, bodies.a, bodies.b);
        if (activate(contact, point, gap_of(contact, point, cores, bodies) < near_point)) {
            const Levers levers = surfaces_of(contact, cores);
            sum = {sum.a + levers.a, sum.b + levers.b};
            fill_rows(contact, bodies, levers, 3, point.rows);
        }
    }
    make_middle(contact, bodies, sum);
}

void make_middle(Contact& contact, const ContactBodies& bodies, const Levers& sum) {
    const auto n = static_cast<std::int64_t>(contact.active_count);
    if (n > 1) {
        const auto share = [n](const Vec3& v) { return Vec3{v.x / n, v.y / n, v.z / n}; };
        fill_rows(contact, bodies, {share(sum.a), share(sum.b)}, 1, contact.middle);
    }
}

void carry_on(Contact& contact, bool to_a, Move& move) {
    Move& carried = to_a ? contact.carried_a : contact.carried_b;
    carried = {};
    for (std::uint32_t i = 0; i < contact.count; ++i) {
        if (contact.points[i].active) {
            add_pushes_of(contact, contact.points[i], contact.points[i].push, to_a, carried);
        }
    }
    add_move(carried, move);
}

void carry_more(Contact& contact, ContactBodies bodies, std::int32_t share) {
    Move move_a;
    Move move_b;
    for (std::uint32_t i = 0; i < contact.count; ++i) {
        ContactPoint& point = contact.points[i];
        if (!point.active || point.push.normal == 0) {
            continue;
        }
        ContactPush more = point.push;
        const auto take = [share](std::int64_t& total, std::int64_t& part) {
            part = fixed::scale_component(share, part);
            total += part;
        };
        take(point.push.normal, more.normal);
        take(point.push.across[0], more.across[0]);
        take(point.push.across[1], more.across[1]);
        add_pushes_of(contact, point, more, true, move_a);
        add_pushes_of(contact, point, more, false, move_b);
    }
    // What does not move may be others' too, at the same time.
    if (contact.shares.a != 0) {
        apply(bodies.a, move_a);
        add_move(move_a, contact.carried_a);
    }
    if (contact.shares.b != 0) {
        apply(bodies.b, move_b);
        add_move(move_b, contact.carried_b);
    }
}

} // namespace lks
