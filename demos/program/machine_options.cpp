#include "program/machine_options.h"

#include <lockstitch/lockstitch.h>

#include "program/messages.h"
#include "scenes/nearest_name.h"

namespace lks_program {
namespace {

// False, with the complaint printed: there is no such instruction set, here or at all.
bool resolve_simd(const std::string& name, lks_simd& simd) {
    std::vector<std::string> names;
    for (int level = LKS_SIMD_AUTO; level <= LKS_SIMD_WASM; ++level) {
        const auto candidate = static_cast<lks_simd>(level);
        if (lks_simd_is_available(candidate) == 0) {
            if (name == lks_simd_name(candidate)) {
                complain("--simd '" + name + "' is not available on this processor or in this build.",
                         exit_usage);
                return false;
            }
            continue;
        }
        if (name == lks_simd_name(candidate)) {
            simd = candidate;
            return true;
        }
        names.emplace_back(lks_simd_name(candidate));
    }
    complain("There is no --simd '" + name + "'; did you mean '" + lks_demo::nearest_name(name, names) + "'?",
             exit_usage);
    return false;
}

} // namespace

bool resolve_machine(const MachineOptions& options, lks_demo::SceneOptions& scene) {
    scene.worker_count = options.workers;
    return options.simd.empty() || resolve_simd(options.simd, scene.simd);
}

} // namespace lks_program
