// An object's coordinates as kernels want them.
#pragma once

#include "collide/contact.h"
#include "kernels/distance_task.h"
#include "solver/object.h"

namespace lks {

inline DistanceArrays distance_arrays(Object& object) {
    return {object.axis(0),
            object.axis(1),
            object.axis(2),
            object.start_axis(0),
            object.start_axis(1),
            object.start_axis(2),
            object.multipliers.empty() ? nullptr : object.multipliers.data()};
}

// Where particles began the substep, as if they were there now.
inline DistanceArrays start_arrays(Object& object) {
    DistanceArrays arrays = distance_arrays(object);
    arrays.x = object.start_axis(0);
    arrays.y = object.start_axis(1);
    arrays.z = object.start_axis(2);
    return arrays;
}

inline ParticleArrays particle_arrays(Object& object) {
    return {object.axis(0),       object.axis(1),       object.axis(2),
            object.start_axis(0), object.start_axis(1), object.start_axis(2)};
}

} // namespace lks
