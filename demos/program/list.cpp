#include <cstdio>

#include "program/commands.h"
#include "scenes/scene.h"

namespace lks_program {

int list(const ListOptions& options) {
    const char* separator = "[";
    for (const std::string& name : lks_demo::scene_names()) {
        const lks_demo::SceneInfo& info = *lks_demo::find_scene_info(name);
        if (options.json) {
            std::printf("%s{\"name\": \"%s\", \"title\": \"%s\", \"ticks\": %u}", separator, info.name,
                        info.title, info.default_ticks);
            separator = ",\n ";
        } else {
            std::printf("%-15s %s\n", info.name, info.title);
        }
    }
    if (options.json) {
        std::printf("]\n");
    }
    return 0;
}

} // namespace lks_program
