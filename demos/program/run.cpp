#include <lockstitch/lockstitch.h>

#include <cstdio>
#include <optional>

#include "golden/text.h"
#include "program/commands.h"
#include "program/frame_times.h"
#include "program/machine_options.h"
#include "program/messages.h"
#include "program/progress.h"
#include "scenes/scene.h"

namespace lks_program {
namespace {

// Prints the hashes of those ticks that are asked for, as lines or as JSON.
class HashPrinter {
public:
    HashPrinter(const RunOptions& options, std::uint32_t last) : options_(options), last_(last) {
        if (options_.json) {
            std::printf("{\"scene\": \"%s\",\n \"ticks\": [", options_.scene.c_str());
        }
    }

    void print(const lks_world* world) {
        const std::uint64_t tick = lks_world_tick(world);
        const bool wanted = tick == last_ || (options_.hash_every != 0 && tick % options_.hash_every == 0);
        if (!wanted || tick > last_ || tick == printed_) {
            return;
        }
        printed_ = tick;
        const std::string state = lks_golden::hexadecimal(lks_world_hash(world));
        const std::string local = lks_golden::hexadecimal(lks_world_local_hash(world));
        if (options_.json) {
            std::printf("%s{\"tick\": %llu, \"state\": \"%s\", \"local\": \"%s\"}", separator_,
                        static_cast<unsigned long long>(tick), state.c_str(), local.c_str());
            separator_ = ",\n           ";
        } else {
            std::printf("tick %llu state %s local %s\n", static_cast<unsigned long long>(tick), state.c_str(),
                        local.c_str());
        }
    }

    void finish(const lks_world* world) const {
        lks_world_counters counters{};
        lks_world_get_counters(world, &counters);
        if (options_.json) {
            std::printf("]");
            print_count("position_clamps", counters.position_clamps);
            print_count("speed_clamps", counters.speed_clamps);
            print_count("target_clamps", counters.target_clamps);
            print_count("world_edge_hits", counters.world_edge_hits);
            print_count("dropped_ticks", counters.dropped_ticks);
            print_count("lost_contacts", counters.lost_contacts);
            print_count("lost_events", counters.lost_events);
            std::printf("}\n");
        }
    }

private:
    static void print_count(const char* name, std::uint64_t count) {
        std::printf(",\n \"%s\": %llu", name, static_cast<unsigned long long>(count));
    }

    const RunOptions& options_;
    std::uint64_t last_;
    std::uint64_t printed_ = ~std::uint64_t{0};
    const char* separator_ = "";
};

// Runs the world to the last tick: tick by tick, or frame by frame through its clock.
int run_world(lks_demo::Scene& scene, std::optional<FrameTimes>& frames, std::uint32_t last,
              HashPrinter& printer) {
    Progress progress(scene.info().name, last);
    lks_world* world = scene.world();
    // Between two ticks of one frame the world is only seen from inside: before the next tick's inputs.
    scene.before_inputs = [&printer](const lks_world* seen) { printer.print(seen); };
    while (lks_world_tick(world) < last) {
        std::string error;
        if (!(frames ? scene.advance(frames->next(), error) : scene.step(error))) {
            return complain(error, exit_failed);
        }
        printer.print(world);
        progress.update(lks_world_tick(world));
    }
    scene.before_inputs = nullptr;
    return 0;
}

} // namespace

int run(const RunOptions& options) {
    std::vector<std::string> known;
    if (!resolve_scenes({options.scene}, known)) {
        return exit_usage;
    }
    lks_demo::SceneOptions scene_options;
    if (!options.offset_km.empty() &&
        !lks_golden::parse_decimal(options.offset_km, 1000, scene_options.offset.x)) {
        return complain("--offset-km '" + options.offset_km +
                            "' is not a number of kilometres from -8388 to 8388.",
                        exit_usage);
    }
    if (!resolve_machine(options.machine, scene_options)) {
        return exit_usage;
    }
    std::optional<FrameTimes> frames;
    std::string error;
    if (options.frame_rate != 0) {
        frames = FrameTimes::at_rate(options.frame_rate);
    } else if (!options.schedule.empty()) {
        frames.emplace(FrameTimes::at_rate(1));
        if (!FrameTimes::from_file(options.schedule, *frames, error)) {
            return complain(error, exit_usage);
        }
    }
    const std::unique_ptr<lks_demo::Scene> scene =
        lks_demo::create_scene(options.scene, scene_options, error);
    if (scene == nullptr) {
        return complain(error, exit_failed);
    }
    tell_instruction_set(scene->world());
    const std::uint32_t last = options.ticks != 0 ? options.ticks : scene->info().default_ticks;
    HashPrinter printer(options, last);
    printer.print(scene->world());
    const int code = run_world(*scene, frames, last, printer);
    if (code == 0) {
        printer.finish(scene->world());
    }
    return code;
}

} // namespace lks_program
