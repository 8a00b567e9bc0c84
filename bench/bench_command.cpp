#include "bench_command.h"

#include <algorithm>
#include <cstdio>

#include "report.h"
#include "report_files.h"
#include "sections.h"
#include "variant.h"

namespace lks_bench {
namespace {

constexpr int failed = 1;
constexpr int bad_use = 2;
constexpr const char* growth_name = "growth";
constexpr const char* instructions_name = "instructions";

struct Section {
    const char* name;
    const char* title;
};

constexpr Section sections[] = {
    {ratios_name, "soft, damped, 256² and ropes beside a 64² cloth, all in turns"},
    {snapshots_name, "save, load and hash of a 256² cloth beside memcpy"},
    {overhead_name, "a tick with next to nothing to do"},
    {sleep_name, "humanoids that lie on the ground, asleep and awake"},
    {queries_name, "rays, overlaps and nearest points among bodies, colliders and particles"},
    {contacts_name, "a 64² cloth lies on a collider of each kind"},
    {ragdolls_name, "100 humanoids of 12 bodies fall on a plane, beside Bullet"},
    {pile_name, "30 humanoids of 15 bodies fall into a pit, beside Bullet"},
    {coupling_name, "12 humanoids with capes, ropes from hand to hand: what coupling costs, and its errors"},
    {ropes_name, "a rope of 99 segments, swept and solved at once: cost and stretch"},
    {growth_name, "1,000 to 1,000,000 constraints"},
    {bodies_name, "1,250 to 20,000 balls on the ground"},
    {accuracy_name, "residual stretch against cost, substeps × iterations"},
    {instructions_name, "instructions a projection, by valgrind"},
};

void list_all() {
    for (const Workload& workload : workloads()) {
        std::printf("%-20s %s\n", workload.name.c_str(), workload.title.c_str());
    }
    for (const Section& section : sections) {
        std::printf("%-20s %s\n", section.name, section.title);
    }
}

std::vector<std::string> chosen_parts(const BenchOptions& options) {
    std::vector<std::string> parts = options.parts;
    if (parts.empty()) {
        for (const Workload& workload : workloads()) {
            parts.push_back(workload.name);
        }
        for (const Section& section : sections) {
            const std::string name = section.name;
            if (!options.report.empty() || name == snapshots_name || name == overhead_name) {
                parts.push_back(name);
            }
        }
    }
    return parts;
}

bool exists(const std::string& part) {
    return find_workload(part) != nullptr ||
           std::any_of(std::begin(sections), std::end(sections),
                       [&](const Section& section) { return part == section.name; });
}

void print(const Results& results, std::size_t from) {
    std::string heading;
    for (std::size_t i = from; i < results.size(); ++i) {
        const Result& r = results[i];
        if (r.workload != heading) {
            heading = r.workload;
            const Workload* workload = find_workload(heading);
            std::printf("%s%s%s\n", heading.c_str(), workload != nullptr ? ": " : "",
                        workload != nullptr ? workload->title.c_str() : "");
        }
        std::printf("  %-12s %-34s %10.4g %s", r.measured.c_str(), r.variant.c_str(), r.value,
                    r.unit.c_str());
        if (r.ratio != 0) {
            std::printf("  × %.3f", r.ratio);
        }
        if (r.best != 0) {
            std::printf("  best %.4g", r.best);
        }
        if (r.low != 0) {
            std::printf("  half of the rounds: %.3f to %.3f", r.low, r.high);
        }
        std::printf("\n");
    }
    std::fflush(stdout);
}

// False, with a sentence: it can't be measured here.
bool measure(const std::string& part, const BenchOptions& options, Results& results, std::string& error) {
    constexpr int usual = 21;
    const int rounds = options.rounds != 0 ? static_cast<int>(options.rounds) : usual;
    if (part == ratios_name) {
        measure_ratios(rounds, results);
    } else if (part == snapshots_name) {
        measure_snapshots(rounds, results);
    } else if (part == overhead_name) {
        measure_overhead(rounds, results);
    } else if (part == sleep_name) {
        measure_sleep(rounds, results);
    } else if (part == queries_name) {
        measure_queries(rounds, results);
    } else if (part == contacts_name) {
        measure_contacts(rounds, results);
    } else if (part == ragdolls_name) {
        measure_ragdolls(rounds, results);
    } else if (part == pile_name) {
        measure_pile(rounds, results);
    } else if (part == coupling_name) {
        measure_coupling(rounds, results);
    } else if (part == ropes_name) {
        measure_ropes(rounds, results);
    } else if (part == growth_name) {
        measure_growth(rounds, results);
    } else if (part == bodies_name) {
        measure_bodies(rounds, results);
    } else if (part == accuracy_name) {
        measure_accuracy(rounds, results);
    } else if (part == instructions_name) {
        return count_instructions(options.program, results, error);
    } else {
        measure_workload(*find_workload(part), rounds, options.rounds == 0, results);
    }
    return true;
}

} // namespace

int run_bench(const BenchOptions& options, const std::function<void(const std::string&)>& complain,
              const std::function<void(const std::string&)>& progress) {
    if (options.list) {
        list_all();
        return 0;
    }
    const std::vector<std::string> parts = chosen_parts(options);
    for (const std::string& part : parts) {
        if (!exists(part)) {
            complain("There is no workload '" + part + "'; --list shows all.");
            return bad_use;
        }
    }
    if (!options.once.empty()) {
        const Workload* workload = find_workload(parts.front());
        const std::vector<std::string> names =
            workload != nullptr ? variant_names(*workload) : std::vector<std::string>();
        if (std::find(names.begin(), names.end(), options.once) == names.end()) {
            complain("There is no variant '" + options.once + "' of " + parts.front() + ".");
            return bad_use;
        }
        project_once(*find_workload(parts.front()), options.once);
        return 0;
    }
    Results results;
    std::string error;
    if (!options.report.empty() && !prepare_report(options.report, complain)) {
        return failed;
    }
    for (const std::string& part : parts) {
        progress(part);
        const std::size_t before = results.size();
        if (!measure(part, options, results, error)) {
            complain(error);
            // A report goes without what this machine can't measure.
            if (options.report.empty()) {
                return failed;
            }
        }
        if (!options.json) {
            print(results, before);
        }
    }
    if (options.json) {
        std::fputs(to_json(results).c_str(), stdout);
    }
    if (!options.report.empty() && !write_report(options.report, results, error)) {
        complain(error);
        return failed;
    }
    return 0;
}

} // namespace lks_bench
