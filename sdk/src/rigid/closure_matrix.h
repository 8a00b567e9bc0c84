// How what closes a figure's loops moves by pushes in it, with all that the trees make of it: the S of
// rigid/closures.h.
//
// With J M⁻¹ Jᵀ = L D Lᵀ, joint by joint from the leaves on as the trees' factors have it,
//
//     S = C M⁻¹ Cᵀ − Bᵀ D⁻¹ B,    B = L⁻¹ J M⁻¹ Cᵀ:
//
// a push in a row is followed from its bodies to the root, and what two rows have in common are the joints
// on the way of both.
#pragma once

#include "rigid/closure_rows.h"
#include "rigid/figures.h"

namespace lks {

// Of rows that are placed, behind the trees' factors: row by row up to the diagonal, in their scales. Without
// what their own springs give.
void find_closure_matrix(RigidScene& scene, const FigureRange& figure, ClosureRows& rows,
                         std::int64_t* matrix);

} // namespace lks
