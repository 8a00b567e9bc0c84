// Authored numbers in sentences.
#pragma once

#include "api/authoring_number.h"
#include "api/report.h"

namespace lks {

// Prints the number in decimal, up to nine significant digits, from its bits: `sentence <<
// Authored{def.mass}`.
struct Authored {
    double value;
};

Sentence& operator<<(Sentence& sentence, const Authored& number);
// The same for what was computed from authored numbers.
Sentence& operator<<(Sentence& sentence, const SignedScaled& number);

} // namespace lks
