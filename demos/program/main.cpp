// The `lockstitch` program: lists, runs, renders and checks the demo scenes.
#include <lockstitch/lockstitch.h>

#include <CLI/CLI.hpp>

#include <cstdio>

#ifdef _WIN32
#include <fcntl.h>
#include <io.h>
#endif

#include "program/commands.h"
#include "program/machine_options.h"
#include "program/messages.h"
#include "scenes/nearest_name.h"

namespace lks_program {
namespace {

const char* const gl_help = "How to get OpenGL: auto, egl or osmesa";

// An empty word is a script's variable that was never set, and no wish for the default.
std::string check_not_empty(const std::string& word) {
    return word.empty() ? "it is empty" : "";
}

class CommandLine {
public:
    CommandLine()
        : app_("Deterministic fixed-point physics: runs, renders and checks the demo scenes.", "lockstitch") {
        app_.require_subcommand(1);
        app_.set_version_flag("--version", std::string(LOCKSTITCH_VERSION_TEXT) + ", solver version " +
                                               std::to_string(lks_solver_version()));
        app_.footer("Examples:\n"
                    "  lockstitch list\n"
                    "  lockstitch run cloth_hang --ticks 300 --hash-every 60\n"
                    "  lockstitch render rope_wrap --fps 30 --out out\n"
                    "  lockstitch check\n"
                    "`lockstitch COMMAND --help` tells more.");
        add_list();
        add_run();
        add_render();
        add_bench();
        add_accuracy();
        add_golden("check", "Compare scenes with their golden states and images", check_options_, check,
                   "Examples:\n"
                   "  lockstitch check\n"
                   "  lockstitch check cloth_hang flag --states-only --simd scalar --workers 4\n"
                   "Exit code 1 if anything differs; out/check/index.html shows the pictures side by side.");
        add_golden("bless", "Make the present states and images the golden ones", bless_options_, bless,
                   "Examples:\n"
                   "  lockstitch bless rope_wrap\n"
                   "  lockstitch bless --images-only\n"
                   "Read golden/README.md first, and look at what changed before you commit it.");
    }

    int run(int argc, char** argv) {
        warn_of_environment();
        bench_options_.program = argv[0];
        try {
            app_.parse(argc, argv);
        } catch (const CLI::CallForHelp& help) {
            return app_.exit(help);
        } catch (const CLI::CallForVersion& version) {
            return app_.exit(version);
        } catch (const CLI::ParseError& error) {
            return complain(explain(error, argc, argv), exit_usage);
        }
        return code_;
    }

private:
    void add_list() {
        CLI::App* command = app_.add_subcommand("list", "Show the scenes");
        command->add_flag("--json", list_options_.json, "As JSON");
        command->footer("Example:\n  lockstitch list --json");
        command->callback([this] { code_ = list(list_options_); });
    }

    void add_run() {
        CLI::App* command = app_.add_subcommand("run", "Run a scene and print the hashes of its states");
        command->add_option("SCENE", run_options_.scene, "The scene")->required();
        command
            ->add_option("--ticks", run_options_.ticks, "How many ticks; the scene's own number by default")
            ->check(CLI::Range(1u, 100000000u));
        CLI::Option* rate = command
                                ->add_option("--frame-rate", run_options_.frame_rate,
                                             "Let real time pass in frames of this rate instead of stepping")
                                ->check(CLI::Range(1u, 100000u));
        command
            ->add_option("--schedule", run_options_.schedule,
                         "Let real time pass in frames of the nanoseconds in this file, one a line")
            ->check(check_not_empty)
            ->excludes(rate);
        add_machine(*command, run_options_.machine);
        command->add_option(
            "--offset-km", run_options_.offset_km,
            "Move the scene this far along x, exactly, as far as all of it stays within 8,388 km");
        command->add_option("--hash-every", run_options_.hash_every, "Also print every so many ticks");
        command->add_flag("--json", run_options_.json, "As JSON");
        command->footer("Examples:\n"
                        "  lockstitch run flag --ticks 240 --hash-every 10\n"
                        "  lockstitch run flag --frame-rate 144\n"
                        "  lockstitch run flag --offset-km 7000.5\n"
                        "  lockstitch run flag --simd scalar");
        command->callback([this] { code_ = lks_program::run(run_options_); });
    }

    void add_render() {
        CLI::App* command = app_.add_subcommand("render", "Draw scenes into PNG files, without a display");
        command->add_option("SCENE", render_options_.scenes, "The scenes");
        command->add_flag("--all", render_options_.all, "All scenes");
        command
            ->add_option("--ticks", render_options_.ticks,
                         "How many ticks; the scene's own number by default")
            ->check(CLI::Range(1u, 100000000u));
        command->add_option("--fps", render_options_.frames_per_second, "Pictures a second of simulated time")
            ->check(CLI::Range(1u, 1000u))
            ->capture_default_str();
        command->add_option("--size", render_options_.size, "WIDTHxHEIGHT")->capture_default_str();
        command->add_option("--out", render_options_.out, "Pictures go into this folder's SCENE folders")
            ->check(check_not_empty)
            ->capture_default_str();
        add_gl(*command, render_options_.gl);
        command->footer("Examples:\n"
                        "  lockstitch render cloth_drape\n"
                        "  lockstitch render --all --fps 30 --size 1920x1080 --out film");
        command->callback([this] { code_ = render(render_options_); });
    }

    void add_bench() {
        CLI::App* command =
            app_.add_subcommand("bench", "Measure what projections, ticks and snapshots cost");
        CLI::Option* parts =
            command->add_option("PART", bench_options_.parts, "Workloads and sections; see --list");
        command
            ->add_option(
                "--rounds", bench_options_.rounds,
                "How often each is measured, for medians: 21, or fewer where it takes long. "
                "Below 21 ragdolls_* and ropes_swing take three ticks a round instead of their whole "
                "motion")
            ->check(CLI::Range(1u, 100000u));
        command
            ->add_option("--report", bench_options_.report,
                         "Measures everything, some minutes, and writes report.md, results.json, results.csv "
                         "and plots into this folder")
            ->check(check_not_empty);
        command->add_flag("--list", bench_options_.list, "What can be measured")->excludes(parts);
        command->add_flag("--json", bench_options_.json, "As JSON");
        command->add_option("--once", bench_options_.once, "Run one variant of one workload once")->group("");
        command->footer("Variants take turns within rounds; × is the ratio to the first one, the median of\n"
                        "the ratios within rounds. All of ours give the same bits.\n\n"
                        "Examples:\n"
                        "  lockstitch bench cloth_64\n"
                        "  lockstitch bench cloth_64 cloth_256 snapshots --rounds 101 --json\n"
                        "  lockstitch bench --report out/bench");
        command->callback([this] { code_ = bench(bench_options_); });
    }

    void add_accuracy() {
        CLI::App* command =
            app_.add_subcommand("accuracy", "Measure error, and what it costs to make it smaller");
        CLI::Option* parts = command->add_option("EXPERIMENT", accuracy_options_.parts,
                                                 "The experiments, all by default; see --list");
        command->add_flag("--quick", accuracy_options_.quick,
                          "A small grid of settings: seconds instead of minutes");
        command->add_flag("--long", accuracy_options_.long_times,
                          "The hanging cloth for 10 seconds; spring and heavy rope for 60 also with --quick");
        command
            ->add_option("--report", accuracy_options_.report,
                         "report.md, results.json, results.csv and plots in this folder")
            ->check(check_not_empty);
        command->add_flag("--list", accuracy_options_.list, "What can be measured")->excludes(parts);
        command->add_flag("--json", accuracy_options_.json, "As JSON");
        command->footer(
            "The experiments of the XPBD paper, and work-precision over substeps × iterations: ours,\n"
            "float32, double precision, PBD and Bullet against converged solutions. With --report two "
            "sheets\n"
            "a scene are drawn, against cost and against projections, with a panel for every measure.\n\n"
            "Examples:\n"
            "  lockstitch accuracy paper_chain paper_beam\n"
            "  lockstitch accuracy rope_heavy_end --report out/rope\n"
            "  lockstitch accuracy cloth_hang --quick --json\n"
            "  lockstitch accuracy --report out/accuracy");
        command->callback([this] { code_ = accuracy(accuracy_options_); });
    }

    void add_golden(const char* name, const char* description, GoldenOptions& options,
                    int (*action)(const GoldenOptions&), const char* footer) {
        CLI::App* command = app_.add_subcommand(name, description);
        command->add_option("SCENE", options.scenes, "The scenes; all by default");
        CLI::Option* states = command->add_flag("--states-only", options.states_only, "No images");
        command->add_flag("--images-only", options.images_only, "No states")->excludes(states);
        command
            ->add_option("--golden", options.golden, "The folder with states/ and images/; golden by default")
            ->check(check_not_empty);
        command->add_option("--out", options.out, "Where failures are shown")
            ->check(check_not_empty)
            ->capture_default_str();
        add_gl(*command, options.gl);
        add_machine(*command, options.machine);
        command->footer(footer);
        command->callback([this, action, &options] { code_ = action(options); });
    }

    static void add_machine(CLI::App& command, MachineOptions& machine) {
        command.add_option("--workers", machine.workers, "Threads at work: the same hashes")
            ->check(CLI::Range(1u, LKS_MAX_WORKERS));
        command
            .add_option("--simd", machine.simd,
                        "auto, scalar, sse4.1, avx2, avx512, neon or wasm: the same hashes")
            ->check(check_not_empty);
    }

    static void add_gl(CLI::App& command, std::string& gl) {
        command.add_option("--gl", gl, gl_help)
            ->check(CLI::IsMember({"auto", "egl", "osmesa"}))
            ->capture_default_str();
    }

    // One sentence, with the nearest valid name where a word is unknown.
    std::string explain(const CLI::ParseError& error, int argc, char** argv) {
        const CLI::App* command = &app_;
        std::vector<std::string> commands;
        for (const CLI::App* candidate : app_.get_subcommands([](CLI::App*) { return true; })) {
            commands.push_back(candidate->get_name());
            command = *candidate ? candidate : command;
        }
        if (argc > 1 && command == &app_ && argv[1][0] != '-') {
            return "There is no command '" + std::string(argv[1]) + "'" +
                   lks_demo::did_you_mean(argv[1], commands) + " `lockstitch --help` shows all.";
        }
        const std::string help =
            "`lockstitch " + (command == &app_ ? std::string() : command->get_name() + " ") + "--help`";
        std::vector<std::string> options;
        for (const CLI::Option* option : command->get_options()) {
            for (const std::string& name : option->get_lnames()) {
                options.push_back("--" + name);
            }
        }
        for (int i = 1; i < argc; ++i) {
            const std::string word = std::string(argv[i]).substr(0, std::string(argv[i]).find('='));
            if (word.rfind("--", 0) == 0 &&
                std::find(options.begin(), options.end(), word) == options.end()) {
                return "There is no option '" + word + "'" + lks_demo::did_you_mean(word, options) + " " +
                       help + " shows all.";
            }
        }
        return std::string(error.what()) + "; " + help + " shows how.";
    }

    CLI::App app_;
    ListOptions list_options_;
    RunOptions run_options_;
    RenderOptions render_options_;
    BenchOptions bench_options_;
    AccuracyOptions accuracy_options_;
    GoldenOptions check_options_;
    GoldenOptions bless_options_;
    int code_ = 0;
};

} // namespace
} // namespace lks_program

int main(int argc, char** argv) {
#ifdef _WIN32
    // The same bytes as everywhere else: no carriage returns in what other programs compare.
    _setmode(_fileno(stdout), _O_BINARY);
#endif
    try {
        return lks_program::CommandLine().run(argc, argv);
    } catch (const std::exception& error) {
        return lks_program::complain(error.what(), lks_program::exit_failed);
    }
}
