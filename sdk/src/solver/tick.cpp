#include "solver/tick.h"

#include <algorithm>

#include "rigid/coupling.h"
#include "rigid/rigid_tick.h"
#include "solver/object_tick.h"
#include "solver/side_by_side.h"
#include "solver/world.h"

namespace lks {
namespace {

// What a kinematic collider was moving to is where it now rests.
void finish_collider_motion(lks_world& world) {
    for (ColliderSlot& slot : world.colliders) {
        if (slot.used) {
            slot.collider.position = slot.collider.target_position;
            slot.collider.rotation = slot.collider.target_rotation;
        }
    }
}

// Constraints and particles, as a measure of an object's work.
std::uint64_t weight(const Object& object) {
    return std::uint64_t{object.asset().constraint_count()} + object.count();
}

// Projections and particles a tick from which on it is worth waking others: some 50 microseconds of work.
constexpr std::uint64_t worth_waking = 30000;

// Whether the blocks of its phases outweigh the stages between them: it has enough of them, and a batch,
// which is a stage of its own, has one and three quarters on the average, so that most are cut in two.
bool is_large(const lks_world& world, const Object& object) {
    const std::uint64_t block = world.kernels->constraints_a_block;
    const lks_asset& asset = object.asset();
    return weight(object) >= 16 * block &&
           4 * std::uint64_t{asset.constraint_count()} >= 7 * block * asset.batches.size();
}

// Coupled ones go with the bodies.
bool runs_alone(const lks_world& world, std::size_t object) {
    return world.objects[object].object != nullptr && !is_coupled(world.rigid, object);
}

// All objects by the caller alone.
void run_objects(lks_world& world) {
    const auto run = [&](Object* const* objects, std::uint32_t count) {
        run_objects_tick(world, objects, count, world.scratch[0]);
    };
    Neighbours neighbours(*world.kernels, run);
    for (std::size_t i = 0; i < world.objects.size(); ++i) {
        if (runs_alone(world, i)) {
            neighbours.add(*world.objects[i].object);
        }
    }
    neighbours.finish();
}

// Of objects that a worker takes at once: as many as go side by side, and some eight blocks a worker, so that
// the last ones come out even.
std::size_t size_of_block(std::size_t objects, std::uint32_t workers) {
    constexpr std::size_t greatest_blocks = 4096;
    const std::size_t even = std::clamp<std::size_t>(objects / (8 * workers), 1, most_side_by_side);
    return std::max(even, (objects + greatest_blocks - 1) / greatest_blocks);
}

// Small objects at the same time, then large ones, each by all.
void run_objects_by_team(lks_world& world, Team& team) {
    struct Context {
        lks_world& world;
        std::size_t size; // of a block
    };
    const std::size_t count = world.objects.size();
    Context context{world, size_of_block(count, world.worker_count)};
    const auto run_block = [](void* argument, std::uint32_t block, std::uint32_t worker) {
        const Context& c = *static_cast<Context*>(argument);
        const auto run = [&](Object* const* objects, std::uint32_t number) {
            run_objects_tick(c.world, objects, number, c.world.scratch[worker]);
        };
        Neighbours neighbours(*c.world.kernels, run);
        const std::size_t end = std::min(c.world.objects.size(), (block + 1) * c.size);
        for (std::size_t i = block * c.size; i < end; ++i) {
            if (runs_alone(c.world, i) && !is_large(c.world, *c.world.objects[i].object)) {
                neighbours.add(*c.world.objects[i].object);
            }
        }
        neighbours.finish();
    };
    team.run({run_block, &context, static_cast<std::uint32_t>((count + context.size - 1) / context.size)});
    for (std::size_t i = 0; i < world.objects.size(); ++i) {
        if (runs_alone(world, i) && is_large(world, *world.objects[i].object)) {
            run_object_tick(world, *world.objects[i].object, world.scratch[0], &team);
        }
    }
}

bool objects_need_team(const lks_world& world) {
    std::uint64_t total = 0;
    std::uint32_t count = 0;
    bool large = false;
    for (std::size_t i = 0; i < world.objects.size(); ++i) {
        if (runs_alone(world, i)) {
            total += weight(*world.objects[i].object);
            large = large || is_large(world, *world.objects[i].object);
            ++count;
        }
    }
    const std::uint64_t passes = std::uint64_t{world.rate.substeps} * world.rate.iterations;
    return (large || count > 1) && total * passes >= worth_waking;
}

// Every worker's share of what was counted. Sums, so that nobody sees who did what.
void collect_counters(lks_world& world) {
    for (std::uint32_t worker = 0; worker < world.worker_count; ++worker) {
        lks_world_counters& counted = world.scratch[worker].counters;
        world.counters.position_clamps += counted.position_clamps;
        world.counters.speed_clamps += counted.speed_clamps;
        world.counters.target_clamps += counted.target_clamps;
        world.counters.world_edge_hits += counted.world_edge_hits;
        counted = {};
    }
}

} // namespace

void run_tick(lks_world& world) {
    if (world.before_tick.call != nullptr) {
        world.running = true;
        world.before_tick.call(world.before_tick.user, &world, world.tick);
        world.running = false;
    }
    for (ColliderSlot& slot : world.colliders) {
        slot.collider.previous_position = slot.collider.position;
        slot.collider.previous_rotation = slot.collider.rotation;
    }
    find_coupled(world);
    const bool for_objects = world.worker_count > 1 && objects_need_team(world);
    const bool for_bodies = world.worker_count > 1 && bodies_need_team(world);
    Team& team = world.helpers.team();
    if (for_objects || for_bodies) {
        world.helpers.begin();
    }
    if (for_objects) {
        run_objects_by_team(world, team);
    } else {
        run_objects(world);
    }
    run_rigid_tick(world, for_bodies ? &team : nullptr);
    if (for_objects || for_bodies) {
        world.helpers.end();
    }
    collect_counters(world);
    finish_collider_motion(world);
    ++world.tick;
}

} // namespace lks
