#include "program/frame_times.h"

#include <algorithm>
#include <fstream>

namespace lks_program {
namespace {

constexpr std::uint64_t nanoseconds_per_second = 1000000000;
constexpr std::int64_t longest_frame = 100000000000000;

bool parse_frame(const std::string& text, std::int64_t& length) {
    const std::size_t first = text.find_first_not_of(" \t");
    const std::size_t last = text.find_last_not_of(" \t\r");
    const std::string digits = text.substr(first, last - first + 1);
    if (digits.size() > 15 || digits.find_first_not_of("0123456789") != std::string::npos) {
        return false;
    }
    length = std::stoll(digits);
    return length <= longest_frame;
}

} // namespace

FrameTimes FrameTimes::at_rate(std::uint32_t hertz) {
    FrameTimes times;
    times.hertz_ = hertz;
    return times;
}

bool FrameTimes::from_file(const std::string& path, FrameTimes& times, std::string& error) {
    std::ifstream file(path);
    if (!file) {
        error = "The schedule " + path + " can't be opened.";
        return false;
    }
    times = FrameTimes();
    std::size_t number = 0;
    for (std::string line; std::getline(file, line);) {
        ++number;
        const std::string text = line.substr(0, line.find('#'));
        if (text.find_first_not_of(" \t\r") == std::string::npos) {
            continue;
        }
        std::int64_t length = 0;
        if (!parse_frame(text, length)) {
            error = "Line " + std::to_string(number) + " of the schedule " + path +
                    " is not a whole number of nanoseconds up to 10^14: " + line;
            return false;
        }
        times.lengths_.push_back(length);
    }
    if (std::all_of(times.lengths_.begin(), times.lengths_.end(),
                    [](std::int64_t length) { return length == 0; })) {
        error = "The schedule " + path + " has no frame that takes time.";
        return false;
    }
    return true;
}

std::int64_t FrameTimes::next() {
    const std::uint64_t frame = frame_++;
    if (!lengths_.empty()) {
        return lengths_[frame % lengths_.size()];
    }
    const auto time = [this](std::uint64_t n) {
        const std::uint64_t whole = n / hertz_;
        const std::uint64_t rest = n % hertz_;
        const std::uint64_t part = (rest * nanoseconds_per_second + hertz_ - 1) / hertz_;
        return static_cast<std::int64_t>(whole * nanoseconds_per_second + part);
    };
    return time(frame + 1) - time(frame);
}

} // namespace lks_program
