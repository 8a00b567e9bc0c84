#include "bench_command.h"

#include <cstdio>

#include "program/commands.h"
#include "program/messages.h"

namespace lks_program {

int bench(const BenchOptions& options) {
    lks_bench::BenchOptions passed;
    passed.parts = options.parts;
    passed.rounds = options.rounds;
    passed.list = options.list;
    passed.json = options.json;
    passed.report = options.report;
    passed.once = options.once;
    passed.program = options.program;
    return lks_bench::run_bench(
        passed, [](const std::string& sentence) { complain(sentence, exit_failed); },
        [](const std::string& part) { std::fprintf(stderr, "bench: %s ...\n", part.c_str()); });
}

} // namespace lks_program
