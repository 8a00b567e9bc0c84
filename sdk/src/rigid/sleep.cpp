#include "rigid/sleep.h"

#include <algorithm>

#include "collide/filter.h"
#include "collide/saturation.h"
#include "rigid/body_roots.h"

namespace lks {
namespace {

using fixed::Vec3;

constexpr std::int64_t still_distance = world_one / 100;
// Half turns: two degrees.
constexpr std::int64_t still_turn = turn_one / 57;
// How many times longer than others what touches nothing has to stay, and what is squeezed on the average.
constexpr std::uint32_t hanging_factor = 4;
constexpr std::uint32_t squeezed_factor = 4;
// Where their counts end: a twitch does not cost the whole time.
constexpr std::uint32_t most_factor = 5;
// Squeezed is what overlaps by more than a millimetre and a half.
constexpr std::int64_t squeezed_depth = (std::int64_t{3} << world_fraction_bits) / 2000;
// Rest counts in fifths of a tick: of what sticks in something, and is still coming out, each tick is one.
constexpr std::uint32_t rest_of_tick = 5;
// Speeds of a body's fastest point; what it gains in a second, as a ball on a slope of a fifth of a degree.
constexpr std::int64_t slow = world_one / 10;
constexpr std::int64_t fast = world_one / 2;
constexpr std::int64_t least_gain = world_one / 20;

// What joints and pushing contacts hold together.
BodyRoots find_islands(RigidScene& scene) {
    BodyRoots roots(scene, scene.islands);
    roots.join_by_joints();
    for (const ContactMemory& memory : scene.memories) {
        if (memory.forgotten == 0 && memory.key.other < other_is_collider) {
            roots.join(memory.key.body_a, memory.key.other);
        }
    }
    return roots;
}

// Calls use(body) for each dynamic body that something kinematic and moving has to do with.
template <typename Use>
void for_each_disturbed(const lks_world& world, const Use& use) {
    const RigidScene& scene = world.rigid;
    const auto disturbs = [&](std::uint32_t other) {
        if (other >= other_is_collider) {
            const std::size_t index = other & ~other_is_collider;
            return index < world.colliders.size() && world.colliders[index].used &&
                   world.colliders[index].collider.moves();
        }
        return !scene.bodies[other].is_dynamic() && scene.bodies[other].is_moving();
    };
    const auto look = [&](std::uint32_t a, std::uint32_t other) {
        if (scene.bodies[a].is_dynamic() && disturbs(other)) {
            use(a);
        }
    };
    for (const ContactMemory& memory : scene.memories) {
        if (memory.forgotten != 0) {
            continue;
        }
        look(memory.key.body_a, memory.key.other);
        if (memory.key.other < other_is_collider) {
            look(memory.key.other, memory.key.body_a);
        }
    }
    for (std::size_t i = 0; i < scene.joints.size(); ++i) {
        if (scene.joint_slots[i].used) {
            const JointDescription& joint = scene.joints[i].description;
            look(joint.body_a, joint.body_b);
            look(joint.body_b, joint.body_a);
        }
    }
}

void mark_touched(RigidScene& scene) {
    for (Body& body : scene.bodies) {
        body.touched = body.figure_touched = body.squeezed = body.sticks = false;
    }
    const auto squeeze = [](Body& body, bool sticks) {
        body.squeezed = true;
        body.sticks = body.sticks || sticks;
    };
    for (const Contact& contact : scene.contacts) {
        if (is_deeper(contact, squeezed_depth)) {
            const bool sticks = is_deeper(contact, sticking_depth);
            squeeze(scene.bodies[contact.key.body_a], sticks);
            if (contact.key.other < other_is_collider) {
                squeeze(scene.bodies[contact.key.other], sticks);
            }
        }
    }
    const auto mark = [&](std::uint32_t body) {
        scene.bodies[body].touched = true;
        scene.bodies[scene.figures[body]].figure_touched = true;
    };
    for (const ContactMemory& memory : scene.memories) {
        mark(memory.key.body_a);
        if (memory.key.other < other_is_collider) {
            mark(memory.key.other);
        }
    }
}

// Whether it is where it has rested. What is squeezed may rattle about there.
bool has_stayed(const Body& body) {
    const std::int64_t way = sum_of_magnitudes(saturating_subtract(body.position, body.rest_position));
    if (body.squeezed) {
        return way <= 2 * still_distance;
    }
    return way <= still_distance &&
           sum_of_magnitudes(half_turn_between(body.rest_orientation, body.orientation)) <= still_turn;
}

// Turns by more than a radian or so a tick: where it is turned to then says nothing, as it may have gone
// round.
bool whirls(const Body& body, const StepRate& rate) {
    return sum_of_magnitudes(body.angular_velocity) >> world_fraction_bits >=
           static_cast<std::int64_t>(rate.ticks_per_second);
}

// How its speed changes. On a slope it becomes less and then more, however a body was thrown: that is steady.
// What trembles or rocks is fastest in between.
void follow_course(Body& body, std::int64_t radius, const StepRate& rate) {
    const Speeds& before = body.tick_speeds;
    const Speeds gained{body.velocity - before.velocity, body.angular_velocity - before.spin};
    const std::int64_t speed = greatest_speed(body, radius);
    if (speed > fast) {
        body.turns = 0;
    }
    if (greatest_speed(gained, radius) < least_gain / rate.ticks_per_second) {
        body.steady = 0;
        return;
    }
    const bool gathers = speed > greatest_speed(before, radius);
    const bool turns = body.gathers != 0 && !gathers;
    body.gathers = gathers ? 1 : 0;
    if (turns) {
        body.steady = 0;
        if (body.turns < enough_turns) {
            ++body.turns;
        }
    } else if (body.steady < UINT8_MAX) {
        ++body.steady;
    }
}

// Whether it has rolled, slid or toppled on for an eighth of a second, rather than trembled or rocked.
bool accelerates(const Body& body, const StepRate& rate) {
    return body.turns < enough_turns &&
           body.steady >= std::clamp<std::uint32_t>(rate.ticks_per_second / 8, 2, UINT8_MAX);
}

// Counts for how long a body has trembled at one place, or crept. A twitch of a limb takes back some of it, a
// real motion all. Slow is a pendulum, too, where it turns: of what hangs or floats only the time counts that
// it has stayed.
void count_rest(Body& body, std::int64_t radius, bool hangs, std::uint32_t most, const StepRate& rate) {
    constexpr std::uint32_t twitch = 8 * rest_of_tick;
    const bool stayed = has_stayed(body) && !whirls(body, rate);
    if (!stayed) {
        body.rest_position = body.position;
        body.rest_orientation = body.orientation;
    }
    const std::int64_t speed = greatest_speed(body, radius);
    if (!hangs && accelerates(body, rate)) {
        body.rest -= std::min(body.rest, rest_of_tick);
    } else if (stayed || (!hangs && speed <= slow)) {
        body.rest = std::min(body.rest + (body.sticks ? 1 : rest_of_tick), most);
    } else if (hangs) {
        body.rest = 0;
    } else {
        const bool twitches = speed <= fast || body.squeezed;
        body.rest = twitches && body.rest >= twitch ? body.rest - twitch : 0;
    }
}

void add_rest(IslandRest& island, std::uint32_t rest, bool squeezed) {
    island.least = std::min(island.least, rest);
    ++island.count;
    island.sum += rest;
    island.squeezed = island.squeezed || squeezed;
}

// Somebody twitches in a pile at nearly any time: all have to rest for the same time as without overlaps.
bool has_rested(const IslandRest& island, std::uint32_t enough) {
    const std::uint64_t on_average = std::uint64_t{squeezed_factor} * enough * island.count;
    return island.least >= enough && (!island.squeezed || island.sum >= on_average);
}

// Whether it moves back to where it has rested: what trembles does, half of the time, what begins to topple
// or to slide does not.
bool returns(const Body& body, std::int64_t radius) {
    // In millionths or so of a metre, a second and a turn.
    constexpr int bits = 24;
    constexpr int down = world_fraction_bits - bits;
    const auto dot = [](const Vec3& p, const Vec3& q) { return p.x * q.x + p.y * q.y + p.z * q.z; };
    const auto part = [](const Vec3& v, int shift) {
        constexpr std::int64_t most = std::int64_t{1} << 30;
        const auto along = [&](std::int64_t c) { return std::clamp(c >> shift, -most, most); };
        return Vec3{along(v.x), along(v.y), along(v.z)};
    };
    const Vec3 way = part(saturating_subtract(body.position, body.rest_position), down);
    const Vec3 turn =
        part(half_turn_between(body.rest_orientation, body.orientation), turn_fraction_bits - bits - 1);
    const std::int64_t lever = std::min<std::int64_t>(radius >> down, std::int64_t{1} << 30);
    const std::int64_t by_turn = fixed::saturate_to_int64(fixed::multiply_signed(
        dot(part(body.angular_velocity, down), turn) >> bits, (lever * lever) >> bits));
    return fixed::saturating_add(dot(part(body.velocity, down), way), by_turn) < 0;
}

// What lies on something and is on its way to sleep gives up a quarter of its speed in each tick in which it
// returns: a pile in which everybody trembles a little would keep itself awake. What hangs or flies does not:
// a pendulum is slow, too, where it turns back.
void calm(Body& body) {
    const auto part = [](const Vec3& v) { return Vec3{v.x - v.x / 4, v.y - v.y / 4, v.z - v.z / 4}; };
    body.velocity = part(body.velocity);
    body.angular_velocity = part(body.angular_velocity);
}

} // namespace

void wake(Body& body) {
    body.asleep = 0;
    body.rest = 0;
    body.turns = 0;
}

void wake_all(RigidScene& scene) {
    for (Body& body : scene.bodies) {
        wake(body);
    }
}

void wake_who_meets(RigidScene& scene, const lks_filter& filter) {
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        if (filters_meet(scene.descriptions[i].filter, filter)) {
            wake(scene.bodies[i]);
        }
    }
}

void wake_neighbours(RigidScene& scene, std::uint32_t other) {
    for (const ContactMemory& memory : scene.memories) {
        if (memory.forgotten != 0) {
            continue;
        }
        if (memory.key.other == other) {
            wake(scene.bodies[memory.key.body_a]);
        } else if (memory.key.body_a == other && memory.key.other < other_is_collider) {
            wake(scene.bodies[memory.key.other]);
        }
    }
}

void wake_jointed(RigidScene& scene, std::uint32_t body) {
    for (std::size_t i = 0; i < scene.joints.size(); ++i) {
        const JointDescription& joint = scene.joints[i].description;
        if (scene.joint_slots[i].used && (joint.body_a == body || joint.body_b == body)) {
            wake(scene.bodies[joint.body_a]);
            wake(scene.bodies[joint.body_b]);
        }
    }
}

void wake_islands(lks_world& world) {
    RigidScene& scene = world.rigid;
    const bool any = std::any_of(scene.bodies.begin(), scene.bodies.end(),
                                 [](const Body& body) { return body.asleep != 0; });
    if (!any) {
        return;
    }
    for_each_disturbed(world, [&](std::uint32_t body) { wake(scene.bodies[body]); });
    BodyRoots islands = find_islands(scene);
    // First the roots, then those that follow them: an awake body wakes its root.
    for (std::uint32_t i = 0; i < scene.bodies.size(); ++i) {
        if (scene.bodies[i].is_dynamic() && scene.bodies[i].asleep == 0) {
            Body& root = scene.bodies[islands.root(i)];
            if (root.asleep != 0) {
                wake(root);
            }
        }
    }
    for (std::uint32_t i = 0; i < scene.bodies.size(); ++i) {
        if (scene.bodies[i].asleep != 0 && scene.bodies[islands.root(i)].asleep == 0) {
            wake(scene.bodies[i]);
        }
    }
}

void fall_asleep(lks_world& world) {
    RigidScene& scene = world.rigid;
    const std::uint32_t ticks = std::max(world.rate.ticks_per_second / 2, 2u);
    const std::uint32_t enough = rest_of_tick * ticks;
    const std::uint32_t calming = rest_of_tick * (ticks / 3);
    mark_touched(scene);
    // A figure without a contact is an island by itself.
    const auto hangs = [&](std::size_t i) { return !scene.bodies[scene.figures[i]].figure_touched; };
    bool ready = false;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        Body& body = scene.bodies[i];
        if (body.is_awake()) {
            const bool alone = hangs(i);
            follow_course(body, scene.descriptions[i].radius, world.rate);
            count_rest(body, scene.descriptions[i].radius, alone, most_factor * enough, world.rate);
            if (body.touched && !accelerates(body, world.rate) && body.rest >= calming &&
                scene.descriptions[i].never_sleeps == 0 && !whirls(body, world.rate) &&
                returns(body, scene.descriptions[i].radius)) {
                calm(body);
            }
            ready = ready || body.rest >= enough;
        }
    }
    if (!ready) {
        return;
    }
    for_each_disturbed(world, [&](std::uint32_t body) { scene.bodies[body].rest = 0; });
    BodyRoots islands = find_islands(scene);
    Array<IslandRest>& rests = scene.island_rests;
    rests.clear();
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        rests.push_reserved({UINT32_MAX, 0, 0, false});
    }
    for (std::uint32_t i = 0; i < scene.bodies.size(); ++i) {
        const Body& body = scene.bodies[i];
        if (body.is_dynamic()) {
            const std::uint32_t own = hangs(i) ? body.rest / hanging_factor : body.rest;
            add_rest(rests[islands.root(i)], scene.descriptions[i].never_sleeps != 0 ? 0 : own,
                     body.squeezed);
        }
    }
    for (std::uint32_t i = 0; i < scene.bodies.size(); ++i) {
        Body& body = scene.bodies[i];
        if (body.is_dynamic() && body.asleep == 0 && has_rested(rests[islands.root(i)], enough)) {
            body.asleep = 1;
            body.gathers = body.turns = body.steady = 0;
            body.velocity = {0, 0, 0};
            body.angular_velocity = {0, 0, 0};
            body.follow_orientation();
        }
    }
}

} // namespace lks
