#include "solver/object_tick.h"

#include <algorithm>
#include <optional>

#include "solver/distance.h"
#include "solver/local_frame.h"
#include "solver/object_arrays.h"
#include "solver/object_blocks.h"
#include "solver/object_contacts.h"
#include "solver/object_rope.h"
#include "solver/particle_rows.h"
#include "solver/pins.h"
#include "solver/prediction.h"
#include "solver/side_by_side.h"
#include "solver/tethers.h"
#include "solver/world.h"

namespace lks {
namespace {

// How one object moves through one tick.
class ObjectTick {
public:
    // number: among the objects that use this scratch at the same time.
    ObjectTick(const lks_world& world, Object& object, TickScratch& scratch, Team* team,
               std::uint32_t number = 0)
        : world_(world), object_(object), scratch_(scratch), blocks_(team, world.worker_count),
          contacts_(world, object, scratch, blocks_, number), rope_(object, scratch, *world.kernels) {}

    void begin_near_colliders() { contacts_.find_candidates(begin(), world_.rate.substeps); }

    // Where its particles are at the beginning of the tick.
    Bounds begin() {
        Bounds bounds = object_.bounds(*world_.kernels);
        follow_object(object_, bounds, scratch_.counters);
        object_.keep_previous();
        begin_pin_motion(object_);
        object_.record_pins();
        return bounds;
    }

    PredictionTask prediction() { return make_prediction(world_.rate, world_.gravity, object_); }

    void predict(const PredictionTask& task) {
        if (blocks_.is_alone()) {
            count(world_.kernels->predict(task));
            return;
        }
        PredictionClamps clamps[greatest_block_count];
        const std::uint32_t blocks = blocks_.cut_particles(
            object_.count(), [&](std::uint32_t block, std::uint32_t first, std::uint32_t count) {
                PredictionTask part = task;
                part.x += first;
                part.count = count;
                clamps[block] = world_.kernels->predict(part);
            });
        for (std::uint32_t block = 0; block < blocks; ++block) {
            count(clamps[block]);
        }
    }

    // After the prediction.
    void begin_substep(std::uint32_t substep) {
        contacts_.begin_substep();
        place_pins(object_, substep, world_.rate.substeps);
        if (!object_.multipliers.empty()) {
            std::fill(object_.multipliers.begin(), object_.multipliers.end(), 0);
        }
    }

    void project() {
        prepare_batches();
        hold_by_tethers();
        sweep_batches();
        leave_rows();
        end_substep();
    }

    void collide(std::uint32_t substep) {
        contacts_.find_candidates(object_.bounds(*world_.kernels), 1);
        resolve_all_contacts(substep);
    }

    void prepare_batches() {
        const Coefficients& coefficients = object_.coefficients();
        if (is_swept_in_rows(*world_.kernels, object_.asset(), coefficients)) {
            rows_.emplace(object_, scratch_.rows.data());
        }
        prepare_distances(object_.asset(), coefficients, rows_ ? rows_->arrays() : distance_arrays(object_),
                          rows_.has_value(), scratch_.distances);
    }

    // Before the constraints, which make even what is pulled taut.
    void hold_by_tethers() {
        TetherAnchor* anchors = scratch_.anchors.data();
        if (object_.asset().tethers.empty() || !place_tether_anchors(object_, anchors)) {
            return;
        }
        leave_rows();
        blocks_.cut_particles(object_.count(), [&](std::uint32_t, std::uint32_t first, std::uint32_t count) {
            lks::hold_by_tethers(object_, anchors, *world_.kernels, first, count);
        });
    }

    // A rope that is solved directly comes last, so that an iteration ends with no segment stretched.
    void sweep_batches() {
        if (rows_ && !are_in_rows_) {
            are_in_rows_ = true;
            blocks_.cut_particles(object_.count(),
                                  [&](std::uint32_t, std::uint32_t first, std::uint32_t count) {
                                      rows_->take(*world_.kernels, first, count);
                                  });
        }
        const bool directly = rope_.is_solved_at_once();
        for (const DistanceTask& task : scratch_.distances.tasks) {
            if (!directly || !rope_.stretches(task)) {
                project(task);
            }
        }
        if (directly) {
            rope_.solve(contacts_.any());
        }
    }

    void end_substep() { rope_.end_substep(world_.rate.substeps_per_second); }

    // Before anything but constraints asks where particles are.
    void leave_rows() {
        if (!are_in_rows_) {
            return;
        }
        are_in_rows_ = false;
        blocks_.cut_particles(object_.count(), [&](std::uint32_t, std::uint32_t first, std::uint32_t count) {
            rows_->give_back(*world_.kernels, first, count);
        });
    }

    // Contacts come last in an iteration, so that a substep ends with nothing inside a collider.
    void resolve_all_contacts(std::uint32_t substep) {
        if (!contacts_.any()) {
            return;
        }
        leave_rows();
        if (contacts_.resolve(substep) && rope_.gives_way_to_contacts()) {
            contacts_.resolve(substep);
        }
    }

private:
    void project(const DistanceTask& task) {
        if (blocks_.is_alone()) {
            world_.kernels->project_distances(task);
            return;
        }
        const std::uint32_t first = first_batch(task, scratch_.distances);
        for (std::uint32_t batch = first; batch < first + task.part_count; ++batch) {
            project_in_blocks(task, batch);
        }
    }

    void project_in_blocks(const DistanceTask& task, std::uint32_t batch) {
        const BatchPart& whole = scratch_.distances.parts[batch];
        const lks_asset& asset = object_.asset();
        blocks_.cut(asset.batches[batch].count, world_.kernels->constraints_a_block,
                    [&](std::uint32_t, std::uint32_t first, std::uint32_t count) {
                        const std::uint32_t from = whole.range.first + first;
                        const BatchPart part = part_of_batch(whole, asset, batch, {from, from + count});
                        DistanceTask block = task;
                        block.parts = &part;
                        block.part_count = 1;
                        world_.kernels->project_distances(block);
                    });
    }

    void count(const PredictionClamps& clamps) {
        scratch_.counters.position_clamps += clamps.positions;
        scratch_.counters.speed_clamps += clamps.speeds;
    }

    const lks_world& world_;
    Object& object_;
    TickScratch& scratch_;
    ObjectBlocks blocks_;
    ObjectContacts contacts_;
    ObjectRope rope_;
    std::optional<ParticleRows> rows_; // where constraints are swept in rows
    bool are_in_rows_ = false;         // the arrays are those of before
};

// How one object, or several side by side, move through one tick: all do each step before any does the next,
// and the constraints of all are projected by the first one.
class ObjectsTick {
public:
    ObjectsTick(const lks_world& world, Object* const* objects, std::uint32_t count, TickScratch& scratch,
                Team* team)
        : world_(world), scratch_(scratch), objects_(objects), count_(count) {
        for (std::uint32_t i = 0; i < count; ++i) {
            ticks_[i].emplace(world, *objects[i], scratch, team, i);
        }
    }

    void run() {
        each([](ObjectTick& tick) { tick.begin_near_colliders(); });
        ticks_[0]->prepare_batches();
        std::ptrdiff_t places[most_side_by_side];
        put_side_by_side(objects_, count_, scratch_.distances, places);
        make_predictions(places);
        for (std::uint32_t substep = 1; substep <= world_.rate.substeps; ++substep) {
            for (std::uint32_t i = 0; i < prediction_count_; ++i) {
                ticks_[i]->predict(predictions_[i]);
            }
            each([&](ObjectTick& tick) { tick.begin_substep(substep); });
            for (std::uint32_t iteration = 0; iteration < world_.rate.iterations; ++iteration) {
                each([](ObjectTick& tick) { tick.hold_by_tethers(); });
                ticks_[0]->sweep_batches();
                each([&](ObjectTick& tick) { tick.resolve_all_contacts(substep); });
            }
            each([](ObjectTick& tick) {
                tick.leave_rows();
                tick.end_substep();
            });
        }
    }

private:
    // One of all objects, if all move alike; otherwise each its own.
    void make_predictions(const std::ptrdiff_t* places) {
        for (std::uint32_t i = 0; i < count_; ++i) {
            predictions_[i] = ticks_[i]->prediction();
        }
        prediction_count_ = count_;
        if (count_ > 1 &&
            std::all_of(predictions_ + 1, predictions_ + count_,
                        [&](const PredictionTask& task) { return moves_alike(task, predictions_[0]); })) {
            prediction_count_ = 1;
            predictions_[0].objects = places;
            predictions_[0].object_count = count_;
        }
    }

    template <typename Step>
    void each(const Step& step) {
        for (std::uint32_t i = 0; i < count_; ++i) {
            step(*ticks_[i]);
        }
    }

    const lks_world& world_;
    TickScratch& scratch_;
    Object* const* objects_;
    std::uint32_t count_;
    std::optional<ObjectTick> ticks_[most_side_by_side];
    PredictionTask predictions_[most_side_by_side];
    std::uint32_t prediction_count_ = 0;
};

} // namespace

void run_object_tick(const lks_world& world, Object& object, TickScratch& scratch, Team* team) {
    Object* const alone = &object;
    ObjectsTick(world, &alone, 1, scratch, team).run();
}

void run_objects_tick(const lks_world& world, Object* const* objects, std::uint32_t count,
                      TickScratch& scratch) {
    ObjectsTick(world, objects, count, scratch, nullptr).run();
}

void begin_object_tick(const lks_world& world, Object& object, TickScratch& scratch) {
    ObjectTick(world, object, scratch, nullptr).begin();
}

void begin_object_substep(const lks_world& world, Object& object, TickScratch& scratch,
                          std::uint32_t substep) {
    ObjectTick tick(world, object, scratch, nullptr);
    tick.predict(tick.prediction());
    tick.begin_substep(substep);
}

void project_object(const lks_world& world, Object& object, TickScratch& scratch) {
    ObjectTick(world, object, scratch, nullptr).project();
}

void collide_object(const lks_world& world, Object& object, TickScratch& scratch, std::uint32_t substep) {
    ObjectTick(world, object, scratch, nullptr).collide(substep);
}

} // namespace lks
