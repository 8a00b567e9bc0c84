// lockstitch/world.h.
#include <lockstitch/world.h>

#include "api/checks.h"
#include "rigid/sleep.h"
#include "solver/tick.h"

using namespace lks;

namespace {

constexpr std::int64_t nanoseconds_per_second = 1000000000;
constexpr std::int64_t elapsed_limit = 100000000000000; // times 10^4 Hz fits into 64 bits
constexpr lks_fixed gravity_limit = LKS_FIXED(1000);
constexpr std::uint64_t substeps_per_second_limit = 1000000;

struct Range {
    const char* name;
    std::uint32_t value;
    std::uint32_t low;
    std::uint32_t high;
};

lks_result check_world_def(const lks_world_def& def) {
    const Range ranges[] = {
        {"tick_rate_hz", def.tick_rate_hz, 1, 10000},
        {"substeps", def.substeps, 1, 1000},
        {"iterations", def.iterations, 1, 1000},
        {"max_ticks_per_advance", def.max_ticks_per_advance, 1, 10000},
        {"excess_time", def.excess_time, LKS_EXCESS_TIME_DROP, LKS_EXCESS_TIME_KEEP},
        {"keep_previous_positions", def.keep_previous_positions, 0, 1},
        {"worker_count", def.worker_count, 1, LKS_MAX_WORKERS},
        {"simd", def.simd, LKS_SIMD_AUTO, LKS_SIMD_WASM},
    };
    for (const Range& range : ranges) {
        if (range.value < range.low || range.value > range.high) {
            return report(def.error, LKS_ERROR_INVALID_ARGUMENT,
                          Sentence() << "The world's " << range.name << " is " << range.value
                                     << "; it must be from " << range.low << " to " << range.high << ".");
        }
    }
    if (def.reserved != 0) {
        return report(def.error, LKS_ERROR_INVALID_ARGUMENT,
                      Sentence() << "The world's reserved field is " << def.reserved << "; it must be 0.");
    }
    const std::uint64_t substeps_per_second = std::uint64_t{def.tick_rate_hz} * def.substeps;
    if (substeps_per_second > substeps_per_second_limit) {
        return report(def.error, LKS_ERROR_INVALID_ARGUMENT,
                      Sentence() << "The world's tick_rate_hz times substeps is " << substeps_per_second
                                 << "; it must be at most " << substeps_per_second_limit << ".");
    }
    if (!within(def.gravity, gravity_limit)) {
        return report(def.error, LKS_ERROR_INVALID_ARGUMENT,
                      out_of_range("gravity", def.gravity, "m/s²", gravity_limit));
    }
    if (const auto simd = static_cast<lks_simd>(def.simd); find_kernels(simd) == nullptr) {
        return report(def.error, LKS_ERROR_INVALID_ARGUMENT,
                      Sentence() << "The world's simd is " << def.simd << " (" << simd_name(simd)
                                 << "), which this processor or this build of the library has not got.");
    }
    if ((def.tasks.enqueue == nullptr) != (def.tasks.finish == nullptr)) {
        return report(def.error, LKS_ERROR_INVALID_ARGUMENT,
                      Sentence() << "The world's task system has only one of its two functions.");
    }
    if (!allocator_is_valid(def.allocator)) {
        return report(def.error, LKS_ERROR_INVALID_ARGUMENT,
                      Sentence() << "The world's allocator has only one of its two functions.");
    }
    return LKS_OK;
}

// Units of the clock in one tick: its unit is 1/(tick rate · 10⁹) s.
constexpr std::int64_t clock_units_per_tick = nanoseconds_per_second;

} // namespace

extern "C" {

lks_world_def lks_default_world_def(void) {
    lks_world_def def{};
    def.struct_size = sizeof(lks_world_def);
    def.tick_rate_hz = 60;
    def.substeps = 20;
    def.iterations = 1;
    def.gravity.y = -LKS_FIXED_RATIO(981, 100);
    def.max_ticks_per_advance = 8;
    def.excess_time = LKS_EXCESS_TIME_DROP;
    def.keep_previous_positions = 1;
    def.worker_count = 1;
    return def;
}

lks_result lks_world_create(const lks_world_def* def, lks_world** world) {
    if (def == nullptr) {
        return LKS_ERROR_NULL_ARGUMENT;
    }
    if (def->struct_size != sizeof(lks_world_def)) {
        return LKS_ERROR_STRUCT_SIZE; // where its error field lies is unknown
    }
    if (world == nullptr) {
        return report(def->error, LKS_ERROR_NULL_ARGUMENT, null_argument("lks_world_create", "world"));
    }
    if (const lks_result result = check_world_def(*def); result != LKS_OK) {
        return result;
    }
    auto* made = lks::create<lks_world>(def->allocator, *def);
    if (made == nullptr) {
        return report(def->error, LKS_ERROR_OUT_OF_MEMORY,
                      Sentence() << "The allocator has no memory for a world.");
    }
    if (!made->helpers.start(def->worker_count - 1, def->tasks)) {
        lks::destroy(def->allocator, made);
        return report(def->error, LKS_ERROR_OUT_OF_MEMORY,
                      Sentence() << "The system has no thread for a world of " << def->worker_count
                                 << " workers.");
    }
    *world = made;
    return report(def->error, LKS_OK, Sentence());
}

void lks_world_destroy(lks_world* world) {
    if (world == nullptr) {
        return;
    }
    if (world->running) {
        (void)world->fail(LKS_ERROR_INVALID_ARGUMENT,
                          Sentence() << "A world can't be destroyed by its own tick hook.");
        return;
    }
    const lks_allocator allocator = world->allocator;
    lks::destroy(allocator, world);
}

const lks_error* lks_world_last_error(const lks_world* world) {
    return world == nullptr ? nullptr : &world->last_error;
}

lks_result lks_world_step(lks_world* world) {
    if (world == nullptr) {
        return LKS_ERROR_NULL_ARGUMENT;
    }
    if (world->running) {
        return world->fail(LKS_ERROR_INVALID_ARGUMENT, Sentence() << "A tick hook can't step its own world.");
    }
    world->event_log.events.clear();
    run_tick(*world);
    return LKS_OK;
}

lks_result lks_world_advance(lks_world* world, int64_t elapsed_ns, uint32_t* ticks_run) {
    if (world == nullptr) {
        return LKS_ERROR_NULL_ARGUMENT;
    }
    if (world->running) {
        return world->fail(LKS_ERROR_INVALID_ARGUMENT, Sentence()
                                                           << "A tick hook can't advance its own world.");
    }
    if (elapsed_ns < 0 || elapsed_ns > elapsed_limit) {
        return world->fail(LKS_ERROR_INVALID_ARGUMENT, Sentence() << "The elapsed time of " << elapsed_ns
                                                                  << " ns lies outside its range from 0 to "
                                                                  << elapsed_limit << ".");
    }
    const std::int64_t gained = elapsed_ns * static_cast<std::int64_t>(world->rate.ticks_per_second);
    if (world->clock.due > INT64_MAX - gained) {
        return world->fail(LKS_ERROR_LIMIT, Sentence()
                                                << "Too many ticks are due; run them before time goes on.");
    }
    world->clock.due += gained;
    world->event_log.events.clear();
    std::uint32_t ran = 0;
    while (ran < world->max_ticks_per_advance && world->clock.due >= clock_units_per_tick) {
        world->clock.due -= clock_units_per_tick;
        run_tick(*world);
        ++ran;
    }
    if (world->excess_time == LKS_EXCESS_TIME_DROP) {
        world->counters.dropped_ticks += static_cast<std::uint64_t>(world->clock.due / clock_units_per_tick);
        world->clock.due %= clock_units_per_tick;
    }
    if (ticks_run != nullptr) {
        *ticks_run = ran;
    }
    return LKS_OK;
}

uint32_t lks_world_interpolation(const lks_world* world) {
    if (world == nullptr) {
        return 0;
    }
    // With ticks still due (LKS_EXCESS_TIME_KEEP) the view stays just before the next one.
    const std::int64_t due = world->clock.due;
    const std::int64_t fraction = due >= clock_units_per_tick ? clock_units_per_tick - 1 : due;
    return static_cast<uint32_t>((static_cast<std::uint64_t>(fraction) << 32) / clock_units_per_tick);
}

lks_simd lks_world_simd(const lks_world* world) {
    return world == nullptr ? LKS_SIMD_AUTO : world->kernels->level;
}

uint64_t lks_world_tick(const lks_world* world) {
    return world == nullptr ? 0 : world->tick;
}

uint32_t lks_world_tick_rate(const lks_world* world) {
    return world == nullptr ? 0 : world->rate.ticks_per_second;
}

uint32_t lks_world_substeps(const lks_world* world) {
    return world == nullptr ? 0 : world->rate.substeps;
}

uint32_t lks_world_iterations(const lks_world* world) {
    return world == nullptr ? 0 : world->rate.iterations;
}

lks_result lks_world_set_gravity(lks_world* world, lks_vec3 gravity) {
    if (world == nullptr) {
        return LKS_ERROR_NULL_ARGUMENT;
    }
    if (!within(gravity, gravity_limit)) {
        return world->fail(LKS_ERROR_INVALID_ARGUMENT,
                           out_of_range("gravity", gravity, "m/s²", gravity_limit));
    }
    if (!(world->gravity == to_vec3(gravity))) {
        wake_all(world->rigid);
    }
    world->gravity = to_vec3(gravity);
    return LKS_OK;
}

lks_result lks_world_gravity(const lks_world* world, lks_vec3* gravity) {
    if (world == nullptr) {
        return LKS_ERROR_NULL_ARGUMENT;
    }
    if (gravity == nullptr) {
        return world->fail(LKS_ERROR_NULL_ARGUMENT, null_argument("lks_world_gravity", "gravity"));
    }
    *gravity = from_vec3(world->gravity);
    return LKS_OK;
}

lks_result lks_world_get_counters(const lks_world* world, lks_world_counters* counters) {
    if (world == nullptr) {
        return LKS_ERROR_NULL_ARGUMENT;
    }
    if (counters == nullptr) {
        return world->fail(LKS_ERROR_NULL_ARGUMENT, null_argument("lks_world_get_counters", "counters"));
    }
    *counters = world->counters;
    return LKS_OK;
}

lks_fixed lks_world_speed_limit(const lks_world* world) {
    return world == nullptr ? 0 : velocity_from_motion(world->rate, world->rate.motion_limit);
}

} // extern "C"
