// A dense linear system of the rigid reference solver.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace reference {

// A·x = b for a symmetric positive A, by L·D·Lᵀ.
template <typename Scalar>
class SymmetricSystem {
public:
    // Row by row; only the lower half is read.
    void factor(std::size_t size, std::vector<Scalar> a) {
        size_ = size;
        lower_ = std::move(a);
        for (std::size_t i = 0; i < size_; ++i) {
            for (std::size_t j = 0; j <= i; ++j) {
                Scalar rest = at(i, j);
                for (std::size_t k = 0; k < j; ++k) {
                    rest -= at(i, k) * at(j, k) * at(k, k);
                }
                at(i, j) = i == j ? rest : rest / at(j, j);
            }
        }
    }

    void solve(std::vector<Scalar>& b) const {
        for (std::size_t i = 0; i < size_; ++i) {
            for (std::size_t k = 0; k < i; ++k) {
                b[i] -= at(i, k) * b[k];
            }
        }
        for (std::size_t i = 0; i < size_; ++i) {
            b[i] /= at(i, i);
        }
        for (std::size_t i = size_; i-- > 0;) {
            for (std::size_t k = i + 1; k < size_; ++k) {
                b[i] -= at(k, i) * b[k];
            }
        }
    }

private:
    Scalar& at(std::size_t i, std::size_t j) { return lower_[i * size_ + j]; }
    const Scalar& at(std::size_t i, std::size_t j) const { return lower_[i * size_ + j]; }

    std::size_t size_ = 0;
    std::vector<Scalar> lower_;
};

} // namespace reference
