// What a cloth or a rope is made into before it is numbered, and the steps that all kinds of assets share.
#pragma once

#include "api/report.h"
#include "asset/asset.h"

namespace lks {

// A distance constraint between two vertices, coloured within its family.
struct Draft {
    std::uint32_t a;
    std::uint32_t b;
    std::uint32_t family;
    std::uint32_t colour;
};

// Everything in the caller's numbering.
struct Build {
    Build(lks_asset& target, lks_error* sentence)
        : asset(target), error(sentence), positions(target.allocator), masses(target.allocator),
          drafts(target.allocator), order(target.allocator) {}

    lks_result fail(lks_result result, const Sentence& sentence) const {
        return report(error, result, sentence);
    }
    lks_result fail_out_of_memory() const {
        return fail(LKS_ERROR_OUT_OF_MEMORY, Sentence() << "The allocator has no memory for an asset.");
    }

    lks_asset& asset;
    lks_error* error;
    Array<Coordinates> positions; // by vertex
    Array<fixed::Scaled> masses;  // by vertex, kg
    Array<Draft> drafts;
    Array<std::uint32_t> order; // the vertex of each particle
};

// Turns a complete build into the asset: particles in their order, constraints in batches and runs, rest
// lengths, incidences.
lks_result assemble(Build& build);

// The exact distance of two positions, rounded to the nearest coordinate unit; INT64_MAX from 128 m on.
std::int64_t distance_between(const Coordinates& a, const Coordinates& b);
// The exact square of it in units of 2^-112 m².
fixed::UInt128 squared_distance(const Coordinates& a, const Coordinates& b);

// Of a complete asset.
std::uint64_t compute_fingerprint(const lks_asset& asset);

} // namespace lks
