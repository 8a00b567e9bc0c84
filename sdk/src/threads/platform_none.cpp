#include "threads/platform.h"

#if defined(__EMSCRIPTEN__) && !defined(__EMSCRIPTEN_PTHREADS__)

namespace lks {

std::uint64_t current_thread() {
    return 1;
}

void give_way() {}

bool Workers::start(std::uint32_t, void (*)(void*, std::uint32_t), void*) {
    return true;
}

void Workers::wake() {}

void Workers::wait() {}

void Workers::stop() {}

} // namespace lks

#endif
