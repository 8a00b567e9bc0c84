// The parts of a benchmark, each of which adds its rows. Variants take turns within rounds.
#pragma once

#include "results.h"
#include "workloads.h"

namespace lks_bench {

inline constexpr const char* ratios_name = "ratios";
inline constexpr const char* snapshots_name = "snapshots";
inline constexpr const char* overhead_name = "overhead";
inline constexpr const char* sleep_name = "sleep";
inline constexpr const char* queries_name = "queries";
inline constexpr const char* contacts_name = "contacts";
inline constexpr const char* ragdolls_name = "ragdolls_100";
inline constexpr const char* pile_name = "ragdolls_pile";
inline constexpr const char* coupling_name = "ragdolls_dressed";
inline constexpr const char* ropes_name = "ropes_swing";
inline constexpr const char* bodies_name = "bodies_growth";
inline constexpr const char* accuracy_name = "accuracy";

// Nanoseconds a projection by itself, the same within a tick, with two workers, and milliseconds a tick;
// bytes a particle and a constraint; the share of constraints in runs.
// `thrifty`: fewer rounds where each is long.
void measure_workload(const Workload& workload, int rounds, bool thrifty, Results& results);
// How many times as long a projection takes when it is soft or damped, in a large cloth, in ropes: these take
// turns within rounds, an instruction set of ours after the other.
void measure_ratios(int rounds, Results& results);
// Save, load and hash of a 256² cloth beside memcpy, GB/s.
void measure_snapshots(int rounds, Results& results);
// A tick in which there is next to nothing to do: of an empty world, and what one more object costs.
void measure_overhead(int rounds, Results& results);
// A tick of humanoids that lie on the ground, asleep and awake.
void measure_sleep(int rounds, Results& results);
// Rays, overlaps and nearest points in a box of ten metres: nanoseconds each.
void measure_queries(int rounds, Results& results);
// A 64² cloth that lies on a collider of each kind: milliseconds a tick.
void measure_contacts(int rounds, Results& results);
// 100 humanoids of 12 bodies fall in a block on a plane, and 30 of 15 bodies into a pit; nobody sleeps, 300
// ticks (fewer with fewer than 21 rounds): milliseconds a tick, how far joints are apart and what energy is
// gained, beside Bullet's rigid bodies; save, load and hash.
void measure_ragdolls(int rounds, Results& results);
void measure_pile(int rounds, Results& results);
// 12 humanoids of 15 bodies with capes on their shoulders, 9 ropes from hand to hand, fall on a plane: the
// same number of ticks; milliseconds a tick coupled, attached without contacts between particles and bodies,
// side by side with nothing in common, and of the bodies alone; how far joints and attachments are apart.
void measure_coupling(int rounds, Results& results);
// A rope of 99 segments swings for three seconds, its end 1 or 10,000 times as heavy as its points:
// nanoseconds a segment and substep of a whole tick, and the worst stretch of any segment, swept and solved
// at once.
void measure_ropes(int rounds, Results& results);
// Ours and float32 on cloths of 1,000 to 1,000,000 constraints.
void measure_growth(int rounds, Results& results);
// 1,250 to 20,000 balls side by side on the ground, at one substep: nanoseconds a body and tick.
void measure_bodies(int rounds, Results& results);
// A 64² cloth that is let go where it hangs from two corners, for two seconds: milliseconds a tick, and the
// root mean square of the relative stretch of its constraints over the last second, for substeps ×
// iterations.
void measure_accuracy(int rounds, Results& results);
// Instructions a projection, counted by valgrind. False, with a sentence: it can't be run.
bool count_instructions(const std::string& program, Results& results, std::string& error);
// What count_instructions runs under valgrind.
void project_once(const Workload& workload, const std::string& variant);

} // namespace lks_bench
