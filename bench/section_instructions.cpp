#include <cstdio>
#include <cstdlib>

#include "sections.h"
#include "variant.h"

#if defined(_WIN32)
#define LKS_NOINLINE
#else
#define LKS_NOINLINE __attribute__((noinline))
#endif

// Found by its name by callgrind, which collects from its beginning to its end.
extern "C" LKS_NOINLINE void lks_bench_collected(lks_bench::Variant& variant) {
    variant.project();
    // Something behind the call: a jump in its place would leave this function before the work.
    std::fflush(stderr);
}

namespace lks_bench {
namespace {

// Of one line of callgrind's: "==123== Collected : 12345".
double collected_in(const std::string& text) {
    const std::size_t at = text.find("Collected : ");
    return at != std::string::npos ? std::strtod(text.c_str() + at + 12, nullptr) : 0;
}

#if !defined(_WIN32)
std::string output_of(const std::string& command) {
    std::string text;
    if (FILE* pipe = popen(command.c_str(), "r")) {
        char part[512];
        while (std::fgets(part, sizeof part, pipe) != nullptr) {
            text += part;
        }
        pclose(pipe);
    }
    return text;
}
#endif

} // namespace

void project_once(const Workload& workload, const std::string& variant) {
    Workload still = workload;
    still.warm_ticks = 1;
    lks_bench_collected(*make_variant(still, variant));
}

bool count_instructions(const std::string& program, Results& results, std::string& error) {
#if defined(_WIN32)
    (void)program;
    (void)results;
    error = "Counting instructions needs valgrind, which there is not on Windows.";
    return false;
#else
    if (output_of("valgrind --version 2>/dev/null").empty()) {
        error = "Counting instructions needs the program valgrind.";
        return false;
    }
    for (const char* name : {"cloth_64", "cloth_64_damped", "mesh_10k", "ropes_200"}) {
        const Workload& workload = *find_workload(name);
        const WorkloadAsset asset(workload);
        const double units = static_cast<double>(lks_asset_constraint_count(asset.get())) * workload.objects *
                             workload.substeps * workload.iterations;
        for (const std::string& variant : variant_names(workload)) {
            // Valgrind knows no AVX-512.
            if (variant.find("512") != std::string::npos) {
                continue;
            }
            const double count =
                collected_in(output_of("valgrind --tool=callgrind --callgrind-out-file=/dev/null "
                                       "--toggle-collect=lks_bench_collected '" +
                                       program + "' bench --once '" + variant + "' " + name + " 2>&1"));
            if (count > 0) {
                results.push_back({name, "instructions", variant, count / units, "a projection"});
            }
        }
    }
    return true;
#endif
}

} // namespace lks_bench
