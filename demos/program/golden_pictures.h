// Golden images of scenes: drawing, keeping, comparing.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "program/commands.h"
#include "scenes/scene.h"

namespace lks_program {

enum class PictureOutcome {
    as_expected,
    different,
    not_compared // it can't be drawn, or there is no golden image
};

// What a picture's comparison came to.
struct PictureResult {
    PictureOutcome outcome = PictureOutcome::not_compared;
    std::string scene;
    std::uint64_t tick = 0;
    std::string sentence; // what differs, or how far the picture is from the golden one
};

class GoldenPictures {
public:
    // `golden` is the folder with images/ in it. Null, with a sentence, where nothing can be drawn.
    static std::unique_ptr<GoldenPictures> create(const GoldenOptions& options, const std::string& golden,
                                                  std::string& error);
    virtual ~GoldenPictures() = default;

    // Draws the scene as it is now and compares it with its golden image; a failure leaves expected, actual
    // and amplified difference in the output folder.
    virtual PictureResult check(lks_demo::Scene& scene) = 0;
    // Draws the scene as it is now and keeps it as the golden image.
    virtual bool bless(lks_demo::Scene& scene, std::string& error) = 0;
    // An HTML page of the failures, if there are any; its path, or nothing.
    virtual std::string write_report(const std::vector<PictureResult>& results) = 0;
};

} // namespace lks_program
