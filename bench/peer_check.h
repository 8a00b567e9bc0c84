// Whether a peer solves the asset's constraints with the asset's masses: a body that nothing holds keeps its
// centre of mass, in whatever order and by whatever formula its edges are corrected.
#pragma once

#include <string>
#include <vector>

#include "asset/asset.h"
#include "plain_float.h"
#include "variant.h"

namespace lks_bench {

// Where a point at rest is put, so that edges are off their lengths, towards one border otherwise than
// towards the other: where only borders are lighter, wrong shares would cancel out between opposite ones.
Point out_of_place(const Point& rest);
void put_out_of_place(FloatCloth& cloth);

// By vertex, before and after one projection of all edges. Exits with a sentence where the centre moved.
void demand_centre_kept(const lks_asset& asset, const std::string& peer, const std::vector<Point>& before,
                        const std::vector<Point>& after);

} // namespace lks_bench
