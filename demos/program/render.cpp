#include <lockstitch/lockstitch.h>

#include <cstdio>
#include <filesystem>

#include "program/commands.h"
#include "program/frame_from_scene.h"
#include "program/frame_times.h"
#include "program/messages.h"
#include "program/progress.h"
#include "render/renderer.h"

namespace lks_program {
namespace {

// A film drops no time, however few pictures a second it has.
constexpr std::uint32_t most_ticks_per_frame = 10000;

bool parse_size(const std::string& text, int& width, int& height) {
    char rest = 0;
    return std::sscanf(text.c_str(), "%dx%d%c", &width, &height, &rest) == 2 && width >= 16 && height >= 16 &&
           width <= 8192 && height <= 8192;
}

std::string file_name(const std::filesystem::path& folder, std::uint32_t frame) {
    char name[16];
    std::snprintf(name, sizeof(name), "%04u.png", frame);
    return (folder / name).string();
}

class SceneRenderer {
public:
    SceneRenderer(const RenderOptions& options, render::Renderer& renderer)
        : options_(options), renderer_(renderer) {}

    bool run(const std::string& name, std::string& error) {
        lks_demo::SceneOptions scene_options;
        scene_options.max_ticks_per_advance = most_ticks_per_frame;
        const std::unique_ptr<lks_demo::Scene> scene = lks_demo::create_scene(name, scene_options, error);
        if (scene == nullptr) {
            return false;
        }
        const std::filesystem::path folder = std::filesystem::path(options_.out) / name;
        std::error_code failure;
        std::filesystem::create_directories(folder, failure);
        if (failure) {
            error = "The folder " + folder.string() + " can't be made: " + failure.message() + ".";
            return false;
        }
        const std::uint32_t ticks = options_.ticks != 0 ? options_.ticks : scene->info().default_ticks;
        const std::uint32_t tick_rate = lks_world_tick_rate(scene->world());
        const std::uint64_t frames = std::uint64_t{ticks} * options_.frames_per_second / tick_rate + 1;
        // Where every picture falls on a tick, that tick is shown; else the place between two.
        whole_ticks_ = tick_rate % options_.frames_per_second == 0;
        FrameTimes times = FrameTimes::at_rate(options_.frames_per_second);
        Progress progress(name, frames);
        for (std::uint32_t frame = 0; frame < frames; ++frame) {
            // The first picture is of the start, before any tick.
            if (frame > 0 && !scene->advance(times.next(), error)) {
                return false;
            }
            if (!draw(*scene, file_name(folder, frame), error)) {
                return false;
            }
            progress.update(frame + 1);
        }
        std::printf("%s: %llu pictures in %s\n", name.c_str(), static_cast<unsigned long long>(frames),
                    folder.string().c_str());
        std::fflush(stdout);
        return true;
    }

private:
    bool draw(lks_demo::Scene& scene, const std::string& path, std::string& error) {
        render::Frame frame;
        render::Image image;
        const std::uint32_t interpolation =
            whole_ticks_ ? LKS_VIEW_LAST_TICK : lks_world_interpolation(scene.world());
        return make_frame(scene, interpolation, frame, error) && renderer_.draw(frame, image, error) &&
               render::write_png(path, image, error);
    }

    const RenderOptions& options_;
    render::Renderer& renderer_;
    bool whole_ticks_ = false;
};

} // namespace

int render(const RenderOptions& options) {
    if (options.scenes.empty() != options.all) {
        return complain("Name the scenes to render, or use --all.", exit_usage);
    }
    std::vector<std::string> scenes;
    if (!resolve_scenes(options.scenes, scenes)) {
        return exit_usage;
    }
    render::RendererOptions renderer_options;
    if (!parse_size(options.size, renderer_options.width, renderer_options.height)) {
        return complain("--size '" + options.size + "' is not WIDTHxHEIGHT with sides from 16 to 8192.",
                        exit_usage);
    }
    renderer_options.road = *render::gl_road_from_name(options.gl);
    std::string error;
    const auto renderer = render::Renderer::create(renderer_options, error);
    if (renderer == nullptr) {
        return complain(error, exit_failed);
    }
    SceneRenderer scene_renderer(options, *renderer);
    for (const std::string& scene : scenes) {
        if (!scene_renderer.run(scene, error)) {
            return complain(error, exit_failed);
        }
    }
    return 0;
}

} // namespace lks_program
