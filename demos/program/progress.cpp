#include "program/progress.h"

#include <cstdio>

#ifdef _WIN32
#include <io.h>
#else
#include <unistd.h>
#endif

namespace lks_program {
namespace {

bool standard_error_is_terminal() {
#ifdef _WIN32
    return _isatty(_fileno(stderr)) != 0;
#else
    return isatty(fileno(stderr)) != 0;
#endif
}

std::string duration(double seconds) {
    const auto whole = static_cast<long>(seconds + 0.5);
    char text[32];
    std::snprintf(text, sizeof(text), "%ld:%02ld", whole / 60, whole % 60);
    return text;
}

} // namespace

Progress::Progress(std::string label, std::uint64_t total)
    : label_(std::move(label)), total_(total), terminal_(standard_error_is_terminal()) {}

Progress::~Progress() {
    if (terminal_ && shown_) {
        std::fprintf(stderr, "\r\033[K");
    }
}

void Progress::update(std::uint64_t done) {
    const Clock::time_point now = Clock::now();
    const double interval = terminal_ ? 0.1 : 2.0;
    if (total_ == 0 || std::chrono::duration<double>(now - last_).count() < interval) {
        return;
    }
    last_ = now;
    shown_ = true;
    const double elapsed = std::chrono::duration<double>(now - start_).count();
    const double share = static_cast<double>(done) / static_cast<double>(total_);
    const std::string remaining = share > 0.0 ? duration(elapsed * (1.0 - share) / share) : std::string("?");
    std::fprintf(stderr, terminal_ ? "\r\033[K%s: %3.0f %%, %s left" : "%s: %3.0f %%, %s left\n",
                 label_.c_str(), 100.0 * share, remaining.c_str());
    std::fflush(stderr);
}

} // namespace lks_program
