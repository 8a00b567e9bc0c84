// Which of the rows that push one way only do push, as it is found by exchanging those that are wrong (block
// principal pivoting; Júdice and Pires 1994): all at once while that makes them fewer, and one by one where
// it doesn't, which comes to an end.
#pragma once

#include <cstdint>

namespace lks {

// solve() with those that push, count_wrong() behind it, and turn_round(count) exchanges so many of them.
template <typename Solve, typename Count, typename Turn>
void exchange_rows(const Solve& solve, const Count& count_wrong, const Turn& turn_round) {
    constexpr int most_passes = 24; // a few are enough as a rule
    constexpr int most_patience = 3;
    std::uint32_t least = UINT32_MAX;
    int patience = most_patience;
    for (int pass = 0; pass < most_passes; ++pass) {
        solve();
        const std::uint32_t wrong = count_wrong();
        if (wrong == 0 || pass + 1 == most_passes) {
            return;
        }
        bool whole = true;
        if (wrong < least) {
            least = wrong;
            patience = most_patience;
        } else {
            whole = patience-- > 0;
        }
        turn_round(whole ? wrong : 1);
    }
}

} // namespace lks
