// The sums and differences of fixed/integer.h, which are defined for every input, by their short names. Those
// of coordinates wrap like unsigned numbers: particles inside their range never get there, and what leaves it
// is clamped and counted by the next prediction. Those of World positions saturate: opposite ends of the
// world are further apart than 64 bits hold.
#pragma once

#include "fixed/integer.h"

namespace lks {

using fixed::saturating_add;
using fixed::saturating_subtract;
using fixed::wrapping_add;
using fixed::wrapping_multiply;
using fixed::wrapping_subtract;

} // namespace lks
