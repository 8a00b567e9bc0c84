#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "program/commands.h"
#include "program/golden_pictures.h"
#include "program/golden_run.h"
#include "program/machine_options.h"
#include "program/messages.h"

namespace lks_program {
namespace {

bool read_file(const std::filesystem::path& path, std::string& text) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream all;
    all << file.rdbuf();
    text = all.str();
    return static_cast<bool>(file);
}

enum class StateOutcome { as_expected, different, missing };

class Check {
public:
    Check(const GoldenOptions& options, const lks_demo::SceneOptions& scene_options,
          const std::string& golden, GoldenPictures* pictures)
        : options_(options), scene_options_(scene_options), golden_(golden), pictures_(pictures) {}

    void check_scene(const std::string& name) {
        std::vector<PictureResult> pictures;
        std::function<bool(lks_demo::Scene&, std::string&)> picture;
        if (pictures_ != nullptr) {
            picture = [&](lks_demo::Scene& scene, std::string&) {
                pictures.push_back(pictures_->check(scene));
                return true;
            };
        }
        lks_golden::GoldenState actual;
        std::string error;
        if (!run_golden(name, scene_options_, picture, actual, error)) {
            fail(name, error);
            return;
        }
        const StateOutcome state = check_state(name, actual);
        for (const PictureResult& result : pictures) {
            report_picture(result, state);
        }
        all_pictures_.insert(all_pictures_.end(), pictures.begin(), pictures.end());
    }

    int finish() {
        if (pictures_ != nullptr) {
            if (const std::string page = pictures_->write_report(all_pictures_); !page.empty()) {
                std::printf("The pictures that differ are side by side in %s\n", page.c_str());
            }
        }
        std::printf("check: %u states and %u images as expected, %u failed\n", good_states_, good_images_,
                    failures_);
        return failures_ == 0 ? 0 : exit_failed;
    }

private:
    void fail(const std::string& scene, const std::string& sentence) {
        ++failures_;
        std::printf("FAIL %s: %s\n", scene.c_str(), sentence.c_str());
        std::fflush(stdout);
    }

    // The state is compared also where only images are asked for: it tells what a changed picture means.
    StateOutcome check_state(const std::string& name, const lks_golden::GoldenState& actual) {
        const std::filesystem::path path = std::filesystem::path(golden_) / "states" / (name + ".txt");
        std::string text;
        if (!read_file(path, text)) {
            if (!options_.images_only) {
                fail(name, "there is no golden state " + path.string() + "; `lockstitch bless " + name +
                               (options_.golden.empty() ? "" : " --golden " + golden_) + "` makes it");
            }
            return StateOutcome::missing;
        }
        const std::vector<std::string> found = lks_golden::differences(text, actual);
        const StateOutcome outcome = found.empty() ? StateOutcome::as_expected : StateOutcome::different;
        if (options_.images_only) {
            return outcome;
        }
        for (const std::string& sentence : found) {
            std::printf("     %s\n", sentence.c_str());
        }
        if (found.empty()) {
            ++good_states_;
            std::printf("ok   %s: state\n", name.c_str());
        } else {
            fail(name, "the simulation's state differs from its golden state");
        }
        return outcome;
    }

    void report_picture(const PictureResult& result, StateOutcome state) {
        const std::string tick = "image at tick " + std::to_string(result.tick);
        if (result.outcome == PictureOutcome::as_expected) {
            ++good_images_;
            std::printf("ok   %s: %s, %s\n", result.scene.c_str(), tick.c_str(), result.sentence.c_str());
            return;
        }
        if (result.outcome == PictureOutcome::not_compared) {
            fail(result.scene, tick + ": " + result.sentence);
            return;
        }
        fail(result.scene, tick + ": " + result.sentence + ". " + meaning_of(state));
    }

    // Of a picture that differs.
    static const char* meaning_of(StateOutcome state) {
        switch (state) {
        case StateOutcome::as_expected:
            return "The rendering changed, the simulation did not: the state is golden.";
        case StateOutcome::different:
            return "The state differs too: the simulation changed.";
        case StateOutcome::missing:
            break;
        }
        return "There is no golden state to tell whether the simulation changed.";
    }

    const GoldenOptions& options_;
    const lks_demo::SceneOptions& scene_options_;
    std::string golden_;
    GoldenPictures* pictures_;
    std::vector<PictureResult> all_pictures_;
    unsigned good_states_ = 0;
    unsigned good_images_ = 0;
    unsigned failures_ = 0;
};

} // namespace

int check(const GoldenOptions& options) {
    std::vector<std::string> scenes;
    lks_demo::SceneOptions scene_options;
    if (!resolve_scenes(options.scenes, scenes) || !resolve_machine(options.machine, scene_options)) {
        return exit_usage;
    }
    const std::string golden = find_golden(options);
    if (!std::filesystem::is_directory(golden)) {
        return complain("There is no folder '" + golden + "' with golden states and images.", exit_usage);
    }
    std::unique_ptr<GoldenPictures> pictures;
    std::string error;
    if (!options.states_only) {
        pictures = GoldenPictures::create(options, golden, error);
        if (pictures == nullptr) {
            return complain(error, exit_failed);
        }
    }
    Check work(options, scene_options, golden, pictures.get());
    for (const std::string& scene : scenes) {
        work.check_scene(scene);
    }
    return work.finish();
}

} // namespace lks_program
