// How long a call takes.
#pragma once

#include <chrono>

namespace lks_accuracy {

template <typename Call>
double nanoseconds_of(const Call& call) {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point begin = Clock::now();
    call();
    return std::chrono::duration<double, std::nano>(Clock::now() - begin).count();
}

} // namespace lks_accuracy
