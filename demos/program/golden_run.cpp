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
    const auto after_tick = [&](std::uint32_t tick, std::string& complaint) {
        const bool wanted = std::count(info.image_ticks.begin(), info.image_ticks.end(), tick) != 0;
        if (wanted && picture && !picture(*scene, complaint)) {
            return false;
        }
        progress.update(tick);
        return true;
    };
    return lks_golden::record_run(*scene, after_tick, state, error);
}

} // namespace lks_program
