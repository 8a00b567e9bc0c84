#include "solver/pins.h"

#include "solver/wrapping.h"

namespace lks {

std::int64_t interpolate_coordinate(std::int64_t from, std::int64_t to, std::uint32_t numerator,
                                    std::uint32_t denominator) {
    const std::int64_t difference = wrapping_subtract(to, from);
    if (difference == 0) {
        return from;
    }
    const auto n = static_cast<std::int64_t>(numerator);
    const auto d = static_cast<std::int64_t>(denominator);
    // |quotient · n| ≤ |difference|, and the remainder is below d ≤ 1000: nothing overflows.
    return wrapping_add(from, difference / d * n + difference % d * n / d);
}

void begin_pin_motion(Object& object) {
    object.pin_starts.clear();
    for (const Pin& pin : object.pins()) {
        object.pin_starts.push_reserved(object.position(pin.particle));
    }
}

void place_pins(Object& object, std::uint32_t substep, std::uint32_t substeps) {
    for (std::size_t i = 0; i < object.pins().size(); ++i) {
        const Pin& pin = object.pins()[i];
        const Coordinates& start = object.pin_starts[i];
        const auto place = [&](int axis, std::int64_t from, std::int64_t to) {
            object.start_axis(axis)[pin.particle] = interpolate_coordinate(from, to, substep - 1, substeps);
            object.axis(axis)[pin.particle] = interpolate_coordinate(from, to, substep, substeps);
        };
        place(0, start.x, pin.target.x);
        place(1, start.y, pin.target.y);
        place(2, start.z, pin.target.z);
    }
}

} // namespace lks
