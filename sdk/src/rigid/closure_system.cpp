#include "rigid/closure_system.h"

#include <algorithm>

#include "rigid/exchange.h"
#include "rigid/fine_algebra.h"

namespace lks {
namespace {

using namespace tree_detail;

// What has been pushed, or is left, stays far from 64 bits.
constexpr std::int64_t greatest_part = std::int64_t{1} << 58;

class ClosureSystem {
public:
    ClosureSystem(const std::int64_t* matrix, ClosureUnknown* rows, std::uint32_t count, int give_shift)
        : matrix_(matrix), rows_(rows), count_(count), give_shift_(give_shift) {}

    void find() {
        for (std::uint32_t i = 0; i < count_; ++i) {
            ClosureUnknown& row = rows_[i];
            row.pushes = row.side == 0 || toward(row, row.pushed) > 0 || toward(row, -row.left) > 0;
        }
        exchange_rows(
            [this] {
                factor();
                find_pushes();
            },
            [this] { return count_wrong(); }, [this](std::uint32_t count) { turn_round(count); });
        // Also where it did not come to an end.
        for (std::uint32_t i = 0; i < count_; ++i) {
            ClosureUnknown& row = rows_[i];
            if (row.side != 0 && toward(row, row.pushed + row.more) < 0) {
                row.more = -row.pushed;
            }
        }
    }

private:
    // In the direction in which it pushes.
    static std::int64_t toward(const ClosureUnknown& row, std::int64_t value) {
        return row.side < 0 ? -value : value;
    }

    // Of the rows that push.
    void factor() {
        used_ = 0;
        for (std::uint32_t i = 0; i < count_; ++i) {
            if (rows_[i].pushes) {
                which_[used_++] = i;
            }
        }
        for (std::uint32_t i = 0; i < used_; ++i) {
            std::int64_t scaled[most_closure_rows]; // L times D
            std::int64_t* const lower_i = lower_ + entry_of(i, 0);
            for (std::uint32_t j = 0; j <= i; ++j) {
                const std::int64_t* const lower_j = lower_ + entry_of(j, 0);
                fixed::ProductSum others;
                for (std::uint32_t k = 0; k < j; ++k) {
                    others.add(scaled[k], lower_j[k]);
                }
                const std::int64_t rest =
                    minus(matrix_[entry_of(which_[i], which_[j])], others.shifted(fine_fraction_bits));
                if (j == i) {
                    const ClosureUnknown& row = rows_[which_[i]];
                    pivots_[i] = invert_fine(plus(rest, plus(row.give, row.own >> give_shift_)));
                } else {
                    scaled[j] = rest;
                    lower_i[j] = divide(rest, pivots_[j]);
                }
            }
        }
    }

    // Those that don't push take back what they have pushed. What the softness of the others leaves is solved
    // for again, while it is more than a thousandth of what is let be: what is not singular is as exact as
    // without.
    void find_pushes() {
        constexpr int rounds = 5;
        for (std::uint32_t i = 0; i < count_; ++i) {
            rows_[i].more = rows_[i].pushes ? 0 : -rows_[i].pushed;
        }
        for (int round = 0; round < rounds; ++round) {
            std::int64_t x[most_closure_rows];
            bool more = false;
            for (std::uint32_t i = 0; i < used_; ++i) {
                x[i] = minus(0, left_of(which_[i]));
                const std::int64_t least = rows_[which_[i]].slack >> 10;
                more = more || x[i] > least || x[i] < -least;
            }
            if (!more) {
                return;
            }
            solve(x);
            for (std::uint32_t i = 0; i < used_; ++i) {
                ClosureUnknown& row = rows_[which_[i]];
                row.more = std::clamp(plus(row.more, x[i]), -greatest_part, greatest_part);
            }
        }
    }

    void solve(std::int64_t (&x)[most_closure_rows]) const {
        for (std::uint32_t i = 0; i < used_; ++i) {
            fixed::ProductSum others;
            for (std::uint32_t k = 0; k < i; ++k) {
                others.add(lower_[entry_of(i, k)], x[k]);
            }
            x[i] = minus(x[i], others.shifted(fine_fraction_bits));
        }
        for (std::uint32_t i = used_; i-- > 0;) {
            x[i] = divide(x[i], pivots_[i]);
            fixed::ProductSum others;
            for (std::uint32_t k = i + 1; k < used_; ++k) {
                others.add(lower_[entry_of(k, i)], x[k]);
            }
            x[i] = minus(x[i], others.shifted(fine_fraction_bits));
        }
    }

    // With all that is pushed more by now.
    std::int64_t left_of(std::uint32_t i) const {
        fixed::ProductSum moved;
        moved.add(rows_[i].give, rows_[i].more);
        const std::int64_t* const row = matrix_ + entry_of(i, 0);
        for (std::uint32_t j = 0; j <= i; ++j) {
            moved.add(row[j], rows_[j].more);
        }
        for (std::uint32_t j = i + 1; j < count_; ++j) {
            moved.add(matrix_[entry_of(j, i)], rows_[j].more);
        }
        return plus(rows_[i].left, moved.shifted(fine_fraction_bits));
    }

    // Those that would pull, or that don't push and are exceeded.
    bool is_wrong(std::uint32_t i) const {
        const ClosureUnknown& row = rows_[i];
        if (row.side == 0) {
            return false;
        }
        return row.pushes ? toward(row, row.pushed + row.more) < 0
                          : toward(row, minus(0, left_of(i))) > row.slack;
    }
    std::uint32_t count_wrong() const {
        std::uint32_t wrong = 0;
        for (std::uint32_t i = 0; i < count_; ++i) {
            wrong += is_wrong(i) ? 1u : 0u;
        }
        return wrong;
    }
    // The last `count` of them.
    void turn_round(std::uint32_t count) {
        bool wrong[most_closure_rows];
        for (std::uint32_t i = 0; i < count_; ++i) {
            wrong[i] = is_wrong(i);
        }
        for (std::uint32_t i = count_; i-- > 0 && count > 0;) {
            if (wrong[i]) {
                rows_[i].pushes = !rows_[i].pushes;
                --count;
            }
        }
    }

    const std::int64_t* matrix_;
    ClosureUnknown* rows_;
    std::uint32_t count_;
    int give_shift_;
    std::uint32_t used_ = 0;
    std::uint32_t which_[most_closure_rows];
    std::int64_t lower_[most_closure_entries];
    FineInverse pivots_[most_closure_rows];
};

} // namespace

void solve_rows(const std::int64_t* matrix, ClosureUnknown* rows, std::uint32_t count, int give_shift) {
    ClosureSystem(matrix, rows, count, give_shift).find();
}

} // namespace lks
