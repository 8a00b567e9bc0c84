#include "report.h"

#include <algorithm>
#include <cstdio>

#include "measure.h"
#include "plots.h"
#include "report_files.h"
#include "workloads.h"

namespace lks_bench {
namespace {

std::string digits(double value) {
    char text[40];
    std::snprintf(text, sizeof text,
                  value != 0 && value < 0.01 ? "%.2e"
                  : value < 10               ? "%.2f"
                                             : "%.1f",
                  value);
    return text;
}

void add_once(std::vector<std::string>& names, const std::string& name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) {
        names.push_back(name);
    }
}

// What of a result names its row, and what its column.
using Label = const std::string& (*)(const Result&);
const std::string& by_workload(const Result& r) {
    return r.workload;
}
const std::string& by_measured(const Result& r) {
    return r.measured;
}
const std::string& by_variant(const Result& r) {
    return r.variant;
}

// Those results that `wanted` picks, as a table; nothing where it picks none.
template <typename Wanted>
std::string table(const Results& results, const std::string& title, Label row_of, Label column_of,
                  const Wanted& wanted) {
    std::vector<std::string> rows;
    std::vector<std::string> columns;
    for (const Result& r : results) {
        if (wanted(r)) {
            add_once(rows, row_of(r));
            add_once(columns, column_of(r));
        }
    }
    if (rows.empty()) {
        return {};
    }
    std::string text = "\n## " + title + "\n\n|";
    for (const std::string& column : columns) {
        text += " | " + column;
    }
    text += " |\n|---" + [&] {
        std::string line;
        for (std::size_t i = 0; i < columns.size(); ++i) {
            line += "|--:";
        }
        return line;
    }() + "|\n";
    for (const std::string& row : rows) {
        text += "| " + row;
        for (const std::string& column : columns) {
            std::string cell;
            for (const Result& r : results) {
                if (wanted(r) && row_of(r) == row && column_of(r) == column) {
                    cell = digits(r.value);
                    if (r.low != 0) {
                        cell += " (" + digits(r.low) + " to " + digits(r.high) + ")";
                    }
                }
            }
            text += " | " + cell;
        }
        text += " |\n";
    }
    return text;
}

std::string workload_list(const Results& results) {
    std::string text = "\n## Workloads\n\n| | | constraints | in runs | bytes a constraint (asset) | "
                       "bytes a particle (object) |\n|---|---|--:|--:|--:|--:|\n";
    const std::string head = text;
    for (const Workload& workload : workloads()) {
        const Result* count = find(results, workload.name, "constraints", "");
        const Result* share = find(results, workload.name, "in runs", "");
        const Result* asset = find(results, workload.name, "asset", "");
        const Result* object = find(results, workload.name, "object", "");
        if (count != nullptr && share != nullptr && asset != nullptr && object != nullptr) {
            char line[300];
            std::snprintf(line, sizeof line, "| %s | %s | %.0f | %.1f %% | %.1f | %.1f |\n",
                          workload.name.c_str(), workload.title.c_str(), count->value, 100 * share->value,
                          asset->value, object->value);
            text += line;
        }
    }
    return text == head ? std::string() : text;
}

bool is_peer(const Result& r) {
    return r.variant.rfind("float32", 0) == 0 || r.variant.rfind("Bullet", 0) == 0;
}

// Peers against each of ours, in what is measured of all of them in turns: within rounds.
std::string ratios(const Results& results, const std::string& measured, const std::string& title) {
    Results found;
    for (const Result& r : results) {
        if (r.measured != measured || r.times.empty() || is_peer(r)) {
            continue;
        }
        for (const Result& peer : results) {
            if (peer.measured == measured && peer.times.size() == r.times.size() &&
                peer.workload == r.workload && is_peer(peer)) {
                found.push_back({r.workload + ", " + r.variant, "", peer.variant,
                                 ratio_of(peer.times, r.times).median, ""});
            }
        }
    }
    return table(found, title + ": peers' time / ours (above 1: ours is faster)", by_workload, by_variant,
                 [](const Result&) { return true; });
}

std::string markdown(const Results& results, const std::vector<Plot>& plots) {
    std::string text = "# What Lockstitch costs\n\n" + machine_name() + "; " + run_name() +
                       ". One thread but where it says two workers. Medians of rounds in which all variants "
                       "take turns (the best of the rounds stands beside them in results.json and "
                       "results.csv); all variants of ours give the same bits.\n";
    text += workload_list(results);
    text += table(results, "Nanoseconds a constraint projection", by_workload, by_variant,
                  [](const Result& r) { return r.measured == "projection"; });
    text += ratios(results, "projection", "Projections");
    text += table(results,
                  "How many times as long a projection takes, within rounds (half of the rounds: from, to)",
                  by_variant, by_measured, [](const Result& r) { return r.workload == "ratios"; });
    text += table(results, "Nanoseconds a projection, whole tick", by_workload, by_variant,
                  [](const Result& r) { return r.measured == "tick" && r.unit == "ns a projection"; });
    text += ratios(results, "tick", "Whole ticks");
    text += table(results, "Threads, whole ticks, ns a projection", by_workload, by_variant,
                  [](const Result& r) { return r.measured == "threads"; });
    text += table(results, "Milliseconds a tick", by_workload, by_variant,
                  [](const Result& r) { return r.measured == "tick" && r.unit == "ms"; });
    text += table(results, "Over spheres: the deepest point of an object below a surface, in mm", by_workload,
                  by_variant, [](const Result& r) { return r.measured == "deepest"; });
    text +=
        table(results, "Over spheres: particles of an object within a millimetre of a surface, or below it",
              by_workload, by_variant, [](const Result& r) { return r.measured == "resting"; });
    text += table(results, "Instructions a projection (valgrind; knows no AVX-512)", by_workload, by_variant,
                  [](const Result& r) { return r.measured == "instructions"; });
    text += table(results, "Snapshots of a 256² cloth, GB/s", by_variant, by_measured,
                  [](const Result& r) { return r.unit == "GB/s"; });
    text += table(results, "Fixed cost of a tick, ns", by_variant, by_measured,
                  [](const Result& r) { return r.workload == "overhead"; });
    text += table(results, "Humanoids on the ground, ns a tick", by_variant, by_measured,
                  [](const Result& r) { return r.workload == "sleep"; });
    text += table(results, "Queries, ns each", by_variant, by_measured,
                  [](const Result& r) { return r.workload == "queries"; });
    text += table(results, "A 64² cloth that lies on a collider, ms a tick", by_measured, by_variant,
                  [](const Result& r) { return r.workload == "contacts"; });
    text +=
        table(results, "100 humanoids of 12 bodies that fall in a block: ms a tick, and joint errors in mm",
              by_variant, by_measured, [](const Result& r) { return r.workload == "ragdolls_100"; });
    text += table(results, "30 humanoids of 15 bodies that fall into a pit: the same", by_variant,
                  by_measured, [](const Result& r) { return r.workload == "ragdolls_pile"; });
    text += table(results, "12 humanoids with capes, ropes from hand to hand: ms a tick, and errors in mm",
                  by_variant, by_measured, [](const Result& r) { return r.workload == "ragdolls_dressed"; });
    text += table(results, "A rope of 99 segments that swings: ns a segment and substep, and worst stretch",
                  by_variant, by_measured, [](const Result& r) { return r.workload == "ropes_swing"; });
    text += table(results, "Residual stretch (root mean square), substeps × iterations", by_measured,
                  by_variant, [](const Result& r) { return r.unit == "relative stretch"; });
    text += table(results, "Milliseconds a tick of the same", by_measured, by_variant,
                  [](const Result& r) { return r.workload == "accuracy" && r.unit == "ms"; });
    for (const Plot& plot : plots) {
        text += "\n## " + std::string(plot.title) + "\n\n![" + plot.title + "](" + plot.file + ")\n";
    }
    return text;
}

} // namespace

bool write_report(const std::string& folder, const Results& results, std::string& error) {
    if (!make_folder(folder, error)) {
        return false;
    }
    std::vector<Plot> plots;
    const bool drawn = draw_plots(folder, results, plots, error);
    return write_file(folder, "results.json", to_json(results), error) &&
           write_file(folder, "results.csv", to_csv(results), error) &&
           write_file(folder, "report.md", markdown(results, drawn ? plots : std::vector<Plot>()), error) &&
           drawn;
}

} // namespace lks_bench
