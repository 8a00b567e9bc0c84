// The golden scenes on one to eight threads, with helpers that begin after naps of random length and kernels
// that sleep now and then: what a tick is made of goes to whoever comes first, and the states are the golden
// ones all the same. LOCKSTITCH_EVERY_SCHEDULE=1 (`./test.sh --portability`, as CI runs it) takes each scene
// on each number of threads; otherwise each scene is taken on two of them, and each number by a quarter of
// the scenes.
#include <doctest/doctest.h>

#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "golden/recorder.h"
#include "scenes/scene.h"
#include "solver/world.h"
#include "support/task_system.h"
#include "unit/dawdling.h"

using namespace support;

namespace {

std::string golden_text(const std::string& scene) {
    std::ifstream file(LOCKSTITCH_GOLDEN_FOLDER "/states/" + scene + ".txt", std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

lks_golden::GoldenState run(const std::string& name, const lks_demo::SceneOptions& options) {
    std::string error;
    const std::unique_ptr<lks_demo::Scene> scene = lks_demo::create_scene(name, options, error);
    REQUIRE_MESSAGE(scene != nullptr, error);
    scene->world()->kernels = &lks::test::dawdling();
    lks_golden::GoldenState state;
    REQUIRE_MESSAGE(lks_golden::record_run(*scene, {}, state, error), error);
    return state;
}

bool every_schedule() {
    const char* value = std::getenv("LOCKSTITCH_EVERY_SCHEDULE");
    return value != nullptr && std::string(value) == "1";
}

} // namespace

TEST_CASE(
    "golden states come out of one to eight threads, however late they are and whoever takes which block") {
    const bool every = every_schedule();
    const std::vector<std::string>& names = lks_demo::scene_names();
    std::uint64_t tasks = 0;
    for (std::uint32_t workers = 1; workers <= 8; ++workers) {
        for (std::size_t index = 0; index < names.size(); ++index) {
            if (!every && (workers + index) % 4 != 0) {
                continue;
            }
            const std::string& name = names[index];
            TaskSystem system(Temper::threads, 100 + workers);
            lks_demo::SceneOptions options;
            options.worker_count = workers;
            options.tasks = system.interface();
            const std::vector<std::string> different =
                lks_golden::differences(golden_text(name), run(name, options));
            INFO(name, " on ", workers);
            CHECK_MESSAGE(different.empty(), different.front());
            CHECK(system.all_awaited());
            tasks += system.tasks();
        }
    }
    CHECK(tasks > 10'000);
}
