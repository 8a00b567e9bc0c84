// Demo scenes for tests: made and stepped, or the test fails.
#pragma once

#include <doctest/doctest.h>

#include <memory>
#include <string>

#include "scenes/scene.h"

namespace support {

inline std::unique_ptr<lks_demo::Scene> make_scene(const std::string& name) {
    std::string error;
    std::unique_ptr<lks_demo::Scene> scene = lks_demo::create_scene(name, {}, error);
    REQUIRE_MESSAGE(scene != nullptr, error);
    return scene;
}

inline void step(lks_demo::Scene& scene) {
    std::string error;
    REQUIRE_MESSAGE(scene.step(error), error);
}

} // namespace support
