#include "scenes/nearest_name.h"

#include <algorithm>
#include <cstddef>

namespace lks_demo {
namespace {

std::string in_small_letters(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return text;
}

// The optimal string alignment distance, by rows; capital letters are as small ones.
std::size_t edit_distance(const std::string& wanted, const std::string& name) {
    const std::string a = in_small_letters(wanted);
    const std::string b = in_small_letters(name);
    std::vector<std::size_t> before_last;
    std::vector<std::size_t> last;
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) {
        row[j] = j;
    }
    for (std::size_t i = 1; i <= a.size(); ++i) {
        before_last = last;
        last = row;
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const bool same = a[i - 1] == b[j - 1];
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0u : 1u)});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
                row[j] = std::min(row[j], before_last[j - 2] + 1);
            }
        }
    }
    return row[b.size()];
}

} // namespace

std::string nearest_name(const std::string& wanted, const std::vector<std::string>& names) {
    const auto nearer = [&wanted](const std::string& a, const std::string& b) {
        return edit_distance(wanted, a) < edit_distance(wanted, b);
    };
    const auto nearest = std::min_element(names.begin(), names.end(), nearer);
    const bool near = nearest != names.end() &&
                      2 * edit_distance(wanted, *nearest) <= std::max(wanted.size(), nearest->size());
    return near ? *nearest : std::string();
}

std::string did_you_mean(const std::string& wanted, const std::vector<std::string>& names) {
    const std::string nearest = nearest_name(wanted, names);
    return nearest.empty() ? std::string(".") : "; did you mean '" + nearest + "'?";
}

} // namespace lks_demo
