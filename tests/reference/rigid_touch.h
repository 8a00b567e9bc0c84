// Where any two shapes of the rigid reference solver touch.
#pragma once

#include "reference/rigid_manifold_boxes.h"
#include "reference/rigid_manifold_segment_box.h"

namespace reference {

// Points of at most so much separation. A plane only as b. `side` is the normal that they touched with
// before, or zero.
template <typename Scalar>
Manifold<Scalar> touch(const Piece<Scalar>& a, const Piece<Scalar>& b, Scalar margin,
                       const Vector3<Scalar>& side) {
    Manifold<Scalar> out(margin, a.radius + b.radius);
    if (b.kind == LKS_SHAPE_PLANE) {
        touch_plane(a, b, out);
    } else if (a.kind == LKS_SHAPE_BOX && b.kind == LKS_SHAPE_BOX) {
        TwoBoxes<Scalar>(a, b, side, out).touch();
    } else if (b.kind == LKS_SHAPE_BOX) {
        SegmentAndBox<Scalar>(a, b, side, out).touch();
    } else if (a.kind == LKS_SHAPE_BOX) {
        SegmentAndBox<Scalar>(b, a, side * Scalar(-1), out).touch();
        out.turn_round();
    } else {
        touch_segments(a, b, out);
    }
    return out;
}

} // namespace reference
