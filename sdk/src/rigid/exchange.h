// Which of the rows that push one way only do push, as it is found by exchanging those that are wrong (block
// principal pivoting; Júdice and Pires 1994): all at once while that makes them fewer, and one by one where
// it doesn't, which comes to an end.
#pragma once

#include <cstdint>

namespace lks {

class Exchange {
public:
    // A few are enough as a rule.
    static constexpr int most_passes = 24;

    // True: all at once.
    bool is_whole(std::uint32_t wrong) {
        if (wrong < least_) {
            least_ = wrong;
            patience_ = most_patience;
            return true;
        }
        return patience_-- > 0;
    }

private:
    static constexpr int most_patience = 3;
    std::uint32_t least_ = UINT32_MAX;
    int patience_ = most_patience;
};

} // namespace lks
