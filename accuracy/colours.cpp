#include "colours.h"

#include <utility>

namespace lks_accuracy {

std::string colour_of(const std::string& solver) {
    static const std::pair<const char*, const char*> colours[] = {
        {"fixed-point", "#08519c"},
        {"fixed-point, at once", "#00a6c8"},
        {"fixed-point, tethers", "#00a6c8"},
        {"float32, tethers", "#b30000"},
        {"double, tethers", "#252525"},
        {"float32", "#fd8d3c"},
        {"float32, at once", "#b30000"},
        {"double", "#969696"},
        {"double, at once", "#252525"},
        {"PBD", "#54278f"},
        {"PBD, scaled", "#9e9ac8"},
        {"Bullet", "#31a354"},
        {"Newton", "#000000"},
        {"XPBD", "#4292c6"},
    };
    for (const auto& [name, colour] : colours) {
        if (solver == name) {
            return colour;
        }
    }
    return "#c51b8a";
}

std::string line_colour_of(const std::string& solver) {
    return " lc rgb '" + colour_of(solver) + "'";
}

} // namespace lks_accuracy
