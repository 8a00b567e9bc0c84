#include "program/machine_options.h"

#include <lockstitch/lockstitch.h>

#include <cstdio>
#include <cstdlib>

#include "program/messages.h"
#include "scenes/nearest_name.h"

namespace lks_program {
namespace {

enum class Found { here, elsewhere, nowhere };

// Whether there is an instruction set of this name, and those that there are here.
Found find_simd(const std::string& name, lks_simd& simd, std::vector<std::string>& names) {
    Found found = Found::nowhere;
    for (int level = LKS_SIMD_AUTO; level <= LKS_SIMD_WASM; ++level) {
        const auto candidate = static_cast<lks_simd>(level);
        const bool here = lks_simd_is_available(candidate) != 0;
        if (here) {
            names.emplace_back(lks_simd_name(candidate));
        }
        if (name == lks_simd_name(candidate)) {
            found = here ? Found::here : Found::elsewhere;
            simd = candidate;
        }
    }
    return found;
}

// "Here are auto, scalar and avx2."
std::string say_all(const std::vector<std::string>& names) {
    std::string text = "Here are ";
    for (std::size_t i = 0; i < names.size(); ++i) {
        text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
    }
    return text + ".";
}

// False, with the complaint printed: there is no such instruction set, here or at all.
bool resolve_simd(const std::string& name, lks_simd& simd) {
    std::vector<std::string> names;
    const Found found = find_simd(name, simd, names);
    if (found == Found::elsewhere) {
        complain("--simd '" + name + "' is not available on this processor or in this build.", exit_usage);
    } else if (found == Found::nowhere) {
        complain("There is no --simd '" + name + "'" + lks_demo::did_you_mean(name, names) + " " +
                     say_all(names),
                 exit_usage);
    }
    return found == Found::here;
}

} // namespace

bool resolve_machine(const MachineOptions& options, lks_demo::SceneOptions& scene) {
    scene.worker_count = options.workers;
    return options.simd.empty() || resolve_simd(options.simd, scene.simd);
}

void warn_of_environment() {
    const char* value = std::getenv("LOCKSTITCH_SIMD");
    if (value == nullptr || *value == '\0') {
        return;
    }
    const std::string name = value;
    lks_simd simd = LKS_SIMD_AUTO;
    std::vector<std::string> names;
    const Found found = find_simd(name, simd, names);
    const std::string ignored = "LOCKSTITCH_SIMD in the environment is ignored: ";
    if (found == Found::elsewhere) {
        complain(ignored + "'" + name + "' is not available on this processor or in this build.", 0);
    } else if (found == Found::nowhere) {
        complain(ignored + "there is no '" + name + "'" + lks_demo::did_you_mean(name, names) + " " +
                     say_all(names),
                 0);
    }
}

void tell_instruction_set(const lks_world* world) {
    std::fprintf(stderr, "instruction set: %s\n", lks_simd_name(lks_world_simd(world)));
}

} // namespace lks_program
