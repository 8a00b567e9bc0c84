// The experiments of the XPBD paper (Macklin, Müller, Chentanez 2016, section 6), measured.
#pragma once

#include <string>
#include <vector>

#include "reference/particle_scene.h"

namespace lks_accuracy {

// What the paper itself gives.
struct PaperFigure {
    int iterations;
    double value;
};
// The chain's force, worst relative error.
inline constexpr PaperFigure paper_chain_errors[] = {{50, 0.06}, {100, 0.02}, {1000, 0.005}};
// Milliseconds a step of its cloth of 24 thousand constraints, XPBD, on a GTX 1070; PBD within 3 % of it.
inline constexpr PaperFigure paper_cloth_milliseconds[] = {{20, 0.97}, {40, 1.78}, {80, 3.34}, {160, 5.65}};

// A mass of 1 kg on a spring of 1 m and 1e-3 m/N, let go at 1.5 m, for 100 frames.
struct SpringRun {
    std::string solver;
    double rate_hz = 60;
    int iterations = 1;
    double period = 0;                 // seconds; 0: it does not swing
    std::vector<double> elongations{}; // metres, by frame
};
inline constexpr double spring_compliance = 1e-3;
inline constexpr double spring_mass = 1;
inline constexpr double pbd_spring_stiffness = 0.1; // k, for comparison
reference::ParticleScene spring_scene();
double analytic_spring_period();
// Of elongations so many seconds apart; 0: it does not swing.
double spring_period(const std::vector<double>& elongations, double step);
// Of the implicit step itself: 2πh / atan(ωh).
double implicit_spring_period(double rate_hz);
SpringRun run_spring(reference::Engine engine, double rate_hz, int iterations,
                     double stiffness = pbd_spring_stiffness);

// 20 particles of 1 kg, 1 m apart, 1e-8 m/N, held at one end and let go horizontally; 100 frames. The load
// is carried through 19 links anew in each frame: in the first ones, which start from nothing, no sweep can.
inline constexpr std::size_t chain_frames_of_start = 10;
struct ChainRun {
    std::string solver;
    double rate_hz = 0;
    int iterations = 0;
    std::vector<double> forces{}; // at the fixed end, newtons, by frame
    // Relative to Newton's force in the same frame: in the first one, and the worst after the start.
    double first_error = 0;
    double worst_error = 0;
    double worst_of_peak = 0; // over all frames, relative to Newton's greatest force
};
// Newton first, then each engine at each number of iterations.
std::vector<ChainRun> run_chain(const std::vector<reference::Engine>& engines, double rate_hz,
                                const std::vector<int>& iterations, lks_rope_solver solver = LKS_ROPE_SWEPT);

// A beam of St. Venant-Kirchhoff triangles held at one end, E = 1e5, ν = 0.3, 50 frames of 8 ms.
struct BeamRun {
    std::string solver;
    int iterations = 0;        // 0: Newton
    std::vector<double> tip{}; // height of the free end's middle, metres, by frame
    double worst_distance = 0; // of the tip from Newton's, metres
    double rounding = 0;       // of float32, the tip's from the same in double precision, metres
};
struct Beam {
    std::vector<BeamRun> runs; // Newton first, then XPBD at each number of iterations, then its float32 build
    std::vector<double> residual{};          // |h| of eq. 9 in one frame, by iteration, XPBD
    std::vector<double> momentum_residual{}; // |g| of eq. 8
    std::vector<double> newton_residual{};
};
Beam run_beam(const std::vector<int>& iterations);

// A hanging cloth that comes to rest: how far the middle of its lower edge hangs below where it would be
// unstretched, by iterations.
struct SagRun {
    std::string solver;
    int iterations = 0;
    double sag = 0;          // metres
    double milliseconds = 0; // the least that a step took
};
struct ClothHang {
    std::uint32_t side = 64;
    double compliance = 0; // m/N
    double seconds = 4;
    double pbd_stiffness = 0.01;
};
std::vector<SagRun> run_cloth(const ClothHang& cloth, const std::vector<reference::Engine>& engines,
                              const std::vector<int>& iterations);

// A shell of springs around a volume that is held at 1.5 times its own, without gravity.
struct BalloonRun {
    std::string solver;
    double shell_compliance = 0;  // m/N
    double volume_compliance = 0; // m⁶/J
    int iterations = 0;
    double volume = 0;  // reached, of the rest volume
    double stretch = 0; // mean of the shell
};
std::vector<BalloonRun> run_balloon(const std::vector<double>& shell_compliances,
                                    const std::vector<double>& volume_compliances,
                                    const std::vector<int>& iterations);

} // namespace lks_accuracy
