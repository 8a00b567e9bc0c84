// Which objects may go through a tick side by side, in one call of a kernel: ropes and small cloths of one
// asset that are pinned at the same vertices. A single rope's runs are too short to fill a kernel's time.
#pragma once

#include <cstddef>

#include "kernels/kernels.h"
#include "solver/distance.h"
#include "solver/object.h"

namespace lks {

// Whether it may with others at all.
bool may_go_side_by_side(const Kernels& kernels, const Object& object);
// Of two that may.
bool are_alike(const Object& a, const Object& b);

// Makes the first one's work that of all; `places` is room for `count`, to be kept as long as the work. One
// object alone stays alone.
void put_side_by_side(const Object* const* objects, std::uint32_t count, DistanceWork& work,
                      std::ptrdiff_t* places);

// Takes objects one after the other, and calls run(objects, count) for those that follow each other and may
// go side by side, and for any other by itself.
template <typename Run>
class Neighbours {
public:
    Neighbours(const Kernels& kernels, const Run& run) : kernels_(kernels), run_(run) {}

    void add(Object& object) {
        const bool may = may_go_side_by_side(kernels_, object);
        if (count_ == most_side_by_side || (count_ != 0 && !(may && are_alike(*objects_[0], object)))) {
            finish();
        }
        objects_[count_++] = &object;
        if (!may) {
            finish();
        }
    }

    // The last ones, too.
    void finish() {
        const std::uint32_t together = count_ < least_side_by_side ? 1 : count_;
        for (std::uint32_t i = 0; i < count_; i += together) {
            run_(objects_ + i, together);
        }
        count_ = 0;
    }

private:
    const Kernels& kernels_;
    const Run& run_;
    Object* objects_[most_side_by_side];
    std::uint32_t count_ = 0;
};

} // namespace lks
