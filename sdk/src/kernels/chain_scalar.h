// The steps of solver/chain.h in which no segment waits for another, in plain integers: what kernels over
// lanes compare with and leave rare groups to. Functions of their own, compiled for every machine.
#pragma once

#include "kernels/chain_task.h"

namespace lks {

void measure_segments_scalar(ChainSegments& segments, std::uint32_t first, std::uint32_t count);
void measure_turns_scalar(ChainSegments& segments, std::uint32_t first, std::uint32_t count);
bool measure_changes_scalar(ChainSegments& segments, std::uint32_t first, std::uint32_t count);
void solve_rows_scalar(ChainRows& rows, std::uint32_t first, std::uint32_t count);
// From pushes.
void move_chain_scalar(ChainMoves& moves, std::uint32_t first, std::uint32_t count);
void cross_particles_scalar(ChainAcross& task, std::uint32_t first, std::uint32_t count);
// Of the segments before these particles.
bool leaves_off_scalar(const ChainAcross& task, std::uint32_t first, std::uint32_t count);

// As kernels/chain_task.h names them.
void measure_chain_scalar(ChainSegments& segments);
bool stretch_chain_scalar(ChainSegments& segments);
void turn_chain_scalar(ChainRows& rows);
void divide_chain_scalar(ChainRows& rows);
void solve_chain_scalar(ChainRows& rows);
void push_chain_scalar(ChainMoves& moves);
bool stiffen_chain_scalar(ChainTensions& tensions);
void share_chain_scalar(ChainShares& shares);
bool cross_chain_scalar(ChainAcross& task);
constexpr ChainKernels chain_scalar{measure_chain_scalar, stretch_chain_scalar, turn_chain_scalar,
                                    divide_chain_scalar,  solve_chain_scalar,   push_chain_scalar,
                                    stiffen_chain_scalar, share_chain_scalar,   cross_chain_scalar};

} // namespace lks
