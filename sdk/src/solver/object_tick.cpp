#include "solver/object_tick.h"

#include <algorithm>
#include <optional>

#include "collide/broad_phase.h"
#include "collide/contact.h"
#include "collide/second_look.h"
#include "fixed/formats.h"
#include "solver/chain.h"
#include "solver/distance.h"
#include "solver/kept_rope.h"
#include "solver/local_frame.h"
#include "solver/particle_rows.h"
#include "solver/pins.h"
#include "solver/prediction.h"
#include "solver/side_by_side.h"
#include "solver/tethers.h"
#include "solver/world.h"
#include "threads/blocks.h"

namespace lks {
namespace {

// How one object moves through one tick.
class ObjectTick {
public:
    // number: among the objects that use this scratch at the same time.
    ObjectTick(const lks_world& world, Object& object, TickScratch& scratch, Team* team,
               std::uint32_t number = 0)
        : world_(world), object_(object), scratch_(scratch), team_(team), asset_(object.asset()),
          coefficients_(object.coefficients()),
          candidates_(scratch.candidates.data() +
                      scratch.candidates.capacity() / most_side_by_side * number) {}

    void begin_near_colliders() { find_candidates(begin(), world_.rate.substeps); }

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
        if (team_ == nullptr) {
            count(world_.kernels->predict(task));
            return;
        }
        PredictionClamps clamps[greatest_block_count];
        const std::uint32_t blocks =
            in_blocks(object_.count(), particles_a_block,
                      [&](std::uint32_t block, std::uint32_t first, std::uint32_t count) {
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
        if (candidate_count_ != 0) {
            begin_bounds();
        }
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
        find_candidates(object_.bounds(*world_.kernels), 1);
        resolve_all_contacts(substep);
    }

    void prepare_batches() {
        if (is_swept_in_rows(*world_.kernels, asset_, coefficients_)) {
            rows_.emplace(object_, scratch_.rows.data());
        }
        prepare_distances(asset_, coefficients_, rows_ ? rows_->arrays() : distance_arrays(),
                          rows_.has_value(), scratch_.distances);
    }

    // Before the constraints, which make even what is pulled taut.
    void hold_by_tethers() {
        TetherAnchor* anchors = scratch_.anchors.data();
        if (asset_.tethers.empty() || !place_tether_anchors(object_, anchors)) {
            return;
        }
        leave_rows();
        in_blocks(object_.count(), particles_a_block,
                  [&](std::uint32_t, std::uint32_t first, std::uint32_t count) {
                      lks::hold_by_tethers(object_, anchors, *world_.kernels, first, count);
                  });
    }

    // A rope that is solved directly comes last, so that an iteration ends with no segment stretched.
    void sweep_batches() {
        if (rows_ && !are_in_rows_) {
            are_in_rows_ = true;
            in_blocks(object_.count(), particles_a_block,
                      [&](std::uint32_t, std::uint32_t first, std::uint32_t count) {
                          rows_->take(*world_.kernels, first, count);
                      });
        }
        const bool directly = !coefficients_.chain.empty();
        for (const DistanceTask& task : scratch_.distances.tasks) {
            if (!directly || !stretches(task)) {
                project(task);
            }
        }
        if (directly) {
            solve_rope();
        }
    }

    void end_substep() {
        if (began_torn_) {
            kept_rope().limit_speeds(world_.rate.substeps_per_second);
            began_torn_ = false;
        }
    }

    // Before anything but constraints asks where particles are.
    void leave_rows() {
        if (!are_in_rows_) {
            return;
        }
        are_in_rows_ = false;
        in_blocks(object_.count(), particles_a_block,
                  [&](std::uint32_t, std::uint32_t first, std::uint32_t count) {
                      rows_->give_back(*world_.kernels, first, count);
                  });
    }

    // Contacts come last in an iteration, so that a substep ends with nothing inside a collider.
    void resolve_all_contacts(std::uint32_t substep) {
        if (candidate_count_ == 0) {
            return;
        }
        leave_rows();
        const Bounds swept = swept_bounds();
        const FarPushes far{std::min(greatest_unlooked_push, world_.rate.greatest_recovery),
                            scratch_.far_pushed.data()};
        if (candidate_count_ > 1) {
            std::fill_n(far.words, look_words(object_.count()), 0);
        }
        bool touched = false;
        for (std::uint32_t i = 0; i < candidate_count_; ++i) {
            ContactFrame frame{};
            if (!find_frame(candidates_[i], substep, swept, frame)) {
                continue;
            }
            if (frame.rotating && frame.reachable) {
                frame.greatest_growth = object_.greatest_growth(*world_.kernels);
            }
            in_blocks(object_.count(), particles_a_block,
                      [&](std::uint32_t, std::uint32_t first, std::uint32_t count) {
                          resolve_contacts(frame, particle_arrays(), first, count, *world_.kernels, nullptr,
                                           candidate_count_ > 1 ? &far : nullptr);
                      });
            touched = true;
        }
        if (touched) {
            if (candidate_count_ > 1) {
                look_again(far, substep);
            }
            place_pins(object_, substep, world_.rate.substeps);
            bounds_.reset();
            start_bounds_.reset();
        }
        if (touched && may_give_way_ && is_torn(coefficients_.chain, distance_arrays())) {
            give_way_to_contacts();
            resolve_all_contacts(substep);
        }
    }

private:
    bool is_near(std::uint32_t index, const Bounds& bounds) const {
        return may_touch(world_.colliders[index].collider, object_.origin, bounds, asset_.particle_radius);
    }

    // False: nothing within the bounds touches it in this substep.
    bool find_frame(std::uint32_t index, std::uint32_t substep, const Bounds& bounds,
                    ContactFrame& frame) const {
        if (!is_near(index, bounds)) {
            return false;
        }
        frame = make_contact_frame(world_.colliders[index].collider, substep, world_.rate.substeps,
                                   object_.origin, bounds, asset_.particle_radius, asset_.friction);
        frame.greatest_recovery = world_.rate.greatest_recovery;
        return true;
    }

    // At who was pushed far: perhaps through another collider, also one that was out of reach before.
    void look_again(const FarPushes& far, std::uint32_t substep) {
        in_blocks(object_.count(), particles_a_block,
                  [&](std::uint32_t, std::uint32_t first, std::uint32_t count) {
                      for (std::uint32_t i = first; i < first + count; i += particles_a_look) {
                          if (const std::uint64_t who = far.words[i / particles_a_look]; who != 0) {
                              SecondLook look(particle_arrays(), far.beyond, i, who);
                              look_again(look, substep);
                          }
                      }
                  });
    }

    void look_again(SecondLook& look, std::uint32_t substep) const {
        if (!is_among_several_that_move_alike(look.bounds())) {
            return;
        }
        while (!look.done()) {
            const Bounds bounds = look.bounds();
            for (std::uint32_t i = 0; i < candidate_count_; ++i) {
                ContactFrame frame{};
                if (find_frame(candidates_[i], substep, bounds, frame) && frame.reachable) {
                    look.meet(frame);
                }
            }
            look.end_round();
        }
    }

    // What moves against each other may leave no room at all: then pushes that give way to one another would
    // bring all particles to one point.
    bool is_among_several_that_move_alike(const Bounds& bounds) const {
        std::uint32_t near = 0;
        bool alike = true;
        fixed::Vec3 first_way{};
        for (std::uint32_t i = 0; i < candidate_count_ && alike; ++i) {
            if (!is_near(candidates_[i], bounds)) {
                continue;
            }
            const ColliderState& collider = world_.colliders[candidates_[i]].collider;
            const fixed::Vec3 way = collider.target_position - collider.position;
            first_way = near == 0 ? way : first_way;
            alike = !collider.rotates() && way == first_way;
            ++near;
        }
        return alike && near > 1;
    }

    // Colliders that the object can reach in so many substeps at its speed limit; each substep looks at its
    // true bounds again.
    void find_candidates(Bounds bounds, std::uint32_t substeps) {
        candidate_count_ = 0;
        if (world_.colliders.empty()) {
            return;
        }
        for (const Pin& pin : object_.pins()) {
            include(bounds, pin.target);
        }
        const std::int64_t reach = std::min(world_.rate.motion_limit, coordinate_limit / substeps) * substeps;
        grow(bounds, reach);
        candidate_count_ =
            collect_candidates(world_.colliders.data(), static_cast<std::uint32_t>(world_.colliders.size()),
                               object_.origin, bounds, asset_.particle_radius, candidates_);
    }

    void solve_rope() {
        const FamilyCoefficients& stretch = coefficients_.families[LKS_CONSTRAINT_STRETCH];
        const DistanceArrays arrays = distance_arrays();
        std::int64_t* const memory = scratch_.chain.data();
        may_give_way_ = false;
        for (int mended = 0; mended < most_mendings &&
                             !solve_chain(coefficients_.chain, stretch, arrays, *world_.kernels, memory);
             ++mended) {
            if (mended == 0) {
                keep_torn();
            }
            sweep_stretch();
            sweep_stretch();
            forget_multipliers();
            mend_chain(coefficients_.chain, stretch, arrays, *world_.kernels, memory);
        }
    }

    // Before it is mended for the first time, a rope that was torn when the substep began.
    void keep_torn() {
        if (!began_torn_) {
            began_torn_ = is_torn(coefficients_.chain, start_arrays());
            if (began_torn_) {
                kept_rope().keep();
            }
        }
        may_give_way_ = began_torn_ && candidate_count_ != 0;
    }

    // What pushed it to where it is mended from is no tension of it.
    void forget_multipliers() {
        if (!object_.multipliers.empty()) {
            for (const std::uint32_t constraint : coefficients_.chain.constraints) {
                object_.multipliers[constraint] = 0;
            }
        }
    }

    // A rope that was torn, was mended, and was torn again by contacts: what holds it apart is neither its
    // inertia nor its pins, and to mend it in each substep anew would make speed of it without end. It is
    // swept instead, from where it was.
    void give_way_to_contacts() {
        may_give_way_ = false;
        kept_rope().put_back();
        sweep_stretch();
        sweep_stretch();
    }

    KeptRope kept_rope() {
        return {object_, scratch_.chain.data() + ChainWork::words(coefficients_.chain.count())};
    }

    // Its multipliers are the direct solve's alone.
    void sweep_stretch() {
        for (DistanceTask task : scratch_.distances.tasks) {
            if (stretches(task)) {
                task.arrays.multipliers = nullptr;
                world_.kernels->project_distances(task);
            }
        }
    }

    // Of the first batch of a task.
    std::uint32_t batch_of(const DistanceTask& task) const {
        return static_cast<std::uint32_t>(task.parts - scratch_.distances.parts.data());
    }

    bool stretches(const DistanceTask& task) const {
        return asset_.batches[batch_of(task)].family == LKS_CONSTRAINT_STRETCH;
    }

    void project(const DistanceTask& task) {
        if (team_ == nullptr) {
            world_.kernels->project_distances(task);
            return;
        }
        const std::uint32_t first = batch_of(task);
        for (std::uint32_t batch = first; batch < first + task.part_count; ++batch) {
            project_in_blocks(task, batch);
        }
    }

    void project_in_blocks(const DistanceTask& task, std::uint32_t batch) {
        const BatchPart& whole = scratch_.distances.parts[batch];
        in_blocks(asset_.batches[batch].count, world_.kernels->constraints_a_block,
                  [&](std::uint32_t, std::uint32_t first, std::uint32_t count) {
                      const std::uint32_t from = whole.range.first + first;
                      const BatchPart part = part_of_batch(whole, asset_, batch, {from, from + count});
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

    // Where the substep before has ended is where this one begins. The prediction has brought what was beyond
    // the range back to its ends.
    void begin_bounds() {
        start_bounds_ = bounds_;
        bounds_.reset();
        if (start_bounds_) {
            keep_in_range(start_bounds_->low);
            keep_in_range(start_bounds_->high);
        }
    }

    // Where the particles have been in this substep, from start to now. What has touched nothing in the one
    // before begins where that looked for it last.
    Bounds swept_bounds() {
        if (!start_bounds_) {
            start_bounds_ = bounds_of_blocks([this](std::uint32_t first, std::uint32_t count) {
                return object_.start_bounds(*world_.kernels, first, count);
            });
        }
        bounds_ = bounds_of_blocks([this](std::uint32_t first, std::uint32_t count) {
            return object_.bounds(*world_.kernels, first, count);
        });
        return joined(*start_bounds_, *bounds_);
    }

    template <typename BoundsOf>
    Bounds bounds_of_blocks(const BoundsOf& bounds_of) {
        Bounds parts[greatest_block_count];
        const std::uint32_t blocks =
            in_blocks(object_.count(), particles_a_block,
                      [&](std::uint32_t block, std::uint32_t first, std::uint32_t count) {
                          parts[block] = bounds_of(first, count);
                      });
        Bounds bounds = parts[0];
        for (std::uint32_t block = 1; block < blocks; ++block) {
            bounds = joined(bounds, parts[block]);
        }
        return bounds;
    }

    static void keep_in_range(fixed::Vec3& corner) {
        const auto keep = [](std::int64_t& value) {
            value = std::clamp(value, -coordinate_limit, coordinate_limit);
        };
        keep(corner.x);
        keep(corner.y);
        keep(corner.z);
    }

    // As many for each worker: for one that is left over the others would wait. What is a little too small
    // for one more counts as one: a grid's batches have a power of two, or somewhat less.
    std::uint32_t wanted_blocks(std::uint32_t count, std::uint32_t grain) const {
        const std::uint32_t workers = world_.worker_count;
        const std::uint32_t most = blocks_a_worker * workers;
        const std::uint32_t wanted = (count + grain / 4) / grain;
        return std::min(wanted < workers ? wanted : wanted < most ? workers : most, greatest_block_count);
    }

    // Calls body(block, first, count) for parts of `count` elements of about `grain` each, one after the
    // other or at the same time, and returns how many parts. Parts begin at whole groups of the kernels and
    // at whole words of FarPushes.
    template <typename Body>
    std::uint32_t in_blocks(std::uint32_t count, std::uint32_t grain, const Body& body) {
        const std::uint32_t wanted = wanted_blocks(count, grain);
        if (team_ == nullptr || wanted < 2) {
            body(0, 0, count);
            return 1;
        }
        static_assert(particles_a_look % widest_group == 0);
        const std::uint32_t size = (count / wanted + particles_a_look) / particles_a_look * particles_a_look;
        run_blocks(team_, count, size, [&](std::uint32_t first, std::uint32_t end, std::uint32_t) {
            body(first / size, first, end - first);
        });
        return (count + size - 1) / size;
    }

    static void grow(Bounds& bounds, std::int64_t reach) {
        const auto lower = [reach](std::int64_t value) {
            return std::clamp(value, -coordinate_limit, coordinate_limit) - reach;
        };
        const auto higher = [reach](std::int64_t value) {
            return std::clamp(value, -coordinate_limit, coordinate_limit) + reach;
        };
        bounds.low = {lower(bounds.low.x), lower(bounds.low.y), lower(bounds.low.z)};
        bounds.high = {higher(bounds.high.x), higher(bounds.high.y), higher(bounds.high.z)};
    }

    // Where particles began the substep, as if they were there now.
    DistanceArrays start_arrays() {
        DistanceArrays arrays = distance_arrays();
        arrays.x = object_.start_axis(0);
        arrays.y = object_.start_axis(1);
        arrays.z = object_.start_axis(2);
        return arrays;
    }

    DistanceArrays distance_arrays() {
        return {object_.axis(0),
                object_.axis(1),
                object_.axis(2),
                object_.start_axis(0),
                object_.start_axis(1),
                object_.start_axis(2),
                object_.multipliers.empty() ? nullptr : object_.multipliers.data()};
    }

    ParticleArrays particle_arrays() {
        return {object_.axis(0),       object_.axis(1),       object_.axis(2),
                object_.start_axis(0), object_.start_axis(1), object_.start_axis(2)};
    }

    // As Kernels::constraints_a_block.
    static constexpr std::uint32_t particles_a_block = 2048;
    // Of a torn rope, in an iteration. What a substep of 0.1 s falls tears one that began whole: it has to be
    // whole again at its end.
    static constexpr int most_mendings = 8;
    // What is pushed no further than a millimetre, or than an old overlap is undone, is not looked at again:
    // one push after the other stops it, of an angle a between two plates some mm/sin²a behind their faces.
    static constexpr std::int64_t greatest_unlooked_push = coordinate_one >> 10;
    // More would even out the last blocks of a phase better, and cost more taking.
    static constexpr std::uint32_t blocks_a_worker = 2;

    const lks_world& world_;
    Object& object_;
    TickScratch& scratch_;
    Team* team_;
    const lks_asset& asset_;
    const Coefficients& coefficients_;
    std::uint32_t* candidates_; // colliders near the object
    std::uint32_t candidate_count_ = 0;
    // Where particles began the substep, and where they are since contacts looked, if nothing has moved them.
    std::optional<Bounds> start_bounds_, bounds_;
    std::optional<ParticleRows> rows_; // where constraints are swept in rows
    bool are_in_rows_ = false;         // the arrays are those of before
    bool began_torn_ = false;          // of a rope: where it was before it was mended is kept
    bool may_give_way_ = false;        // it has been mended since
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
