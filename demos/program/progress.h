// Progress on standard error: a line that is rewritten on a terminal, with the time that remains; elsewhere a
// plain line every two seconds. Nothing for what takes less than that.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace lks_program {

class Progress {
public:
    Progress(std::string label, std::uint64_t total);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void update(std::uint64_t done);

private:
    using Clock = std::chrono::steady_clock;

    std::string label_;
    std::uint64_t total_;
    bool terminal_;
    bool shown_ = false;
    Clock::time_point start_ = Clock::now();
    Clock::time_point last_ = start_;
};

} // namespace lks_program
