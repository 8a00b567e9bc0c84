#include "program/golden_pictures.h"

#include <lockstitch/lockstitch.h>

#include <filesystem>
#include <fstream>
#include <map>

#include "program/frame_from_scene.h"
#include "render/image_compare.h"
#include "render/renderer.h"

namespace lks_program {
namespace {

namespace fs = std::filesystem;

constexpr int golden_width = 640;
constexpr int golden_height = 360;

// What the same renderer may change on another processor: llvmpipe takes estimates of reciprocals and roots,
// which makers of processors round differently.
constexpr render::Tolerance of_processors{1, 0, 60};

// Which renderer made which golden image: a line "IMAGE RENDERER" each, in the images' order.
class RendererNotes {
public:
    explicit RendererNotes(const fs::path& path) : path_(path) {
        std::ifstream file(path_);
        for (std::string line; std::getline(file, line);) {
            const std::size_t space = line.find(' ');
            if (space != std::string::npos && line[0] != '#') {
                makers_[line.substr(0, space)] = line.substr(space + 1, line.find('\r') - space - 1);
            }
        }
    }

    std::string maker_of(const std::string& image) const {
        const auto found = makers_.find(image);
        return found != makers_.end() ? found->second : std::string();
    }

    bool note(const std::string& image, const std::string& maker, std::string& error) {
        makers_[image] = maker;
        std::ofstream file(path_, std::ios::binary);
        file << "# Which renderer made which image: GL_RENDERER | GL_VERSION.\n";
        for (const auto& [name, renderer] : makers_) {
            file << name << ' ' << renderer << '\n';
        }
        file.close();
        if (!file) {
            error = "The file " + path_.string() + " can't be written.";
        }
        return static_cast<bool>(file);
    }

private:
    fs::path path_;
    std::map<std::string, std::string> makers_;
};

class Pictures final : public GoldenPictures {
public:
    Pictures(std::unique_ptr<render::Renderer> renderer, const fs::path& images, const fs::path& out)
        : renderer_(std::move(renderer)), images_(images), out_(out) {}

    PictureResult check(lks_demo::Scene& scene) override {
        PictureResult result;
        result.scene = scene.info().name;
        result.tick = lks_world_tick(scene.world());
        render::Image actual;
        render::Image expected;
        const fs::path golden = images_ / file_name(scene);
        if (!draw(scene, actual, result.sentence) ||
            !render::read_png(golden.string(), expected, result.sentence)) {
            return result;
        }
        const bool same_renderer = renderers_.maker_of(file_name(scene)) == renderer_line();
        const render::Tolerance tolerance = same_renderer ? of_processors : render::Tolerance{};
        const render::ImageDifference difference = render::compare_images(expected, actual, tolerance);
        const bool good = difference.within(tolerance);
        result.outcome = good ? PictureOutcome::as_expected : PictureOutcome::different;
        result.sentence = difference.identical() ? "identical" : difference.sentence(tolerance);
        if (good && !same_renderer) {
            result.sentence += " (another renderer than the golden image's)";
        } else if (!good) {
            result.sentence += same_renderer ? "; more than another processor may change"
                                             : "; more than another renderer may change";
            keep_failure(scene, expected, actual);
        }
        return result;
    }

    bool bless(lks_demo::Scene& scene, std::string& error) override {
        render::Image image;
        return make_folder(images_, error) && draw(scene, image, error) &&
               render::write_png((images_ / file_name(scene)).string(), image, error) &&
               renderers_.note(file_name(scene), renderer_line(), error);
    }

    std::string write_report(const std::vector<PictureResult>& results) override {
        std::ofstream page;
        for (const PictureResult& result : results) {
            if (result.outcome != PictureOutcome::different) {
                continue;
            }
            if (!page.is_open()) {
                std::error_code ignored;
                fs::create_directories(out_, ignored);
                page.open(out_ / "index.html");
                page << "<!doctype html><meta charset=\"utf-8\"><title>Golden images that differ</title>\n"
                        "<style>body{font:16px sans-serif;margin:2em}img{width:32%;border:1px solid "
                        "#888}</style>\n"
                        "<h1>Golden images that differ</h1><p>From left to right: expected, actual, "
                        "difference (amplified).</p>\n";
            }
            const std::string stem = result.scene + "-" + std::to_string(result.tick);
            page << "<h2>" << result.scene << ", tick " << result.tick << "</h2><p>" << result.sentence
                 << "</p>\n";
            for (const char* kind : {"expected", "actual", "difference"}) {
                page << "<img src=\"" << stem << "-" << kind << ".png\" alt=\"" << kind << "\">\n";
            }
        }
        return page.is_open() ? (out_ / "index.html").string() : std::string();
    }

private:
    static std::string file_name(lks_demo::Scene& scene) {
        return std::string(scene.info().name) + "-" + std::to_string(lks_world_tick(scene.world())) + ".png";
    }

    static bool make_folder(const fs::path& folder, std::string& error) {
        std::error_code failure;
        fs::create_directories(folder, failure);
        if (failure) {
            error = "The folder " + folder.string() + " can't be made: " + failure.message() + ".";
        }
        return !failure;
    }

    std::string renderer_line() const {
        return renderer_->info().renderer + " | " + renderer_->info().version;
    }

    bool draw(lks_demo::Scene& scene, render::Image& image, std::string& error) {
        render::Frame frame;
        return make_frame(scene, LKS_VIEW_LAST_TICK, frame, error) && renderer_->draw(frame, image, error);
    }

    void keep_failure(lks_demo::Scene& scene, const render::Image& expected, const render::Image& actual) {
        std::string ignored;
        if (!make_folder(out_, ignored)) {
            return;
        }
        const std::string stem =
            std::string(scene.info().name) + "-" + std::to_string(lks_world_tick(scene.world()));
        render::write_png((out_ / (stem + "-expected.png")).string(), expected, ignored);
        render::write_png((out_ / (stem + "-actual.png")).string(), actual, ignored);
        render::write_png((out_ / (stem + "-difference.png")).string(),
                          render::difference_image(expected, actual), ignored);
    }

    std::unique_ptr<render::Renderer> renderer_;
    fs::path images_;
    fs::path out_;
    RendererNotes renderers_{images_ / "renderer.txt"};
};

} // namespace

std::unique_ptr<GoldenPictures> GoldenPictures::create(const GoldenOptions& options,
                                                       const std::string& golden, std::string& error) {
    render::RendererOptions renderer_options;
    renderer_options.width = golden_width;
    renderer_options.height = golden_height;
    renderer_options.road = *render::gl_road_from_name(options.gl);
    auto renderer = render::Renderer::create(renderer_options, error);
    if (renderer == nullptr) {
        return nullptr;
    }
    return std::make_unique<Pictures>(std::move(renderer), fs::path(golden) / "images", options.out);
}

} // namespace lks_program
