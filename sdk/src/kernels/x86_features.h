// What an x86 processor and its operating system offer.
#pragma once

namespace lks {

struct X86Features {
    bool sse41;
    bool avx2;
    bool avx512; // F, BW, CD, DQ and VL
};

X86Features detect_x86_features();

} // namespace lks
