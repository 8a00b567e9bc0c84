#include "program/messages.h"

#include <algorithm>
#include <cstdio>

#include "scenes/nearest_name.h"
#include "scenes/scene.h"

namespace lks_program {

int complain(const std::string& sentence, int code) {
    std::fprintf(stderr, "lockstitch: %s\n", sentence.c_str());
    return code;
}

bool resolve_scenes(const std::vector<std::string>& wanted, std::vector<std::string>& scenes) {
    const std::vector<std::string>& known = lks_demo::scene_names();
    for (const std::string& name : wanted) {
        if (std::find(known.begin(), known.end(), name) == known.end()) {
            complain("There is no scene '" + name + "'" + lks_demo::did_you_mean(name, known) +
                         " `lockstitch list` shows all.",
                     exit_usage);
            return false;
        }
    }
    scenes = wanted.empty() ? known : wanted;
    return true;
}

} // namespace lks_program
