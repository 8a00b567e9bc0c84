// Float32 as a peer: with the care that ours got, and as one writes it in an afternoon.
#pragma once

#include "variant.h"

namespace lks_bench {

std::vector<std::string> float_peer_names();
std::unique_ptr<Variant> make_float_peer(const Workload& workload, const std::string& name);

} // namespace lks_bench
