// The lengths of frames in nanoseconds, as a display or a recorded schedule gives them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace lks_program {

class FrameTimes {
public:
    // Frames of 1/hertz s: each is the difference of two rounded times, so that nothing drifts. Rounded up,
    // so that a tick that ends with a frame is due in it.
    static FrameTimes at_rate(std::uint32_t hertz);
    // One frame a line in nanoseconds, '#' begins a comment; repeated from the start when it ends. False,
    // with a sentence: the file can't be read or has no frame that takes time.
    static bool from_file(const std::string& path, FrameTimes& times, std::string& error);

    std::int64_t next();

private:
    std::uint32_t hertz_ = 0;
    std::vector<std::int64_t> lengths_;
    std::uint64_t frame_ = 0;
};

} // namespace lks_program
