#include <cstdio>
#include <filesystem>
#include <fstream>

#include "program/commands.h"
#include "program/golden_pictures.h"
#include "program/golden_run.h"
#include "program/machine_options.h"
#include "program/messages.h"

namespace lks_program {
namespace {

bool write_state(const std::string& golden, const lks_golden::GoldenState& state, std::string& error) {
    const std::filesystem::path folder = std::filesystem::path(golden) / "states";
    std::error_code failure;
    std::filesystem::create_directories(folder, failure);
    const std::filesystem::path path = folder / (state.scene + ".txt");
    std::ofstream file(path, std::ios::binary);
    file << lks_golden::to_text(state);
    file.close();
    if (!file) {
        error = "The golden state " + path.string() + " can't be written.";
    }
    return static_cast<bool>(file);
}

} // namespace

int bless(const GoldenOptions& options) {
    std::vector<std::string> scenes;
    lks_demo::SceneOptions scene_options;
    if (!resolve_scenes(options.scenes, scenes) || !resolve_machine(options.machine, scene_options)) {
        return exit_usage;
    }
    const std::string golden = find_golden(options);
    std::unique_ptr<GoldenPictures> pictures;
    std::string error;
    if (!options.states_only) {
        pictures = GoldenPictures::create(options, golden, error);
        if (pictures == nullptr) {
            return complain(error, exit_failed);
        }
    }
    std::function<bool(lks_demo::Scene&, std::string&)> picture;
    if (pictures != nullptr) {
        picture = [&pictures](lks_demo::Scene& scene, std::string& why) {
            return pictures->bless(scene, why);
        };
    }
    for (const std::string& scene : scenes) {
        lks_golden::GoldenState state;
        if (!run_golden(scene, scene_options, picture, state, error) ||
            (!options.images_only && !write_state(golden, state, error))) {
            return complain(error, exit_failed);
        }
        std::printf("blessed %s\n", scene.c_str());
        std::fflush(stdout);
    }
    std::printf("Look at the difference with git before you commit it: %s\n", golden.c_str());
    return 0;
}

} // namespace lks_program
