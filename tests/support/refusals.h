// What "refused" means everywhere: the right result, one sentence that names the value, and nothing changed.
#pragma once

#include <lockstitch/lockstitch.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cctype>
#include <string>

#include "support/handles.h"

namespace support {

inline std::string lower_case(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
}

// `value` is what the sentence must contain, in one of several spellings separated by '|'.
inline bool names(const std::string& message, const std::string& value) {
    const std::string text = lower_case(message);
    for (std::size_t from = 0; from <= value.size();) {
        const std::size_t to = std::min(value.find('|', from), value.size());
        if (text.find(lower_case(value.substr(from, to - from))) != std::string::npos) {
            return true;
        }
        from = to + 1;
    }
    return false;
}

inline void check_sentence(const std::string& message, const std::string& value) {
    INFO("message: " << message << "\nvalue: " << value);
    CHECK(message.size() > 10);
    CHECK(message.size() < LKS_MESSAGE_CAPACITY);
    CHECK(message.back() == '.');
    CHECK(names(message, value));
}

inline void check_asset_refused(lks_cloth_def def, lks_result expected, const std::string& value) {
    INFO("value: " << value);
    lks_error error{};
    lks_asset* const untouched = reinterpret_cast<lks_asset*>(&error);
    lks_asset* asset = untouched;
    def.error = &error;
    CHECK(lks_asset_create_cloth(&def, &asset) == expected);
    CHECK(asset == untouched);
    CHECK(error.result == expected);
    check_sentence(error.message, value);
    def.error = nullptr; // works without anybody to tell, too
    CHECK(lks_asset_create_cloth(&def, &asset) == expected);
}

inline void check_asset_refused(lks_rope_def def, lks_result expected, const std::string& value) {
    INFO("value: " << value);
    lks_error error{};
    lks_asset* const untouched = reinterpret_cast<lks_asset*>(&error);
    lks_asset* asset = untouched;
    def.error = &error;
    CHECK(lks_asset_create_rope(&def, &asset) == expected);
    CHECK(asset == untouched);
    CHECK(error.result == expected);
    check_sentence(error.message, value);
    def.error = nullptr;
    CHECK(lks_asset_create_rope(&def, &asset) == expected);
}

inline void check_world_refused(lks_world_def def, lks_result expected, const std::string& value) {
    INFO("value: " << value);
    lks_error error{};
    lks_world* const untouched = reinterpret_cast<lks_world*>(&error);
    lks_world* world = untouched;
    def.error = &error;
    CHECK(lks_world_create(&def, &world) == expected);
    CHECK(world == untouched);
    CHECK(error.result == expected);
    check_sentence(error.message, value);
    def.error = nullptr;
    CHECK(lks_world_create(&def, &world) == expected);
}

// `call` is made on a world with something in it.
template <typename Call>
void check_call_refused(const World& world, lks_result expected, const std::string& value, Call call) {
    INFO("value: " << value);
    const std::uint64_t hash = world.hash();
    const Image image = world.save();
    CHECK(call() == expected);
    CHECK(world.hash() == hash);
    CHECK(world.save() == image);
    CHECK(lks_world_last_error(world)->result == expected);
    check_sentence(world.message(), value);
}

} // namespace support
