// In place of render.cpp and golden_pictures.cpp where the program was built without a renderer.
#include "program/commands.h"
#include "program/golden_pictures.h"
#include "program/messages.h"

namespace lks_program {

int render(const RenderOptions&) {
    return complain("This build has no renderer; configure it with -DLOCKSTITCH_RENDER=ON.", exit_failed);
}

std::unique_ptr<GoldenPictures> GoldenPictures::create(const GoldenOptions&, const std::string&,
                                                       std::string& error) {
    error = "This build has no renderer; use --states-only, or configure it with -DLOCKSTITCH_RENDER=ON.";
    return nullptr;
}

} // namespace lks_program
