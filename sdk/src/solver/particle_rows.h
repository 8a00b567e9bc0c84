// Objects of which most constraints stand in no run are swept in rows: x, y and z of a particle follow each
// other, and a kernel finds them with one load where arrays take three. The arrays are what everybody else
// works on; rows are taken from them before a sweep, and given back behind the last one that nobody looks on
// between. The bits are the same.
#pragma once

#include <cstddef>

#include "asset/asset.h"
#include "kernels/kernels.h"
#include "solver/object.h"

namespace lks {

bool is_swept_in_rows(const Kernels& kernels, const lks_asset& asset, const Coefficients& coefficients);

// How many numbers the rows of any object of this asset take.
std::size_t row_words(const lks_asset& asset, const Coefficients& coefficients);

// One object's, in scratch of row_words().
class ParticleRows {
public:
    ParticleRows(Object& object, std::int64_t* scratch);

    DistanceArrays arrays() const;
    // Of some particles, from a whole group on; of all before anybody asks for any.
    void take(const Kernels& kernels, std::uint32_t first, std::uint32_t count) const;
    void give_back(const Kernels& kernels, std::uint32_t first, std::uint32_t count) const;

private:
    RowTask positions_;
    RowTask starts_;
    bool damped_; // only then are starts asked for
    std::int64_t* multipliers_;
};

} // namespace lks
