// Threads that sleep until they are woken, do one piece of work each, and sleep again.
#pragma once

#include <cstdint>

namespace lks {

class Workers {
public:
    Workers() = default;
    ~Workers() { stop(); }
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;

    // work(context, i) is what thread i of `count` does when it is woken. False: no thread or no memory, and
    // none runs. Where there are no threads, none is started and that is all right.
    [[nodiscard]] bool start(std::uint32_t count, void (*work)(void* context, std::uint32_t index),
                             void* context);
    void wake();
    // Until all that were woken have done their work.
    void wait();
    void stop();

private:
    struct State;
    State* state_ = nullptr;
};

} // namespace lks
