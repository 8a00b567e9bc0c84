#include "program/golden_run.h"

#include <lockstitch/lockstitch.h>

#include <algorithm>
#include <filesystem>

#include "golden/recorder.h"
#include "program/progress.h"

namespace lks_program {

std::string find_golden(const GoldenOptions& options) {
    if (!options.golden.empty()) {
        return options.golden;
    }
    return std::filesystem::is_directory("golden/states") ? std::string("golden")
                                                          : std::string(LOCKSTITCH_GOLDEN_FOLDER);
}

bool run_golden(const std::string& name, const lks_demo::SceneOptions& options,
                const std::function<bool(lks_demo::Scene&, std::string&)>& picture,
                lks_golden::GoldenState& state, std::string& error) {
    const std::unique_ptr<lks_demo::Scene> scene = lks_demo::create_scene(name, options, error);
    if (scene == nullptr) {
        return false;
    }
    const lks_demo::SceneInfo& info = scene->info();
    Progress progress(name, info.golden_ticks);
    lks_golden::Recorder recorder(*scene);
    for (std::uint32_t tick = 1; tick <= info.golden_ticks; ++tick) {
        if (!scene->step(error)) {
            return false;
        }
        recorder.record_tick();
        const bool wanted = std::count(info.image_ticks.begin(), info.image_ticks.end(), tick) != 0;
        if (wanted && picture && !picture(*scene, error)) {
            return false;
        }
        progress.update(tick);
    }
    recorder.record_points();
    state = recorder.state();
    return true;
}

} // namespace lks_program
