// Around a kernel: registers as code of narrower instruction sets expects them. After 256- and 512-bit
// instructions the older 128-bit ones of a game run at half their speed until the upper halves are cleared,
// and compilers do not always see to it.
#pragma once

namespace lks {
namespace {

template <typename L, auto kernel, typename... Arguments>
inline auto leaving(Arguments... arguments) {
    struct Leave {
        ~Leave() { L::leave(); }
    };
    const Leave at_end;
    return kernel(arguments...);
}

} // namespace
} // namespace lks
