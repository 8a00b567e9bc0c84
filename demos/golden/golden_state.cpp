#include "golden/golden_state.h"

#include <lockstitch/lockstitch.h>

#include <algorithm>
#include <sstream>

#include "golden/text.h"

namespace lks_golden {
namespace {

constexpr const char* title = "lockstitch golden state";
constexpr std::size_t digests_a_line = 15; // the bones of a mannequin

class Parser {
public:
    Parser(const std::string& text, GoldenState& state) : text_(text), state_(state) {}

    bool run(std::string& error) {
        std::istringstream lines(text_);
        for (std::string line; std::getline(lines, line);) {
            ++number_;
            if (!line.empty() && line.back() == '\r') {
                line.pop_back();
            }
            if (line.empty() || line[0] == '#') {
                continue;
            }
            std::istringstream words(line);
            std::string word;
            words >> word;
            if (!parse_line(word, words, line)) {
                error = "Line " + std::to_string(number_) + " of the golden state " + reason_ + ": " + line;
                return false;
            }
        }
        if (!has_title_ || state_.scene.empty() || state_.ticks.empty()) {
            error = "The golden state is incomplete: it needs its title, a scene and ticks.";
            return false;
        }
        return true;
    }

private:
    bool parse_line(const std::string& word, std::istringstream& words, const std::string& line) {
        if (!has_title_) {
            has_title_ = line == std::string(title) + " " + std::to_string(format_version);
            return has_title_;
        }
        if (word == "scene") {
            return static_cast<bool>(words >> state_.scene);
        }
        if (word == "tick") {
            return parse_tick(words);
        }
        if (word == "point") {
            return parse_point(words);
        }
        if (word == "body") {
            return parse_body(words);
        }
        const std::size_t space = line.find(' ');
        if (space == std::string::npos || !state_.ticks.empty()) {
            return false;
        }
        state_.parameters.emplace_back(line.substr(0, space), line.substr(space + 1));
        return true;
    }

    bool parse_tick(std::istringstream& words) {
        std::uint64_t tick = 0;
        std::string kind;
        if (!(words >> tick >> kind)) {
            return false;
        }
        if (kind == "state") {
            std::string state;
            std::string word;
            std::string local;
            TickRecord record;
            record.tick = tick;
            words >> state >> word >> local;
            state_.ticks.push_back(record);
            return word == "local" && parse_hexadecimal(state, state_.ticks.back().state) &&
                   parse_hexadecimal(local, state_.ticks.back().local);
        }
        if (kind == "bodies") {
            return belongs(tick) && parse_bodies(words);
        }
        ObjectRecord object;
        std::string hash;
        if (kind != "object" || !(words >> object.index >> object.name >> hash) ||
            !parse_hexadecimal(hash, object.hash)) {
            return false;
        }
        if (!belongs(tick)) {
            return false;
        }
        state_.ticks.back().objects.push_back(object);
        return true;
    }

    bool belongs(std::uint64_t tick) {
        if (state_.ticks.empty() || state_.ticks.back().tick != tick) {
            reason_ = "names another tick than the state above it";
            return false;
        }
        return true;
    }

    bool parse_bodies(std::istringstream& words) {
        std::vector<std::uint32_t>& bodies = state_.ticks.back().bodies;
        std::size_t first = 0;
        if (!(words >> first) || first != bodies.size()) {
            return false;
        }
        for (std::string word; words >> word;) {
            std::uint64_t digest = 0;
            if (word.size() != 8 || !parse_hexadecimal("00000000" + word, digest)) {
                return false;
            }
            bodies.push_back(static_cast<std::uint32_t>(digest));
        }
        return bodies.size() > first;
    }

    bool parse_body(std::istringstream& words) {
        BodyRecord body;
        std::size_t index = 0;
        std::string word;
        std::string parts[7];
        if (!(words >> index >> body.name >> word >> parts[0] >> parts[1] >> parts[2]) || word != "metres" ||
            index != state_.bodies.size()) {
            return false;
        }
        if (!(words >> word >> parts[3] >> parts[4] >> parts[5] >> parts[6]) || word != "rotation") {
            return false;
        }
        body.metres = parts[0] + " " + parts[1] + " " + parts[2];
        body.rotation = parts[3] + " " + parts[4] + " " + parts[5] + " " + parts[6];
        state_.bodies.push_back(body);
        return true;
    }

    bool parse_point(std::istringstream& words) {
        PointRecord point;
        std::string word;
        std::string x;
        std::string y;
        std::string z;
        if (!(words >> point.object >> point.vertex >> word >> x >> y >> z) || word != "raw") {
            return false;
        }
        point.raw = x + " " + y + " " + z;
        if (!(words >> word >> x >> y >> z) || word != "metres") {
            return false;
        }
        point.metres = x + " " + y + " " + z;
        state_.points.push_back(point);
        return true;
    }

    const std::string& text_;
    GoldenState& state_;
    std::size_t number_ = 0;
    const char* reason_ = "makes no sense";
    bool has_title_ = false;
};

class Comparison {
public:
    Comparison(const GoldenState& expected, const GoldenState& actual, std::size_t limit)
        : expected_(expected), actual_(actual), limit_(limit) {}

    std::vector<std::string> run() {
        if (expected_.scene != actual_.scene) {
            add("name", expected_.scene, actual_.scene);
        }
        compare_parameters();
        compare_ticks();
        compare_points();
        compare_bodies();
        return sentences_;
    }

private:
    void add(const std::string& where, const std::string& expected, const std::string& actual) {
        if (sentences_.size() < limit_) {
            sentences_.push_back("scene " + expected_.scene + ", " + where + ": expected " + expected +
                                 ", got " + actual + ".");
        }
    }

    void compare_parameters() {
        for (const auto& [key, value] : expected_.parameters) {
            const auto found = std::find_if(actual_.parameters.begin(), actual_.parameters.end(),
                                            [&key = key](const auto& other) { return other.first == key; });
            if (found == actual_.parameters.end()) {
                add(key, value, "nothing");
            } else if (found->second != value) {
                add(key, value, found->second);
            }
        }
        if (expected_.parameters.size() < actual_.parameters.size()) {
            add("parameters", std::to_string(expected_.parameters.size()),
                std::to_string(actual_.parameters.size()));
        }
    }

    void compare_ticks() {
        for (const TickRecord& tick : expected_.ticks) {
            const std::string name = "tick " + std::to_string(tick.tick);
            const TickRecord* other = actual_.find_tick(tick.tick);
            if (other == nullptr) {
                add(name, "a record", "none");
                continue;
            }
            compare_objects(tick, *other, name);
            compare_digests(tick, *other, name);
            if (tick.local != other->local) {
                add(name + ", the world without its place", hexadecimal(tick.local),
                    hexadecimal(other->local));
            }
            if (tick.state != other->state) {
                add(name + ", the whole world", hexadecimal(tick.state), hexadecimal(other->state));
            }
        }
        if (expected_.ticks.size() < actual_.ticks.size()) {
            add("records of ticks", std::to_string(expected_.ticks.size()),
                std::to_string(actual_.ticks.size()));
        }
    }

    void compare_objects(const TickRecord& expected, const TickRecord& actual, const std::string& name) {
        for (std::size_t i = 0; i < std::max(expected.objects.size(), actual.objects.size()); ++i) {
            if (i >= expected.objects.size() || i >= actual.objects.size()) {
                add(name + ", objects", std::to_string(expected.objects.size()),
                    std::to_string(actual.objects.size()));
                return;
            }
            const ObjectRecord& e = expected.objects[i];
            const ObjectRecord& a = actual.objects[i];
            if (e.index != a.index || e.name != a.name || e.hash != a.hash) {
                const bool same_object = e.index == a.index && e.name == a.name;
                add(name + ", object " + std::to_string(e.index) + " (" + e.name + ")", hexadecimal(e.hash),
                    hexadecimal(a.hash) +
                        (same_object ? std::string()
                                     : " of object " + std::to_string(a.index) + " (" + a.name + ")"));
            }
        }
    }

    std::string body_name(std::size_t index) const {
        const std::string number = "body " + std::to_string(index);
        return index < expected_.bodies.size() ? number + " (" + expected_.bodies[index].name + ")" : number;
    }

    void compare_digests(const TickRecord& expected, const TickRecord& actual, const std::string& name) {
        if (expected.bodies.size() != actual.bodies.size()) {
            add(name + ", bodies", std::to_string(expected.bodies.size()),
                std::to_string(actual.bodies.size()));
            return;
        }
        for (std::size_t i = 0; i < expected.bodies.size(); ++i) {
            if (expected.bodies[i] != actual.bodies[i]) {
                add(name + ", " + body_name(i), short_hexadecimal(expected.bodies[i]),
                    short_hexadecimal(actual.bodies[i]));
            }
        }
    }

    void compare_bodies() {
        for (std::size_t i = 0; i < expected_.bodies.size(); ++i) {
            const BodyRecord& e = expected_.bodies[i];
            const std::string name = "last tick, " + body_name(i);
            const auto text = [](const BodyRecord& body) {
                return body.metres + " m, rotation " + body.rotation;
            };
            if (i >= actual_.bodies.size()) {
                add(name, text(e), "nothing");
            } else if (actual_.bodies[i].name != e.name) {
                add(name, e.name, actual_.bodies[i].name);
            } else if (text(actual_.bodies[i]) != text(e)) {
                add(name, text(e), text(actual_.bodies[i]));
            }
        }
        if (expected_.bodies.size() < actual_.bodies.size()) {
            add("bodies", std::to_string(expected_.bodies.size()), std::to_string(actual_.bodies.size()));
        }
    }

    void compare_points() {
        for (std::size_t i = 0; i < expected_.points.size(); ++i) {
            const PointRecord& e = expected_.points[i];
            const bool present = i < actual_.points.size() && actual_.points[i].object == e.object &&
                                 actual_.points[i].vertex == e.vertex;
            const std::string name = "last tick, object " + e.object + ", vertex " + std::to_string(e.vertex);
            if (!present) {
                add(name, e.metres + " m", "nothing");
            } else if (actual_.points[i].raw != e.raw || actual_.points[i].metres != e.metres) {
                add(name, e.metres + " m (raw " + e.raw + ")",
                    actual_.points[i].metres + " m (raw " + actual_.points[i].raw + ")");
            }
        }
        if (expected_.points.size() < actual_.points.size()) {
            add("points", std::to_string(expected_.points.size()), std::to_string(actual_.points.size()));
        }
    }

    const GoldenState& expected_;
    const GoldenState& actual_;
    std::size_t limit_;
    std::vector<std::string> sentences_;
};

// What means the same but is not the same text: a comment, an order, a record of the wrong place.
std::vector<std::string> different_line(const std::string& expected, const std::string& actual,
                                        const std::string& scene) {
    std::istringstream expected_lines(expected);
    std::istringstream actual_lines(actual);
    for (std::size_t number = 1;; ++number) {
        std::string expected_line;
        std::string actual_line;
        const bool more_expected = static_cast<bool>(std::getline(expected_lines, expected_line));
        const bool more_actual = static_cast<bool>(std::getline(actual_lines, actual_line));
        if (!more_expected && !more_actual) {
            return {};
        }
        if (!expected_line.empty() && expected_line.back() == '\r') {
            expected_line.pop_back();
        }
        if (more_expected != more_actual || expected_line != actual_line) {
            return {"scene " + scene + ", line " + std::to_string(number) +
                    " of the golden state: it says '" + expected_line + "' and must be '" + actual_line +
                    "'."};
        }
    }
}

} // namespace

const TickRecord* GoldenState::find_tick(std::uint64_t tick) const {
    const auto found = std::find_if(ticks.begin(), ticks.end(),
                                    [tick](const TickRecord& record) { return record.tick == tick; });
    return found == ticks.end() ? nullptr : &*found;
}

std::string to_text(const GoldenState& state) {
    std::ostringstream text;
    text << title << ' ' << format_version << "\nscene " << state.scene << '\n';
    for (const auto& [key, value] : state.parameters) {
        text << key << ' ' << value << '\n';
    }
    for (const TickRecord& tick : state.ticks) {
        text << "\ntick " << tick.tick << " state " << hexadecimal(tick.state) << " local "
             << hexadecimal(tick.local) << '\n';
        for (const ObjectRecord& object : tick.objects) {
            text << "tick " << tick.tick << " object " << object.index << ' ' << object.name << ' '
                 << hexadecimal(object.hash) << '\n';
        }
        for (std::size_t i = 0; i < tick.bodies.size(); ++i) {
            if (i % digests_a_line == 0) {
                text << "tick " << tick.tick << " bodies " << i;
            }
            const bool ends = (i + 1) % digests_a_line == 0 || i + 1 == tick.bodies.size();
            text << ' ' << short_hexadecimal(tick.bodies[i]) << (ends ? "\n" : "");
        }
    }
    text << "\n# At the last tick: raw units of 2^-56 m from the object's origin, and metres in the world.\n";
    for (const PointRecord& point : state.points) {
        text << "point " << point.object << ' ' << point.vertex << " raw " << point.raw << " metres "
             << point.metres << '\n';
    }
    for (std::size_t i = 0; i < state.bodies.size(); ++i) {
        const BodyRecord& body = state.bodies[i];
        text << "body " << i << ' ' << body.name << " metres " << body.metres << " rotation " << body.rotation
             << '\n';
    }
    return text.str();
}

bool parse(const std::string& text, GoldenState& state, std::string& error) {
    GoldenState parsed;
    if (!Parser(text, parsed).run(error)) {
        return false;
    }
    state = std::move(parsed);
    return true;
}

std::vector<std::string> differences(const GoldenState& expected, const GoldenState& actual,
                                     std::size_t limit) {
    return Comparison(expected, actual, limit).run();
}

std::vector<std::string> differences(const std::string& expected_text, const GoldenState& actual,
                                     std::size_t limit) {
    GoldenState expected;
    std::string error;
    if (!parse(expected_text, expected, error)) {
        return {"scene " + actual.scene + ": " + error};
    }
    std::vector<std::string> found = differences(expected, actual, limit);
    if (found.empty()) {
        found = different_line(expected_text, to_text(actual), actual.scene);
    }
    return found;
}

} // namespace lks_golden
