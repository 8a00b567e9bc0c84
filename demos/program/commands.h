// The program's commands, each with its options. They return the exit code: 0, 1 (the work failed), 2 (bad
// use).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace lks_program {

struct ListOptions {
    bool json = false;
};

struct MachineOptions {
    std::uint32_t workers = 1;
    std::string simd; // a name of lockstitch/simd.h; empty: the best
};

struct RunOptions {
    std::string scene;
    std::uint32_t ticks = 0; // 0: the scene's own
    std::uint32_t frame_rate = 0;
    std::string schedule; // a file of nanoseconds a frame
    std::string offset_km;
    std::uint32_t hash_every = 0; // 0: only the last
    MachineOptions machine;
    bool json = false;
};

struct RenderOptions {
    std::vector<std::string> scenes;
    bool all = false;
    std::uint32_t ticks = 0;
    std::uint32_t frames_per_second = 10;
    std::string size = "1280x720";
    std::string out = "out";
    std::string gl = "auto";
};

struct GoldenOptions {
    std::vector<std::string> scenes; // empty: all
    bool states_only = false;
    bool images_only = false;
    std::string golden; // empty: golden/ here, or where the program was built
    std::string out = "out/check";
    std::string gl = "auto";
    MachineOptions machine;
};

struct BenchOptions {
    std::vector<std::string> parts;
    std::uint32_t rounds = 21;
    bool list = false;
    bool json = false;
    std::string report;
    std::string once;
    std::string program; // this one, to be run under valgrind
};

struct AccuracyOptions {
    std::vector<std::string> parts;
    bool quick = false;
    bool long_times = false;
    bool list = false;
    bool json = false;
    std::string report;
};

int list(const ListOptions& options);
int run(const RunOptions& options);
int render(const RenderOptions& options);
int check(const GoldenOptions& options);
int bless(const GoldenOptions& options);
int bench(const BenchOptions& options);
int accuracy(const AccuracyOptions& options);

} // namespace lks_program
